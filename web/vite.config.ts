import { execFileSync } from 'node:child_process';
import type { Plugin } from 'vite';
import { viteSingleFile } from 'vite-plugin-singlefile';
import { defineConfig } from 'vitest/config';

const built = (path: string) => new URL(`../build/${path}`, import.meta.url).pathname;

/** The WebAssembly core as text: compressed, it takes a third of the room. By LZMA it takes a
 * fifth less than by what browsers can undo themselves. */
const coreAsText: Plugin = {
  name: 'core-as-text',
  resolveId: (id) => (id === 'virtual:core' ? id : undefined),
  load: (id) =>
    id === 'virtual:core'
      ? `export default '${execFileSync('xz', ['--format=lzma', '--lzma1=preset=9e,lc=4,pb=0', '-c', built('wasm/poise.wasm')], { maxBuffer: 2 ** 26 }).toString('base64')}'`
      : undefined,
};

// One file that opens from the disk: scripts, styles and the WebAssembly core within it.
export default defineConfig({
  base: './',
  build: { target: 'es2022', rolldownOptions: { input: 'playground.html' } },
  resolve: { alias: { '@core': new URL('../bindings/wasm/poise.mjs', import.meta.url).pathname, '@examples': built('fixtures'),
    // The decoder alone: the package exports it with the encoder.
    '@lzma': new URL('node_modules/lzma1/lib', import.meta.url).pathname } },
  test: { include: ['test/*.test.ts'] },
  plugins: [coreAsText, viteSingleFile()],
});

import { readFileSync } from 'node:fs';
import { gzipSync } from 'node:zlib';
import type { Plugin } from 'vite';
import { viteSingleFile } from 'vite-plugin-singlefile';
import { defineConfig } from 'vitest/config';

const built = (path: string) => new URL(`../build/${path}`, import.meta.url).pathname;

/** The WebAssembly core as text: compressed, it takes a third of the room. */
const coreAsText: Plugin = {
  name: 'core-as-text',
  resolveId: (id) => (id === 'virtual:core' ? id : undefined),
  load: (id) =>
    id === 'virtual:core'
      ? `export default '${gzipSync(readFileSync(built('wasm/poise.wasm')), { level: 9 }).toString('base64')}'`
      : undefined,
};

// One file that opens from the disk: scripts, styles and the WebAssembly core within it.
export default defineConfig({
  base: './',
  build: { target: 'es2022', rolldownOptions: { input: 'playground.html' } },
  resolve: { alias: { '@core': built('wasm/poise.mjs'), '@examples': built('fixtures') } },
  test: { include: ['test/*.test.ts'] },
  plugins: [coreAsText, viteSingleFile()],
});

import { execFileSync } from 'node:child_process';
import { readFileSync, statSync } from 'node:fs';
import type { Plugin } from 'vite';
import { viteSingleFile } from 'vite-plugin-singlefile';
import { defineConfig } from 'vitest/config';
import { folded } from './src/fold.ts';

const built = (path: string) => new URL(`../build/${path}`, import.meta.url).pathname;

/** The WebAssembly core as text: compressed, it takes a third of the room. By LZMA it takes a
 * fifth less than by what browsers can undo themselves. */
const coreAsText: Plugin = {
  name: 'core-as-text',
  resolveId: (id) => (id === 'virtual:core' ? id : undefined),
  load: (id) => {
    if (id !== 'virtual:core') return undefined;
    const wasm = built('wasm/poise.wasm');
    const packed = execFileSync('xz', ['--format=lzma', '--lzma1=preset=9e,lc=4,pb=0,nice=64', '-c', wasm], { maxBuffer: 2 ** 26 });
    return `export const size = ${statSync(wasm).size}; export const text = '${packed.toString('base64')}'`;
  },
};

/** An example whose shape is a mesh: the grasp, and the mesh to draw. */
const foldedMeshes: Plugin = {
  name: 'folded-meshes',
  enforce: 'pre',
  load: (id) => {
    if (!id.endsWith('.mesh.json')) return undefined;
    const { grasp, mesh } = JSON.parse(readFileSync(id, 'utf8'));
    return JSON.stringify({ grasp, mesh: folded(mesh) });
  },
};

// One file that opens from the disk: scripts, styles and the WebAssembly core within it.
export default defineConfig({
  base: './',
  build: { target: 'es2022', modulePreload: { polyfill: false }, rolldownOptions: { input: 'playground.html' } },
  resolve: { alias: { '@core': new URL('../bindings/wasm/poise.mjs', import.meta.url).pathname, '@examples': built('fixtures') } },
  test: { include: ['test/*.test.{ts,mjs}'] },
  plugins: [coreAsText, foldedMeshes, viteSingleFile()],
});

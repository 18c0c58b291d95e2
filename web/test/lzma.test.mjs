import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { expect, test } from 'vitest';
import { unpacked } from '../src/lzma';

const packed = (bytes, options) => execFileSync('xz', ['--format=lzma', `--lzma1=${options}`, '-c'], { input: bytes, maxBuffer: 2 ** 26 });

// The same numbers in every run.
let state = 7;
const noise = (size) => Uint8Array.from({ length: size }, () => (state = (state * 48271) % 2147483647) >> 8);

test('what xz packs is unpacked', () => {
  const far = noise(70_000);
  const samples = {
    nothing: new Uint8Array(0),
    'one byte': Uint8Array.of(200),
    'one byte, often': new Uint8Array(100_000).fill(7),
    noise: far,
    'noise again, far back': Uint8Array.from([...far, ...noise(9), ...far.subarray(5)]),
    text: new TextEncoder().encode(JSON.stringify(Array.from(noise(9_000), (k) => ({ k, root: Math.sqrt(k) })))),
    'a program': readFileSync(process.execPath).subarray(0, 300_000),
  };
  for (const [name, bytes] of Object.entries(samples))
    for (const options of ['preset=9e,lc=4,pb=0,nice=64', 'preset=6', 'preset=1,lc=0,lp=4,pb=4', 'preset=9,lc=1,lp=2,pb=1'])
      expect(Buffer.compare(unpacked(packed(bytes, options), bytes.length), bytes), `${name}, ${options}`).toBe(0);
}, 60_000);

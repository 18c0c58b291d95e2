// Whether the WebAssembly module answers as the native program does: node fixtures_test.mjs MODULE
// FIXTURES. Numbers to 1e-9 of themselves, those near nothing to 1e-12; everything else exactly.
import { readdirSync, readFileSync } from 'node:fs';
import { pathToFileURL } from 'node:url';

const [module, fixtures] = process.argv.slice(2);
const { default: create } = await import(pathToFileURL(module));
const core = await create({ wasmBinary: readFileSync(module.replace('.mjs', '.wasm')) });
const answer = (request) =>
  JSON.parse(core.ccall('poise_answer', 'string', ['string'], [JSON.stringify(request)]));
const read = (file) => JSON.parse(readFileSync(`${fixtures}/${file}`, 'utf8'));

let compared = 0;
let worst = 0;
const failures = [];
const expect = (holds, what) => holds || failures.push(what);

function compare(found, wanted, path) {
  if (typeof wanted === 'number' && typeof found === 'number') {
    const error = Math.abs(found - wanted);
    const size = Math.max(Math.abs(found), Math.abs(wanted));
    ++compared;
    if (error > 1e-12) worst = Math.max(worst, error / size);
    expect(error <= Math.max(1e-9 * size, 1e-12), `${path}: ${found} instead of ${wanted}`);
  } else if (wanted === null || typeof wanted !== 'object') {
    expect(found === wanted, `${path}: ${found} instead of ${wanted}`);
  } else {
    const keys = (value) => Object.keys(value ?? {}).join();
    expect(keys(found) === keys(wanted), `${path}: ${keys(found)} instead of ${keys(wanted)}`);
    for (const key of Object.keys(wanted)) {
      // At a kink many y are optimal; which one is found is rounding. What it proves is compared.
      if (key === 'dual' && wanted.kind === 'kink') continue;
      compare(found?.[key], wanted[key], `${path}.${key}`);
    }
  }
}

const names = readdirSync(fixtures).filter((file) => file.endsWith('.grasp.json'));
expect(names.length >= 3, 'no fixtures');
for (const file of names) {
  const name = file.replace('.grasp.json', '');
  for (const command of ['check', 'hold', 'best', 'curve'])
    compare(answer({ command, grasp: read(file) }), read(`${name}.${command}.json`), `${name}.${command}`);
}

const grasp = read(names[0]);
const error = (request) => answer(request).error ?? {};
expect(error({ command: 'hold' }).path === 'grasp', 'a request without a grasp');
expect(error({ command: 'turn', grasp }).path === 'command', 'an unknown command');
expect(error({ command: 'hold', grasp, angel_deg: 3 }).path === 'angel_deg', 'an unknown key');
expect(error({ command: 'hold', grasp, force_cap: -1 }).path === 'force_cap', 'a bad force cap');
const broken = structuredClone(grasp);
broken.contacts[1].friction = -1;
const bad = error({ command: 'best', grasp: broken });
expect(bad.path === 'contacts[1].friction' && bad.problem === 'is -1, must be at least 0' && bad.column > 1,
  `a negative friction: ${JSON.stringify(bad)}`);
expect(answer({ command: 'hold', grasp, angle_deg: 540 }).angle_deg === 180, 'an angle beyond 180');

for (const failure of failures.slice(0, 20)) console.error(failure);
console.log(`${compared} numbers of ${names.length} examples compared, largest difference ${worst.toExponential(1)}`);
process.exit(failures.length ? 1 : 0);

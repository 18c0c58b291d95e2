// Whether the WebAssembly module answers as the native program does: node fixtures_test.mjs MODULE
// FIXTURES EXAMPLES PROGRAM. Numbers to 1e-9 of themselves, those near nothing to 1e-12, and to 1e-9 of
// the best posture in space; everything else exactly. Other minima in space are found by descent: V is
// flat there, so that V is as exact, and where it lies only to 1e-7; where a search went another way,
// to 1e-5.
import { spawnSync } from 'node:child_process';
import { mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { load } from './poise.mjs';

const [module, fixtures, examples, program] = process.argv.slice(2);
const call = await load(readFileSync(module));
const answer = (request) => JSON.parse(call(JSON.stringify(request)));
const read = (file) => JSON.parse(readFileSync(`${fixtures}/${file}`, 'utf8'));

let compared = 0;
let worst = 0;
const failures = [];
const expect = (holds, ...what) => holds || failures.push(what.join(' '));

function compare(found, wanted, path, exact = 1e-9) {
  if (typeof wanted === 'number' && typeof found === 'number') {
    const error = Math.abs(found - wanted);
    const size = Math.max(Math.abs(found), Math.abs(wanted));
    ++compared;
    if (exact === 1e-9 && error > 1e-12) worst = Math.max(worst, error / size);
    expect(error <= Math.max(exact * size, exact > 1e-9 ? exact : 1e-12), `${path}: ${found} instead of ${wanted}`);
  } else if (wanted === null || typeof wanted !== 'object') {
    expect(found === wanted, `${path}: ${found} instead of ${wanted}`);
  } else {
    const keys = (value) => Object.keys(value ?? {}).join();
    expect(keys(found) === keys(wanted), `${path}: ${keys(found)} instead of ${keys(wanted)}`);
    for (const key of Object.keys(wanted)) {
      // At a kink many y are optimal, and so are many cuts of a corner; which ones are found is
      // rounding. What they prove is compared: all cuts together to the gap that was asked for.
      if (key === 'dual' && (wanted.kind === 'kink' || exact > 1e-9)) continue;
      if (key === 'cuts' || key === 'holds') continue;
      if ((key === 'lower_bound' || key === 'relative_gap') && wanted.cuts && !sameSearch(found, wanted)) continue;
      const searched = ['minima', 'best', 'best_pinched', 'rotation', 'orientation', 'relative_gap'].includes(key);
      const flat = wanted.cuts && searched && (!sameSearch(found, wanted) ? 1e-5 : key === 'minima' ? 1e-7 : 1.1e-9);
      const ofHold = key !== 'effort' || 'force_norm' in wanted; // else of a drive
      const sure = ofHold && ['effort', 'force_norm', 'scenario_efforts', 'lower_bound'].includes(key);
      const listed = (each) => (key === 'minima' && flat ? [...each.minima].sort(inOrder) : each?.[key]);
      compare(listed(found), listed(wanted), `${path}.${key}`, sure ? 1e-9 : flat || exact);
    }
  }
}

/** Of equally good postures, rounding decides which one the search in space holds next. After that the
 * cuts are others, and so is the bound that they prove: each is to be within the gap. */
function sameSearch(found, wanted) {
  for (const { best, lower_bound, options: { gap } } of [found, wanted])
    if (best) expect(lower_bound <= best.effort * (1 + 1e-15) && best.effort - lower_bound <= gap * best.effort, 'a bound within the gap', lower_bound, best.effort);
  const near = (a, b) => Math.abs(a - b) <= 1e-6 * Math.max(Math.abs(a), Math.abs(b), 1);
  const same = found.holds === wanted.holds && found.cuts.length === wanted.cuts.length &&
    found.cuts.every((cut, k) => (cut.y ?? cut.n).every((part, i) => near(part, (wanted.cuts[k].y ?? wanted.cuts[k].n)?.[i])));
  searches[same ? 'same' : 'other'].add(found);
  return same;
}
const searches = { same: new Set(), other: new Set() };

/** Equally good minima may come in any order. */
const inOrder = (a, b) => {
  const keys = ({ effort, up }) => [effort.toPrecision(6), ...up.map((part) => Math.round(1000 * part))].map(Number);
  return keys(a).map((key, k) => key - keys(b)[k]).find((difference) => difference) ?? 0;
};

const folder = mkdtempSync(`${tmpdir()}/poise-`);
process.on('exit', () => rmSync(folder, { recursive: true }));
const names = readdirSync(fixtures).filter((file) => file.endsWith('.grasp.json'));
expect(names.length >= 3, 'no fixtures');
for (const file of names) {
  const name = file.replace('.grasp.json', '');
  const grasp = read(file);
  for (const command of ['check', 'hold', 'best', ...(grasp.dimension === 2 ? ['curve'] : [])]) {
    const found = answer({ command, grasp });
    compare(found, read(`${name}.${command}.json`), `${name}.${command}`);
    // What it proves holds, as the program finds that shares nothing with the solver.
    writeFileSync(`${folder}/result.json`, JSON.stringify(found));
    const { status, stdout, stderr } = spawnSync(program, ['verify', `${examples}/${name}.yaml`, `${folder}/result.json`], { encoding: 'utf8' });
    expect(status === 0, `${name}.${command} is refuted:`, stdout, stderr);
  }

  // The greatest weight is held, and a little more is not; so is the least friction.
  const { holdable, weight, greatest_weight, friction_factor } = answer({ command: 'margins', grasp });
  const held = (change) => {
    const other = structuredClone(grasp);
    change(other);
    return answer({ command: 'hold', grasp: other }).holdable;
  };
  const rubbed = (factor) => (other) => other.contacts.forEach((each) => {
    each.friction *= factor;
    if (each.torsion) each.torsion *= factor;
  });
  if (holdable && friction_factor > 1e-6) {
    expect(held(rubbed(1.0001 * friction_factor)), `${name}: the least friction`);
    expect(!held(rubbed(0.9999 * friction_factor)), `${name}: less than the least friction`);
  }
  if (holdable && greatest_weight !== null && grasp.object.weight) {
    expect(held((other) => void (other.object.weight = 0.9999 * greatest_weight)), `${name}: the greatest weight`, greatest_weight, weight);
    expect(!held((other) => void (other.object.weight = 1.0001 * greatest_weight)), `${name}: more than the greatest weight`);
  }
  if (grasp.dimension === 2) continue;

  // All around at once as one by one; no plane is above the effort anywhere, nor below the bound
  // outside of what the best posture proves.
  const best = answer({ command: 'best', grasp });
  const ups = [...best.minima.map(({ up }) => up), [1, 0, 0], [0, -2, 1], [0.3, 0.4, -0.5]];
  const { efforts } = answer({ command: 'efforts', grasp, ups });
  ups.forEach((up, k) => {
    const one = answer({ command: 'hold', grasp, up });
    const found = one.scenario_efforts ? Math.max(...one.scenario_efforts.map((each) => each ?? Infinity)) : one.effort;
    // Minima may lie on the border of what can be held, where rounding decides.
    if (k >= best.minima.length || (one.holdable && efforts[k] !== null))
      compare(efforts[k], one.holdable && found < Infinity ? found : null, `${name}.efforts[${k}]`);
  });
  const { planes } = answer({ command: 'planes', grasp, cuts: best.cuts });
  const proofs = planes.filter((_, k) => 'y' in best.cuts[k]);
  const at = (up) => Math.max(...proofs.map(({ a, b }) => (a[0] * up[0] + a[1] * up[1] + a[2] * up[2]) / Math.hypot(...up) - b));
  ups.forEach((up, k) => expect(efforts[k] === null || at(up) <= efforts[k] * (1 + 1e-9), `${name}: a plane above the effort`, up));
  if (best.best) expect(at(best.best.up) > 0.99 * best.best.effort, `${name}: the planes touch at the best`, at(best.best.up), best.best.effort);
}

const planar = names.find((file) => read(file).dimension === 2);
const spatial = names.find((file) => read(file).dimension === 3);
const grasp = read(planar);
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
expect(error({ command: 'curve', grasp: read(spatial) }).path === 'command', 'a curve in space');
expect(error({ command: 'hold', grasp: read(spatial), angle_deg: 3 }).problem.startsWith('is for the plane'), 'an angle in space');
expect(error({ command: 'hold', grasp: read(spatial), up: [0, 0, 0] }).path === 'up', 'no direction');
expect(error({ command: 'planes', grasp: read(spatial), cuts: [{ y: [1, 2, 3, 4, 5, 6], scenario: 7 }] }).path === 'cuts[0]', 'no such scenario');

// Files, with the words of the command line.
const digits = (text) => Buffer.from(text).toString('hex');
const file = (text) => answer({ command: 'read', file: 'part.yaml', bytes: digits(text) });
const yaml = readFileSync(`${examples}/l-part.yaml`);
compare(file(yaml), read('l-part.grasp.json'), 'l-part.yaml');
expect(file('x'.repeat(2 ** 20 + 1)).error.message === 'part.yaml: is larger than 1048576 bytes, the most that is read', 'too large');
const message = (text) => file(text).error?.message;
expect(answer({ command: 'read', file: 'part.yaml' }).error.message === 'part.yaml: is empty, must be a grasp file', 'an empty file');
expect(message('poise: 1\ndimension: 2\nobject: {weight: 10, com: [0, 0}\n') === 'part.yaml:3:32: is not YAML: illegal flow end', 'not YAML');
expect(message(yaml.toString().replace('friction: 0.6', 'fricton: 0.6')).includes('is not a known key, the nearest is friction'), 'an unknown key');
expect(message(Buffer.from([112, 233])) === 'part.yaml:1:2: is not UTF-8 text', 'not UTF-8');

expect(answer({ command: 'hold', grasp, angle_deg: 540 }).angle_deg === 180, 'an angle beyond 180');

for (const failure of failures.slice(0, 20)) console.error(failure);
console.log(`${compared} numbers of ${names.length} examples compared, largest difference ${worst.toExponential(1)}; ${searches.other.size} of ${searches.same.size + searches.other.size} searches in space went another way`);
process.exit(failures.length ? 1 : 0);

// Whether the WebAssembly module answers as the native program does: node fixtures_test.mjs MODULE
// FIXTURES EXAMPLES PROGRAM. For grip and for effort. Numbers to 1e-9 of themselves, those near nothing
// to 1e-12, and to 1e-9 of the best posture in space; forces of the least grip to 1e-8, and to 1e-7
// those of the least effort with pads or limits of drives, whose value is flat there; everything else exactly. Other minima in space are found by descent: V is flat there, so that V is as exact, and where
// it lies only to 1e-7; where a search went another way, to 1e-5, and of the grip its best value. Of turns
// in space, and of what is withstood, the two pairs of bounds overlap.
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
let forces = 1e-9;  // how exact those of the least effort are
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
      // Of what cannot be held any motion that nothing resists is a proof.
      if (key === 'dual' && (wanted.kind === 'kink' || wanted.holdable === false || exact > 1e-9)) continue;
      // So are the proofs of a grip that several drives or contacts decide.
      if (key === 'cuts' || key === 'holds' || key === 'y' || key === 'rates') continue;
      if ((key === 'lower_bound' || key === 'relative_gap') && wanted.cuts && !sameSearch(found, wanted)) continue;
      const searched = ['minima', 'best', 'best_pinched', 'relative_gap', 'turn', 'without_pressing_harder'].includes(key);
      // Of equally good postures any may be found.
      if (wanted.options?.objective === 'grip' && wanted.cuts && searched && !sameSearch(found, wanted)) {
        if (key === 'best') compare(valueOf(found.best), valueOf(wanted.best), `${path}.best`, wanted.options.gap);
        continue;
      }
      const flat = wanted.cuts && searched && (!sameSearch(found, wanted) ? 1e-5 : key === 'minima' ? 1e-7 : 1.1e-9);
      const isGrip = (wanted.options ?? wanted).objective === 'grip';
      const ofHold = key !== 'effort' || 'force_norm' in wanted; // else of a drive
      const sure = ofHold && [...(wanted.objective === 'grip' ? ['grip'] : ['effort', 'force_norm']), 'load_grips', 'load_efforts', 'lower_bound'].includes(key);
      if (wanted[key] && (key === 'without_pressing_harder' || key === 'turn') && (wanted.cuts || 'way' in wanted[key])) {
        if (key === 'turn') sameTurn(found[key], wanted[key], `${path}.${key}`, wanted.cuts ? 1e-4 : 1e-9);
        else sameBounds([found[key]?.reachable_bound, valueOf(found[key])], [wanted[key].reachable_bound, valueOf(wanted[key])], `${path}.${key}`);
        continue;
      }
      const listed = (each) => (key === 'minima' && flat ? [...each.minima].sort(inOrder) : each?.[key]);
      compare(listed(found), listed(wanted), `${path}.${key}`, sure ? 1e-9 : flat || (isGrip ? Math.max(exact, 1e-8) : Math.max(exact, forces)));
    }
  }
}

/** Of equally good postures, rounding decides which one the search in space holds next. After that the
 * cuts are others, and so is the bound that they prove: each is to be within the gap. */
function sameSearch(found, wanted) {
  for (const { best, lower_bound, options: { gap } } of [found, wanted]) {
    const value = valueOf(best);
    if (best) expect(lower_bound <= value * (1 + 1e-15) && value - lower_bound <= gap * value, 'a bound within the gap', lower_bound, value);
  }
  const near = (a, b) => Math.abs(a - b) <= 1e-6 * Math.max(Math.abs(a), Math.abs(b), 1);
  const same = found.holds === wanted.holds && found.cuts.length === wanted.cuts.length &&
    found.cuts.every((cut, k) => (cut.y ?? cut.n).every((part, i) => near(part, (wanted.cuts[k].y ?? wanted.cuts[k].n)?.[i])));
  searches[same ? 'same' : 'other'].add(found);
  return same;
}
/** Both enclose the same. */
function sameBounds(found, wanted, path) {
  const [low, high] = [found, wanted].map(([, most]) => (most ?? Infinity) * (1 + 1e-9));
  expect((found[0] ?? Infinity) <= high && (wanted[0] ?? Infinity) <= low, `${path}: ${found} instead of ${wanted}`);
  ++compared;
}

/** To where it leads, and what is proven of it: where the peak of equal ones is, rounding decides. */
function sameTurn(found, wanted, path, exact) {
  for (const key of ['rotation', 'orientation', 'turn_deg']) compare(found?.[key], wanted[key], `${path}.${key}`, exact);
  const bounds = (each) => [each?.lower_bound, each?.peak];
  sameBounds(bounds(found), bounds(wanted), `${path}.peak`);
  const stretches = (each) => each?.unholdable.map(({ from_deg, to_deg }) => [from_deg, to_deg].map((at) => Math.round(at)));
  compare(stretches(found), stretches(wanted), `${path}.unholdable`);
  expect(found?.way?.status === wanted.way?.status, `${path}.way: ${found?.way?.status} instead of ${wanted.way?.status}`);
  if (wanted.way) sameBounds(bounds(found?.way), bounds(wanted.way), `${path}.way`);
}

const valueOf = (hold) => (hold?.objective === 'grip' ? hold.grip : hold?.effort);
const searches = { same: new Set(), other: new Set() };

/** Equally good minima may come in any order. */
const inOrder = (a, b) => {
  const keys = ({ up, ...hold }) => [valueOf(hold).toPrecision(6), ...up.map((part) => Math.round(1000 * part))].map(Number);
  return keys(a).map((key, k) => key - keys(b)[k]).find((difference) => difference) ?? 0;
};

const folder = mkdtempSync(`${tmpdir()}/poise-`);
process.on('exit', () => rmSync(folder, { recursive: true }));
const names = readdirSync(fixtures).filter((file) => file.endsWith('.grasp.json'));
expect(names.length >= 3, 'no fixtures');
for (const file of names) {
  const name = file.replace('.grasp.json', '');
  const grasp = read(file);
  const isLimited = [...Object.values(grasp.fingers ?? {}), ...(Array.isArray(grasp.drives) ? grasp.drives : [])].some((each) => each.max_force ?? each.max);
  forces = isLimited || grasp.contacts.some(({ pad }) => pad) ? 1e-7 : 1e-9;
  const objectives = answer({ command: 'objectives', grasp });
  expect(objectives.objective === (grasp.objective ?? 'grip') && objectives.grip_unit === 'N', `${name}: its objectives`);
  const cases = ['hold', 'best', 'turn', ...(grasp.dimension === 2 ? ['curve'] : [])].flatMap((command) => ['grip', 'effort'].map((objective) => [command, objective]));
  for (const [command, objective] of [['check'], ...cases]) {
    const to = command === 'turn' && (grasp.dimension === 2 ? { angle_deg: 90 } : { up: [1, 2, 2] });
    const found = answer({ command, grasp, ...(objective && { objective }), ...to });
    const what = [name, command, objective].filter(Boolean).join('.');
    compare(found, read(`${what}.json`), what);
    // What it proves holds, as the program finds that shares nothing with the solver.
    writeFileSync(`${folder}/result.json`, JSON.stringify(found));
    const { status, stdout, stderr } = spawnSync(program, ['verify', `${examples}/${name}.yaml`, `${folder}/result.json`], { encoding: 'utf8' });
    expect(status === 0, `${what} is refuted:`, stdout, stderr);
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
  // What is withstood: of several loads the least. Both enclose the same.
  const shaken = answer({ command: 'shake', grasp, ...(grasp.dimension === 2 ? { angle_deg: 90 } : { up: [0, 0, 1] }) });
  const { capacities } = read(`${name}.capacity.json`);
  const least = (of) => capacities.map(of).reduce((a, b) => ((a ?? Infinity) < (b ?? Infinity) ? a : b));
  sameBounds([shaken.acceleration, shaken.bound], ['acceleration', 'bound'].map((key) => least(({ shake }) => shake[key])), `${name}.shake`);
  sameBounds([shaken.tilt_deg, shaken.tilt_bound_deg], [least(({ tilt_deg }) => tilt_deg), least(({ tilt }) => tilt.bound_deg)], `${name}.tilt`);
  if (grasp.dimension === 2) continue;

  // All around at once as one by one; no plane is above the value anywhere, nor below the bound
  // outside of what the best posture proves.
  for (const objective of ['grip', 'effort']) {
    const best = answer({ command: 'best', grasp, objective });
    const ups = [...best.minima.map(({ up }) => up), [1, 0, 0], [0, -2, 1], [0.3, 0.4, -0.5]];
    const { values, objective: told } = answer({ command: 'values', grasp, objective, ups });
    expect(told === objective, `${name}: values of ${objective}`);
    ups.forEach((up, k) => {
      const one = answer({ command: 'hold', grasp, objective, up });
      const found = (one.load_grips ?? one.load_efforts) ? Math.max(...(one.load_grips ?? one.load_efforts).map((each) => each ?? Infinity)) : valueOf(one);
      // Minima may lie on the border of what can be held, where rounding decides.
      if (k >= best.minima.length || (one.holdable && values[k] !== null))
        compare(values[k], one.holdable && found < Infinity ? found : null, `${name}.values[${k}]`, Math.max(1e-9, forces / 10));
    });
    const { planes } = answer({ command: 'planes', grasp, objective, cuts: best.cuts });
    const proofs = planes.filter(({ rate }) => rate > 0);
    const beyond = ({ a, b }, up) => (a[0] * up[0] + a[1] * up[1] + a[2] * up[2]) / Math.hypot(...up) - b;
    const at = (up) => Math.max(...proofs.map((plane) => beyond(plane, up) / plane.rate));
    ups.forEach((up, k) => {
      expect(values[k] === null || at(up) <= values[k] * (1 + 1e-9), `${name}: a plane above the ${objective}`, up);
      // What no grip holds is behind a plane without a rate.
      planes.forEach((plane, i) => plane.rate > 0 || 'n' in best.cuts[i] || values[k] === null ||
        expect(beyond(plane, up) < 1e-9, `${name}: a wall before what is held`, up));
    });
    if (best.best) expect(at(best.best.up) > 0.99 * valueOf(best.best), `${name}: the planes touch at the best`, at(best.best.up), valueOf(best.best));
  }
}

const planar = names.find((file) => read(file).dimension === 2);
const spatial = names.find((file) => read(file).dimension === 3);
const grasp = read(planar);
const error = (request) => answer(request).error ?? {};
expect(error({ command: 'hold' }).path === 'grasp', 'a request without a grasp');
expect(error({ command: 'tilt', grasp }).path === 'command', 'an unknown command');
expect(error({ command: 'turn', grasp }).path === 'angle_deg', 'a turn to nowhere');
expect(error({ command: 'turn', grasp: read(spatial) }).path === 'up', 'a turn to nowhere in space');
expect(error({ command: 'hold', grasp, angel_deg: 3 }).path === 'angel_deg', 'an unknown key');
expect(error({ command: 'hold', grasp, objective: 'force' }).path === 'objective', 'an unknown objective');
expect(error({ command: 'hold', grasp, force_cap: -1 }).path === 'force_cap', 'a bad force cap');
const broken = structuredClone(grasp);
broken.contacts[1].friction = -1;
const bad = error({ command: 'best', grasp: broken });
expect(bad.path === 'contacts[1].friction' && bad.problem === 'is -1, must be at least 0' && bad.column > 1,
  `a negative friction: ${JSON.stringify(bad)}`);
expect(error({ command: 'curve', grasp: read(spatial) }).path === 'command', 'a curve in space');
expect(error({ command: 'hold', grasp: read(spatial), angle_deg: 3 }).problem.startsWith('is for the plane'), 'an angle in space');
expect(error({ command: 'hold', grasp: read(spatial), up: [0, 0, 0] }).path === 'up', 'no direction');
expect(error({ command: 'planes', grasp: read(spatial), cuts: [{ y: [1, 2, 3, 4, 5, 6], load: 7 }] }).path === 'cuts[0]', 'no such load');

// Two fingers that face each other: upright each presses with W/(2 mu). In another file, the effort.
const facing = {
  poise: 1, dimension: 2, object: { weight: 10, com: [0, 0] },
  contacts: [{ position: [-0.04, 0], normal: [1, 0], friction: 0.4, finger: 'left' }, { position: [0.04, 0], normal: [-1, 0], friction: 0.4, finger: 'right' }],
};
compare(answer({ command: 'hold', grasp: facing, angle_deg: 0 }).grip, 10 / (2 * 0.4), 'two fingers');
expect(answer({ command: 'hold', grasp: { ...facing, objective: 'effort' }, angle_deg: 0 }).objective === 'effort', 'the objective of the file');

// The turn is left out where it is not asked for.
for (const each of [grasp, read(spatial)]) {
  const [without, all] = [false, true].map((with_turn) => answer({ command: 'best', grasp: each, with_turn }));
  expect(without.turn === null && without.without_pressing_harder === null && all.turn !== null, 'the best without the turn');
  compare(without.best, all.best, 'the best with the turn');
}

// Of a finger that closes to nowhere no grip is known: the effort, and the answer says so.
const around = structuredClone(facing);
for (const contact of around.contacts) contact.finger = 'ring';
expect(answer({ command: 'objectives', grasp: around }).grip_unit === null, 'no grip');
expect(answer({ command: 'best', grasp: around, objective: 'grip' }).options.objective === 'effort', 'the effort instead');

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

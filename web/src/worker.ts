// What takes longer than a frame: the certified best posture in space, and the values all around.
import { askSpatial, BadGrasp, start, type Plane, type Shaken, type SpatialBest, type SpatialTurn } from './core';
import { tracksOf, type Track } from './course';
import type { SpatialGrasp, Vec } from './grasp';
import { icosahedron, refined, split } from './mesh';
import { circle, flat, type Ring } from './ring';

export interface Task {
  id: number;
  grasp: SpatialGrasp;
}

/** What the turn to a posture takes. */
export interface TurnTask {
  turn: number;
  grasp: SpatialGrasp;
  to: Vec;
}

/** Nothing else where that cannot be told. */
export interface TurnAnswer {
  turn: number;
  taken?: SpatialTurn;
  tracks?: Track[];
  values?: (number | null)[][];
}

/** What a posture withstands. */
export interface ShakeTask {
  shake: number;
  grasp: SpatialGrasp;
  up: Vec;
}

export interface ShakeAnswer {
  shake: number;
  found: Shaken;
}

/** Parts of the answer to a task, as they come. */
export type Part =
  | { id: number; best: SpatialBest; planes: Plane[]; ring: Ring | undefined }
  | ({ id: number } & Coloured)
  | { id: number; done: true };

/** F or V at the points of a sphere; then, of each `split` of it where postures can no longer be held,
 * at the new ones. */
export interface Coloured {
  level: number;
  values: (number | null)[];
}

/** Spheres to be coloured: a rough one at once, a fine one in the end, and finer where holdable postures
 * end. */
const levels = [3, 5];
const finer = 2;

let latest = -1;
let latestTurn = -1;
let latestShake = -1;
let ready: Promise<void>;

self.onmessage = async ({ data }: MessageEvent<ArrayBuffer | Task | TurnTask | ShakeTask>) => {
  if (data instanceof ArrayBuffer) {
    ready = start(data);
    return;
  }
  if ('turn' in data) {
    latestTurn = data.turn;
    await ready;
    await new Promise((done) => setTimeout(done));
    if (data.turn === latestTurn) postMessage(turnOf(data));
    return;
  }
  if ('shake' in data) {
    latestShake = data.shake;
    await ready;
    await new Promise((done) => setTimeout(done));
    if (data.shake === latestShake) postMessage(shakeOf(data));
    return;
  }
  latest = data.id;
  await ready;
  // Of many tasks only the last one is worth beginning.
  await new Promise((done) => setTimeout(done));
  if (data.id !== latest) return;
  for (const part of parts(data)) {
    if (part) postMessage({ id: data.id, ...part });
    await new Promise((done) => setTimeout(done));  // another task may have come
    if (data.id !== latest) return;
  }
  postMessage({ id: data.id, done: true });
};

function turnOf({ turn, grasp, to }: TurnTask): TurnAnswer {
  try {
    const taken = askSpatial('turn', grasp, { up: to });
    const tracks = tracksOf(taken);
    return { turn, taken, tracks, values: tracks.map(({ ups }) => askSpatial('values', grasp, { ups }).values) };
  } catch (error) {
    if (!(error instanceof BadGrasp)) throw error;
    return { turn };
  }
}

const shakeOf = ({ shake, grasp, up }: ShakeTask): ShakeAnswer => ({ shake, found: askSpatial('shake', grasp, { up }) });

/** Nothing in between: there another task may come. */
function* valuesAt(grasp: SpatialGrasp, ups: Vec[]): Generator<undefined, (number | null)[]> {
  const all: (number | null)[] = [];
  for (let k = 0; k < ups.length; k += 250) {
    all.push(...askSpatial('values', grasp, { ups: ups.slice(k, k + 250) }).values);
    yield;
  }
  return all;
}

function* parts({ grasp }: Task) {
  try {
    const values = (ups: Vec[]) => valuesAt(grasp, ups);
    yield { level: levels[0]!, values: yield* values(refined(icosahedron, levels[0]!).points) };
    const best = askSpatial('best', grasp, { with_turn: false });
    const { planes } = askSpatial('planes', grasp, { cuts: best.cuts });
    const normal = best.lower_bound === null ? undefined : flat(planes, best.lower_bound);
    const ups = normal && circle(normal);
    yield { best, planes, ring: ups && { normal, ups, values: yield* values(ups) } };
    let net = refined(icosahedron, levels[1]!);
    const all = yield* values(net.points);
    for (let k = 0; k < finer && !normal; ++k) {
      net = split(net, (point) => all[point] === null);
      all.push(...(yield* values(net.points.slice(all.length))));
    }
    yield { level: levels[1]!, values: all };
  } catch (error) {
    // The page has been told already.
    if (!(error instanceof BadGrasp)) throw error;
  }
}

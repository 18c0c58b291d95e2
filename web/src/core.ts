// The solver: the C++ core as WebAssembly. Its documents are those of docs/command-line.md.
import { load } from '@core';
import type { Domain, Grasp, Objective, PlanarGrasp, PlanarShape, Point, SpatialGrasp, SpatialShape, Vec } from './grasp';

export type { Objective };
export type Limit = 'none' | 'min' | 'max';
export type State = 'unloaded' | 'sticking' | 'slipping';
export type Kind = 'boundary' | 'kink' | 'smooth';
export type Manner = 'resting' | 'cradled' | 'pinched';
export type Range = [number, number];
/** In what the grip is told. */
export type GripUnit = 'N' | 'N m' | 'of max';

export interface ContactForce<P> {
  finger: string;
  friction_used: number;
  normal_force: number;
  tangential_force: number;
  torsion_moment?: number;
  force: P;
  state: State;
  limit: Limit;
}

interface Posture<P> {
  up: P;
  /** In the plane. */
  angle_deg?: number;
  objective: Objective;
  /** The proof: of the effort, of the grip. */
  dual?: number[];
  y?: number[];
  lower_bound: number;
  load?: number;
  load_grips?: (number | null)[];
  load_efforts?: (number | null)[];
}

export interface Held<P> extends Posture<P> {
  holdable: true;
  effort: number;
  force_norm: number;
  manner: Manner;
  /** Null where a finger has no closing direction. */
  grip: number | null;
  drives: { max: number | null }[];
  fingers: { finger: string; normal_force: number; force: P }[];
  contacts: ContactForce<P>[];
}

export interface NotHeld<P> extends Posture<P> {
  holdable: false;
  reason: string;
}

export type Hold<P> = Held<P> | NotHeld<P>;
export type AnyHold = Hold<Point> | Hold<Vec>;

/** The twist that proves what a hold is. */
export const proofOf = ({ y, dual }: { y?: number[]; dual?: number[] }): number[] => y ?? dual!;

export type Optimum = Held<Point> & {
  angle_deg: number;
  kind: Kind;
  type: 'min' | 'max';
  from_deg?: number;
  to_deg?: number;
  edges_meet?: Point | null;
};

/** One of V and F. */
export interface Arc {
  from_deg: number;
  to_deg: number;
  V?: { c0: number; cos1: number; sin1: number; cos2: number; sin2: number };
  F?: { c0: number; cos1: number; sin1: number };
}

export interface Best {
  options: { domain: Domain };
  status: 'optimal' | 'gap' | 'unholdable';
  best: Optimum | null;
  best_pinched: Optimum | null;
  unholdable_arcs: { from_deg: number; to_deg: number }[];
}

export interface Curve {
  arcs: Arc[];
  optima: Optimum[];
  holdable_arcs_deg: Range[];
}

export type Cut = { y: number[]; load: number; rates?: number[] } | { n: Vec };

export interface SpatialBest {
  status: 'optimal' | 'gap' | 'unholdable';
  best: Held<Vec> | null;
  best_pinched: Held<Vec> | null;
  minima: Held<Vec>[];
  lower_bound: number | null;
  relative_gap: number | null;
  holds: number;
  cuts: Cut[];
}

/** What a cut says of any load x, 1 being the weight: F or V, times the rate, is at least a . x - b. */
export interface Plane {
  a: Vec;
  b: number;
  rate: number;
}

interface AnyCheck<P, Shape> {
  shape: Shape | null;
  contacts: {
    finger: string;
    position: P;
    normal: P;
    friction: number;
    torsion?: number;
    min_normal: number;
    max_normal: number | null;
  }[];
  loads: { name?: string; weight: number; com: P; lift: number; acceleration: P; fixed: number[] }[];
  force_closure: boolean;
  warnings: string[];
}

const gravity = 9.80665;

/** What turns with gravity [N]: the weight, and what lifting the object adds. */
export const turningForce = ({ weight, lift }: { weight: number; lift: number }) => weight * (1 + lift / gravity);

/** The force of what does not, on the object [N]: of its inertia, and what pushes it. */
export const stillForce = ({ weight, acceleration, fixed }: { weight: number; acceleration: readonly number[]; fixed: number[] }): number[] =>
  acceleration.map((a, k) => -(weight / gravity) * a - fixed[k]!);

export interface Check extends AnyCheck<Point, PlanarShape> {
  fork_deg: Range | null;
}

export interface SpatialCheck extends AnyCheck<Vec, SpatialShape> {
  tilt: { from: Vec; max_deg: number } | null;
}

/** How far a posture is from what it can no longer hold. */
export interface Margins {
  weight: number;
  holdable: boolean;
  /** null: any weight. */
  greatest_weight: number | null;
  /** On all frictions together; null: none is enough. */
  friction_factor: number | null;
  /** Of the grip in space, which may have a kink there: its changes per degree, to all sides. */
  slopes?: number[];
}

/** What a posture withstands besides the loads. */
export interface Shaken {
  holdable: boolean;
  /** In any direction [m/s²]; null: any. */
  acceleration: number | null;
  /** In which no more is withstood; of the object. */
  direction: number[];
  /** In any direction; 180 where every posture is held. */
  tilt_deg: number;
  /** That it is no more. */
  proven: boolean;
}

/** What a turn takes [N², or as the grip]; null where a posture of it cannot be held. */
export interface Peak<P> {
  /** Counter-clockwise positive, as all angles of it. */
  turn_deg: number;
  peak: number | null;
  peak_at: (Hold<P> & { turn_deg: number }) | null;
  unholdable: { from_deg: number; to_deg: number; posture: Hold<P> & { turn_deg: number } }[];
}

interface AnyTurn<P, Turn> {
  now: Hold<P>;
  then: Hold<P>;
  turn: Turn;
}

export type PlanarTurn = AnyTurn<Point, Peak<Point> & { other_way: Peak<Point> | null }>;

export interface Quaternion {
  w: number;
  x: number;
  y: number;
  z: number;
}

/** From the grasp file's posture, or upright. */
export interface SpatialTurn extends AnyTurn<Vec, Peak<Vec> & { rotation: Quaternion; way: Way | null }> {
  options: { orientation: Quaternion };
}

/** That of least peak, by smallest turns to each of some orientations. */
interface Way {
  status: 'optimal' | 'gap' | 'unholdable';
  peak: number | null;
  lower_bound: number | null;
  orientations: Quaternion[];
}

/** What is least if nothing is asked for; without a unit there is no grip. */
export interface Objectives {
  objective: Objective;
  grip_unit: GripUnit | null;
}

interface PlanarAnswers {
  margins: Margins;
  shake: Shaken;
  objectives: Objectives;
  check: Check;
  hold: Hold<Point>;
  best: Best;
  turn: PlanarTurn;
  curve: Curve;
}

interface SpatialAnswers {
  margins: Margins;
  shake: Shaken;
  objectives: Objectives;
  check: SpatialCheck;
  hold: Hold<Vec>;
  best: SpatialBest;
  turn: SpatialTurn;
  values: { values: (number | null)[] };
  planes: { planes: Plane[] };
}

/** A grasp that has no meaning: the words of the command line. */
export class BadGrasp extends Error {}

let call: (request: string) => string;

/** To be called once, before anything is asked. */
export async function start(wasm: ArrayBuffer): Promise<void> {
  call = await load(wasm);
}

/** The answer, or the words for what is wrong with the request. */
function answer(request: unknown, words: (error: { path: string; problem: string; message: string }) => string) {
  const found = JSON.parse(call(JSON.stringify(request)));
  if (found.error) throw new BadGrasp(words(found.error));
  return found;
}

const onField = ({ path, problem }: { path: string; problem: string }) => (path ? `${path}: ${problem}` : problem);

export const ask = <Command extends keyof PlanarAnswers>(
  command: Command,
  grasp: PlanarGrasp,
  options: { angle_deg?: number; domain?: Domain; objective?: Objective; with_turn?: boolean } = {},
): PlanarAnswers[Command] => answer({ command, grasp, ...options }, onField);

export const askSpatial = <Command extends keyof SpatialAnswers>(
  command: Command,
  grasp: SpatialGrasp,
  options: { up?: Vec; ups?: readonly Vec[]; cuts?: Cut[]; objective?: Objective; with_turn?: boolean } = {},
): SpatialAnswers[Command] => answer({ command, grasp, ...options }, onField);

/** The grasp that a file spells, in YAML or JSON. */
export function read(bytes: Uint8Array, file: string): Grasp {
  const digits = Array.from(bytes, (byte) => byte.toString(16).padStart(2, '0')).join('');
  return answer({ command: 'read', file, ...(digits && { bytes: digits }) }, ({ message }) => message);
}

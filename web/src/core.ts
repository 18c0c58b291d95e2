// The solver: the C++ core as WebAssembly. Its documents are those of docs/command-line.md.
import create from '@core';
import packed from 'virtual:core';
import type { Domain, Grasp, Point, Shape } from './grasp';

export type Limit = 'none' | 'min' | 'max';
export type State = 'unloaded' | 'sticking' | 'slipping';
export type Kind = 'boundary' | 'kink' | 'smooth';
export type Manner = 'resting' | 'cradled' | 'pinched';
export type Range = [number, number];

export interface ContactForce {
  finger: string;
  friction_used: number;
  normal_force: number;
  tangential_force: number;
  force: Point;
  state: State;
  limit: Limit;
}

interface Posture {
  up: Point;
  angle_deg: number;
  dual: [number, number, number];
  lower_bound: number;
}

export interface Held extends Posture {
  holdable: true;
  effort: number;
  force_norm: number;
  manner: Manner;
  grip_force: number;
  fingers: { finger: string; normal_force: number; force: Point }[];
  contacts: ContactForce[];
}

export interface NotHeld extends Posture {
  holdable: false;
  reason: string;
}

export type Hold = Held | NotHeld;

export type Optimum = Held & {
  kind: Kind;
  type: 'min' | 'max';
  from_deg?: number;
  to_deg?: number;
  edges_meet?: Point | null;
};

export interface Arc {
  from_deg: number;
  to_deg: number;
  V: { c0: number; cos1: number; sin1: number; cos2: number; sin2: number };
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

export interface Check {
  weight: number;
  com: Point;
  shape: Shape | null;
  contacts: {
    finger: string;
    position: Point;
    normal: Point;
    friction: number;
    min_normal: number;
    max_normal: number | null;
  }[];
  force_closure: boolean;
  cradled_deg: Range | null;
  warnings: string[];
}

interface Answers {
  check: Check;
  hold: Hold;
  best: Best;
  curve: Curve;
}

/** A grasp that has no meaning: the words of the command line. */
export class BadGrasp extends Error {}

async function unpacked(text: string): Promise<ArrayBuffer> {
  const bytes = Uint8Array.from(atob(text), (character) => character.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'));
  return new Response(stream).arrayBuffer();
}

const core = await create({ wasmBinary: await unpacked(packed) });

export function ask<Command extends keyof Answers>(
  command: Command,
  grasp: Grasp,
  options: { angle_deg?: number; domain?: Domain } = {},
): Answers[Command] {
  const request = JSON.stringify({ command, grasp, ...options });
  const answer = JSON.parse(core.ccall('poise_answer', 'string', ['string'], [request]));
  if (answer.error) {
    const { path, problem } = answer.error;
    throw new BadGrasp(path ? `${path}: ${problem}` : problem);
  }
  return answer;
}

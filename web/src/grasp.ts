// A grasp file (docs/grasp-file.md) in SI units, as `poise view` and the examples give it.

export type Point = readonly [number, number];

export type Shape =
  | { disk: { radius: number } }
  | { ellipse: { radii: Point } }
  | { polygon: Point[] };

export interface Contact {
  position: Point;
  normal?: Point;
  friction: number;
  min_normal?: number;
  max_normal?: number;
  share?: number;
  finger?: string;
}

export interface Grasp {
  poise: number;
  dimension: number;
  name?: string;
  safety?: number;
  angle_deg?: number;
  domain?: Domain;
  object: { weight: number; com: Point; shape?: Shape };
  contacts: Contact[];
}

export type Domain = 'all' | 'pinched';

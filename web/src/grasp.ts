// A grasp file (docs/grasp-file.md) in SI units, as `poise view` and the examples give it.

export type Point = readonly [number, number];
export type Vec = readonly [number, number, number];

export type PlanarShape =
  | { disk: { radius: number } }
  | { ellipse: { radii: Point } }
  | { polygon: Point[] };

export type SpatialShape =
  | { box: { size: Vec } }
  | { cylinder: { radius: number; height: number } }
  | { sphere: { radius: number } }
  | { ellipsoid: { radii: Vec } };

export interface Contact<P> {
  position: P;
  normal?: P;
  friction: number;
  torsion?: number;
  min_normal?: number;
  max_normal?: number;
  share?: number;
  finger?: string;
}

interface AnyGrasp<P> {
  poise: number;
  name?: string;
  safety?: number;
  objective?: Objective;
  contacts: Contact<P>[];
}

export interface PlanarGrasp extends AnyGrasp<Point> {
  dimension: 2;
  angle_deg?: number;
  domain?: Domain;
  object: { weight: number; com: Point; shape?: PlanarShape };
}

export interface Scenario {
  weight: number;
  com: Vec;
}

export interface SpatialGrasp extends AnyGrasp<Vec> {
  dimension: 3;
  up?: Vec;
  tilt?: { from: Vec; max_deg: number };
  object: (Scenario | { scenarios: Scenario[] }) & { shape?: SpatialShape };
}

export type Grasp = PlanarGrasp | SpatialGrasp;

export type Domain = 'all' | 'pinching-up';
export type Objective = 'grip' | 'effort';

/** What the object may be: parts of the grasp, to be changed there. */
export const scenariosOf = ({ object }: SpatialGrasp): Scenario[] =>
  'scenarios' in object ? object.scenarios : [object];

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

/** What acts in one case; weight and com are the object's where they are left out. */
export interface LoadEntry<P> {
  name?: string;
  weight?: number;
  com?: P;
  acceleration?: { up?: number; fixed?: P };
  force?: P;
  at?: P;
  moment?: number | Vec;
}

interface AnyGrasp<P> {
  poise: number;
  name?: string;
  safety?: number;
  objective?: Objective;
  contacts: Contact<P>[];
  loads?: LoadEntry<P>[];
}

export interface PlanarGrasp extends AnyGrasp<Point> {
  dimension: 2;
  angle_deg?: number;
  domain?: Domain;
  object: { weight: number; com: Point; shape?: PlanarShape };
}

export interface SpatialGrasp extends AnyGrasp<Vec> {
  dimension: 3;
  up?: Vec;
  tilt?: { from: Vec; max_deg: number };
  object: { weight: number; com: Vec; shape?: SpatialShape };
}

export type Grasp = PlanarGrasp | SpatialGrasp;

export type Domain = 'all' | 'pinching-up';
export type Objective = 'grip' | 'effort';

/** What a load weighs and where, to be changed where it is written. */
export interface Mass<P> {
  name: string;
  weight: number;
  com: P;
}

/** Of each load. */
export function massesOf<P>({ object, loads }: { object: { weight: number; com: P }; loads?: LoadEntry<P>[] }): Mass<P>[] {
  return (loads ?? [{}]).map((entry: LoadEntry<P>, k) => ({
    name: entry.name ?? `${k}`,
    get weight() {
      return entry.weight ?? object.weight;
    },
    set weight(value) {
      (entry.weight === undefined ? object : entry).weight = value;
    },
    get com() {
      return entry.com ?? object.com;
    },
    set com(value) {
      (entry.com === undefined ? object : entry).com = value;
    },
  }));
}

/** One of each that can be changed by itself. */
export function ownMassesOf<P>(grasp: { object: { weight: number; com: P }; loads?: LoadEntry<P>[] }): Mass<P>[] {
  const is = (k: number) => {
    const { weight, com } = grasp.loads?.[k] ?? {};
    return weight !== undefined || com !== undefined;
  };
  const first = (grasp.loads ?? [{}]).findIndex((_, k) => !is(k));
  return massesOf(grasp).filter((_, k) => k === first || is(k));
}

type Loaded<P> = { object: { com: P }; loads?: LoadEntry<P>[] };

/** What pushes the object [N]: the force of the first load that has one. */
export const pushOf = <P>({ loads }: Loaded<P>): P | undefined => loads?.find(({ force }) => force)?.force;

/** Pushes it with another force. Where nothing does yet all loads are pushed, at the centre of mass. */
export function push<P extends Point | Vec>(grasp: Loaded<P>, force: P): void {
  const pushed = grasp.loads?.filter((load) => load.force) ?? [];
  if (pushed.length > 0) {
    pushed[0]!.force = force;
    return;
  }
  grasp.loads ??= [{ name: 'pushed' }];
  for (const load of grasp.loads) Object.assign(load, { force, at: load.com ?? grasp.object.com });
}

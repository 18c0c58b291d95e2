// Bodies as triangles: to draw, to take hold of, and to move contacts along.
import type { SpatialShape, Vec } from './grasp';
import { add, across, cross, dot, length, minus, times, unit } from './turn';

export interface Triangles {
  points: Vec[];
  triangles: (readonly [number, number, number])[];
}

export interface Body extends Triangles {
  /** One for each corner of each triangle. */
  normals: Vec[];
  /** To be drawn as lines. */
  edges: (readonly [Vec, Vec])[];
}

export const icosahedron: Triangles = (() => {
  const g = (1 + Math.sqrt(5)) / 2;
  const points = ([[-1, g, 0], [1, g, 0], [-1, -g, 0], [1, -g, 0], [0, -1, g], [0, 1, g], [0, -1, -g], [0, 1, -g],
    [g, 0, -1], [g, 0, 1], [-g, 0, -1], [-g, 0, 1]] as Vec[]).map(unit);
  const triangles = [[0, 11, 5], [0, 5, 1], [0, 1, 7], [0, 7, 10], [0, 10, 11], [1, 5, 9], [5, 11, 4], [11, 10, 2],
    [10, 7, 6], [7, 1, 8], [3, 9, 4], [3, 4, 2], [3, 2, 6], [3, 6, 8], [3, 8, 9], [4, 9, 5], [2, 4, 11], [6, 2, 10],
    [8, 6, 7], [9, 8, 1]] as [number, number, number][];
  return { points, triangles };
})();

/** A sphere: every triangle made four, as often as is wanted. */
export function refined(sphere: Triangles, times: number): Triangles {
  if (times === 0) return sphere;
  const points = [...sphere.points];
  const middles = new Map<number, number>();
  const middle = (a: number, b: number) => {
    const key = Math.min(a, b) * 1e6 + Math.max(a, b);
    if (!middles.has(key)) middles.set(key, points.push(unit(add(points[a]!, points[b]!))) - 1);
    return middles.get(key)!;
  };
  const triangles = sphere.triangles.flatMap(([a, b, c]): [number, number, number][] => {
    const [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
    return [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]];
  });
  return refined({ points, triangles }, times - 1);
}

/** Those triangles made four whose corners are not all of one kind; the new points come last. */
export function split({ points, triangles }: Triangles, kind: (point: number) => unknown): Triangles {
  const mixed = (corners: readonly number[]) => corners.some((k) => kind(k) !== kind(corners[0]!));
  const finer = refined({ points, triangles: triangles.filter(mixed) }, 1);
  return { points: finer.points, triangles: [...triangles.filter((corners) => !mixed(corners)), ...finer.triangles] };
}

const around = 72;
const circle = (radius: number, z: number): Vec[] =>
  Array.from({ length: around }, (_, k) => {
    const phi = (2 * Math.PI * k) / around;
    return [radius * Math.cos(phi), radius * Math.sin(phi), z];
  });
const ring = (points: Vec[]): [Vec, Vec][] => points.map((p, k) => [p, points[(k + 1) % points.length]!]);

/** Corners that belong to flat faces: each triangle has its own normal. */
function flat(points: Vec[], faces: number[][], edges: (readonly [Vec, Vec])[]): Body {
  const triangles = faces.flatMap((face) =>
    face.slice(2).map((last, k) => [face[0]!, face[k + 1]!, last] as [number, number, number]),
  );
  const normals = triangles.flatMap(([a, b, c]) => {
    const normal = cross(minus(points[b]!, points[a]!), minus(points[c]!, points[a]!));
    const n = length(normal) > 0 ? unit(normal) : normal;
    return [n, n, n];
  });
  return { points, triangles, normals, edges };
}

function box([x, y, z]: Vec): Body {
  const points = [0, 1, 2, 3, 4, 5, 6, 7].map((k): Vec => [
    (k & 1 ? x : -x) / 2,
    (k & 2 ? y : -y) / 2,
    (k & 4 ? z : -z) / 2,
  ]);
  const faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
  const edges = [0, 1, 2, 3, 4, 5, 6, 7].flatMap((k) =>
    [1, 2, 4].filter((bit) => !(k & bit)).map((bit) => [points[k]!, points[k | bit]!] as const),
  );
  return flat(points, faces, edges);
}

/** A cylinder or, with a radius of 0 at an end, a cone about z. */
export function tapered(low: number, high: number, from: number, to: number): Body {
  const [bottom, top] = [circle(low, from), circle(high, to)];
  const points = [...bottom, ...top];
  const slope = (low - high) / (to - from);
  const side = Array.from({ length: around }, (_, k) => [k, (k + 1) % around]).flatMap(([k, next]) => [
    [k!, next!, around + next!] as const,
    [k!, around + next!, around + k!] as const,
  ]);
  const outward = (k: number): Vec => {
    const phi = (2 * Math.PI * (k % around)) / around;
    return unit([Math.cos(phi), Math.sin(phi), slope]);
  };
  const ends = flat(points, [bottom.map((_, k) => around - 1 - k), top.map((_, k) => around + k)], []);
  return {
    points,
    triangles: [...side, ...ends.triangles],
    normals: [...side.flatMap((corners) => corners.map(outward)), ...ends.normals],
    edges: [...(low > 0 ? ring(bottom) : []), ...(high > 0 ? ring(top) : [])],
  };
}

function ellipsoid(radii: Vec): Body {
  const sphere = refined(icosahedron, 4);
  const by = (p: Vec, q: Vec): Vec => [p[0] * q[0], p[1] * q[1], p[2] * q[2]];
  const over: Vec = [1 / radii[0], 1 / radii[1], 1 / radii[2]];
  return {
    points: sphere.points.map((p) => by(p, radii)),
    triangles: sphere.triangles,
    normals: sphere.triangles.flatMap((corners) => corners.map((k) => unit(by(sphere.points[k]!, over)))),
    edges: [],
  };
}

export function bodyOf(shape: SpatialShape): Body {
  if ('box' in shape) return box(shape.box.size);
  if ('cylinder' in shape) {
    const { radius, height } = shape.cylinder;
    return tapered(radius, radius, -height / 2, height / 2);
  }
  if ('sphere' in shape) return ellipsoid([shape.sphere.radius, shape.sphere.radius, shape.sphere.radius]);
  return ellipsoid(shape.ellipsoid.radii);
}

/** A mesh from a file: edges are where its faces turn by more than 30 degrees. */
export function bodyOfMesh({ points, triangles }: Triangles): Body {
  const body = flat(points, triangles as unknown as number[][], []);
  // The program writes equal points once.
  const beside = new Map<number, Vec>();
  body.triangles.forEach((corners, t) => {
    const n = body.normals[3 * t]!;
    corners.forEach((from, k) => {
      const to = corners[(k + 1) % 3]!;
      const [here, there] = [from * points.length + to, to * points.length + from];
      const other = beside.get(there);
      if (other) {
        beside.delete(there);
        if (dot(other, n) < Math.cos(Math.PI / 6)) body.edges.push([points[from]!, points[to]!]);
      } else beside.set(here, n);
    });
  });
  return body;
}

export interface Hit {
  point: Vec;
  /** Of the surface, outwards. */
  normal: Vec;
}

/** Where a ray first meets a body. */
export function hit(body: Body, from: Vec, direction: Vec): Hit | undefined {
  let best: Hit | undefined;
  let nearest = Infinity;
  body.triangles.forEach(([i, j, k], t) => {
    const a = body.points[i]!;
    const [ab, ac, away] = [minus(body.points[j]!, a), minus(body.points[k]!, a), minus(from, a)];
    const n = cross(ab, ac);
    const facing = dot(n, direction);
    if (!(facing < 0)) return;
    const way = -dot(n, away) / facing;
    if (!(way >= 0) || way >= nearest) return;
    const aside = cross(away, direction);
    const [u, v] = [dot(ac, aside) / -facing, -dot(ab, aside) / -facing];
    if (u < 0 || v < 0 || u + v > 1) return;
    nearest = way;
    best = { point: add(from, times(way, direction)), normal: body.normals[3 * t]! };
  });
  return best;
}

/** The point of the surface on the way from the origin to a point; not so near to an edge, where
 * there is no single normal, that the core would refuse it. */
export function onSurface(shape: SpatialShape, p: Vec): Vec {
  if ('sphere' in shape) return times(shape.sphere.radius / (length(p) || 1), p);
  if ('ellipsoid' in shape) {
    const r = shape.ellipsoid.radii;
    return times(1 / (Math.hypot(p[0] / r[0], p[1] / r[1], p[2] / r[2]) || 1), p);
  }
  if ('cylinder' in shape) {
    const { radius, height } = shape.cylinder;
    const clear = 3e-4 * Math.hypot(radius, height / 2);
    const wide = Math.hypot(p[0], p[1]);
    const [side, end] = [wide / radius, (2 * Math.abs(p[2])) / height];
    if (side >= end) {
      const k = radius / (wide || 1);
      return [k * p[0], k * p[1], within(k * p[2], height / 2 - clear)];
    }
    const k = height / 2 / Math.abs(p[2]);
    const far = Math.min(1, (radius - clear) / (k * wide || 1));
    return [far * k * p[0], far * k * p[1], k * p[2]];
  }
  const half = times(0.5, shape.box.size);
  const clear = 3e-4 * length(half);
  const parts = p.map((x, k) => Math.abs(x) / half[k]!);
  const face = parts.indexOf(Math.max(...parts));
  const k = half[face]! / (Math.abs(p[face]!) || 1);
  return p.map((x, i) => (i === face ? k * x : within(k * x, half[i]! - clear))) as unknown as Vec;
}

const within = (x: number, most: number) => Math.min(Math.max(x, -most), most);

/** The faces of what all planes a . x <= c leave over, as polygons; cut from a box. */
export function polytope(planes: { a: Vec; c: number }[], reach: number): Vec[][] {
  const all = [
    ...planes,
    ...[0, 1, 2].flatMap((k) => [1, -1].map((sign) => ({ a: [0, 1, 2].map((i) => (i === k ? sign : 0)) as unknown as Vec, c: reach }))),
  ];
  return all.flatMap(({ a, c }, own) => {
    const size = length(a);
    if (!(size > 0)) return [];
    const n = times(1 / size, a);
    const foot = times(c / size, n);
    const [u, v] = [times(4 * reach, across(n)), times(4 * reach, cross(n, across(n)))];
    let face: Vec[] = [add(add(foot, u), v), add(minus(foot, u), v), minus(minus(foot, u), v), minus(add(foot, u), v)];
    all.forEach((other, k) => {
      if (k !== own && face.length) face = clipped(face, other.a, other.c);
    });
    return face.length > 2 ? [face] : [];
  });
}

/** The part of a polygon where a . x <= c. */
function clipped(face: Vec[], a: Vec, c: number): Vec[] {
  const over = face.map((p) => dot(a, p) - c);
  return face.flatMap((p, k) => {
    const next = (k + 1) % face.length;
    const [here, there] = [over[k]!, over[next]!];
    const kept = here <= 0 ? [p] : [];
    if (here < 0 === there < 0 || here === 0 || there === 0) return kept;
    return [...kept, add(p, times(here / (here - there), minus(face[next]!, p)))];
  });
}

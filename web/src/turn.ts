// Vectors and rotations in space.
import type { Vec } from './grasp';

export const add = (a: Vec, b: Vec): Vec => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const minus = (a: Vec, b: Vec): Vec => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const times = (k: number, a: Vec): Vec => [k * a[0], k * a[1], k * a[2]];
export const dot = (a: Vec, b: Vec) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a: Vec, b: Vec): Vec => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
export const length = (a: Vec) => Math.hypot(...a);
export const unit = (a: Vec): Vec => times(1 / length(a), a);
/** Between two directions [rad]. */
export const angle = (a: Vec, b: Vec) => Math.atan2(length(cross(a, b)), dot(a, b));

/** Any direction across another. */
export function across(a: Vec): Vec {
  const least = a.map(Math.abs).indexOf(Math.min(...a.map(Math.abs)));
  return unit(cross(a, [0, 1, 2].map((k) => (k === least ? 1 : 0)) as unknown as Vec));
}

/** A rotation, by its columns: where x, y and z go. */
export type Turn = readonly [Vec, Vec, Vec];

export const still: Turn = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];

export const turned = ([x, y, z]: Turn, a: Vec): Vec =>
  add(add(times(a[0], x), times(a[1], y)), times(a[2], z));
/** The other way round. */
export const turnedBack = ([x, y, z]: Turn, a: Vec): Vec => [dot(x, a), dot(y, a), dot(z, a)];

/** First b, then a; rounding does not add up. */
export function after(a: Turn, b: Turn): Turn {
  const x = unit(turned(a, b[0]));
  const z = unit(cross(x, turned(a, b[1])));
  return [x, cross(z, x), z];
}

export function about(axis: Vec, radians: number): Turn {
  const [c, s] = [Math.cos(radians), Math.sin(radians)];
  const column = (e: Vec) => add(add(times(c, e), times(s, cross(axis, e))), times((1 - c) * dot(axis, e), axis));
  return [column(still[0]), column(still[1]), column(still[2])];
}

/** A part of the smallest rotation that takes one direction to another. */
export function towards(from: Vec, to: Vec, part = 1): Turn {
  const normal = cross(from, to);
  const axis = length(normal) > 1e-12 ? unit(normal) : across(from);
  return about(axis, part * angle(from, to));
}

/** Some rotation that takes z to a direction. */
export function frame(z: Vec): Turn {
  const x = across(z);
  return [x, cross(z, x), z];
}

export interface Ball {
  centre: Vec;
  radius: number;
}

/** About the middle of the box of all points. */
export function ballOf(points: readonly Vec[]): Ball {
  const centre = [0, 1, 2].map((k) => {
    const values = points.map((point) => point[k]!);
    return (values.reduce((a, b) => Math.min(a, b)) + values.reduce((a, b) => Math.max(a, b))) / 2;
  }) as unknown as Vec;
  return { centre, radius: points.reduce((most, point) => Math.max(most, length(minus(point, centre))), 0) || 1 };
}

// Grasps that hold only what points along one plane, such as two hard jaws: no direction of a sphere's
// net need lie in it.
import type { Plane } from './core';
import type { Vec } from './grasp';
import { add, dot, frame, length, times, unit } from './turn';
import { radians } from './vector';

/** F or V all around in that plane. */
export interface Ring {
  normal: Vec;
  ups: Vec[];
  values: (number | null)[];
}

/** The normal of the plane in which all loads lie of at most a value, if two planes leave but that. */
export function flat(planes: Plane[], value: number): Vec | undefined {
  const walls = planes.map(({ a, b, rate }) => ({ n: unit(a), reach: (rate * value + b) / length(a) })).filter(({ reach }) => reach < 1e-6);
  return walls.find(({ n }) => walls.some((other) => dot(n, other.n) < 1e-9 - 1))?.n;
}

/** By degrees, back to where it began. */
export function circle(normal: Vec): Vec[] {
  const [x, y] = frame(normal);
  return Array.from({ length: 361 }, (_, k) => add(times(Math.cos(radians(k)), x), times(Math.sin(radians(k)), y)));
}

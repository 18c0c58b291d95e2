import type { Point } from './grasp';

export const add = (a: Point, b: Point): Point => [a[0] + b[0], a[1] + b[1]];
export const minus = (a: Point, b: Point): Point => [a[0] - b[0], a[1] - b[1]];
export const times = (k: number, a: Point): Point => [k * a[0], k * a[1]];
export const dot = (a: Point, b: Point) => a[0] * b[0] + a[1] * b[1];
export const length = (a: Point) => Math.hypot(a[0], a[1]);
export const left = (a: Point): Point => [-a[1], a[0]];
export const radians = (degrees: number) => (degrees * Math.PI) / 180;

/** Turned counter-clockwise. */
export function turned(a: Point, angle: number): Point {
  const c = Math.cos(radians(angle));
  const s = Math.sin(radians(angle));
  return [c * a[0] - s * a[1], s * a[0] + c * a[1]];
}

// The disk of the paper: S. Ito et al., Numerical Analysis for Optimal Posture of Circular Object
// Grasped with Frictions. The bounds are (20)-(25), with the minus sign that (22), (23) lack.
import type { PlanarGrasp, Point } from './grasp';
import { dot, length, radians } from './vector';

export function paperDisk(name: string, phi: number, mu1: number, mu2: number): PlanarGrasp {
  const s = Math.sin(radians(phi));
  const c = Math.cos(radians(phi));
  return {
    poise: 1,
    dimension: 2,
    name,
    objective: 'effort',
    object: { weight: 10, com: [0, 0], shape: { disk: { radius: 1 } } },
    contacts: [
      { position: [s, c], normal: [-s, -c], friction: mu1, finger: 'right' },
      { position: [-s, c], normal: [s, -c], friction: mu2, finger: 'left' },
    ],
  };
}

/** A grasp seen as the paper sees it: the contacts at +-phi of an axis of the disk. */
export interface PaperView {
  phi: number;
  /** The posture in which the axis points up [degrees]. */
  axis: number;
  mu: [number, number];
  weight: number;
}

export function asPaper(grasp: PlanarGrasp): PaperView | undefined {
  const { shape, com, weight } = grasp.object;
  const [a, b] = grasp.contacts;
  if (!shape || !('disk' in shape) || length(com) > 1e-9 * shape.disk.radius) return undefined;
  if (!a || !b || grasp.contacts.length !== 2) return undefined;
  if ([a, b].some((each) => each.min_normal || each.max_normal !== undefined || (each.share ?? 1) !== 1))
    return undefined;
  const clockwise = (p: Point) => Math.atan2(p[0], p[1]);
  // The axis is on the side of the contacts' middle; contact 1 is clockwise of it.
  const middle: Point = [a.position[0] + b.position[0], a.position[1] + b.position[1]];
  const phi = Math.acos(Math.min(1, Math.max(-1, dot(a.position, b.position) / shape.disk.radius ** 2))) / 2;
  if (length(middle) < 1e-9 * shape.disk.radius || phi < 1e-6) return undefined;
  const axis = clockwise(middle);
  const first = Math.sin(clockwise(a.position) - axis) > 0;
  const safety = grasp.safety ?? 1;
  const mu: [number, number] = [a.friction / safety, b.friction / safety];
  return { phi, axis: (axis * 180) / Math.PI, mu: first ? mu : [mu[1], mu[0]], weight };
}

/** alpha_1 ... alpha_6, each the least internal force with which one condition holds [N]. */
export function alphas({ phi, axis, mu, weight }: PaperView, angle: number): number[] {
  const theta = radians(angle - axis);
  const [s, c] = [Math.sin(phi), Math.cos(phi)];
  const [x, y] = [Math.sin(theta), Math.cos(theta)];
  const scale = weight / Math.SQRT2;
  const touch = (side: number) => (scale / (s * s)) * (side * x + s * c * y);
  const upward = (-scale * s * y) / c;
  const friction = (side: number, m: number) => {
    const d = m * s - c;
    return d > 1e-14 ? (scale / d) * ((s + m * c) * y + (side * m * x) / s) : Infinity;
  };
  return [touch(1), touch(-1), upward, upward, friction(1, mu[0]), friction(-1, mu[1])];
}

// Labels that do not lie on one another.
import type { Point } from './grasp';

export interface Label {
  at: Point;
  width: number;
  height: number;
}

/** Where to put labels that belong near given points: each as near as it can, in turn. */
export function apart<Kind extends Label>(labels: Kind[]): Kind[] {
  const placed: Kind[] = [];
  for (const label of labels) {
    const free = (y: number) =>
      placed.every(
        (other) =>
          Math.abs(other.at[0] - label.at[0]) >= (other.width + label.width) / 2 ||
          Math.abs(other.at[1] - y) >= (other.height + label.height) / 2,
      );
    const steps = Array.from({ length: 120 }, (_, k) => label.at[1] + (k % 2 ? 4 : -4) * Math.ceil(k / 2));
    placed.push({ ...label, at: [label.at[0], steps.find(free) ?? label.at[1]] });
  }
  return placed;
}

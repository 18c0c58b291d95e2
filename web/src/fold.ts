// The meshes of the examples, small: columns of whole numbers, and triangles as steps from the one
// before.
import type { Triangles } from './mesh';
import type { Vec } from './grasp';

export interface Folded {
  /** x, y and z of all points, in hundredths of a millimetre. */
  columns: number[][];
  steps: number[];
}

const unit = 1e-5;

export function folded({ points, triangles }: Triangles): Folded {
  const corners = triangles.flat();
  return {
    columns: [0, 1, 2].map((k) => points.map((p) => Math.round(p[k]! / unit))),
    steps: corners.map((corner, i) => corner - (corners[i - 3] ?? 0)),
  };
}

export function unfolded({ columns, steps }: Folded): Triangles {
  const last: [number, number, number] = [0, 0, 0];
  const triangles: [number, number, number][] = [];
  steps.forEach((step, i) => {
    last[i % 3]! += step;
    if (i % 3 === 2) triangles.push([...last]);
  });
  return { points: columns[0]!.map((_, i) => columns.map((column) => column[i]! * unit) as unknown as Vec), triangles };
}

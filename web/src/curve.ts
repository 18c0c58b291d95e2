// The posture curve on its arcs, where it is a formula: nothing between two answers is guessed.
import type { Arc, Curve, Range } from './core';
import { radians } from './vector';

const formula = ({ V, F }: Arc) => ({ cos2: 0, sin2: 0, ...(V ?? F!) });

/** V or F. */
export function valueOn(arc: Arc, angle: number): number {
  const c = Math.cos(radians(angle));
  const s = Math.sin(radians(angle));
  const { c0, cos1, sin1, cos2, sin2 } = formula(arc);
  return Math.max(0, c0 + cos1 * c + sin1 * s + cos2 * (c * c - s * s) + sin2 * 2 * s * c);
}

/** What is drawn of it: √V or F. */
export const heightOn = (arc: Arc, angle: number) => (arc.V ? Math.sqrt(valueOn(arc, angle)) : valueOn(arc, angle));

/** The parts of a range of postures within [-180, 180]. */
export function onAxis([from, to]: Range): Range[] {
  return [-360, 0, 360]
    .map((turn): Range => [Math.max(from + turn, -180), Math.min(to + turn, 180)])
    .filter(([low, high]) => low < high);
}

/** Points (angle, height) along each arc, its ends among them. */
export function samples(curve: Curve, step: number): [number, number][][] {
  return curve.arcs.flatMap((arc) =>
    onAxis([arc.from_deg, arc.to_deg]).map(([from, to]) => {
      const steps = Math.max(4, Math.ceil((to - from) / step));
      return Array.from({ length: steps + 1 }, (_, k): [number, number] => {
        const angle = from + ((to - from) * k) / steps;
        return [angle, heightOn(arc, angle)];
      });
    }),
  );
}

export const contains = ([from, to]: Range, angle: number, slack = 1e-9) =>
  [-360, 0, 360].some((turn) => angle + turn >= from - slack && angle + turn <= to + slack);

/** By how much √V or F changes per degree to one side of a posture (+1: counter-clockwise). */
export function slope(curve: Curve, angle: number, side: 1 | -1): number | undefined {
  const step = 1e-4;
  const arc = curve.arcs.find((each) => {
    const range: Range = [each.from_deg, each.to_deg];
    return contains(range, angle, 1e-7) && contains(range, angle + side * step);
  });
  if (!arc) return undefined;
  const c = Math.cos(radians(angle));
  const s = Math.sin(radians(angle));
  const { cos1, sin1, cos2, sin2 } = formula(arc);
  const perRadian = sin1 * c - cos1 * s + 2 * (sin2 * (c * c - s * s) - cos2 * 2 * s * c);
  return (side * radians(perRadian)) / (arc.V ? 2 * heightOn(arc, angle) : 1);
}

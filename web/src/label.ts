// Words beside fingers and arrows, where they cover neither one another nor what they tell of.
import type { Point } from './grasp';
import { text } from './svg';
import { newtons } from './words';

export interface Label {
  at: Point;
  width: number;
  height: number;
}

export type Arrow = readonly [Point, Point];

/** Where to put labels that belong near given points: each as near as it can, in turn. To cover an
 * arrow is as bad as to be 40 pixels away. */
export function apart<Kind extends Label>(labels: Kind[], arrows: readonly Arrow[] = []): Kind[] {
  const placed: Kind[] = [];
  for (const label of labels) {
    const covers = (y: number, { at, width, height }: Label) =>
      Math.abs(at[0] - label.at[0]) < (width + label.width) / 2 && Math.abs(at[1] - y) < (height + label.height) / 2;
    const cost = (y: number) =>
      Math.abs(y - label.at[1]) +
      (placed.some((other) => covers(y, other)) ? 1e4 : 0) +
      40 * arrows.filter((arrow) => crosses(arrow, [label.at[0], y], [label.width / 2 + 3, label.height / 2 + 3])).length;
    const steps = Array.from({ length: 120 }, (_, k) => label.at[1] + (k % 2 ? 4 : -4) * Math.ceil(k / 2));
    const costs = steps.map(cost);
    placed.push({ ...label, at: [label.at[0], steps[costs.indexOf(Math.min(...costs))]!] });
  }
  return placed;
}

/** Whether an arrow meets a box about a point. */
function crosses([from, to]: Arrow, at: Point, half: Point): boolean {
  let [enters, leaves] = [0, 1];
  for (const k of [0, 1] as const) {
    const ways = [-half[k], half[k]].map((side) => (at[k] + side - from[k]) / (to[k] - from[k]));
    enters = Math.max(enters, Math.min(...ways));
    leaves = Math.min(leaves, Math.max(...ways));
  }
  return enters <= leaves;
}

export interface Finger {
  name: string;
  /** On the screen: where it touches, and the way from there out of the object. */
  at: Point;
  out: Point;
  /** How hard it presses, where the object is held [N]. */
  force: number | undefined;
}

interface Words extends Label {
  lines: [words: string, kind: string][];
}

/** Each finger's name and force outside the object, and the weight beside the tip of its arrow. */
export function labels(fingers: Finger[], weight: number, tip: Point, arrows: Arrow[], size: Point): SVGTextElement[] {
  const lettering = (lines: Words['lines']) => ({
    lines,
    width: Math.max(...lines.map(([words, kind]) => (kind.startsWith('finger') ? 7.6 : 8.8) * words.length)),
    height: 17 * lines.length,
  });
  const heavy = lettering([[newtons(weight), 'gravity label']]);
  const beside = (fingers.length > 8 ? [] : fingers).map(({ name, at, out, force }): Words => {
    const own = lettering([
      [name.length > 14 ? `${name.slice(0, 13)}…` : name, 'finger label'],
      // Beside a weight, forces may be nothing but rounding.
      ...(force === undefined ? [] : [[newtons(force < 1e-9 * weight ? 0 : force), 'force label'] as [string, string]]),
    ]);
    const far = 19 + (Math.abs(out[0]) * own.width + Math.abs(out[1]) * own.height) / 2;
    const within = (k: 0 | 1, room: number) => Math.min(Math.max(at[k] + far * out[k], room / 2 + 2), size[k] - room / 2 - 2);
    return { ...own, at: [within(0, own.width), within(1, own.height)] };
  });
  return apart([{ ...heavy, at: [tip[0] + 10 + heavy.width / 2, tip[1] - 5] }, ...beside], arrows).flatMap(({ at, lines }) =>
    lines.map(([words, kind], k) => text(words, [at[0], at[1] + 5 + 17 * (k - (lines.length - 1) / 2)], kind)),
  );
}

// What is to be least, and how it is told: the grip to command, or the force norm, the root of the
// effort.
import type { AnyHold, GripUnit, Objective } from './core';
import { newtons, percent, plain } from './words';

type AnyHeld = Extract<AnyHold, { holdable: true }>;

export interface Measure {
  objective: Objective;
  /** In the middle of a sentence. */
  name: string;
  /** With symbol and unit: of an axis, of colours. */
  title: string;
  /** What is shown of a value: F of F, √V of V. */
  shown(value: number): number;
  of(hold: AnyHeld): number;
  /** A shown value with its unit. */
  text(shown: number): string;
}

export function measure(objective: Objective, unit: GripUnit | null): Measure {
  if (objective === 'effort')
    return { objective, name: 'force norm', title: 'force norm √V [N]', shown: Math.sqrt, of: (hold) => hold.force_norm, text: newtons };
  return {
    objective,
    name: 'grip',
    title: unit === 'of max' ? 'grip F, of max' : `grip F [${unit}]`,
    shown: (value) => value,
    of: (hold) => hold.grip!,
    text: (shown) => gripText(shown, unit),
  };
}

export function gripText(grip: number | null, unit: GripUnit | null): string {
  if (grip === null || unit === null) return '–';
  return unit === 'of max' ? `${percent(grip)} of max` : `${plain(grip)} ${unit}`;
}

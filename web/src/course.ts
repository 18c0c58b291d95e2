// What a turn takes: the courses on which it may go, to be drawn and played, and what is said of them.
import type { Curve, Peak, PlanarTurn, Quaternion, Range, SpatialTurn } from './core';
import { heightOn } from './curve';
import type { Point, Vec } from './grasp';
import type { Measure } from './measure';
import { about, angle, cross, times, towards, turned, unit, type Turn } from './turn';
import { radians } from './vector';
import { degrees, wrapped } from './words';

/** From one posture to another: in the plane angles, in space the directions that are up. */
export interface Course<Posture> {
  kind: 'straight' | 'detour';
  /** Of a button. */
  name: string;
  /** In all [degrees]; in the plane counter-clockwise positive. */
  by: number;
  size: number;
  /** What is needed so far on the way [degrees], in pieces, where nothing is left out. */
  pieces: Point[][];
  peak: Point | undefined;
  unholdable: Range[];
  at(way: number): Posture;
}

export interface Turning<Posture> {
  from: Posture;
  to: Posture;
  courses: Course<Posture>[];
  /** How the object is turned, in the middle of a sentence. */
  how: string;
  words: string;
}

/** Ways are told where they need less than the straight turn by more than this part. */
const worthAWay = 0.01;
/** A peak above what both ends need by no more than this part is none. */
const noPeak = 1e-3;
const peakOf = ({ peak }: { peak: number | null }) => peak ?? Infinity;

/** As `poise turn` says it. */
function peakInWords<P extends Point | Vec>(whole: string, peak: Peak<P>, { now, then }: Pick<PlanarTurn | SpatialTurn, 'now' | 'then'>, measure: Measure): string {
  const some = (shown: number) => `a ${measure.name} of ${measure.text(shown)}`;
  if (peak.unholdable.length)
    return peak.unholdable.map(({ from_deg, to_deg, posture }, k) => {
      const single = Math.abs(to_deg - from_deg) < 0.006;
      const where = single ? `after ${degrees(Math.abs(posture.turn_deg))}` : `from ${degrees(Math.abs(from_deg))} to ${degrees(Math.abs(to_deg))}`;
      const reason = posture.holdable ? '' : posture.reason.replace(/\.$/, '');
      return `${k ? 'And' : whole} it cannot be held ${where} of the turn: ${reason}.`;
    }).join(' ');
  const [first, last] = [now, then].map((hold) => (hold.holdable ? measure.of(hold) : 0)) as [number, number];
  const ends = Math.max(first, last);
  const most = measure.shown(peak.peak!);
  if (peak.peak! <= (1 + noPeak) * (measure.objective === 'grip' ? ends : ends ** 2))
    return `${whole} it needs no more than at its ${first >= last ? 'start' : 'end'}: ${some(ends)}.`;
  return `${whole} it needs up to ${some(most)}, after ${degrees(Math.abs(peak.peak_at!.turn_deg))} of ${degrees(Math.abs(peak.turn_deg))}.`;
}

/** The parts of the curve on a turn, in its order; the domain of the curve is all. */
function piecesOn(curve: Curve, from: number, by: number): Point[][] {
  const [low, high] = [Math.min(from, from + by), Math.max(from, from + by)];
  const side = Math.sign(by);
  const parts = curve.arcs.flatMap((arc) =>
    [-720, -360, 0, 360, 720].flatMap((round) => {
      const [first, last] = [Math.max(low, arc.from_deg + round), Math.min(high, arc.to_deg + round)];
      if (!(first < last)) return [];
      const steps = Math.max(2, Math.ceil((last - first) / 2));
      const points = Array.from({ length: steps + 1 }, (_, k): Point => {
        const at = first + ((last - first) * k) / steps;
        return [side * (at - from), heightOn(arc, at)];
      });
      return [side > 0 ? points : points.reverse()];
    }));
  return parts.sort((a, b) => a[0]![0] - b[0]![0]);
}

const rangeOf = ({ from_deg, to_deg }: { from_deg: number; to_deg: number }): Range => [Math.abs(from_deg), Math.abs(to_deg)];

export function planarTurning(taken: PlanarTurn, curve: Curve, measure: Measure, from: number, to: number): Turning<number> {
  const course = (peak: Peak<Point>, kind: 'straight' | 'detour'): Course<number> => ({
    kind,
    name: kind === 'straight' ? 'the shorter way round' : 'the other way round',
    by: peak.turn_deg,
    size: Math.abs(peak.turn_deg),
    pieces: piecesOn(curve, from, peak.turn_deg),
    peak: peak.peak === null ? undefined : [Math.abs(peak.peak_at!.turn_deg), measure.shown(peak.peak)],
    unholdable: peak.unholdable.map(rangeOf),
    at: (way) => wrapped(from + Math.sign(peak.turn_deg) * way),
  });
  const { turn: straight } = taken;
  const other = straight.other_way && peakOf(straight.other_way) < (1 - worthAWay) * peakOf(straight) ? straight.other_way : undefined;
  const words = [peakInWords('On this turn', straight, taken, measure)];
  if (other) words.push(peakInWords(`The other way round, by ${inWords(other.turn_deg)},`, other, taken, measure));
  return {
    from,
    to,
    courses: [course(straight, 'straight'), ...(other ? [course(other, 'detour')] : [])],
    how: inWords(straight.turn_deg),
    words: words.join(' '),
  };
}

const inWords = (by: number) => `${degrees(Math.abs(by))} ${by < 0 ? 'clockwise' : 'counter-clockwise'}`;

/** A stretch of postures in space, where values are asked for. */
export interface Track {
  /** From the start, ascending [degrees]. */
  ways: number[];
  ups: Vec[];
}

/** The third row of its matrix: what it leads to the vertical. */
const upOf = ({ w, x, y, z }: Quaternion): Vec => unit([2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z]);

/** Seen from the object: what is up moves the other way. */
function axisOf({ options: { orientation }, turn: { rotation } }: SpatialTurn): Vec {
  const { w, x, y, z } = orientation;
  const v: Vec = [-x, -y, -z];
  const axis: Vec = [rotation.x, rotation.y, rotation.z];
  const aside = times(2, cross(v, axis));
  const across = cross(v, aside);
  return unit([0, 1, 2].map((k) => -(axis[k]! + w * aside[k]! + across[k]!)) as unknown as Vec);
}

const inAll = 96;

/** The straight turn, and the way, if it is worth it. */
export function tracksOf(taken: SpatialTurn): Track[] {
  const { now, then, turn: straight } = taken;
  const steps = stepsOf(taken) ?? [];
  const ends = [now.up, ...steps, then.up];
  const legs = ends.slice(1).map((to, k): Leg => ({ from: ends[k]!, turn: (part) => towards(ends[k]!, to, part), size: degreesBetween(ends[k]!, to) }));
  const axis = axisOf(taken);
  const whole: Leg = { from: now.up, turn: (part) => about(axis, part * radians(straight.turn_deg)), size: straight.turn_deg };
  return [track([whole], straight.peak_at?.turn_deg), ...(steps.length ? [track(legs)] : [])];
}

interface Leg {
  from: Vec;
  turn(part: number): Turn;
  size: number;
}
const degreesBetween = (a: Vec, b: Vec) => (angle(a, b) * 180) / Math.PI;

function track(legs: Leg[], peak?: number): Track {
  const size = legs.reduce((sum, leg) => sum + leg.size, 0);
  let before = 0;
  const result: Track = { ways: [0], ups: [legs[0]!.from] };
  for (const leg of legs) {
    const steps = Math.max(2, Math.ceil((inAll * leg.size) / size));
    const ways = Array.from({ length: steps }, (_, k) => (leg.size * (k + 1)) / steps);
    if (peak !== undefined && peak > 0 && !ways.includes(peak)) ways.push(peak);
    for (const each of ways.sort((a, b) => a - b)) {
      result.ways.push(before + each);
      result.ups.push(turned(leg.turn(each / leg.size), leg.from));
    }
    before += leg.size;
  }
  return result;
}

/** The postures in between, of a way that needs less by enough to be told. */
function stepsOf({ turn: { way: found, ...straight } }: SpatialTurn): Vec[] | undefined {
  return found && peakOf(found) < (1 - worthAWay) * peakOf(straight) ? found.orientations.slice(1, -1).map(upOf) : undefined;
}

export function spatialTurning(taken: SpatialTurn, tracks: Track[], values: (number | null)[][], measure: Measure): Turning<Vec> {
  const { now, then, turn: straight } = taken;
  const { way: found } = straight;
  const some = (value: number) => `a ${measure.name} of ${measure.text(measure.shown(value))}`;
  const better = tracks.length > 1;
  const count = (found?.orientations.length ?? 0) - 1;
  const words = [peakInWords('On this turn', straight, taken, measure)];
  if (found?.status === 'unholdable') words.push('No way leads there: a closed curve of postures that cannot be held lies between.');
  else if (found) {
    const only = better ? `A way of ${count} steps needs only ${some(found.peak!)}` : '';
    if (found.status === 'optimal' && better) words.push(`${only}; no way needs less than ${some(found.lower_bound!)}.`);
    if (found.status === 'gap') words.push(`${only ? `${only}. ` : ''}That no way needs less is not proven: one may need only ${some(found.lower_bound!)}.`);
  }
  const courses = tracks.map(({ ways, ups }, k): Course<Vec> => {
    const points = ways.map((each, i) => [each, values[k]![i] ?? null] as const).map(([each, value]) => (value === null ? undefined : ([each, measure.shown(value)] as Point)));
    const highest = points.reduce((most, point) => (point && !(most && most[1] >= point[1]) ? point : most), undefined);
    const peak = k ? found!.peak : straight.peak;
    return {
      kind: k ? 'detour' : 'straight',
      name: k ? `the way of ${count} steps` : 'the straight turn',
      by: ways.at(-1)!,
      size: ways.at(-1)!,
      pieces: piecesOf(points),
      peak: peak === null ? undefined : [k ? highest![0] : straight.peak_at!.turn_deg, measure.shown(peak)],
      unholdable: k ? [] : straight.unholdable.map(rangeOf),
      at: (to) => between(ways, ups, to),
    };
  });
  return { from: now.up, to: then.up, courses, how: degrees(straight.turn_deg), words: words.join(' ') };
}

/** Without what cannot be held. */
function piecesOf(points: (Point | undefined)[]): Point[][] {
  const pieces: Point[][] = [[]];
  for (const point of points)
    if (point) pieces.at(-1)!.push(point);
    else pieces.push([]);
  return pieces.filter((piece) => piece.length);
}

/** Between neighbours, which are near. */
function between(ways: number[], ups: Vec[], to: number): Vec {
  const next = Math.min(Math.max(ways.findIndex((each) => each >= to), 1), ways.length - 1);
  const part = (to - ways[next - 1]!) / (ways[next]! - ways[next - 1]!);
  if (!(part < 1)) return ups[next]!;
  return turned(towards(ups[next - 1]!, ups[next]!, Math.max(part, 0)), ups[next - 1]!);
}

/** What is needed so far on the way, where it can be held. */
export function heightAt<Posture>({ pieces }: Course<Posture>, to: number): number | undefined {
  for (const piece of pieces) {
    const next = piece.findIndex(([each]) => each >= to - 1e-9);
    if (next < 0 || piece[0]![0] > to + 1e-9) continue;
    const [after, height] = piece[next]!;
    const [before, lower] = piece[Math.max(next - 1, 0)]!;
    return after > before ? lower + ((height - lower) * (Math.min(to, after) - before)) / (after - before) : height;
  }
  return undefined;
}

/** Values worth seeing: the peaks, and what is needed near postures that cannot be held only so far. */
export function highest(courses: Course<unknown>[]): number {
  const peaks = courses.flatMap(({ peak }) => (peak ? [peak[1]] : []));
  const heights = courses.flatMap(({ pieces }) => pieces.flat().map(([, height]) => height));
  const most = Math.max(...heights, ...peaks, 0);
  const ends = courses.flatMap(({ pieces }) => [pieces[0]?.[0]?.[1], pieces.at(-1)?.at(-1)?.[1]]).filter((each) => each !== undefined);
  return courses.every(({ peak }) => peak) ? most : Math.min(most, 4 * Math.max(...peaks, ...ends, 1e-300) || most);
}

import { describe, expect, test } from 'vitest';
import type { Curve, Hold, Peak, PlanarTurn, Quaternion, SpatialTurn } from '../src/core';
import { heightAt, highest, planarTurning, spatialTurning, tracksOf } from '../src/course';
import type { Point, Vec } from '../src/grasp';
import { measure } from '../src/measure';
import { angle, dot, length, minus, towards, turned, type Turn } from '../src/turn';

const grip = measure('grip', 'N');
const held = <P>(up: P, value: number) => ({ holdable: true, objective: 'grip', up, grip: value, effort: value ** 2, force_norm: value }) as unknown as Hold<P>;
const not = <P>(up: P) => ({ holdable: false, objective: 'grip', up, reason: 'it would slide down' }) as unknown as Hold<P>;
const degrees = (rad: number) => (rad * 180) / Math.PI;

describe('a turn in the plane', () => {
  // F = 2 + cos theta: most at 0, least at 180 degrees.
  const value = (at: number) => 2 + Math.cos((at * Math.PI) / 180);
  const curve: Curve = {
    arcs: [[-180, -60], [-60, 100], [100, 180]].map(([from_deg, to_deg]) => ({ from_deg: from_deg!, to_deg: to_deg!, F: { c0: 2, cos1: 1, sin1: 0 } })),
    optima: [],
    holdable_arcs_deg: [[-180, 180]],
  };
  const up: Point = [0, 1];
  const peak = (turn_deg: number, at: number, most: number): Peak<Point> =>
    ({ turn_deg, peak: most, peak_at: { ...held(up, most), turn_deg: at }, unholdable: [] });
  // From 150 to -90 degrees: the shorter way over 180, and the other one over 0.
  const taken = (straight: Peak<Point>, other_way: Peak<Point> | null): PlanarTurn =>
    ({ now: held(up, value(150)), then: held(up, value(-90)), turn: { ...straight, other_way } });

  test('follows the curve, over its seam, either way round', () => {
    for (const [from, by] of [[150, 120], [150, -240], [-170, -30], [10, 350]] as const) {
      const to = from + by;
      const { courses } = planarTurning({ now: held(up, value(from)), then: held(up, value(to)), turn: { ...peak(by, 0, 3), other_way: null } }, curve, grip, from, to);
      const [course] = courses;
      expect(course!.size).toBe(Math.abs(by));
      const points = course!.pieces.flat();
      expect(points[0]![0]).toBeCloseTo(0, 12);
      expect(points.at(-1)![0]).toBeCloseTo(Math.abs(by), 12);
      points.forEach(([way, height], k) => {
        expect(height).toBeCloseTo(value(from + Math.sign(by) * way), 12);
        if (k) expect(way).toBeGreaterThanOrEqual(points[k - 1]![0] - 1e-9);
      });
      for (const way of [0, 33.3, Math.abs(by)].filter((each) => each <= course!.size)) {
        expect(heightAt(course!, way)).toBeCloseTo(value(from + Math.sign(by) * way), 3);
        expect(value(course!.at(way))).toBeCloseTo(value(from + Math.sign(by) * way), 12);
      }
    }
  });
  test('is told with its peak', () => {
    const said = planarTurning(taken(peak(120, 120, 2), peak(-240, -150, 3)), curve, grip, 150, -90);
    expect(said.words).toBe('On this turn it needs no more than at its end: a grip of 2.000 N.');
    expect(said.courses).toHaveLength(1);
    expect(said.how).toBe('120.00° counter-clockwise');
  });
  test('has another way round where that needs less', () => {
    const said = planarTurning(taken(peak(-240, -150, 3), peak(120, 120, 2)), curve, grip, 150, -90);
    expect(said.words).toBe('On this turn it needs up to a grip of 3.000 N, after 150.00° of 240.00°. The other way round, by 120.00° counter-clockwise, it needs no more than at its end: a grip of 2.000 N.');
    expect(said.courses.map(({ kind, peak: most }) => [kind, most])).toEqual([['straight', [150, 3]], ['detour', [120, 2]]]);
    expect(planarTurning(taken(peak(-240, -150, 3), peak(120, 120, 2.98)), curve, grip, 150, -90).courses).toHaveLength(1);
  });
  test('says where it cannot be held', () => {
    const arcs = curve.arcs.slice(1);
    const straight: Peak<Point> = { turn_deg: 120, peak: null, peak_at: null, unholdable: [{ from_deg: 30, to_deg: 150, posture: { ...not(up), turn_deg: 90 } }] };
    const { words, courses } = planarTurning(taken(straight, null), { ...curve, arcs }, grip, 150, -90);
    expect(words).toBe('On this turn it cannot be held from 30.00° to 150.00° of the turn: it would slide down.');
    expect(courses[0]!.unholdable).toEqual([[30, 150]]);
    expect(courses[0]!.peak).toBeUndefined();
    expect(heightAt(courses[0]!, 20)).toBeCloseTo(value(170), 3);
    expect(heightAt(courses[0]!, 60)).toBeUndefined();
    expect(highest(courses)).toBeCloseTo(value(150), 12);
  });
});

describe('a turn in space', () => {
  const quaternion = ([x, y, z]: Turn): Quaternion => {
    // Not for half a turn.
    const w = Math.sqrt(1 + x[0] + y[1] + z[2]) / 2;
    return { w, x: (y[2] - z[1]) / (4 * w), y: (z[0] - x[2]) / (4 * w), z: (x[1] - y[0]) / (4 * w) };
  };
  /** Object to world: a posture is up. */
  const orientation = (up: Vec) => quaternion(towards(up, [0, 0, 1]));
  const now: Vec = [0.6, 0, 0.8];
  const then: Vec = [0, 0.8, -0.6];
  const between: Vec = [1, 0, 0];
  const start = towards(now, [0, 0, 1]);
  const size = degrees(angle(now, then));
  const taken: SpatialTurn = {
    options: { orientation: orientation(now) },
    now: held(now, 2),
    then: held(then, 1),
    turn: {
      rotation: quaternion(towards(turned(start, then), [0, 0, 1])),
      turn_deg: size,
      peak: 4,
      peak_at: { ...held(now, 4), turn_deg: 50.5 },
      unholdable: [],
      way: { status: 'optimal', peak: 3, lower_bound: 2.999, orientations: [now, between, then].map(orientation) },
    },
  };
  const value = (up: Vec) => 2 + up[0];
  const of = (each: SpatialTurn) => {
    const tracks = tracksOf(each);
    return { tracks, ...spatialTurning(each, tracks, tracks.map(({ ups }) => ups.map(value)), grip) };
  };

  test('goes straight, and by way of postures', () => {
    const { tracks, courses } = of(taken);
    const [straight, way] = tracks;
    expect(tracks).toHaveLength(2);
    for (const each of tracks) {
      expect(length(minus(each.ups[0]!, now))).toBeLessThan(1e-12);
      expect(length(minus(each.ups.at(-1)!, then))).toBeLessThan(1e-9);
      each.ups.forEach((up) => expect(length(up)).toBeCloseTo(1, 12));
      each.ups.slice(1).forEach((up, k) => expect(degrees(angle(each.ups[k]!, up))).toBeCloseTo(each.ways[k + 1]! - each.ways[k]!, 9));
      expect(each.ups.length).toBeGreaterThan(60);
      expect(each.ups.length).toBeLessThan(120);
    }
    expect(straight!.ways.at(-1)).toBeCloseTo(size, 9);
    expect(straight!.ways).toContain(50.5);
    expect(way!.ups.some((up) => length(minus(up, between)) < 1e-9)).toBe(true);
    expect(way!.ways.at(-1)).toBeCloseTo(degrees(angle(now, between) + angle(between, then)), 9);
    const at = courses[0]!.at(40);
    expect(degrees(angle(now, at))).toBeCloseTo(40, 9);
    expect(degrees(angle(then, at))).toBeCloseTo(size - 40, 9);
    expect(heightAt(courses[0]!, 40)).toBeCloseTo(value(at), 3);
  });
  test('goes over the head as the world says', () => {
    // Upside down about the world's x, which is the object's.
    const over: SpatialTurn = { ...taken, options: { orientation: { w: 1, x: 0, y: 0, z: 0 } }, now: held([0, 0, 1], 2), then: held([0, 0, -1], 2),
      turn: { ...taken.turn, turn_deg: 180, rotation: { w: 0, x: 1, y: 0, z: 0 }, way: null } };
    const [straight] = tracksOf(over);
    const side = straight!.ups[Math.floor(straight!.ups.length / 2)]!;
    expect(side[0]).toBeCloseTo(0, 12);
    // By a quarter of a turn about x, what was along y points up.
    expect(dot(side, [0, 1, 0])).toBeGreaterThan(0.99);
  });
  test('is told with its peak and its way', () => {
    expect(of(taken).words).toBe(`On this turn it needs up to a grip of 4.000 N, after 50.50° of ${size.toFixed(2)}°. A way of 2 steps needs only a grip of 3.000 N; no way needs less than a grip of 2.999 N.`);
    const told = (way: SpatialTurn['turn']['way']) => of({ ...taken, turn: { ...taken.turn, way } });
    expect(told({ ...taken.turn.way!, status: 'gap', lower_bound: 2 }).words).toMatch(/ A way of 2 steps needs only a grip of 3.000 N\. That no way needs less is not proven: one may need only a grip of 2.000 N\.$/);
    const same = told({ ...taken.turn.way!, peak: 3.999, orientations: [now, then].map(orientation) });
    expect(same.words).toMatch(/of \d+\.\d+°\.$/);
    expect(same.courses).toHaveLength(1);
    expect(told({ status: 'unholdable', peak: null, lower_bound: null, orientations: [] }).words).toMatch(/No way leads there/);
  });
  test('leaves out what cannot be held', () => {
    const straight = { ...taken.turn, peak: null, peak_at: null, unholdable: [{ from_deg: 30, to_deg: 60, posture: { ...not(now), turn_deg: 45 } }] };
    const each = { ...taken, turn: { ...straight, way: null } };
    const tracks = tracksOf(each);
    const { courses } = spatialTurning(each, tracks, [tracks[0]!.ways.map((way) => (way > 30 && way < 60 ? null : 2))], grip);
    expect(courses[0]!.pieces).toHaveLength(2);
    expect(heightAt(courses[0]!, 45)).toBeUndefined();
    expect(heightAt(courses[0]!, 20)).toBe(2);
  });
});

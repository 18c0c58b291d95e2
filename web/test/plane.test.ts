import { describe, expect, test } from 'vitest';
import type { Arc, Curve } from '../src/core';
import { contains, heightOn, onAxis, samples, slope } from '../src/curve';
import { fileName, fromLink, toLink, yaml } from '../src/files';
import { massesOf, ownMassesOf, push, pushOf, type Grasp, type PlanarGrasp, type PlanarShape, type Point } from '../src/grasp';
import { alphas, asPaper, paperDisk } from '../src/paper';
import { along, nearest } from '../src/shape';
import { dot, length, minus } from '../src/vector';
import { degrees, list, newtons, plain, turn, wrapped } from '../src/words';

describe('the paper', () => {
  // The table of docs/paper.md.
  test.each([
    [60, Math.sqrt(3), Math.sqrt(3), 0, 12.2474],
    [60, 1, 1, 0, 26.3896],
    [75, 1, 1, 0, 12.2474],
    [75, 1, 1 / Math.sqrt(3), 30, 15.7834],
  ])('phi = %d, mu = %d and %d', (phi, mu1, mu2, theta, alpha) => {
    const paper = asPaper(paperDisk('', phi, mu1, mu2))!;
    const all = alphas(paper, theta);
    expect(Math.max(...all)).toBeCloseTo(alpha, 3);
    expect(all[4]).toBeCloseTo(all[5]!, 9);
  });
  test('is not about disks with a limit, or whose com is elsewhere', () => {
    const disk = paperDisk('', 60, 1, 1);
    expect(asPaper({ ...disk, object: { ...disk.object, com: [0.1, 0] } })).toBeUndefined();
    disk.contacts[0]!.max_normal = 3;
    expect(asPaper(disk)).toBeUndefined();
  });
});

describe.each([
  ['effort', { from_deg: 100, to_deg: 250, V: { c0: 9, cos1: 1, sin1: 2, cos2: -3, sin2: 1 } }, (c: number, s: number) => Math.sqrt(9 + c + 2 * s - 3 * (c * c - s * s) + 2 * s * c)],
  ['grip', { from_deg: 100, to_deg: 250, F: { c0: 9, cos1: 1, sin1: 2 } }, (c: number, s: number) => 9 + c + 2 * s],
] as [string, Arc, (c: number, s: number) => number][])('the curve of the %s', (_, arc, height) => {
  const curve: Curve = { arcs: [arc], optima: [], holdable_arcs_deg: [[100, 250]] };
  test('is drawn on the axis', () => {
    expect(onAxis([100, 250])).toEqual([[-180, -110], [100, 180]]);
    expect(contains([100, 250], -150)).toBe(true);
    expect(contains([100, 250], 0)).toBe(false);
    const points = samples(curve, 1).flat();
    expect(Math.min(...points.map(([angle]) => angle))).toBe(-180);
    expect(Math.max(...points.map(([angle]) => angle))).toBe(180);
    for (const [angle, y] of points) expect(y).toBeCloseTo(height(Math.cos((angle * Math.PI) / 180), Math.sin((angle * Math.PI) / 180)), 12);
  });
  test('is as steep as it looks', () => {
    const step = 1e-5;
    const rise = (heightOn(arc, 150 + step) - heightOn(arc, 150 - step)) / (2 * step);
    expect(slope(curve, 150, 1)).toBeCloseTo(rise, 6);
    expect(slope(curve, 150, -1)).toBeCloseTo(-rise, 6);
    expect(slope(curve, 0, 1)).toBeUndefined();
  });
});

describe('outlines', () => {
  const ellipse: PlanarShape = { ellipse: { radii: [2, 1] } };
  test('have a nearest point, from which the normal leads back', () => {
    for (const to of [[3, 1], [0.5, 2], [-1, -3]] as Point[]) {
      const p = nearest(ellipse, to);
      expect((p[0] / 2) ** 2 + p[1] ** 2).toBeCloseTo(1, 9);
      const normal: Point = [p[0] / 4, p[1]];
      expect(dot(minus(to, p), normal) / (length(minus(to, p)) * length(normal))).toBeCloseTo(1, 6);
    }
  });
  test('are walked along', () => {
    expect(length(minus(along(ellipse, [2, 0], 0.01), [2, 0]))).toBeCloseTo(0.01, 5);
    const square: PlanarShape = { polygon: [[0, 0], [1, 0], [1, 1], [0, 1]] };
    expect(along(square, [0.5, 0], 0.25)).toEqual([0.75, 0]);
    const [x, y] = along(square, [0.9, 0], 0.25);
    expect(x).toBe(1);
    expect(y).toBeGreaterThan(0);
  });
});

test('numbers are written as the command line writes them', () => {
  expect([plain(17.3205), plain(300), plain(0.0012345), plain(0), newtons(9.99999)]).toEqual(['17.32', '300.0', '0.001234', '0', '10.00 N']);
  expect([degrees(-0.001), wrapped(-180), wrapped(540), turn(170, -170)]).toEqual(['0.00°', 180, 180, '20.00° counter-clockwise']);
  expect(list(['a', 'b', 'c'])).toBe('a, b and c');
});

describe('loads', () => {
  const plain = (): PlanarGrasp => ({ poise: 1, dimension: 2, object: { weight: 4, com: [0.1, 0] }, contacts: [] });
  test('take from the object what they do not say, and change it there', () => {
    const grasp: PlanarGrasp = { ...plain(), loads: [{ name: 'lifted', acceleration: { up: 2 } }, { weight: 9 }, { name: 'again' }] };
    expect(massesOf(grasp).map(({ name, weight }) => [name, weight])).toEqual([['lifted', 4], ['1', 9], ['again', 4]]);
    expect(ownMassesOf(grasp).map(({ name }) => name)).toEqual(['lifted', '1']);
    massesOf(grasp)[2]!.weight = 5;
    massesOf(grasp)[1]!.weight = 6;
    expect([grasp.object.weight, grasp.loads![1]!.weight, grasp.loads![0]!.weight]).toEqual([5, 6, undefined]);
  });
  test('are made by a push, at the centre of mass', () => {
    const grasp = plain();
    expect(pushOf(grasp)).toBeUndefined();
    push(grasp, [1, 2]);
    push(grasp, [3, 4]);
    expect(grasp.loads).toEqual([{ name: 'pushed', force: [3, 4], at: [0.1, 0] }]);
    const lifted: PlanarGrasp = { ...plain(), loads: [{ name: 'a' }, { com: [0, 1] }] };
    push<Point>(lifted, [1, 0]);
    expect(lifted.loads!.map(({ at }) => at)).toEqual([[0.1, 0], [0, 1]]);
    expect(pushOf(lifted)).toEqual([1, 0]);
  });
});

describe('files', () => {
  const grasp: Grasp = {
    poise: 1, dimension: 3, name: 'a "name": with <b>, # and ä',
    object: { weight: 1, com: [0, 0, 0.125] },
    loads: [{ name: 'full' }, { weight: 2, com: [0, 0, 0] }],
    contacts: [{ position: [1, 0, 0], normal: [-1, 0, 0], friction: 1e-7, finger: "it's" }],
  };
  test('in YAML have a line for each contact', () => {
    expect(yaml(grasp).split('\n')).toEqual([
      'poise: 1',
      'dimension: 3',
      'name: "a \\"name\\": with <b>, # and ä"',
      'object:',
      '  weight: 1',
      '  com: [0, 0, 0.125]',
      'loads:',
      '  - {name: "full"}',
      '  - {weight: 2, com: [0, 0, 0]}',
      'contacts:',
      '  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 1e-7, finger: "it\'s"}',
      '',
    ]);
    expect(fileName(grasp)).toBe('a-name-with-b-and-a');
    expect(fileName({ ...grasp, name: '…' })).toBe('grasp');
  });
  test('travel in links', async () => {
    const link = await toLink(grasp);
    expect(link).toMatch(/^grasp=[A-Za-z0-9_-]+$/);
    expect(JSON.parse(new TextDecoder().decode(await fromLink(`#${link}`)))).toEqual(grasp);
    expect(await fromLink('#elsewhere')).toBeUndefined();
    expect(await fromLink('#grasp=!!!')).toHaveLength(0);
    expect(await fromLink(`#${link.slice(0, 40)}`)).toHaveLength(0);
  });
});

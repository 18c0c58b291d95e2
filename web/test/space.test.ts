import { describe, expect, test } from 'vitest';
import type { Vec } from '../src/grasp';
import { apart } from '../src/label';
import { bodyOf, bodyOfMesh, hit, icosahedron, onSurface, polytope, refined, split, type Body } from '../src/mesh';
import { folded, unfolded } from '../src/fold';
import { circle, flat } from '../src/ring';
import { rounds } from '../src/scale';
import { ballOf } from '../src/turn';
import { about, add, after, angle, cross, dot, frame, length, minus, times, towards, turned, turnedBack, unit } from '../src/turn';

// The same numbers in every run.
let state = 7;
const random = () => ((state = (state * 48271) % 2147483647) / 2147483647) * 2 - 1;
const direction = (): Vec => {
  const v: Vec = [random(), random(), random()];
  return length(v) > 0.1 && length(v) < 1 ? unit(v) : direction();
};
const close = (a: Vec, b: Vec, within = 1e-12) => expect(length(minus(a, b))).toBeLessThan(within);

describe('rotations', () => {
  test('lead from one direction to another by the angle between them', () => {
    for (let k = 0; k < 100; ++k) {
      const [a, b] = [direction(), direction()];
      close(turned(towards(a, b), a), b);
      expect(angle(turned(towards(a, b, 0.25), a), a)).toBeCloseTo(angle(a, b) / 4, 12);
      close(turnedBack(towards(a, b), b), a);
    }
    close(turned(towards([0, 0, 1], [0, 0, -1]), [0, 0, 1]), [0, 0, -1]);
  });
  test('follow one another', () => {
    const [a, b, p] = [about(direction(), 1), about(direction(), 2), direction()];
    close(turned(after(a, b), p), turned(a, turned(b, p)));
  });
  test('turn to the left', () => close(turned(about([0, 0, 1], Math.PI / 2), [1, 0, 0]), [0, 1, 0]));
  test('keep lengths after many of them', () => {
    let turn = about(direction(), 1);
    for (let k = 0; k < 10000; ++k) turn = after(about([0, 0, 1], 0.01), turn);
    expect(length(turned(turn, [0, 1, 0]))).toBeCloseTo(1, 13);
  });
  test('stand on a direction', () => {
    const n = direction();
    const [x, y, z] = frame(n);
    close(z, n);
    close(cross(x, y), z);
  });
});

/** By Gauss; the sign tells whether triangles are seen from outside. */
const volume = ({ points, triangles }: Pick<Body, 'points' | 'triangles'>) =>
  triangles.reduce((sum, [a, b, c]) => sum + dot(points[a]!, cross(points[b]!, points[c]!)) / 6, 0);

describe('bodies', () => {
  test('have the volume of their shape', () => {
    expect(volume(bodyOf({ box: { size: [1, 2, 3] } }))).toBeCloseTo(6, 12);
    expect(volume(bodyOf({ cylinder: { radius: 2, height: 3 } })) / (12 * Math.PI)).toBeCloseTo(1, 2);
    expect(volume(bodyOf({ sphere: { radius: 2 } })) / ((32 * Math.PI) / 3)).toBeCloseTo(1, 2);
    expect(volume(bodyOf({ ellipsoid: { radii: [1, 2, 3] } })) / (8 * Math.PI)).toBeCloseTo(1, 2);
  });
  test('have normals that point outwards', () => {
    for (const shape of [{ box: { size: [1, 2, 3] as Vec } }, { cylinder: { radius: 2, height: 3 } }, { ellipsoid: { radii: [1, 2, 3] as Vec } }]) {
      const { points, triangles, normals } = bodyOf(shape);
      triangles.forEach((corners, t) => corners.forEach((corner, k) => expect(dot(points[corner]!, normals[3 * t + k]!)).toBeGreaterThanOrEqual(-1e-12)));
    }
  });
  test('have the edges of a box, also as a mesh', () => {
    const box = bodyOf({ box: { size: [1, 2, 3] } });
    expect(box.edges).toHaveLength(12);
    const mesh = bodyOfMesh(box);
    expect(mesh.edges).toHaveLength(12);
    expect(volume(mesh)).toBeCloseTo(6, 12);
  });
  test('may have more points than a call has arguments', { timeout: 60000 }, () => {
    // A sheet that is folded once: its edges are the fold and nothing else.
    const n = 400;
    const points = Array.from({ length: n * n }, (_, k): Vec => [k % n, Math.abs(Math.floor(k / n) - n / 2), 0.1 * Math.floor(k / n)]);
    const triangles = points.flatMap((_, k) => (k % n === n - 1 || k >= n * (n - 1) ? [] : [[k, k + 1, k + n], [k + 1, k + n + 1, k + n]] as [number, number, number][]));
    expect(bodyOfMesh({ points, triangles }).edges).toHaveLength(n - 1);
    expect(ballOf(points)).toMatchObject({ centre: [(n - 1) / 2, n / 4, 0.05 * (n - 1)] });
  });
  test('are hit where they are', () => {
    const box = bodyOf({ box: { size: [1, 2, 3] } });
    for (let k = 0; k < 200; ++k) {
      const [p, d] = [times(5, direction()), direction()];
      // By slabs: the last entry before the first exit.
      const [near, far] = [0, 1, 2].reduce(([low, high], i) => {
        const half = [0.5, 1, 1.5][i]!;
        const [s, t] = [(-half - p[i]!) / d[i]!, (half - p[i]!) / d[i]!];
        return [Math.max(low!, Math.min(s, t)), Math.min(high!, Math.max(s, t))];
      }, [-Infinity, Infinity]);
      const found = hit(box, p, d);
      if (near! < far! && near! > 0) close(found!.point, add(p, times(near!, d)), 1e-9);
      else expect(found).toBeUndefined();
    }
  });
  test('keep contacts on their surface and off their edges', () => {
    for (let k = 0; k < 200; ++k) {
      const p = times(3, direction());
      const [x, y, z] = onSurface({ box: { size: [2, 2, 2] } }, p).map(Math.abs).sort((a, b) => a - b);
      expect(z).toBeCloseTo(1, 12);
      expect(Math.max(x!, y!)).toBeLessThan(1 - 2e-4);
      const [a, b, c] = onSurface({ cylinder: { radius: 1, height: 2 } }, p);
      const [side, end] = [Math.hypot(a, b), Math.abs(c)];
      expect(Math.max(side, end)).toBeCloseTo(1, 12);
      expect(Math.min(side, end)).toBeLessThan(1 - 2e-4);
      const e = onSurface({ ellipsoid: { radii: [1, 2, 3] } }, p);
      expect(Math.hypot(e[0], e[1] / 2, e[2] / 3)).toBeCloseTo(1, 12);
    }
  });
  test('of a sphere are the finer the more triangles they have', () => {
    const fine = refined(icosahedron, 3);
    expect(fine.points).toHaveLength(642);
    expect(fine.triangles).toHaveLength(1280);
    fine.points.forEach((p) => expect(length(p)).toBeCloseTo(1, 12));
  });
});

describe('what planes leave over', () => {
  const area = (face: Vec[]) =>
    face.slice(2).reduce((sum, last, k) => sum + length(cross(minus(face[k + 1]!, face[0]!), minus(last, face[0]!))) / 2, 0);
  test('is a cube, an octahedron', () => {
    const cube = polytope([], 1);
    expect(cube).toHaveLength(6);
    cube.forEach((face) => expect(area(face)).toBeCloseTo(4, 9));
    const signs = [0, 1, 2, 3, 4, 5, 6, 7].map((k): Vec => [k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1]);
    const octahedron = polytope(signs.map((a) => ({ a, c: 1 })), 2);
    expect(octahedron).toHaveLength(8);
    octahedron.forEach((face) => expect(area(face)).toBeCloseTo(Math.sqrt(3) / 2, 9));
  });
  test('lies on the right side of all of them, and is closed', () => {
    const planes = Array.from({ length: 40 }, () => ({ a: direction(), c: 1 }));
    const faces = polytope(planes, 3);
    for (const p of faces.flat()) for (const { a, c } of planes) expect(dot(a, p)).toBeLessThan(c + 1e-9);
    const edges = faces.reduce((sum, face) => sum + face.length, 0) / 2;
    const corners = new Set(faces.flat().map((p) => p.map((x) => x.toFixed(6)).join()));
    expect(corners.size - edges + faces.length).toBe(2);
  });
});

test('round numbers lie between the ends, some but not many', () => {
  for (const [low, high] of [[4.9, 8.8], [1, 1000], [5.39, 5.41], [0.013, 0.04], [10.62, 17]] as const) {
    const found = rounds(low, high);
    expect(found.length).toBeGreaterThan(1);
    expect(found.length).toBeLessThan(17);
    found.forEach((value) => expect(value > low && value < high).toBe(true));
  }
});

test('labels do not lie on one another', () => {
  const labels = apart(Array.from({ length: 6 }, (_, k) => ({ at: [100 + 5 * k, 50] as const, width: 60, height: 30 })));
  labels.forEach((a, i) => labels.slice(i + 1).forEach((b) =>
    expect(Math.abs(a.at[0] - b.at[0]) >= 60 || Math.abs(a.at[1] - b.at[1]) >= 30).toBe(true)));
  expect(labels[0]!.at).toEqual([100, 50]);
});

test('labels leave arrows free where they can', () => {
  const arrow = [[0, 50], [200, 50]] as const;
  const [label] = apart([{ at: [100, 52] as const, width: 60, height: 30 }], [arrow]);
  expect(Math.abs(label!.at[1] - 50)).toBeGreaterThanOrEqual(18);
  expect(Math.abs(label!.at[1] - 52)).toBeLessThan(30);
  // Not at any price: an arrow that goes on and on is covered.
  const [stuck] = apart([{ at: [100, 52] as const, width: 60, height: 30 }], [[[100, -500], [100, 600]]]);
  expect(stuck!.at).toEqual([100, 52]);
});

test('folded meshes are the same to half a hundredth of a millimetre', () => {
  const body = bodyOf({ cylinder: { radius: 0.04, height: 0.1 } });
  const again = unfolded(JSON.parse(JSON.stringify(folded(body))));
  expect(again.triangles).toEqual(body.triangles);
  again.points.forEach((p, k) => close(p, body.points[k]!, 0.9e-5));
});

test('where something changes, a sphere is split, and covers as much as before', () => {
  const inside = ([x, , z]: Vec) => z + 0.3 * x > 0.5;
  let net = refined(icosahedron, 3);
  const coarse = net.points.length;
  for (let k = 0; k < 2; ++k) net = split(net, (point) => inside(net.points[point]!));
  // By Girard: the areas on the unit sphere.
  const area = net.triangles.reduce((sum, corners) => {
    const [a, b, c] = corners.map((k) => net.points[k]!) as [Vec, Vec, Vec];
    const wedge = (p: Vec, q: Vec, r: Vec) => angle(cross(p, q), cross(p, r));
    return sum + wedge(a, b, c) + wedge(b, c, a) + wedge(c, a, b) - Math.PI;
  }, 0);
  expect(area).toBeCloseTo(4 * Math.PI, 9);
  const long = net.triangles.filter((corners) => new Set(corners.map((k) => inside(net.points[k]!))).size > 1)
    .map(([a, b]) => angle(net.points[a]!, net.points[b]!));
  expect(Math.max(...long)).toBeLessThan(0.05);
  expect(net.points.length).toBeLessThan(3 * coarse);
  // What was there keeps its place.
  expect(net.points.slice(0, coarse)).toEqual(refined(icosahedron, 3).points);
});

describe('a plane of loads', () => {
  const n = unit([1, 2, 3]);
  const wall = { a: times(1e9, n), b: 0, rate: 1 };
  const back = { a: times(-3e9, n), b: 1e-9, rate: 1 };
  test('is what two walls leave', () => {
    const found = flat([{ a: [3, 4, 5], b: 2, rate: 1 }, wall, { a: [0, 0, -7], b: 2, rate: 1 }, back], 2)!;
    close(times(Math.sign(dot(found, n)), found), n);
  });
  test('is what two walls leave that hold whatever the grip', () => {
    const found = flat([{ a: n, b: 0, rate: 0 }, { a: times(-1, n), b: 0, rate: 0 }], 2)!;
    close(times(Math.sign(dot(found, n)), found), n);
  });
  test('is not what one wall leaves, nor two with room between them', () => {
    expect(flat([wall, { a: [3, 4, 5], b: 2, rate: 1 }], 2)).toBeUndefined();
    expect(flat([{ a: n, b: 2, rate: 1 }, { a: times(-1, n), b: 2, rate: 1 }], 2)).toBeUndefined();
  });
  test('is gone round once', () => {
    const ups = circle(n);
    close(ups[0]!, ups.at(-1)!);
    for (const up of ups) expect([dot(up, n), length(up) - 1].every((each) => Math.abs(each) < 1e-12)).toBe(true);
    for (const [k, up] of ups.slice(1).entries()) expect(angle(up, ups[k]!)).toBeCloseTo(Math.PI / 180, 9);
  });
});

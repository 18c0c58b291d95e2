// Outlines: points on them, and ways along them.
import type { PlanarShape, Point } from './grasp';
import { add, dot, length, minus, times } from './vector';

const points = 180;

/** The boundary as a closed line, without repeating the first point. */
export function outline(shape: PlanarShape): Point[] {
  if ('polygon' in shape) return shape.polygon;
  return Array.from({ length: points }, (_, k) => onEllipse(radii(shape), (2 * Math.PI * k) / points));
}

/** The point of the boundary nearest to a point; a polygon's corners, which have no normal, apart. */
export function nearest(shape: PlanarShape, to: Point): Point {
  if ('polygon' in shape) return nearestOfPolygon(shape.polygon, to);
  const [a, b] = radii(shape);
  return onEllipse([a, b], nearestParameter([a, b], to));
}

/** The point of the boundary that lies a way further along it. */
export function along(shape: PlanarShape, from: Point, way: number): Point {
  if ('polygon' in shape) return alongPolygon(shape.polygon, from, way);
  const [a, b] = radii(shape);
  const t = nearestParameter([a, b], from);
  return onEllipse([a, b], t + way / Math.hypot(a * Math.sin(t), b * Math.cos(t)));
}

const radii = (shape: Exclude<PlanarShape, { polygon: Point[] }>): Point =>
  'disk' in shape ? [shape.disk.radius, shape.disk.radius] : shape.ellipse.radii;

const onEllipse = ([a, b]: Point, t: number): Point => [a * Math.cos(t), b * Math.sin(t)];

function nearestParameter([a, b]: Point, to: Point): number {
  if (a === b) return Math.atan2(to[1], to[0]);
  const distance = (t: number) => length(minus(onEllipse([a, b], t), to));
  let best = 0;
  for (let k = 1; k < points; ++k) {
    const t = (2 * Math.PI * k) / points;
    if (distance(t) < distance(best)) best = t;
  }
  let [low, high] = [best - (2 * Math.PI) / points, best + (2 * Math.PI) / points];
  for (let k = 0; k < 60; ++k) {
    const [t, u] = [low + (high - low) / 3, high - (high - low) / 3];
    if (distance(t) < distance(u)) high = u;
    else low = t;
  }
  return (low + high) / 2;
}

interface Edge {
  from: Point;
  direction: Point;
  length: number;
}

function edges(polygon: Point[]): Edge[] {
  return polygon.map((from, k) => {
    const way = minus(polygon[(k + 1) % polygon.length]!, from);
    return { from, direction: times(1 / length(way), way), length: length(way) };
  });
}

/** Twice as far from corners as the core takes for the corner itself: 1e-4 of the shape's size. */
function clearance(polygon: Point[]): number {
  const [x, y] = [polygon.map((p) => p[0]), polygon.map((p) => p[1])];
  return 1e-4 * Math.hypot(Math.max(...x) - Math.min(...x), Math.max(...y) - Math.min(...y));
}

function at(edge: Edge, way: number, clear: number): Point {
  const room = Math.min(clear, edge.length / 2);
  return add(edge.from, times(Math.min(Math.max(way, room), edge.length - room), edge.direction));
}

function nearestEdge(polygon: Point[], to: Point): { edge: number; way: number; point: Point } {
  const clear = clearance(polygon);
  const candidates = edges(polygon).map((edge, k) => {
    const way = dot(minus(to, edge.from), edge.direction);
    return { edge: k, way, point: at(edge, way, clear) };
  });
  return candidates.reduce((best, next) =>
    length(minus(next.point, to)) < length(minus(best.point, to)) ? next : best,
  );
}

const nearestOfPolygon = (polygon: Point[], to: Point) => nearestEdge(polygon, to).point;

function alongPolygon(polygon: Point[], from: Point, way: number): Point {
  const all = edges(polygon);
  const clear = clearance(polygon);
  const start = nearestEdge(polygon, from);
  const edge = all[start.edge]!;
  const target = start.way + way;
  // Over a corner to the beginning of the next edge: no posture of the contact is left out by that.
  const step = target > edge.length - clear ? 1 : target < clear ? -1 : 0;
  if (step === 0) return at(edge, target, clear);
  const next = all[(start.edge + step + all.length) % all.length]!;
  return at(next, step > 0 ? clear : next.length - clear, clear);
}

// The posture curve: drawn from its arcs, with the present posture as a handle.
import type { Curve, Kind, Optimum, Range } from './core';
import type { Turning } from './course';
import { contains, heightOn, onAxis, samples } from './curve';
import type { Point } from './grasp';
import type { Measure } from './measure';
import { alphas, asPaper } from './paper';
import type { PlanarModel } from './state';
import { draggable, keySteps, line, node, path, place, set, text } from './svg';
import { degrees, plain, wrapped } from './words';

export interface View {
  squared: boolean;
  logarithmic: boolean;
  bounds: boolean;
}

/** Two lines of words, the upper one at y. */
interface Written {
  x: number;
  y: number;
  half: number;
}

const margin = { left: 58, right: 16, top: 14, bottom: 38 };

export class Plot {
  readonly view: View = { squared: false, logarithmic: false, bounds: false };
  /** From the grasp file's posture. */
  turning: Turning<number> | undefined;
  readonly picture = node('svg', { role: 'group', 'aria-label': 'What the fingers need, over all postures' });
  private readonly layers = node('g', { class: 'passive' });
  private readonly area = node('rect', { class: 'area' });
  private readonly marks = node('g');
  private readonly handle = node('g', { class: 'handle posture', tabindex: 0, role: 'slider' });
  private size: Point = [600, 300];

  constructor(
    parent: HTMLElement,
    private readonly model: PlanarModel,
  ) {
    this.picture.append(
      node(
        'defs',
        {},
        hatch('hatch'),
        node('clipPath', { id: 'inside' }, node('rect')),
      ),
      this.area,
      this.layers,
      this.marks,
      this.handle,
    );
    parent.prepend(this.picture);
    set(this.handle, { 'aria-label': 'Posture', 'aria-valuemin': -180, 'aria-valuemax': 180 });
    const follow = (event: PointerEvent) => {
      const angle = this.angleAt(place(this.picture, event)[0]);
      this.model.turnTo(this.model.snapped(angle, (5 * 360) / this.width()));
    };
    for (const element of [this.area, this.handle])
      draggable(element, (event) => {
        follow(event);
        return follow;
      }, this.handle);
    keySteps(this.handle, (dx, dy) => this.model.turnTo(this.model.angle + dx + dy));
  }

  /** By factors of ten where the curve climbs far above its lowest point, unless that is nothing. */
  suitScale(): void {
    const { low, high } = this.range();
    this.view.logarithmic = high > 20 * low && low > 1e-6 * high;
  }

  private squared = () => this.view.squared && this.model.answers.measure.objective === 'effort';
  showsBounds = () => this.view.bounds && this.mayShowBounds();
  /** They are newtons of force norm. */
  mayShowBounds = () =>
    !this.squared() && this.model.answers.measure.objective === 'effort' && asPaper(this.model.answers.grasp) !== undefined;
  /** The curve of the other objective, where it has the same unit. */
  other = () => (this.squared() ? undefined : this.model.answers.other);
  private width = () => this.size[0] - margin.left - margin.right;
  private height = () => this.size[1] - margin.top - margin.bottom;
  private x = (angle: number) => margin.left + ((angle + 180) / 360) * this.width();
  private angleAt = (x: number) =>
    Math.min(180, Math.max(-180, ((x - margin.left) / this.width()) * 360 - 180));
  private scaled = (height: number) => (this.squared() ? height ** 2 : height);
  private of = (hold: Parameters<Measure['of']>[0]) => this.scaled(this.model.answers.measure.of(hold));

  /** Heights worth seeing: up to a thousand times the lowest, or to the last minimum. */
  private range(): { low: number; high: number } {
    const { answers } = this.model;
    if (!answers.best.best) return { low: 1, high: 10 };
    const ranges = [answers.curve, this.other()].flatMap((curve) => {
      const heights = curve ? samples(curve, 1).flat().map(([, height]) => height) : [];
      if (!heights.length) return [];
      const minima = curve!.optima.filter((each) => each.type === 'min').map(heightOf);
      const low = Math.min(...heights, ...minima);
      const highest = Math.max(...heights);
      return [{ low, high: Math.min(highest, Math.max(1000 * low, 3 * Math.max(...minima))) }];
    });
    const [low, high] = [Math.min(...ranges.map((each) => each.low)), Math.max(...ranges.map((each) => each.high))];
    return high > 5e-10 ? { low, high } : { low: 0, high: 1 };
  }

  draw(): void {
    const box = this.picture.getBoundingClientRect();
    this.size = [box.width || 600, box.height || 300];
    const [width, height] = this.size;
    set(this.picture, { viewBox: `0 0 ${width} ${height}` });
    const frame = { x: margin.left, y: margin.top, width: this.width(), height: this.height() };
    set(this.area, frame);
    set(this.picture.querySelector('clipPath rect')!, frame);

    const y = this.vertical();
    const inside = node('g', { 'clip-path': 'url(#inside)' });
    inside.append(...this.shades(), ...this.grid(y.ticks, y.at));
    const bounds = this.showsBounds() ? this.bounds(y.at) : { lines: [], names: [] };
    inside.append(...bounds.lines);
    const drawn = (curve: Curve | undefined, kind: string) =>
      (curve ? samples(curve, 180 / this.width()) : []).map((points) =>
        node('path', {
          d: path(points.map(([angle, height]): Point => [this.x(angle), y.at(this.scaled(height))])),
          class: kind,
        }),
      );
    inside.append(...drawn(this.other(), 'other'), ...drawn(this.model.answers.curve, 'curve'));
    inside.append(...this.turns(y.at), ...bounds.names, this.now(this.drawOptima(y.at)));
    this.layers.replaceChildren(inside, ...this.axes(y.ticks, y.at));
    this.drawHandle(y.at);
  }

  /** The line of the present posture, which leaves out what is written across it. */
  private now(written: Written[]): Node {
    const x = this.x(this.model.angle);
    const across = written.filter((each) => Math.abs(each.x - x) < each.half + 3).sort((a, b) => a.y - b.y);
    const ends = [margin.top, ...across.flatMap(({ y }) => [y - 12, y + 17]), margin.top + this.height()];
    return node('path', { d: ends.map((y, k) => `${k % 2 ? 'L' : 'M'}${x} ${y}`).join(''), class: 'now' });
  }

  private vertical(): { at: (value: number) => number; ticks: number[] } {
    const { low, high } = this.range();
    const [least, most] = [this.scaled(low), this.scaled(high)];
    const { logarithmic } = this.view;
    const [bottom, top] = logarithmic ? [0.45 * Math.max(least, most / 1e4), 1.7 * most] : [0, 1.12 * most];
    const part = (value: number) =>
      logarithmic
        ? Math.log(Math.max(value, 1e-300) / bottom) / Math.log(top / bottom)
        : value / top;
    const floor = margin.top + this.height();
    return {
      at: (value) => Math.min(Math.max(floor - part(value) * this.height(), -1e4), 1e4),
      ticks: logarithmic ? decades(bottom, top) : steps(top, this.height() / 45),
    };
  }

  private shades(): Node[] {
    const shade = ([from, to]: Range, kind: string) =>
      onAxis([from, to]).map(([low, high]) =>
        node('rect', {
          x: this.x(low),
          y: margin.top,
          width: Math.max(this.x(high) - this.x(low), 0),
          height: this.height(),
          class: kind,
        }),
      );
    const { check, best } = this.model.answers;
    return [
      ...(check.fork_deg ? shade(check.fork_deg, 'cradled') : []),
      ...best.unholdable_arcs.flatMap((arc) => shade([arc.from_deg, arc.to_deg], 'unholdable')),
    ];
  }

  /** Above the axis the postures that are passed, and where the most is needed. */
  private turns(at: (value: number) => number): Node[] {
    if (!this.turning) return [];
    const { from, courses } = this.turning;
    const y = (k: number) => margin.top + this.height() - 5 - 6 * k;
    const passed = courses.flatMap(({ by, kind }, k) =>
      onAxis([Math.min(from, from + by), Math.max(from, from + by)]).map(([low, high]) => line([this.x(low), y(k)], [this.x(high), y(k)], `course ${kind}`)));
    const peaks = courses.flatMap(({ peak, kind, at: posture }) =>
      peak ? [node('path', { d: peakMark([this.x(posture(peak[0])), at(this.scaled(peak[1])) - 7]), class: `peak ${kind}` })] : []);
    return [...passed, ...peaks, node('circle', { cx: this.x(from), cy: y(0), r: 4, class: 'start' })];
  }

  private horizontalTicks(): number[] {
    const step = this.width() < 400 ? 90 : 45;
    return Array.from({ length: 360 / step + 1 }, (_, k) => -180 + k * step);
  }

  private grid(ticks: number[], at: (value: number) => number): Node[] {
    const [left, right] = [this.x(-180), this.x(180)];
    return [
      ...ticks.map((tick) => line([left, at(tick)], [right, at(tick)], 'grid')),
      ...this.horizontalTicks().map((angle) =>
        line([this.x(angle), margin.top], [this.x(angle), margin.top + this.height()], 'grid'),
      ),
    ];
  }

  private axes(ticks: number[], at: (value: number) => number): Node[] {
    const floor = margin.top + this.height();
    const title = this.squared() ? 'effort V [N²]' : this.model.answers.measure.title;
    const vertical = text(title, [0, 0], 'title');
    set(vertical, { transform: `translate(13 ${margin.top + this.height() / 2}) rotate(-90)` });
    const exists = this.model.answers.best.best;
    return [
      line([margin.left, margin.top], [margin.left, floor], 'axis'),
      line([margin.left, floor], [this.x(180), floor], 'axis'),
      vertical,
      text('object turned counter-clockwise', [this.x(0), floor + 33], 'title'),
      ...this.horizontalTicks().map((angle) => text(`${angle}°`, [this.x(angle), floor + 16], 'tick')),
      ...(exists
        ? ticks.map((tick) => text(short(tick), [margin.left - 7, at(tick) + 4], 'tick', 'end'))
        : [text('cannot be held in any posture', [this.x(0), margin.top + this.height() / 2], 'nowhere')]),
    ];
  }

  /** The paper's lower bounds on the internal force, in its range of pinching up. */
  private bounds(at: (value: number) => number): { lines: Node[]; names: Node[] } {
    const all: { lines: Node[]; names: Node[] } = { lines: [], names: [] };
    const paper = asPaper(this.model.answers.grasp);
    if (!paper) return all;
    const range = 180 - (paper.phi * 180) / Math.PI;
    const steps = 200;
    const angles = Array.from({ length: steps + 1 }, (_, k) => range * ((2 * k) / steps - 1));
    const names = ['α₁', 'α₂', 'α₃ = α₄', '', 'α₅', 'α₆'];
    for (const [k, name] of names.entries()) {
      const value = (angle: number) => alphas(paper, paper.axis + angle)[k]!;
      if (!name || !Number.isFinite(value(0))) continue;
      for (const turn of [-360, 0, 360]) {
        const points = angles.map((angle): Point => [this.x(paper.axis + angle + turn), at(value(angle))]);
        all.lines.push(node('path', { d: path(points), class: `bound bound-${k + 1}` }));
      }
      // Named where it is in sight, each at another part of the way, and away from the curve.
      const floor = margin.top + this.height();
      const visible = angles.filter((angle) => at(value(angle)) > margin.top + 18 && at(value(angle)) < floor - 6);
      const angle = visible[Math.floor(visible.length * [0.6, 0.4, 0.96, 0, 0.2, 0.86][k]!)];
      if (angle === undefined) continue;
      const where: Point = [this.x(wrapped(paper.axis + angle)), at(value(angle)) + 4];
      all.names.push(k === 2 ? text(name, [where[0] - 9, where[1]], 'bound-name', 'end') : text(name, where, 'bound-name'));
    }
    return all;
  }

  /** Gives what is written beside the optima. */
  private drawOptima(at: (value: number) => number): Written[] {
    const taken: Written[] = [];
    const { best } = this.model.answers;
    const named = ({ angle_deg }: Optimum) =>
      best.best?.angle_deg === angle_deg ? 'best' : best.best_pinched?.angle_deg === angle_deg ? 'best pinched' : '';
    const floor = margin.top + this.height();
    // Where there is no room for all words, those of the best are there.
    const marks = [...this.model.answers.curve.optima].sort((a, b) => Number(!named(a)) - Number(!named(b))).map((optimum) => {
      const centre: Point = [this.x(optimum.angle_deg), at(this.of(optimum))];
      const mark = node('g', { class: `optimum ${optimum.type}` });
      if (centre[1] < margin.top - 1) return mark;
      mark.append(
        node('path', { d: symbol(optimum.kind, centre), class: 'symbol' }),
        node('title', {}, sentence(optimum, this.model.answers.measure)),
      );
      mark.addEventListener('click', () => this.model.turnTo(optimum.angle_deg));
      if (optimum.type === 'max' || this.showsBounds()) return mark;
      const words = `${named(optimum) || optimum.manner}, ${optimum.kind}`;
      const half = 3.3 * words.length + 2;  // about: 12 px high
      const x = Math.min(Math.max(centre[0], margin.left + half), this.x(180) - half);
      const free = (way: number) =>
        centre[1] + way + 14 < floor &&
        taken.every((other) => Math.abs(other.x - x) >= other.half + half || Math.abs(other.y - centre[1] - way) >= 28);
      const way = [20, ...(this.width() > 400 || named(optimum) ? [48] : []), -31].find(free);
      if (way === undefined) return mark;
      const y = centre[1] + way;
      taken.push({ x, y, half });
      mark.append(
        text(degrees(optimum.angle_deg), [x, y], 'optimum-label'),
        text(words, [x, y + 13], 'optimum-label kind'),
      );
      return mark;
    });
    this.marks.replaceChildren(...marks);
    return taken;
  }

  private drawHandle(at: (value: number) => number): void {
    const { angle } = this.model;
    const { hold, curve, measure } = this.model.answers;
    const x = this.x(angle);
    const floor = margin.top + this.height();
    const arc = curve.arcs.find((each) => contains([each.from_deg, each.to_deg], angle));
    const height = hold.holdable ? measure.of(hold) : arc ? heightOn(arc, angle) : undefined;
    const y = height === undefined ? floor : Math.max(at(this.scaled(height)), margin.top);
    this.handle.replaceChildren(
      node('rect', { x: x - 12, y: margin.top, width: 24, height: this.height(), class: 'grab' }),
      height === undefined
        ? node('path', { d: `M${x - 6} ${y - 12}l12 -12m0 12l-12 -12`, class: 'cross' })
        : node('circle', { cx: x, cy: y, r: 7, class: 'knob' }),
    );
    set(this.handle, {
      'aria-valuenow': angle.toFixed(2),
      'aria-valuetext':
        height === undefined
          ? `${degrees(angle)}, cannot be held`
          : `${degrees(angle)}, ${measure.name} ${measure.text(height)}`,
    });
  }
}

const heightOf = (each: Optimum) => (each.objective === 'grip' ? each.grip! : each.force_norm);

const sentence = (each: Optimum, measure: Measure) =>
  `${each.type === 'min' ? 'minimum' : 'maximum'} at ${degrees(each.angle_deg)}, ${each.kind}, ${each.manner}: ` +
  `${measure.name} ${measure.text(measure.of(each))}${measure.objective === 'effort' ? `, effort V ${plain(each.effort)} N²` : ''}`;

export const hatch = (id: string) =>
  node(
    'pattern',
    { id, width: 6, height: 6, patternUnits: 'userSpaceOnUse', patternTransform: 'rotate(45)' },
    node('rect', { width: 6, height: 6, class: 'hatch-ground' }),
    node('line', { x1: 0, y1: 0, x2: 0, y2: 6, class: 'hatch-line' }),
  );

/** It points down to the peak of a turn. */
export const peakMark = ([x, y]: Point) => `M${x} ${y}l-5 -8h10Z`;

export function symbol(kind: Kind, [x, y]: Point): string {
  if (kind === 'kink') return `M${x} ${y - 6.5}l6.5 6.5l-6.5 6.5l-6.5 -6.5Z`;
  if (kind === 'boundary') return `M${x - 5} ${y - 5}h10v10h-10Z`;
  return `M${x - 5.5} ${y}a5.5 5.5 0 1 0 11 0a5.5 5.5 0 1 0 -11 0Z`;
}

export const short = (value: number) => {
  const size = Math.abs(value);
  if (size >= 1e5) return value.toExponential().replace('e+', 'e').replace(/^1e/, '1e');
  return `${Number(value.toPrecision(6))}`;
};

export function steps(top: number, wanted: number): number[] {
  const rough = top / Math.max(wanted, 2);
  const unit = 10 ** Math.floor(Math.log10(rough));
  const step = unit * (rough / unit <= 2 ? 2 : rough / unit <= 5 ? 5 : 10);
  return Array.from({ length: Math.floor(top / step) + 1 }, (_, k) => k * step);
}

function decades(bottom: number, top: number): number[] {
  const many = Math.log10(top / bottom) > 3;
  const ticks: number[] = [];
  for (let power = Math.floor(Math.log10(bottom)); power <= Math.log10(top); ++power)
    for (const digit of many ? [1] : [1, 2, 5]) ticks.push(digit * 10 ** power);
  return ticks.filter((tick) => tick >= bottom && tick <= top);
}

// The turn from the grasp file's posture: what it takes as a curve, and the object as it turns.
import { heightAt, highest, type Course, type Turning } from './course';
import type { Point } from './grasp';
import { apart } from './label';
import type { Measure } from './measure';
import { html } from './panel';
import { hatch, peakMark, short, steps } from './plot';
import { draggable, keySteps, line, node, path, place, set, text } from './svg';
import { degrees } from './words';

/** What turns, in the plane or in space. */
export interface Turned<Posture> {
  /** As it is shown. */
  now(): Posture;
  /** As the grasp file has it. */
  start(): Posture;
  best(): Posture | undefined;
  /** Whether the best is still looked for. */
  looking(): boolean;
  /** Between two postures [degrees]. */
  apart(a: Posture, b: Posture): number;
  show(posture: Posture): void;
  /** What the turn to a posture takes; undefined where that cannot be told. */
  ask(to: Posture, then: (turning: Turning<Posture> | undefined) => void): void;
  draw(): void;
}

/** Postures that are told in the same words [degrees]. */
const same = 0.005;
/** On the way: but for rounding. */
const rounding = 1e-6;
const rest = 150;  // [ms]
const perDegree = 22;  // [ms]
const shortest = 1200;  // [ms]
/** Pictures of a course. */
const fewest = 40;
const still = 1500;  // [ms]
const margin = { left: 58, right: 16, top: 24, bottom: 36 };

export class Player<Posture> {
  /** Where it is late, of another posture or another grasp. */
  private turning: Turning<Posture> | undefined;
  private known: unknown;
  private asked: Posture | undefined;
  private timer = 0;
  private late = false;
  /** Where on which course the object is, if it is on one. */
  private on: { course: number; way: number } | undefined;
  private playing = 0;
  private size: Point = [500, 165];
  /** Where the axes end. */
  private longest = 1;
  private top = 1;
  private measure!: Measure;

  private readonly head = html('h2');
  private readonly said = html('p', { role: 'status' });
  private readonly picture = node('svg', { role: 'group', 'aria-label': 'What the fingers need on the turn' });
  private readonly layers = node('g', { class: 'passive' });
  private readonly area = node('rect', { class: 'area' });
  private readonly handle = node('g', { class: 'handle posture', tabindex: 0, role: 'slider', 'aria-label': 'Posture on the turn' });
  private readonly hatched: string;
  private readonly figure: HTMLElement;
  private readonly buttons: HTMLButtonElement[];

  constructor(
    private readonly parent: HTMLElement,
    private readonly of: Turned<Posture>,
  ) {
    this.hatched = `hatch-${parent.id}`;
    this.picture.append(node('defs', {}, hatch(this.hatched)), this.area, this.layers, this.handle);
    this.buttons = [0, 1].map((k) => {
      const button = html('button', { type: 'button' });
      button.addEventListener('click', () => this.press(k));
      return button;
    });
    this.figure = html('figure', {}, this.picture, html('figcaption', {}, ...this.buttons));
    parent.append(this.head, this.figure, this.said);
    for (const element of [this.area, this.handle])
      draggable(element, (event) => {
        const [x, y] = place(this.picture, event);
        const course = this.nearest(x, y);
        const follow = (e: PointerEvent) => this.go(course, this.wayAt(place(this.picture, e)[0]));
        if (element === this.area) follow(event);
        return follow;
      }, this.handle);
    keySteps(this.handle, (dx, dy) => this.go(this.course, this.way + dx + dy));
  }

  private get course(): number {
    return this.on?.course ?? 0;
  }

  /** So far on the course; a posture that one looks at is at its end, the file's at its beginning. */
  private get way(): number {
    return this.on ? this.on.way : this.atStart() ? 0 : this.turning!.courses[0]!.size;
  }

  private atStart = () => this.of.apart(this.of.now(), this.of.start()) < same;

  get plays(): boolean {
    return this.playing !== 0;
  }

  /** To be drawn elsewhere, too. */
  get drawn(): Turning<Posture> | undefined {
    return this.late ? undefined : this.turning;
  }

  /** `known` is another where everything else is. */
  draw(known: unknown, measure: Measure): void {
    this.measure = measure;
    if (known !== this.known) {
      // What was found stays, in grey, until it is known anew.
      this.known = known;
      this.asked = this.on = undefined;
      this.stop();
    }
    const now = this.of.now();
    if (this.on && !(this.of.apart(now, this.shown()) < rounding)) {
      this.on = undefined;
      this.stop();
    }
    if (!this.on) this.want(this.atStart() ? this.of.best() : now);
    this.parent.classList.toggle('late', this.late);
    this.parent.setAttribute('aria-busy', String(this.late));
    this.figure.classList.toggle('nothing', !this.turning);
    if (this.turning) this.drawPlot(this.turning);
    this.drawWords(this.turning);
  }

  /** Another grasp. */
  forget(): void {
    this.turning = this.asked = this.on = undefined;
    this.stop();
  }

  private shown = () => this.turning!.courses[this.on!.course]!.at(this.on!.way);

  /** Asks for a turn as soon as nothing moves. */
  private want(to: Posture | undefined): void {
    if (to === undefined || this.of.apart(to, this.of.start()) < same) {
      this.asked = undefined;
      clearTimeout(this.timer);
      this.late = to === undefined && this.of.looking();
      if (!this.late) this.turning = undefined;
      return;
    }
    if (this.asked !== undefined && this.of.apart(this.asked, to) < rounding) return;
    this.asked = to;
    this.late = true;
    clearTimeout(this.timer);
    this.timer = window.setTimeout(() => this.of.ask(to, (turning) => {
      if (this.asked !== to) return;
      this.turning = turning;
      this.late = false;
      this.of.draw();
    }), rest);
  }

  private go(course: number, way: number): void {
    if (!this.turning || this.late) return;
    this.stop();
    this.move(course, way);
  }

  private move(course: number, way: number): void {
    const { size } = this.turning!.courses[course]!;
    this.on = { course, way: Math.min(Math.max(way, 0), size) };
    this.of.show(this.shown());
  }

  private stop(): void {
    this.playing = 0;
  }

  /** Plays a course from where it is, or from its beginning; or stops. */
  private press(k: number): void {
    const was = this.playing && this.course === k;
    this.stop();
    if (was || !this.turning || this.late) return this.of.draw();
    const { size, peak } = this.turning.courses[k]!;
    const begin = this.on?.course === k && this.on.way < size ? this.on.way : 0;
    this.parent.dispatchEvent(new CustomEvent('play', { bubbles: true }));
    const mine = (this.playing = Math.random());
    this.move(k, begin);
    const goes = (by: number): boolean => {
      // Whoever turned it otherwise has it.
      if (this.playing !== mine || !this.on || !(this.of.apart(this.of.now(), this.shown()) < rounding)) return false;
      const way = Math.min(this.on.way + by, size);
      this.move(k, way);
      if (way >= size) this.stop();
      return way < size;
    };
    if (matchMedia('(prefers-reduced-motion: reduce)').matches) {
      // Nothing moves: the beginning, the peak and the end.
      const steps = peak && peak[0] > begin && peak[0] < size ? [peak[0] - begin, size] : [size];
      const next = (i: number): void => void setTimeout(() => goes(steps[i]!) && next(i + 1), still);
      return next(0);
    }
    const pace = Math.max(perDegree, shortest / size);
    let before = performance.now();
    const step = () => {
      // Where a picture takes long, it takes longer: nothing is leapt over.
      const now = performance.now();
      const goesOn = goes(Math.min((now - before) / pace, size / fewest));
      before = now;
      if (goesOn) requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  }

  private width = () => this.size[0] - margin.left - margin.right;
  private height = () => this.size[1] - margin.top - margin.bottom;
  private x = (way: number) => margin.left + (way / this.longest) * this.width();
  private wayAt = (x: number) => ((x - margin.left) / this.width()) * this.longest;
  private y = (height: number) => margin.top + (1 - height / this.top) * this.height();

  /** The course whose curve is nearest to a point. */
  private nearest(x: number, y: number): number {
    const far = (course: Course<Posture>) => {
      const height = heightAt(course, this.wayAt(x));
      return height === undefined ? 1e9 : Math.abs(this.y(height) - y);
    };
    const away = (this.turning?.courses ?? []).map(far);
    return away.length > 1 && away[1]! < away[0]! ? 1 : 0;
  }

  private drawPlot({ courses }: Turning<Posture>): void {
    const box = this.picture.getBoundingClientRect();
    this.size = [box.width || 500, box.height || 165];
    this.longest = Math.max(...courses.map(({ size }) => size));
    this.top = 1.12 * (highest(courses) || 1);
    set(this.picture, { viewBox: `0 0 ${this.size[0]} ${this.size[1]}` });
    set(this.area, { x: margin.left, y: margin.top, width: this.width(), height: this.height() });
    const floor = margin.top + this.height();
    const [left, right] = [this.x(0), this.x(this.longest)];
    const heights = steps(this.top, this.height() / 22);
    const apartBy = this.longest / (this.width() < 400 ? 3 : 5);
    const step = [1, 2, 5, 10, 15, 30, 45, 60, 90].find((each) => each >= apartBy) ?? 90;
    const fine = this.longest < 3;
    const ways = fine ? [0, this.longest] : Array.from({ length: Math.floor(this.longest / step) + 1 }, (_, k) => k * step);
    const title = text(this.measure.title, [0, 0], 'title');
    set(title, { transform: `translate(13 ${margin.top + this.height() / 2}) rotate(-90)` });
    const curve = ({ kind, pieces }: Course<Posture>) =>
      pieces.map((points) => node('path', { d: path(points.map(([way, height]): Point => [this.x(way), Math.max(this.y(height), margin.top - 6)])), class: `course ${kind}` }));
    const marks = courses.flatMap(({ peak, kind }) => (peak ? [{ at: [this.x(peak[0]), this.y(peak[1])] as Point, kind, words: this.measure.text(peak[1]) }] : []));
    const labels = apart(marks.map(({ at: [x, y], words }) => {
      const width = 6.8 * words.length;
      return { words, width, height: 15, at: [Math.min(Math.max(x, left + width / 2 + 2), right - width / 2 - 2), y - 16] as Point };
    }));
    this.layers.replaceChildren(
      ...courses[0]!.unholdable.map(([from, to]) =>
        node('rect', { x: this.x(from) - (to - from < 0.006 ? 1 : 0), y: margin.top, width: Math.max(this.x(to) - this.x(from), 2), height: this.height(), fill: `url(#${this.hatched})` })),
      ...heights.map((tick) => line([left, this.y(tick)], [right, this.y(tick)], 'grid')),
      ...[...courses].reverse().flatMap(curve),
      line([left, margin.top], [left, floor], 'axis'),
      line([left, floor], [right, floor], 'axis'),
      title,
      text('turned so far', [(left + right) / 2, floor + 32], 'title'),
      ...heights.map((tick) => text(short(tick), [left - 7, this.y(tick) + 4], 'tick', 'end')),
      ...ways.map((tick) => text(fine ? degrees(tick) : `${tick}°`, [this.x(tick), floor + 16], 'tick')),
      ...marks.map(({ at: [x, y], kind }) => node('path', { d: peakMark([x, y]), class: `peak ${kind}` })),
      ...labels.map(({ words, at: [x, y] }) => text(words, [x, y + 4], 'optimum-label')),
    );
    this.drawHandle(courses[this.course]!, floor);
  }

  private drawHandle(course: Course<Posture>, floor: number): void {
    const height = heightAt(course, this.way);
    const x = this.x(this.way);
    this.handle.replaceChildren(
      node('rect', { x: x - 12, y: margin.top, width: 24, height: this.height(), class: 'grab' }),
      line([x, margin.top], [x, floor], 'now'),
      height === undefined
        ? node('path', { d: `M${x - 6} ${floor - 12}l12 12m0 -12l-12 12`, class: 'cross' })
        : node('circle', { cx: x, cy: Math.max(this.y(height), margin.top), r: 6, class: 'knob' }),
    );
    const where = `${degrees(this.way)} of ${degrees(course.size)}`;
    set(this.handle, {
      'aria-valuemin': 0,
      'aria-valuemax': course.size.toFixed(2),
      'aria-valuenow': this.way.toFixed(2),
      'aria-valuetext': height === undefined ? `${where}, cannot be held` : `${where}, ${this.measure.name} ${this.measure.text(height)}`,
    });
  }

  private drawWords(turning: Turning<Posture> | undefined): void {
    const best = this.of.best();
    const toBest = turning && best !== undefined && this.of.apart(turning.to, best) < same;
    this.head.textContent = turning ? `The turn to ${toBest ? 'the best' : 'this'} posture: ${turning.how}` : 'The turn';
    const words = turning?.words ?? (this.late ? '' : 'Turn the object: here is what that takes.');
    if (this.said.textContent !== words) this.said.textContent = words;
    this.buttons.forEach((button, k) => {
      const course = turning?.courses[k];
      button.hidden = !course;
      if (!course) return;
      const runs = this.playing !== 0 && this.course === k;
      const label = `${course.name.replace('the ', '')}${runs ? ', playing' : `, ${degrees(course.size)}`}`;
      if (button.textContent === label) return;
      set(button, { 'aria-label': `${runs ? 'Stop' : 'Play'} ${course.name}` });
      button.replaceChildren(
        node('svg', { viewBox: '0 0 12 12', class: 'mark', 'aria-hidden': 'true' }, node('path', { d: runs ? 'M2 2h8v8h-8Z' : 'M2 1l9 5l-9 5Z' })),
        node('svg', { viewBox: '0 0 26 12', class: 'swatch-line', 'aria-hidden': 'true' }, node('path', { d: 'M0 6h26', class: `course ${course.kind}` })),
        label,
      );
    });
  }
}

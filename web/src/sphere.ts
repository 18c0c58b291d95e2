// The sphere of postures, fixed to the object: the point on top is the direction that points up.
import { turnable, view } from './body';
import type { Course, Turning } from './course';
import type { Picture } from './files';
import { Canvas, colour, seen, type Colour, type Eye, type Loaded } from './gl';
import type { Point, Vec } from './grasp';
import { icosahedron, polytope, refined, split, type Triangles } from './mesh';
import { rounds } from './scale';
import type { SpatialModel } from './space';
import { peakMark } from './plot';
import { line, node, path, place, set, text } from './svg';
import { add, cross, dot, length, minus, times, turned, turnedBack, unit } from './turn';
import { radians } from './vector';
import { plain } from './words';
import type { Coloured } from './worker';

/** Light where little force is needed; darker and darker, so that it can be read without colour. */
const ramp = ['#f4f7ec', '#b9dcd6', '#6cb1ce', '#2b73ad', '#0f3569'].map((hex): Colour => {
  const part = (k: number) => parseInt(hex.slice(1 + 2 * k, 3 + 2 * k), 16) / 255;
  return [part(0), part(1), part(2)];
});

const spheres = new Map<number, Triangles>();
const sphere = (level: number): Triangles => {
  if (!spheres.has(level)) spheres.set(level, refined(icosahedron, level));
  return spheres.get(level)!;
};

const bar = { left: 16, right: 16, height: 12 };

export class SphereView {
  certificate = false;
  /** From the grasp file's posture. */
  turning: Turning<Vec> | undefined;
  private readonly canvas: Canvas;
  private readonly picture: SVGSVGElement;
  private readonly legend = node('svg', { class: 'legend', role: 'img' });
  private readonly ground = node('circle', { class: 'area', tabindex: 0, role: 'application' });
  private readonly marks = node('g', { class: 'minima' });
  private eye!: Eye;
  private size: Point = [500, 330];
  private known: { of: Coloured; net: Triangles } | undefined;
  private drawn: unknown;
  private loaded: Loaded | undefined;
  private ring: { of: unknown; band: Loaded } | undefined;
  private proof: { of: unknown; level: number | undefined; faces: Loaded; edges: Loaded; body: Loaded | undefined } | undefined;

  constructor(
    parent: HTMLElement,
    private readonly model: SpatialModel,
  ) {
    this.canvas = new Canvas(document.createElement('canvas'));
    this.canvas.element.setAttribute('aria-hidden', 'true');
    this.picture = node('svg', { role: 'group', 'aria-label': 'The sphere of postures, coloured by what it needs' });
    this.picture.append(this.ground, this.marks);
    const globe = document.createElement('div');
    globe.className = 'globe';
    globe.append(this.canvas.element, this.picture);
    parent.prepend(globe, this.legend);
    set(this.ground, { 'aria-label': 'Sphere of postures: turn it with the arrow keys' });
    turnable(this.ground, model, () => this.eye.scale, (event) => {
      const p = this.under(event);
      if (p) this.model.turnTo(p);
    });
  }

  /** The direction of the object under the pointer. */
  private under(event: PointerEvent): Vec | undefined {
    const [px, py] = place(this.picture, event);
    const [x, y] = [(px - this.size[0] / 2) / this.eye.scale, (this.size[1] / 2 - py) / this.eye.scale];
    const rest = 1 - x * x - y * y;
    if (rest < 0) return undefined;
    return unit(turnedBack(this.model.orientation, turnedBack(view, [x, y, Math.sqrt(rest)])));
  }

  /** What values are of. */
  private net(coloured: Coloured): Triangles {
    if (this.known?.of !== coloured) {
      const { level, values } = coloured;
      let net = sphere(level);
      while (net.points.length < values.length) net = split(net, (k) => values[k] === null);
      this.known = { of: coloured, net };
    }
    return this.known.net;
  }

  /** From the least of all that is shown to where colours end. */
  range(): { low: number; high: number } | undefined {
    const { sphere: coloured, best, ring } = this.model.found;
    if (!coloured) return undefined;
    let [low, high] = [Infinity, 0];
    const { tilt } = this.model.answers.check;
    const { points } = this.net(coloured);
    const inside = (p: Vec) => !tilt || dot(p, tilt.from) >= Math.cos(radians(tilt.max_deg));
    for (const value of ring?.values ?? []) if (value !== null) [low, high] = [Math.min(low, value), Math.max(high, value)];
    for (const [k, value] of coloured.values.entries())
      if (value !== null && inside(points[k]!)) [low, high] = [Math.min(low, value), Math.max(high, value)];
    const { measure } = this.model.answers;
    [low, high] = [measure.shown(low), measure.shown(high)];
    if (best?.best) low = Math.min(low, measure.of(best.best));
    if (!(low < Infinity)) return undefined;
    // Where nothing is needed, colours begin a little above.
    if (!(low > 1e-3 * high)) return { low: 0.05 * high || 1, high: high || 2 };
    return { low, high: Math.max(Math.min(high, 20 * low), 1.05 * low) };
  }

  draw(): void {
    const box = this.picture.getBoundingClientRect();
    this.size = [box.width || 500, box.height || 330];
    const [width, height] = this.size;
    const scale = Math.min(width / 2 - 12, height / 2 - 26);
    this.eye = { turn: view, centre: [0, 0, 0], scale, depth: 4 };
    set(this.picture, { viewBox: `0 0 ${width} ${height}` });
    set(this.ground, { cx: width / 2, cy: height / 2, r: scale });
    this.load();
    this.canvas.begin(width, height, this.eye);
    const pose = { turn: this.model.orientation };
    const range = this.range();
    const { tilt } = this.model.answers.check;
    const proof = this.certificate ? this.proved() : undefined;
    if (proof) {
      if (proof.body) this.canvas.solid(proof.body, pose, colour('--force'));
      this.canvas.lines(proof.edges, pose, colour('--best'), 0.35, 1);
      this.canvas.glass(proof.faces, pose, colour('--best'), 0.12);
      this.canvas.veil(proof.faces, pose);
      this.canvas.lines(proof.edges, pose, colour('--best'), 1, 1.4);
    }
    if (this.loaded) {
      const colours = {
        ramp,
        low: Math.log(range?.low ?? 1),
        high: Math.log(range?.high ?? 2),
        levels: pad(range ? rounds(range.low, range.high).map(Math.log) : [], 16),
        count: range ? Math.min(rounds(range.low, range.high).length, 16) : 0,
        unholdable: colour('--unholdable'),
        hatch: colour('--hatch'),
        ground: colour('--ground'),
        tilt_from: tilt?.from ?? [0, 0, 1],
        tilt: tilt ? Math.cos(radians(tilt.max_deg)) : -2,
        opacity: proof ? 0.22 : 1,
      };
      this.canvas.globe(this.loaded, pose, colours);
      const band = this.band();
      if (band) this.canvas.globe(band, { ...pose, stretch: [1.003, 1.003, 1.003] }, colours);
    }
    this.drawMarks();
    this.drawLegend(range);
    const late = this.model.outdated;
    for (const element of [this.canvas.element, this.legend, this.marks]) element.classList.toggle('late', late);
  }

  get image(): Picture {
    return { image: this.canvas.finely(() => this.draw()), overlay: this.picture, legend: this.legend };
  }

  private logarithm = (value: number) => Math.log(Math.max(this.model.answers.measure.shown(value), 1e-30));

  private load(): void {
    const coloured = this.model.found.sphere;
    if (coloured === this.drawn && this.loaded) return;
    this.drawn = coloured;
    this.canvas.drop(this.loaded);
    const { points, triangles } = coloured ? this.net(coloured) : sphere(3);
    // What the band shows better is left to it.
    const values = this.model.found.ring ? [] : coloured?.values ?? [];
    // Beside what cannot be held, the colour of the nearest that can.
    const logs = points.map((_, k) => this.logarithm(values[k] ?? NaN));
    const shown = [...logs];
    for (const corners of triangles)
      for (const k of corners)
        if (Number.isNaN(logs[k]))
          for (const other of corners)
            if (!Number.isNaN(logs[other]!)) shown[k] = Math.max(Number.isNaN(shown[k]!) ? -Infinity : shown[k]!, logs[other]!);
    const data = points.flatMap((_, k) => [Number.isNaN(shown[k]!) ? 0 : shown[k]!, Number.isNaN(logs[k]!) ? 1 : 0]);
    this.loaded = this.canvas.load(
      { position: { size: 3, data: new Float32Array(points.flat()) }, value: { size: 2, data: Float32Array.from(data) } },
      Uint32Array.from(triangles.flat()),
    );
  }

  /** Where only a circle of postures can be held, between those of the sphere: a band about it. */
  private band(): Loaded | undefined {
    const { ring } = this.model.found;
    if (this.ring?.of === ring) return this.ring?.band;
    this.canvas.drop(this.ring?.band);
    this.ring = undefined;
    if (!ring) return undefined;
    const { normal, ups } = ring;
    const half = times(0.012, normal);
    const points = ups.flatMap((up) => [unit(minus(up, half)), unit(add(up, half))]);
    const values = ring.values.flatMap((each) => {
      const value = each === null ? [0, 1] : [this.logarithm(each), 0];
      return [...value, ...value];
    });
    const corners = ups.slice(1).flatMap((_, k) => [0, 2, 1, 1, 2, 3].map((i) => 2 * k + i));
    const band = this.canvas.load(
      { position: { size: 3, data: new Float32Array(points.flat()) }, value: { size: 2, data: Float32Array.from(values) } },
      Uint32Array.from(corners),
    );
    this.ring = { of: ring, band };
    return band;
  }

  /** What the proof shows, in words. */
  said(): string {
    const { best, planes } = this.model.found;
    if (!best || !planes) return '';
    if (best.lower_bound === null) return 'Every direction is cut off: it cannot be held in any of them.';
    const { measure } = this.model.answers;
    const least = measure.text(measure.shown(best.lower_bound));
    const body = this.proof?.body ? `Blue: the loads that a ${measure.name} of ${least} holds. ` : '';
    return `${body}Green: planes that no load held by ${least} can cross, each proven by the hold in one posture. The weight is on the sphere, whatever the posture; nothing that the planes enclose leaves it, so no posture needs less.`;
  }

  /** Loads that need the lower bound at most by what the cuts say, and those that it
   * carries: the weight, in the best posture, is as far as both reach. */
  private proved() {
    const { best, planes, sphere: coloured } = this.model.found;
    if (!best || !planes || best.lower_bound === null) return undefined;
    if (this.proof?.of === planes && this.proof.level === coloured?.level) return this.proof;
    const faces = polytope(planes.map(({ a, b, rate }) => ({ a, c: rate * best.lower_bound! + b })), 1.5);
    const corners = faces.flatMap((face) => face.slice(2).flatMap((last, k) => [face[0]!, face[k + 1]!, last]));
    const flat = (points: Vec[]) => ({
      points,
      triangles: byThree(points),
      normals: points.map(unitOr),
    });
    this.canvas.drop(this.proof?.faces);
    this.canvas.drop(this.proof?.edges);
    this.canvas.drop(this.proof?.body);
    this.proof = {
      of: planes,
      level: coloured?.level,
      faces: this.canvas.loadBody(flat(corners)),
      edges: this.canvas.loadLines(faces.flatMap((face) => face.map((p, k) => [p, face[(k + 1) % face.length]!] as const))),
      body: this.carried(),
    };
    return this.proof;
  }

  /** Without limits of the forces what is shown grows in proportion along a ray. */
  private carried(): Loaded | undefined {
    const { best, sphere: coloured, ring } = this.model.found;
    const limited = this.model.answers.check.contacts.some((each) => each.min_normal > 0 || each.max_normal !== null) ||
      best?.best?.drives.some(({ max }) => max !== null);
    if (!coloured || !best?.lower_bound || limited) return undefined;
    const { shown } = this.model.answers.measure;
    const least = shown(best.lower_bound);
    const far = (value: number | null | undefined) => (value ? least / shown(value) : 0);
    if (ring) {
      const rim = ring.ups.map((up, k) => times(far(ring.values[k]), up));
      const fan = rim.slice(1).flatMap((p, k): Vec[] => [[0, 0, 0], rim[k]!, p]);
      return this.canvas.loadBody({ points: fan, triangles: byThree(fan), normals: fan.map(() => ring.normal) });
    }
    const { points, triangles } = this.net(coloured);
    const { tilt } = this.model.answers.check;
    const inside = points.map((p) => (tilt ? dot(p, tilt.from) - Math.cos(radians(tilt.max_deg)) : 1));
    const reach = points.map((p, k) => times(far(coloured.values[k]), p));
    const corners: Vec[] = [];
    const normals: Vec[] = [];
    for (const triangle of triangles) {
      const border: Vec[] = [];
      const face = triangle.flatMap((k, i) => {
        const next = triangle[(i + 1) % 3]!;
        const [here, there] = [inside[k]!, inside[next]!];
        const kept = here >= 0 ? [reach[k]!] : [];
        if (here >= 0 === there >= 0) return kept;
        // Where the tilt ends, so does the body: cut along the rays.
        const cut = add(reach[k]!, times(here / (here - there), minus(reach[next]!, reach[k]!)));
        if (here >= 0) border.push(cut);
        else border.unshift(cut);
        return [...kept, cut];
      });
      for (const fan of face.slice(2).map((last, k) => [face[0]!, face[k + 1]!, last])) {
        corners.push(...fan);
        normals.push(...fan.map(unitOr));
      }
      if (!border.length) continue;
      const side = unitOr(cross(border[0]!, border[1]!));
      corners.push(...border, [0, 0, 0]);
      normals.push(side, side, side);
    }
    return this.canvas.loadBody({ points: corners, triangles: byThree(corners), normals });
  }

  private drawMarks(): void {
    const { best } = this.model.found;
    const centre: Point = [this.size[0] / 2, this.size[1] / 2];
    const at = (p: Vec): Vec => {
      const [x, y, z] = seen(this.eye, p);
      return [centre[0] + x, centre[1] - y, z];
    };
    const marks: Node[] = [node('circle', { cx: centre[0], cy: centre[1], r: this.eye.scale, class: 'limb' })];
    marks.push(...[...(this.turning?.courses ?? [])].reverse().flatMap((course) => this.courseOn(course, at)));
    const top = at([0, 0, 1]);
    if (this.turning) {
      const [x, y, z] = at(turned(this.model.orientation, this.turning.from));
      if (z > 0) marks.push(node('circle', { cx: x, cy: y, r: 4, class: 'start' }));
      // Up there other words are.
      if (z > 0 && Math.hypot(x - top[0], y - top[1]) > 40) marks.push(text('start', [x, y + 18], 'optimum-label'));
    }
    const { measure } = this.model.answers;
    const minima = best ? [...best.minima] : [];
    for (const each of minima) {
      const [x, y, z] = at(turned(this.model.orientation, each.up));
      if (z < -0.02 * this.eye.scale) continue;
      const name = measure.of(each) === measure.of(best!.best!) ? 'best' : same(each.up, best!.best_pinched?.up) ? 'best pinched' : '';
      const mark = node('g', { class: `optimum min${name === 'best' ? ' best' : ''}` },
        node('circle', { cx: x, cy: y, r: name ? 6 : 4, class: 'symbol' }),
        node('title', {}, `${name || 'minimum'}, ${each.manner}: ${measure.name} ${measure.text(measure.of(each))}`));
      mark.addEventListener('click', () => this.model.turnTo(each.up));
      if (name) mark.append(text(name, [x, y + 20], 'optimum-label'));
      marks.push(mark);
    }
    const pin = at([0, 0, 1.13]);
    marks.push(
      line([top[0], top[1]], [pin[0], pin[1]], 'pin'),
      node('circle', { cx: top[0], cy: top[1], r: 6.5, class: 'knob passive' }),
      text('up', [pin[0] + 13, pin[1] + 5], 'label'),
    );
    this.marks.replaceChildren(...marks);
  }

  /** The line of the directions that point up on the turn: faint behind the sphere. */
  private courseOn({ kind, name, size, peak, at: posture }: Course<Vec>, at: (p: Vec) => Vec): Node[] {
    const points = Array.from({ length: 97 }, (_, k) => at(turned(this.model.orientation, posture((size * k) / 96))));
    const pieces: { behind: boolean; points: Point[] }[] = [];
    for (const [k, [x, y, z]] of points.entries()) {
      const behind = z < 0;
      const last = pieces.at(-1);
      if (last?.behind !== behind) pieces.push({ behind, points: k ? [[points[k - 1]![0], points[k - 1]![1]]] : [] });
      pieces.at(-1)!.points.push([x, y]);
    }
    const lines = pieces.flatMap(({ behind, points: own }) => [
      ...(behind ? [] : [node('path', { d: path(own), class: 'halo passive' })]),
      node('path', { d: path(own), class: `course ${kind}${behind ? ' behind' : ''} passive` }),
    ]);
    const [x, y, z] = peak ? at(turned(this.model.orientation, posture(peak[0]))) : [0, 0, -1];
    if (peak === undefined || z < 0) return lines;
    return [...lines, node('path', { d: peakMark([x, y]), class: `peak ${kind}` }, node('title', {}, `the most on ${name}: ${this.model.answers.measure.text(peak[1])}`))];
  }

  private drawLegend(range: { low: number; high: number } | undefined): void {
    const width = this.legend.getBoundingClientRect().width || 400;
    set(this.legend, { viewBox: `0 0 ${width} 48` });
    if (!range) {
      this.legend.replaceChildren(text(this.model.outdated ? 'looking all around …' : 'cannot be held in any posture', [width / 2, 24], 'title'));
      return;
    }
    const { low, high } = range;
    const { hold, measure } = this.model.answers;
    const inside = width - bar.left - bar.right;
    const x = (shown: number) => bar.left + (inside * Math.log(shown / low)) / Math.log(high / low);
    const stops = ramp.map((rgb, k) => node('stop', { offset: k / 4, 'stop-color': `rgb(${rgb.map((c) => Math.round(255 * c)).join()})` }));
    const drawn: Node[] = [
      node('defs', {}, node('linearGradient', { id: 'ramp' }, ...stops)),
      node('rect', { x: bar.left, y: 4, width: inside, height: bar.height, fill: 'url(#ramp)', class: 'bar' }),
    ];
    let last = -Infinity;
    for (const tick of [low, ...rounds(low, high)]) {
      const label = tick === low ? plain(low) : String(Number(tick.toPrecision(3)));
      drawn.push(line([x(tick), 4], [x(tick), 4 + bar.height], 'tick-line'));
      const half = 3.6 * label.length;
      if (x(tick) - half < last + 8 || x(tick) + half > width) continue;
      last = x(tick) + half;
      drawn.push(text(label, [Math.max(x(tick), half), 30], 'tick'));
    }
    drawn.push(text(measure.title, [width / 2, 45], 'title'));
    if (hold.holdable) {
      const now = Math.min(Math.max(x(measure.of(hold)), bar.left), width - bar.right);
      drawn.push(node('path', { d: `M${now} 6l-5 -6h10Z`, class: 'pointer' }), line([now, 2], [now, 4 + bar.height], 'now'));
    }
    set(this.legend, { 'aria-label': `Colours from ${measure.text(low)}, light, to ${measure.text(high)}, dark` });
    this.legend.replaceChildren(...drawn);
  }
}

const byThree = (points: Vec[]) => Array.from({ length: points.length / 3 }, (_, t) => [3 * t, 3 * t + 1, 3 * t + 2] as const);
const unitOr = (p: Vec): Vec => (length(p) > 0 ? unit(p) : [0, 0, 1]);
const same = (a: Vec, b: Vec | undefined) => b !== undefined && dot(a, b) > 1 - 1e-14;
const pad = (values: number[], size: number) => [...values.slice(0, size), ...Array<number>(Math.max(0, size - values.length)).fill(0)];

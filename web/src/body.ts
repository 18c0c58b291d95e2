// The object in space as it hangs: gravity points down on the screen.
import { proofOf, stillForce, turningForce, type NotHeld } from './core';
import type { Picture } from './files';
import { Canvas, colour, seen, type Eye, type Loaded, type Pose } from './gl';
import { push, pushOf, type Point, type Vec } from './grasp';
import { labels, type Arrow, type Finger } from './label';
import { bodyOf, hit, onSurface, tapered, type Body } from './mesh';
import type { SpatialModel } from './space';
import { draggable, keySteps, line, node, place, set } from './svg';
import { about, add, after, cross, dot, frame, length, minus, times, turned, turnedBack, unit, type Turn } from './turn';
import { radians } from './vector';

/** Seen a little from above. */
export const elevation = radians(25);
/** The world, whose z is up, on the screen, whose y is up and whose z is towards the eye. */
export const view: Turn = after(about([1, 0, 0], elevation - Math.PI / 2), [[1, 0, 0], [0, 1, 0], [0, 0, 1]]);

/** Drags and arrow keys turn the object: sideways about the vertical, up and down against it. */
export function turnable(element: SVGElement, model: SpatialModel, pixels: () => number, click?: (at: PointerEvent) => void): void {
  draggable(element, (event) => {
    const from = model.orientation;
    const [x, y] = [event.clientX, event.clientY];
    let moved = false;
    element.addEventListener('pointerup', (e) => moved || click?.(e), { once: true });
    return (e) => {
      moved ||= Math.hypot(e.clientX - x, e.clientY - y) > 3;
      if (!moved) return;
      const spun = after(about([0, 0, 1], (e.clientX - x) / pixels()), from);
      model.orient(model.snapped(after(about([1, 0, 0], (e.clientY - y) / pixels()), spun)));
    };
  });
  keySteps(element, (dx, dy) => model.turnBy(radians(dx), radians(-dy)));
}

export class BodyView {
  private readonly canvas: Canvas;
  private readonly picture: SVGSVGElement;
  private readonly ground = node('rect', { class: 'area', tabindex: 0, role: 'application' });
  private readonly back = node('g', { class: 'passive' });
  private readonly front = node('g', { class: 'passive' });
  private readonly handles = node('g');
  private readonly com = node('g', { class: 'handle com', tabindex: 0, role: 'application' });
  /** Of the arrow of what pushes the object. */
  private readonly tip = node('g', { class: 'handle tip', tabindex: 0, role: 'application' }, node('circle', { r: 16, class: 'grab' }));
  private contacts: SVGGElement[] = [];
  private readonly shaft: Loaded;
  private readonly head: Loaded;
  private readonly cone: Loaded;
  private readonly ball: Loaded;
  private shown: Body | undefined;
  private loaded: { body: Loaded; edges: Loaded } | undefined;
  private eye!: Eye;
  private size: Point = [500, 430];

  constructor(
    parent: HTMLElement,
    private readonly model: SpatialModel,
  ) {
    this.canvas = new Canvas(document.createElement('canvas'));
    this.canvas.element.setAttribute('aria-hidden', 'true');
    this.picture = node('svg', { role: 'group', 'aria-label': 'The object as it is held, gravity pointing down' });
    this.picture.append(this.ground, this.back, this.front, this.handles, this.com, this.tip);
    parent.append(this.canvas.element, this.picture);
    this.shaft = this.canvas.loadBody(tapered(1, 1, 0, 1));
    this.head = this.canvas.loadBody(tapered(1, 0, 0, 1));
    this.cone = this.canvas.loadBody(open(tapered(0, 1, 0, 1)));
    this.ball = this.canvas.loadBody(bodyOf({ sphere: { radius: 1 } }));
    this.com.append(node('circle', { r: 16, class: 'grab' }), node('circle', { r: 5, class: 'dot' }));

    set(this.ground, { 'aria-label': 'Posture: turn the object with the arrow keys' });
    turnable(this.ground, model, () => this.eye.scale * model.frame.radius);
    set(this.com, { 'aria-label': 'Centre of mass: arrow keys move it' });
    draggable(this.com, (event) => {
      const grip = this.grip(event, model.deciding.com);
      return (e) => this.moveCom(grip(e));
    });
    keySteps(this.com, (dx, dy) => this.moveCom(add(model.deciding.com, this.step(dx, dy))));
    set(this.tip, { 'aria-label': 'Push: arrow keys change it' });
    draggable(this.tip, (event) => {
      const perNewton = this.perNewton();
      const { com } = model.deciding;
      const grip = this.grip(event, add(com, times(perNewton, pushOf(model.grasp) ?? [0, 0, 0])));
      return (e) => this.push(times(1 / perNewton, minus(grip(e), com)));
    });
    keySteps(this.tip, (dx, dy) =>
      this.push(add(pushOf(model.grasp) ?? [0, 0, 0], times(1 / this.perNewton(), this.step(dx, dy)))));
  }

  /** From the object's frame to the world, in which the middle of the frame is 0. */
  private get pose(): Pose {
    const { orientation, frame } = this.model;
    return { turn: orientation, at: times(-1, turned(orientation, frame.centre)) };
  }

  private world = (p: Vec): Vec => turned(this.model.orientation, minus(p, this.model.frame.centre));
  private object = (p: Vec): Vec => add(turnedBack(this.model.orientation, p), this.model.frame.centre);
  private screen = (p: Vec): Point => {
    const [x, y] = seen(this.eye, this.world(p));
    return [this.size[0] / 2 + x, this.size[1] / 2 - y];
  };

  draw(): void {
    const box = this.picture.getBoundingClientRect();
    this.size = [box.width || 500, box.height || 430];
    const [width, height] = this.size;
    const { radius } = this.model.frame;
    const scale = Math.min(width / 2 - 62, height / 2 - 52) / radius;
    this.eye = { turn: view, centre: [0, 0, 0], scale, depth: 6 * radius };
    set(this.picture, { viewBox: `0 0 ${width} ${height}` });
    set(this.ground, { width, height });
    this.load();
    this.canvas.begin(width, height, this.eye);
    this.drawForces();
    this.drawCones();
    this.drawBody();
    this.drawLabels();
    this.placeHandles();
  }

  /** The picture, for saving. */
  get image(): Picture {
    return { image: this.canvas.finely(() => this.draw()), overlay: this.picture };
  }

  private load(): void {
    const { body } = this.model;
    if (body === this.shown) return;
    this.shown = body;
    this.canvas.drop(this.loaded?.body);
    this.canvas.drop(this.loaded?.edges);
    this.loaded = body && { body: this.canvas.loadBody(body), edges: this.canvas.loadLines(body.edges) };
  }

  private drawBody(): void {
    const { canvas, loaded, pose } = this;
    const { hold } = this.model.answers;
    if (!loaded) return;
    const outline = colour('--outline');
    canvas.lines(loaded.edges, pose, outline, 0.25, 1.2);
    canvas.glass(loaded.body, pose, colour('--body'), hold.holdable ? 0.24 : 0.16, 0.5);
    if (!hold.holdable) this.drawFall(hold);
    canvas.veil(loaded.body, pose);
    canvas.lines(loaded.edges, pose, outline, hold.holdable ? 0.9 : 0.4, 1.4);
  }

  /** The object a little further on the motion that gravity drives and no contact opposes. */
  private drawFall(hold: NotHeld<Vec>): void {
    const dual = proofOf(hold);
    const { body, frame: ball } = this.model;
    const v = times(-1, dual.slice(0, 3) as unknown as Vec);
    const w = times(-1, dual.slice(3) as unknown as Vec);
    const far = body!.points.reduce((most, p) => Math.max(most, length(add(v, cross(w, p)))), 0);
    if (!(far > 0)) return;
    const time = (0.2 * ball.radius) / far;
    const speed = length(w);
    const turn = speed * time > 1e-9 ? about(unit(w), speed * time) : about([0, 0, 1], 0);
    // The screw: as it turns about its axis, it moves along it.
    const foot = speed * time > 1e-9 ? times(1 / speed ** 2, cross(w, v)) : ([0, 0, 0] as Vec);
    const slide = speed * time > 1e-9 ? times((time * dot(w, v)) / speed ** 2, w) : times(time, v);
    const shift = add(minus(foot, turned(turn, foot)), slide);
    const fallen = after(this.model.orientation, turn);
    const pose = { turn: fallen, at: add(turned(this.model.orientation, shift), this.pose.at!) };
    this.canvas.glass(this.loaded!.body, pose, colour('--limit'), 0.1, 0.5);
    this.canvas.lines(this.loaded!.edges, pose, colour('--limit'), 0.8, 1.4);
  }

  /** Arrows begin where the finger touches, and are as long as the force is large. */
  private perNewton(): number {
    const { check, hold } = this.model.answers;
    const { radius } = this.model.frame;
    const heaviest = Math.max(...check.loads.map((load) => Math.max(Math.abs(turningForce(load)), length(stillForce(load) as unknown as Vec))));
    const largest = hold.holdable ? Math.max(...hold.contacts.map((each) => length(each.force))) : 0;
    return Math.min((0.55 * radius) / heaviest, (0.9 * radius) / (largest || 1e-300));
  }

  private arrow(from: Vec, force: Vec, name: string): void {
    const { radius } = this.model.frame;
    const size = length(force);
    if (size < 1e-3 * radius) return;
    const turn = frame(unit(force));
    const tip = Math.min(0.13 * radius, 0.8 * size);
    const thick = 0.017 * radius * Math.sqrt(this.crowd());
    const tint = colour(name);
    this.canvas.solid(this.shaft, { turn, stretch: [thick, thick, size - 0.9 * tip], at: from }, tint);
    const at = add(from, times(1 - tip / size, force));
    this.canvas.solid(this.head, { turn, stretch: [0.4 * tip, 0.4 * tip, tip], at }, tint);
  }

  /** Of a pad that many contacts stand for, each is shown smaller. */
  private crowd(): number {
    const { contacts } = this.model.answers.check;
    return 1 / Math.sqrt(contacts.length / new Set(contacts.map(({ finger }) => finger)).size);
  }

  private drawForces(): void {
    const { check, hold } = this.model.answers;
    const { canvas } = this;
    const load = this.model.deciding;
    const { radius } = this.model.frame;
    const perNewton = this.perNewton();
    check.contacts.forEach((contact, i) => {
      const at = this.world(contact.position);
      const n = turned(this.model.orientation, contact.normal);
      const force = hold.holdable ? hold.contacts[i]! : undefined;
      const limited = force && force.limit !== 'none' && force.state !== 'unloaded';
      if (force) this.arrow(at, times(perNewton, turned(this.model.orientation, force.force)), limited ? '--limit' : '--force');
      const thick = (contact.torsion ? 0.045 : 0.03) * radius * this.crowd();
      const wide = (contact.torsion ? 0.085 : 0.055) * radius * this.crowd();
      const pad = { turn: frame(n), stretch: [wide, wide, thick] as Vec, at: minus(at, times(thick, n)) };
      canvas.solid(this.shaft, pad, colour(limited ? '--limit' : '--outline'));
    });
    const com = this.world(load.com);
    const dot: Vec = [0.03 * radius, 0.03 * radius, 0.03 * radius];
    canvas.solid(this.ball, { turn: view, stretch: dot, at: com }, colour('--weight'));
    this.arrow(com, [0, 0, -perNewton * turningForce(load)], '--weight');
    this.arrow(com, times(perNewton, turned(this.model.orientation, stillForce(load) as unknown as Vec)), '--weight');
  }

  private drawCones(): void {
    const { check, hold } = this.model.answers;
    const { radius } = this.model.frame;
    check.contacts.forEach((contact, i) => {
      const slipping = hold.holdable && hold.contacts[i]!.state === 'slipping';
      const high = (0.34 * radius * this.crowd()) / Math.hypot(1, contact.friction);
      const wide = high * contact.friction;
      if (wide <= 0) return;
      const turn = frame(turned(this.model.orientation, contact.normal));
      const at = this.world(contact.position);
      this.canvas.glass(this.cone, { turn, stretch: [wide, wide, high], at }, colour('--force'), slipping ? 0.34 : 0.14, slipping ? 0.5 : 0.2);
    });
  }

  private drawLabels(): void {
    const { check, hold } = this.model.answers;
    const { com } = this.model.deciding;
    const weight = turningForce(this.model.deciding);
    const perNewton = this.perNewton();
    const from = this.screen(com);
    const tip = this.screen(this.object(add(this.world(com), [0, 0, -perNewton * weight])));
    const arrows = !hold.holdable ? [] : hold.contacts.map(({ force }, i): Arrow => {
      const { position } = check.contacts[i]!;
      return [this.screen(position), this.screen(add(position, times(perNewton, force)))];
    });
    const fingers = [...new Set(check.contacts.map((contact) => contact.finger))].map((name): Finger => {
      const own = check.contacts.filter((contact) => contact.finger === name);
      const mean = (points: Vec[]) => times(1 / own.length, points.reduce(add));
      const [x, y] = turned(view, turned(this.model.orientation, mean(own.map((each) => times(-1, each.normal)))));
      const aside = Math.hypot(x, y);
      const force = hold.holdable ? hold.fingers.find((each) => each.finger === name)?.force : undefined;
      // Above one that is seen from behind or from in front.
      return { name, at: this.screen(mean(own.map((each) => each.position))), out: aside > 0.35 ? [x / aside, -y / aside] : [0, -1], force: force && length(force) };
    });
    this.back.replaceChildren(line([from[0], 0], [from[0], this.size[1]], 'vertical'));
    this.front.replaceChildren(...labels(fingers, weight, tip, [...arrows, [from, tip]], this.size));
  }

  private placeHandles(): void {
    const { contacts } = this.model.answers.check;
    if (this.contacts.length !== contacts.length) this.makeHandles(contacts.length);
    contacts.forEach((contact, i) => {
      const [x, y] = this.screen(contact.position);
      set(this.contacts[i]!, {
        transform: `translate(${x} ${y})`,
        'aria-label': `Contact ${i}, finger ${contact.finger}: arrow keys move it`,
      });
    });
    const { com } = this.model.deciding;
    const place = (handle: SVGElement, p: Vec) => set(handle, { transform: `translate(${this.screen(p).join(' ')})` });
    place(this.com, com);
    const force = pushOf(this.model.grasp);
    this.tip.toggleAttribute('hidden', !force);
    if (force) place(this.tip, add(com, times(this.perNewton(), force)));
  }

  private push(force: Vec): void {
    this.model.edit((grasp) => push(grasp, force));
  }

  private makeHandles(count: number): void {
    this.contacts = Array.from({ length: count }, (_, i) => {
      const handle = node('g', { class: 'handle contact', tabindex: 0, role: 'application' }, node('circle', { r: 17, class: 'grab' }));
      draggable(handle, (event) => {
        const grip = this.grip(event, this.model.grasp.contacts[i]!.position);
        return (e) => this.moveContact(i, grip(e), this.beneath(e));
      });
      keySteps(handle, (dx, dy) => {
        const to = add(this.model.grasp.contacts[i]!.position, this.step(dx, dy));
        const normal = this.model.answers.check.contacts[i]!.normal;
        const { body, frame: ball } = this.model;
        this.moveContact(i, to, body && hit(body, minus(to, times(ball.radius, normal)), normal));
      });
      return handle;
    });
    this.handles.replaceChildren(...this.contacts);
  }

  /** A step on the screen as one of the object. */
  private step(dx: number, dy: number): Vec {
    const way = turnedBack(this.model.orientation, turnedBack(view, [dx, dy, 0]));
    return times(0.02 * this.model.frame.radius, way);
  }

  /** A point that follows the pointer at the depth at which it was taken hold of. */
  private grip(begin: PointerEvent, p: Vec): (event: PointerEvent) => Vec {
    const start = place(this.picture, begin);
    const turn = this.model.orientation;
    return (event) => {
      const [x, y] = place(this.picture, event);
      const way = turnedBack(view, [(x - start[0]) / this.eye.scale, (start[1] - y) / this.eye.scale, 0]);
      return add(p, turnedBack(turn, way));
    };
  }

  /** The surface under the pointer. */
  private beneath(event: PointerEvent) {
    const [x, y] = place(this.picture, event);
    const far = 3 * this.model.frame.radius;
    const eye: Vec = [(x - this.size[0] / 2) / this.eye.scale, (this.size[1] / 2 - y) / this.eye.scale, far];
    const { body } = this.model;
    return body && hit(body, this.object(turnedBack(view, eye)), turnedBack(this.model.orientation, turnedBack(view, [0, 0, -1])));
  }

  private moveContact(i: number, to: Vec, surface: ReturnType<typeof hit>): void {
    this.model.edit(({ object, contacts }) => {
      const contact = contacts[i]!;
      if (object.shape) {
        contact.position = onSurface(object.shape, surface ? surface.point : to);
        delete contact.normal;  // the shape's
      } else if (this.model.body) {
        if (!surface) return;
        contact.position = surface.point;
        contact.normal = times(-1, surface.normal);
      } else contact.position = this.within(to, 1);
    });
  }

  private moveCom(to: Vec): void {
    this.model.edit(() => {
      this.model.mass.com = this.within(to, 1.15);
    });
  }

  /** Not out of sight. */
  private within(p: Vec, most: number): Vec {
    const { centre, radius } = this.model.frame;
    const from = minus(p, centre);
    return add(centre, times(Math.min(1, (most * radius) / (length(from) || 1e-300)), from));
  }
}

/** Without its ends. */
function open(body: Body): Body {
  const kept = body.triangles.flatMap((_, t) => (Math.abs(body.normals[3 * t]![2]) < 0.999999 ? [t] : []));
  return {
    ...body,
    triangles: kept.map((t) => body.triangles[t]!),
    normals: kept.flatMap((t) => body.normals.slice(3 * t, 3 * t + 3)),
  };
}

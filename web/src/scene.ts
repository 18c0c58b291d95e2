// The object as it hangs: gravity points down on the screen.
import { proofOf, stillForce, turningForce, type NotHeld, type Optimum } from './core';
import { push, pushOf, type Point } from './grasp';
import { labels, type Arrow, type Finger } from './label';
import { along, nearest, outline } from './shape';
import type { PlanarModel } from './state';
import { arrow, draggable, keySteps, line, node, path, place, set } from './svg';
import { add, left, length, minus, times, turned } from './vector';
import { degrees, wrapped } from './words';

/** From the object frame to the screen and back. */
class Placement {
  readonly scale: number;
  constructor(
    readonly width: number,
    readonly height: number,
    private readonly pivot: Point,
    radius: number,
    private readonly angle: number,
  ) {
    // Room for the labels at the fingers, which are wider than high.
    this.scale = Math.min((width / 2 - 78) / radius, (height / 2 - 58) / radius);
  }
  point(p: Point): Point {
    return add([this.width / 2, this.height / 2], this.direction(minus(p, this.pivot), this.scale));
  }
  direction(v: Point, scale = 1): Point {
    const [x, y] = turned(v, this.angle);
    return [scale * x, -scale * y];
  }
  object([x, y]: Point): Point {
    const centred: Point = [(x - this.width / 2) / this.scale, (this.height / 2 - y) / this.scale];
    return add(this.pivot, turned(centred, -this.angle));
  }
}

export class Scene {
  readonly picture: SVGSVGElement;
  private readonly back = node('g');
  private readonly body = node('path', { class: 'body', tabindex: 0, role: 'slider' });
  private readonly cones = node('g', { class: 'passive' });
  private readonly front = node('g', { class: 'passive' });
  private readonly com = node('g', { class: 'handle com', tabindex: 0, role: 'application' });
  private contacts: SVGGElement[] = [];
  private readonly handles = node('g');
  /** Of the arrow of what pushes the object. */
  private readonly tip = node('g', { class: 'handle tip', tabindex: 0, role: 'application' }, node('circle', { r: 16, class: 'grab' }));
  private perNewton = 1;
  private now: Placement;

  constructor(
    parent: HTMLElement,
    private readonly model: PlanarModel,
  ) {
    this.picture = node('svg', { role: 'group', 'aria-label': 'The object as it is held, gravity pointing down' });
    this.picture.append(this.back, this.body, this.cones, this.front, this.handles, this.com, this.tip);
    parent.prepend(this.picture);
    this.com.append(
      node('circle', { r: 16, class: 'grab' }),
      node('circle', { r: 5, class: 'dot' }),
    );
    this.now = this.placement();

    set(this.body, { 'aria-label': 'Posture: turn the object', 'aria-valuemin': -180, 'aria-valuemax': 180 });
    draggable(this.body, (event) => {
      const about = (e: PointerEvent) => {
        const [x, y] = place(this.picture, e);
        return (Math.atan2(this.now.height / 2 - y, x - this.now.width / 2) * 180) / Math.PI;
      };
      const from = about(event);
      const start = this.model.angle;
      return (e) => this.model.turnTo(this.model.snapped(start + wrapped(about(e) - from), 0.6));
    });
    keySteps(this.body, (dx, dy) => this.model.turnTo(this.model.angle + dx + dy));

    set(this.com, { 'aria-label': 'Centre of mass: arrow keys move it' });
    draggable(this.com, () => (e) => this.moveCom(this.now.object(place(this.picture, e))));
    keySteps(this.com, (dx, dy) => {
      const step = times(0.02 * this.model.frame.radius, turned([dx, dy], -this.model.angle));
      this.moveCom(add(this.model.deciding.com, step));
    });

    set(this.tip, { 'aria-label': 'Push: arrow keys change it' });
    draggable(this.tip, () => {
      const { perNewton } = this;
      return (e) => {
        const from = this.now.point(this.model.deciding.com);
        const [x, y] = minus(place(this.picture, e), from);
        this.push(times(1 / perNewton, turned([x, -y], -this.model.angle)));
      };
    });
    keySteps(this.tip, (dx, dy) => {
      const step = times(0.05 * Math.abs(turningForce(this.model.deciding) || 1), turned([dx, dy], -this.model.angle));
      this.push(add(pushOf(this.model.grasp) ?? [0, 0], step));
    });
  }

  draw(): void {
    this.now = this.placement();
    const { width, height } = this.now;
    set(this.picture, { viewBox: `0 0 ${width} ${height}` });
    this.drawBody();
    this.drawContacts();
    this.drawForces();
    const com = this.now.point(this.model.deciding.com);
    set(this.com, { transform: `translate(${com[0]} ${com[1]})` });
  }

  private placement(): Placement {
    const box = this.picture.getBoundingClientRect();
    const { pivot, radius } = this.model.frame;
    return new Placement(box.width || 500, box.height || 500, pivot, radius, this.model.angle);
  }

  private drawBody(): void {
    const { check, hold } = this.model.answers;
    const points = check.shape
      ? outline(check.shape)
      : check.contacts.map((contact) => contact.position);
    const angle = this.model.angle;
    set(this.body, {
      d: check.shape ? path(points.map((p) => this.now.point(p)), true) : this.discThrough(),
      class: `body${check.shape ? '' : ' unknown'}${hold.holdable ? '' : ' fallen'}`,
      'aria-valuenow': angle.toFixed(2),
      'aria-valuetext': degrees(angle),
    });
    const com = this.now.point(this.model.deciding.com);
    const vertical = line([com[0], 0], [com[0], this.now.height], 'vertical');
    this.back.replaceChildren(vertical, ...(hold.holdable ? [] : this.fall(hold, points)));
  }

  /** The object a little further on the motion that gravity drives and no contact opposes. */
  private fall(hold: NotHeld<Point>, points: Point[]): Node[] {
    const { radius } = this.model.frame;
    const [vx, vy, turning] = proofOf(hold).map((part) => -part) as [number, number, number];
    const far = Math.max(...points.map((p) => length([vx - turning * p[1], vy + turning * p[0]])));
    if (!(far > 0)) return [];
    return [1, 2].map((step) => {
      const time = (0.09 * step * radius) / far;
      const angle = turning * time;
      // A turn about the centre of the motion, which may be far away.
      const [s, c] = Math.abs(angle) < 1e-9 ? [1, 0] : [Math.sin(angle) / angle, (1 - Math.cos(angle)) / angle];
      const shift: Point = [time * (s * vx - c * vy), time * (c * vx + s * vy)];
      const moved = points.map((p) => this.now.point(add(shift, turned(p, (angle * 180) / Math.PI))));
      return node('path', { d: path(moved, true), class: `fall fall-${step}` });
    });
  }

  /** Where the shape is not known, something to take hold of. */
  private discThrough(): string {
    const { pivot, radius } = this.model.frame;
    const ring = Array.from({ length: 90 }, (_, k): Point => turned([1.02 * radius, 0], 4 * k));
    return path(ring.map((p) => this.now.point(add(pivot, p))), true);
  }

  private drawContacts(): void {
    const { check, hold } = this.model.answers;
    if (this.contacts.length !== check.contacts.length) this.makeHandles(check.contacts.length);
    const reach = 0.8 * this.now.scale * this.model.frame.radius;
    const cones: Node[] = [];
    check.contacts.forEach((contact, i) => {
      const tip = this.now.point(contact.position);
      const n = this.now.direction(contact.normal);
      const half = Math.atan(contact.friction);
      const slipping = hold.holdable && hold.contacts[i]?.state === 'slipping';
      const at = (angle: number): Point =>
        add(tip, add(times(reach * Math.cos(angle), n), times(reach * Math.sin(angle), left(n))));
      const arc = Array.from({ length: 25 }, (_, k) => at((half * (k - 12)) / 12));
      cones.push(
        node('path', { d: path([tip, ...arc], true), class: 'cone' }),
        node('path', { d: path([at(half), tip, at(-half)]), class: `edge${slipping ? ' slipping' : ''}` }),
      );
      const turn = (Math.atan2(n[1], n[0]) * 180) / Math.PI;
      const atLimit = hold.holdable && hold.contacts[i]?.limit !== 'none';
      set(this.contacts[i]!, {
        transform: `translate(${tip[0]} ${tip[1]}) rotate(${turn})`,
        class: `handle contact${atLimit ? ' limit' : ''}`,
        'aria-label': `Contact ${i}, finger ${contact.finger}: arrow keys move it`,
      });
    });
    this.cones.replaceChildren(...cones);
  }

  private makeHandles(count: number): void {
    this.contacts = Array.from({ length: count }, (_, i) => {
      const handle = node(
        'g',
        { class: 'handle contact', tabindex: 0, role: 'application' },
        node('circle', { r: 22, class: 'grab', cx: -5 }),
        node('rect', { x: -13, y: -13, width: 13, height: 26, rx: 4, class: 'pad' }),
      );
      draggable(handle, () => (e) => this.moveContact(i, this.now.object(place(this.picture, e))));
      keySteps(handle, (dx, dy) => {
        const { shape } = this.model.grasp.object;
        const { position } = this.model.grasp.contacts[i]!;
        const step = 0.02 * this.model.frame.radius;
        this.moveContact(
          i,
          shape
            ? along(shape, position, step * (dx + dy))
            : add(position, times(step, turned([dx, dy], -this.model.angle))),
        );
      });
      return handle;
    });
    this.handles.replaceChildren(...this.contacts);
  }

  private moveContact(i: number, to: Point): void {
    this.model.edit(({ object, contacts }) => {
      const contact = contacts[i]!;
      contact.position = object.shape ? nearest(object.shape, to) : this.within(to, 1);
      if (object.shape) delete contact.normal;  // the shape's
    });
  }

  private push(force: Point): void {
    this.model.edit((grasp) => push(grasp, force));
  }

  private placeTip(): void {
    const force = pushOf(this.model.grasp);
    this.tip.toggleAttribute('hidden', !force);
    if (!force) return;
    const [x, y] = add(this.now.point(this.model.deciding.com), this.now.direction(force, this.perNewton));
    set(this.tip, { transform: `translate(${x} ${y})` });
  }

  private moveCom(to: Point): void {
    this.model.edit(() => {
      this.model.mass.com = this.within(to, 1.15);
    });
  }

  /** Not out of sight. */
  private within(p: Point, most: number): Point {
    const { pivot, radius } = this.model.frame;
    const from = minus(p, pivot);
    return add(pivot, times(Math.min(1, (most * radius) / length(from)) || 1, from));
  }

  private drawForces(): void {
    const { check, hold } = this.model.answers;
    const size = this.now.scale * this.model.frame.radius;
    const forces = hold.holdable ? hold.contacts.map((each) => length(each.force)) : [];
    const load = this.model.deciding;
    const turning = turningForce(load);
    const still = stillForce(load) as unknown as Point;
    const largest = Math.max(Math.abs(turning), length(still));
    const perNewton = Math.min((0.5 * size) / largest, (0.95 * size) / Math.max(...forces, 0));
    this.perNewton = perNewton;
    this.placeTip();
    const com = this.now.point(load.com);
    const weight: Point = [com[0], com[1] + perNewton * turning];
    const drawn: Node[] = [...this.meeting()];
    const arrows: Arrow[] = [];
    const draw = (from: Point, to: Point, kind: string) => {
      arrows.push([from, to]);
      drawn.push(arrow(from, to, kind));
    };

    if (hold.holdable)
      hold.contacts.forEach((each, i) => {
        const tip = this.now.point(check.contacts[i]!.position);
        draw(tip, add(tip, this.now.direction(each.force, perNewton)), each.limit === 'none' ? 'force' : 'force limit');
      });
    if (turning !== 0) draw(com, weight, 'gravity');
    if (length(still) > 0) draw(com, add(com, this.now.direction(still, perNewton)), 'gravity');
    this.front.replaceChildren(...drawn, ...labels(this.fingers(), turning, weight, arrows, [this.now.width, this.now.height]));
  }

  /** Where the edges of two cones meet at the kink nearest to this posture. */
  private meeting(): Node[] {
    const { check, curve } = this.model.answers;
    const away = (each: Optimum) => Math.abs(wrapped(each.angle_deg - this.model.angle));
    const [kink] = curve.optima.filter((each) => each.edges_meet).sort((a, b) => away(a) - away(b));
    if (!kink?.edges_meet || away(kink) > 75) return [];
    const meet = this.now.point(kink.edges_meet);
    const lines = kink.contacts.flatMap((each, i) =>
      each.state === 'slipping' ? [line(this.now.point(check.contacts[i]!.position), meet, 'meeting')] : [],
    );
    const here = away(kink) < 1e-7;
    return [...lines, node('circle', { cx: meet[0], cy: meet[1], r: 6, class: `meet${here ? ' here' : ''}` })];
  }

  private fingers(): Finger[] {
    const { check, hold } = this.model.answers;
    return [...new Set(check.contacts.map((contact) => contact.finger))].map((name) => {
      const own = check.contacts.filter((contact) => contact.finger === name);
      const mean = (points: Point[]) => times(1 / own.length, points.reduce(add));
      const force = hold.holdable ? hold.fingers.find((each) => each.finger === name)?.force : undefined;
      return {
        name,
        at: mean(own.map((each) => this.now.point(each.position))),
        out: mean(own.map((each) => this.now.direction(each.normal, -1))),
        force: force && length(force),
      };
    });
  }
}

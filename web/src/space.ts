// What is shown of a grasp in space: as state.ts in the plane. The certified best posture and the
// sphere come from a worker, later than the rest.
import { askSpatial, BadGrasp, type GripUnit, type Held, type Hold, type Margins, type Plane, type Shaken, type SpatialBest, type SpatialCheck } from './core';
import { spatialTurning, type Turning } from './course';
import { massesOf, type Objective, type SpatialGrasp, type Vec } from './grasp';
import { measure, type Measure } from './measure';
import { bodyOf, bodyOfMesh, type Body, type Triangles } from './mesh';
import type { Ring } from './ring';
import { about, add, after, angle, ballOf, frame, times, towards, turned, turnedBack, unit, type Ball, type Turn } from './turn';
import { radians } from './vector';
import Worker from './worker?worker&inline';
import type { Coloured, Part, ShakeAnswer, ShakeTask, Task, TurnAnswer, TurnTask } from './worker';

export interface SpatialAnswers {
  grasp: SpatialGrasp;
  check: SpatialCheck;
  gripUnit: GripUnit | null;
  measure: Measure;
  hold: Hold<Vec>;
}

/** What the worker found, of the grasp as it is or as it was. */
export interface Found {
  best?: SpatialBest;
  planes?: Plane[];
  /** All around in the only plane of directions that can be held, where there is but that. */
  ring?: Ring | undefined;
  sphere?: Coloured;
}

const up: Vec = [0, 0, 1];
const found = 2e-5;

export class SpatialModel {
  grasp: SpatialGrasp;
  /** The object in the world, whose z is up. */
  orientation: Turn;
  frame: Ball;
  body: Body | undefined;
  answers: SpatialAnswers;
  found: Found = {};
  /** Whether what was found is of another grasp than the one that is shown. */
  outdated = true;
  problem = '';

  private stale = false;
  private pending = false;
  private moving = 0;
  private task = 0;
  private turns = 0;
  private told: ((turning: Turning<Vec> | undefined) => void) | undefined;
  private shakes = 0;
  private shaken: ((found: Shaken) => void) | undefined;
  private bodyIsOf: unknown;
  private readonly worker: InstanceType<typeof Worker>;
  private readonly listeners: (() => void)[] = [];

  constructor(wasm: ArrayBuffer, grasp: SpatialGrasp, private mesh?: Triangles) {
    this.worker = new Worker();
    this.worker.postMessage(wasm);
    this.worker.onmessage = ({ data }: MessageEvent<Part | TurnAnswer | ShakeAnswer>) =>
      'turn' in data ? this.receiveTurn(data) : 'shake' in data ? this.receiveShake(data) : this.receive(data);
    this.grasp = structuredClone(grasp);
    this.orientation = hung(grasp);
    this.answers = this.ask();
    this.body = this.bodyNow();
    this.frame = frameOf(this.answers.check, this.body);
    this.order();
  }

  onChange(listener: () => void): void {
    this.listeners.push(listener);
  }

  /** Another grasp; one without meaning is refused, and nothing changes. */
  load(grasp: SpatialGrasp, mesh?: Triangles): void {
    const before = [this.grasp, this.orientation] as const;
    this.grasp = structuredClone(grasp);
    this.orientation = hung(grasp);
    try {
      this.answers = this.ask();
    } catch (error) {
      [this.grasp, this.orientation] = before;
      throw error;
    }
    this.mesh = mesh;
    this.body = this.bodyNow();
    this.frame = frameOf(this.answers.check, this.body);
    this.problem = '';
    this.found = {};
    this.order();
    this.changed(false);
  }

  /** A mesh is not known to the solver, which would miss the shape. */
  get warnings(): string[] {
    return this.mesh ? [] : this.answers.check.warnings;
  }

  /** On its way to a posture, or there, and not yet asked how it is held. */
  get turning(): boolean {
    return this.moving !== 0 || this.pending;
  }

  /** The direction of the object that points up. */
  get up(): Vec {
    return turnedBack(this.orientation, up);
  }

  /** The load that decides. */
  get deciding() {
    return this.answers.check.loads[this.answers.hold.load ?? 0]!;
  }

  nameOf(load: number): string {
    return this.answers.check.loads[load]?.name ?? `load ${load}`;
  }

  /** The same as it is written in the grasp, to be changed. */
  get mass() {
    return massesOf(this.grasp)[this.answers.hold.load ?? 0]!;
  }

  orient(orientation: Turn): void {
    this.moving = 0;
    this.orientation = orientation;
    this.changed(false);
  }

  /** By angles about the world's vertical and about the horizontal of the screen [rad]. */
  turnBy(vertical: number, horizontal: number, from = this.orientation): void {
    this.orient(after(about([1, 0, 0], horizontal), after(about(up, vertical), from)));
  }

  /** To a posture, by the smallest turn; it is seen to turn, unless that is not wanted. */
  turnTo(posture: Vec): void {
    const from = this.orientation;
    const way = turnedBack(from, up);
    const still = matchMedia('(prefers-reduced-motion: reduce)').matches;
    const begin = performance.now();
    const mine = (this.moving = Math.random());
    const step = () => {
      if (this.moving !== mine) return;
      const part = still ? 1 : Math.min((performance.now() - begin) / 250, 1);
      // In the object's frame the direction that is up moves from one to the other.
      const now = unit(turnTowards(way, posture, part * (2 - part)));
      this.orientation = after(towards(turned(from, part === 1 ? posture : now), up), from);
      this.changed(false);
      if (part < 1) requestAnimationFrame(step);
      else this.moving = 0;
    };
    step();
  }

  /** At once, by the smallest turn. */
  show(posture: Vec): void {
    this.orient(after(towards(turned(this.orientation, posture), up), this.orientation));
  }

  /** The file's posture, or upright. */
  get from(): Vec {
    return unit(this.answers.grasp.up ?? up);
  }

  /** What the turn to a posture takes, from the worker; of many questions the last is answered. */
  askTurn(to: Vec, then: (turning: Turning<Vec> | undefined) => void): void {
    this.told = then;
    this.worker.postMessage({ turn: ++this.turns, grasp: this.answers.grasp, to } satisfies TurnTask);
  }

  /** What the posture withstands, likewise. */
  askShake(then: (found: Shaken) => void): void {
    this.shaken = then;
    const { grasp, hold } = this.answers;
    this.worker.postMessage({ shake: ++this.shakes, grasp, up: hold.up } satisfies ShakeTask);
  }

  edit(change: (grasp: SpatialGrasp) => void): void {
    change(this.grasp);
    this.changed(true);
  }

  /** What was found of another objective says nothing. */
  minimise(objective: Objective): void {
    this.found = {};
    this.outdated = true;
    this.edit((grasp) => void (grasp.objective = objective));
  }

  margins(): Margins {
    const { grasp, hold, measure } = this.answers;
    const margins = askSpatial('margins', grasp, { up: this.up });
    if (measure.objective === 'effort' || !hold.holdable) return margins;
    const [x, y, z] = frame(hold.up);
    const [degrees, sides] = [0.02, 16];
    const ups = Array.from({ length: sides }, (_, k) => {
      const side = add(times(Math.cos((2 * Math.PI * k) / sides), x), times(Math.sin((2 * Math.PI * k) / sides), y));
      return add(times(Math.cos(radians(degrees)), z), times(Math.sin(radians(degrees)), side));
    });
    const values = askSpatial('values', grasp, { ups: [hold.up, ...ups] }).values;
    return { ...margins, slopes: values.slice(1).flatMap((value) => (value === null ? [] : [(value - values[0]!) / degrees])) };
  }

  holdAt(posture: Vec, objective: Objective): Hold<Vec> {
    return askSpatial('hold', this.answers.grasp, { up: posture, objective });
  }

  /** The minimum that a posture is, within an angle [rad]: as exact as minima are found. */
  minimum(posture: Vec, within = found): Held<Vec> | undefined {
    if (this.outdated) return undefined;
    return this.found.best?.minima.find((each) => angle(each.up, posture) <= within);
  }

  /** Exact where a hand is not: an orientation next to one in which a minimum is up. */
  snapped(orientation: Turn): Turn {
    const near = this.minimum(turnedBack(orientation, up), 0.02);
    return near ? after(towards(turned(orientation, near.up), up), orientation) : orientation;
  }

  private changed(grasp: boolean): void {
    this.stale ||= grasp;
    if (this.pending) return;
    this.pending = true;
    requestAnimationFrame(() => {
      this.pending = false;
      try {
        if (this.stale) {
          this.answers = this.ask();
          this.body = this.bodyNow();
          this.order();
        } else if (!this.problem) this.answers.hold = askSpatial('hold', this.grasp, { up: this.up });
        this.problem = '';
      } catch (error) {
        if (!(error instanceof BadGrasp)) throw error;
        this.problem = error.message;
        this.answers.hold = askSpatial('hold', this.answers.grasp, { up: this.up });
      }
      this.stale = this.problem !== '';
      this.tell();
    });
  }

  private tell(): void {
    for (const listener of this.listeners) listener();
  }

  private ask(): SpatialAnswers {
    const grasp = structuredClone(this.grasp);
    const { objective, grip_unit } = askSpatial('objectives', grasp);
    return {
      grasp,
      check: askSpatial('check', grasp),
      gripUnit: grip_unit,
      measure: measure(objective, grip_unit),
      hold: askSpatial('hold', grasp, { up: this.up }),
    };
  }

  private order(): void {
    this.outdated = true;
    this.worker.postMessage({ id: ++this.task, grasp: this.answers.grasp } satisfies Task);
  }

  private receiveTurn({ turn, taken, tracks, values }: TurnAnswer): void {
    if (turn === this.turns) this.told?.(taken && spatialTurning(taken, tracks!, values!, this.answers.measure));
  }

  private receiveShake({ shake, found }: ShakeAnswer): void {
    if (shake === this.shakes) this.shaken?.(found);
  }

  private receive(part: Part): void {
    if (part.id !== this.task) return;
    if ('best' in part) Object.assign(this.found, { best: part.best, planes: part.planes, ring: part.ring });
    else if ('values' in part) this.found.sphere = part;
    else this.outdated = false;
    if ('best' in part) this.outdated = false;
    this.tell();
  }

  /** The body as it was, unless the shape is another. */
  private bodyNow(): Body | undefined {
    const { shape } = this.answers.check;
    const of = shape ? JSON.stringify(shape) : this.mesh;
    if (of !== this.bodyIsOf) this.body = shape ? bodyOf(shape) : this.mesh && bodyOfMesh(this.mesh);
    this.bodyIsOf = of;
    return this.body;
  }
}

/** In its posture, and turned so that no side of it is seen head-on. */
const hung = ({ up: now = up }: SpatialGrasp) => after(about(up, radians(-32)), towards(now, up));

/** A part of the way from one direction to another. */
function turnTowards(from: Vec, to: Vec, part: number): Vec {
  return turned(towards(from, to, part), from);
}

/** The part of space that is shown: fixed for a grasp, so that nothing jumps while one drags. */
function frameOf({ contacts, loads }: SpatialCheck, body: Body | undefined): Ball {
  // Joined, as a call cannot take as many arguments as a mesh has points.
  return ballOf(contacts.map((contact) => contact.position).concat(body ? body.points : loads.map(({ com }) => com)));
}

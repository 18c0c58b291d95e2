// What is shown: a grasp, a posture, and the answers to them.
import { ask, BadGrasp, type Best, type Check, type Curve, type GripUnit, type Hold, type Margins, type Optimum, type Shaken } from './core';
import { planarTurning, type Turning } from './course';
import { massesOf, type Domain, type Objective, type PlanarGrasp, type Point } from './grasp';
import { measure, type Measure } from './measure';
import { outline } from './shape';
import { length, minus } from './vector';
import { wrapped } from './words';

export interface PlanarAnswers {
  grasp: PlanarGrasp;
  check: Check;
  gripUnit: GripUnit | null;
  measure: Measure;
  best: Best;
  curve: Curve;
  /** Of the other objective, where both are newtons. */
  other: Curve | undefined;
  hold: Hold<Point>;
}

/** The part of the plane that is shown: fixed for a grasp, so that nothing jumps while one drags. */
export interface Frame {
  pivot: Point;
  radius: number;
}

export class PlanarModel {
  grasp: PlanarGrasp;
  angle = 0;
  domain: Domain = 'all';
  frame: Frame;
  answers: PlanarAnswers;
  /** Why the grasp as it is now has no meaning; the answers are then those of the last that had. */
  problem = '';

  private stale = false;
  private pending = false;
  private readonly listeners: (() => void)[] = [];

  constructor(grasp: PlanarGrasp) {
    this.grasp = structuredClone(grasp);
    this.frame = frameOf(grasp);
    this.domain = grasp.domain ?? 'all';
    this.answers = this.ask();
    this.angle = this.start();
    this.answers.hold = ask('hold', this.grasp, { angle_deg: this.angle });
  }

  onChange(listener: () => void): void {
    this.listeners.push(listener);
  }

  /** Another grasp; one without meaning is refused, and nothing changes. */
  load(grasp: PlanarGrasp): void {
    const next = new PlanarModel(grasp);
    Object.assign(this, { grasp: next.grasp, frame: next.frame, domain: next.domain });
    Object.assign(this, { answers: next.answers, angle: next.angle, problem: '' });
    this.changed(false);
  }

  turnTo(angle: number): void {
    this.angle = wrapped(angle);
    this.changed(false);
  }

  edit(change: (grasp: PlanarGrasp) => void): void {
    change(this.grasp);
    this.changed(true);
  }

  choose(domain: Domain): void {
    this.domain = domain;
    this.changed(true);
  }

  /** @throws BadGrasp where the drives' limits leave no curve of the effort, and nothing changes. */
  minimise(objective: Objective): void {
    ask('curve', this.answers.grasp, { objective });
    this.edit((grasp) => void (grasp.objective = objective));
  }

  margins(): Margins {
    return ask('margins', this.answers.grasp, { angle_deg: this.angle });
  }

  shaken(): Shaken {
    return ask('shake', this.answers.grasp, { angle_deg: this.angle });
  }

  /** From the file's posture, or upright. */
  get from(): number {
    return wrapped(this.answers.grasp.angle_deg ?? 0);
  }

  /** What the turn to a posture takes. */
  turning(to: number): Turning<number> | undefined {
    const { grasp, measure, curve } = this.answers;
    try {
      const taken = ask('turn', grasp, { angle_deg: to, domain: this.domain });
      return planarTurning(taken, this.domain === 'all' ? curve : ask('curve', grasp, { domain: 'all' }), measure, this.from, to);
    } catch (error) {
      if (error instanceof BadGrasp) return undefined;
      throw error;
    }
  }

  /** The load that decides. */
  get deciding() {
    return this.answers.check.loads[this.answers.hold.load ?? 0]!;
  }

  /** Its body as it is written in the grasp, to be changed. */
  get mass() {
    return massesOf(this.grasp)[this.answers.hold.load ?? 0]!;
  }

  holdAt(angle: number, objective: Objective): Hold<Point> {
    return ask('hold', this.answers.grasp, { angle_deg: angle, objective });
  }

  /** The optimum within half a degree of a posture: exact, where a hand is not. */
  snapped(angle: number, within: number): number {
    const near = this.answers.curve.optima.find(
      (each) => Math.abs(wrapped(each.angle_deg - angle)) <= within,
    );
    return near ? near.angle_deg : angle;
  }

  /** The optimum that the present posture is. */
  optimum(): Optimum | undefined {
    return this.answers.curve.optima.find((each) => Math.abs(wrapped(each.angle_deg - this.angle)) < 1e-7);
  }

  private changed(grasp: boolean): void {
    this.stale ||= grasp;
    if (this.pending) return;
    this.pending = true;
    requestAnimationFrame(() => {
      this.pending = false;
      try {
        if (this.stale) this.answers = this.ask();
        else if (!this.problem) this.answers.hold = ask('hold', this.grasp, { angle_deg: this.angle });
        this.problem = '';
      } catch (error) {
        if (!(error instanceof BadGrasp)) throw error;
        this.problem = error.message;
        this.answers.hold = ask('hold', this.answers.grasp, { angle_deg: this.angle });
      }
      this.stale = this.problem !== '';
      for (const listener of this.listeners) listener();
    });
  }

  private ask(): PlanarAnswers {
    const { domain } = this;
    const grasp = structuredClone(this.grasp);
    const { objective, grip_unit } = ask('objectives', grasp);
    const other = objective === 'grip' ? 'effort' : 'grip';
    return {
      grasp,
      check: ask('check', grasp),
      gripUnit: grip_unit,
      measure: measure(objective, grip_unit),
      other: grip_unit === 'N' ? this.curveOf(other, grasp) : undefined,
      best: ask('best', grasp, { domain, with_turn: false }),
      curve: ask('curve', grasp, { domain }),
      hold: ask('hold', grasp, { angle_deg: this.angle }),
    };
  }

  private curveOf(objective: Objective, grasp: PlanarGrasp): Curve | undefined {
    try {
      return ask('curve', grasp, { domain: this.domain, objective });
    } catch (error) {
      if (error instanceof BadGrasp) return undefined;
      throw error;
    }
  }

  /** As it is held now; else the best pinched posture, the one that is worth looking at. */
  private start(): number {
    const { best, best_pinched } = this.answers.best;
    return this.grasp.angle_deg ?? best_pinched?.angle_deg ?? best?.angle_deg ?? 0;
  }
}

function frameOf({ object, contacts }: PlanarGrasp): Frame {
  const points = contacts.map((contact) => contact.position).concat(object.shape ? outline(object.shape) : [object.com]);
  const middle = (k: 0 | 1) => {
    const values = points.map((point) => point[k]);
    return (Math.min(...values) + Math.max(...values)) / 2;
  };
  const pivot: Point = [middle(0), middle(1)];
  const radius = Math.max(...points.map((point) => length(minus(point, pivot))));
  return { pivot, radius: radius || 1 };
}

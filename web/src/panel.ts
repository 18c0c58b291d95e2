// Numbers to type and to slide, and tables of what they lead to.
import type { AnyHold, GripUnit, Kind } from './core';
import { massesOf, ownMassesOf, push, pushOf, type Contact, type LoadEntry, type Vec } from './grasp';
import { symbol } from './plot';
import type { SpatialModel } from './space';
import type { PlanarModel } from './state';
import { node } from './svg';
import { length, unit } from './turn';
import { gripText, type Measure } from './measure';
import { degrees, fixed, newtons, percent } from './words';

type AnyHeld = Extract<AnyHold, { holdable: true }>;
type Attributes = Record<string, string>;

export function html<Name extends keyof HTMLElementTagNameMap>(
  name: Name,
  attributes: Attributes = {},
  ...children: (Node | string)[]
): HTMLElementTagNameMap[Name] {
  const element = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  element.append(...children);
  return element;
}

/** A number that follows the model, except while someone types it. */
class NumberField {
  readonly element: HTMLInputElement;
  constructor(
    label: string,
    kind: 'number' | 'range',
    attributes: Attributes,
    private readonly read: () => number | undefined,
    write: (value: number | undefined) => void,
  ) {
    this.element = html('input', { type: kind, 'aria-label': label, ...attributes });
    this.element.addEventListener('input', () => {
      const { value, valueAsNumber, validity } = this.element;
      if (validity.badInput) return;  // not yet a number, such as 1e
      if (value === '' || Number.isFinite(valueAsNumber)) write(value === '' ? undefined : valueAsNumber);
    });
    this.element.addEventListener('blur', () => this.show(true));
  }
  show(always = false): void {
    if (!always && this.element === document.activeElement && this.element.type === 'number') return;
    const value = this.read();
    // What rounding leaves of 0 is shown as 0.
    this.element.value = value === undefined ? '' : String(Math.abs(value) < 1e-12 ? 0 : Number(value.toPrecision(6)));
  }
}

/** What controls need of a model, in the plane and in space. */
interface Held {
  grasp: { name?: string; contacts: Contact<unknown>[] };
  answers: { check: { contacts: { finger: string }[] }; hold: AnyHold };
  frame: { radius: number };
  edit(change: () => void): void;
}

/** A tenth of a number, about. */
const stepOf = (size: number) => String(10 ** Math.floor(Math.log10(size) - 1));

abstract class Controls<Model extends Held> {
  protected fields: NumberField[] = [];
  private forces: HTMLElement[] = [];
  private shown = '';
  constructor(
    private readonly parent: HTMLElement,
    protected readonly model: Model,
  ) {}

  protected abstract rows(): HTMLElement[];
  protected abstract soft: boolean;
  protected abstract heaviest(): number;

  /** Another grasp is shown. */
  forget(): void {
    this.shown = '';
  }

  draw(): void {
    const { contacts, name } = this.model.grasp;
    const built = `${contacts.length} ${name}`;
    if (built !== this.shown) this.build();
    this.shown = built;
    for (const field of this.fields) field.show();
    const { hold } = this.model.answers;
    this.forces.forEach((cell, i) => {
      const force = hold.holdable ? hold.contacts[i] : undefined;
      cell.textContent = force ? newtons(force.state === 'unloaded' ? 0 : force.normal_force) : '–';
      const used = this.forces[i]!.nextElementSibling!;
      used.textContent = force ? (force.state === 'unloaded' ? 'unloaded' : percent(force.friction_used)) : '–';
      used.classList.toggle('at-limit', force?.state === 'slipping');
      cell.classList.toggle('at-limit', !!force && force.limit !== 'none' && force.state !== 'unloaded');
    });
  }

  private build(): void {
    this.fields = [];
    this.forces = [];
    this.parent.replaceChildren(html('div', { class: 'rows' }, ...this.rows()), this.contactTable());
  }

  protected field(...parameters: ConstructorParameters<typeof NumberField>): HTMLInputElement {
    const field = new NumberField(...parameters);
    this.fields.push(field);
    return field.element;
  }

  protected weight(of: string, object: () => { weight: number } | undefined): HTMLElement {
    const now = object()!.weight;
    const write = given((value) => this.model.edit(() => void (object()!.weight = value)));
    const read = () => object()?.weight;
    const most = String(Number((3 * now).toPrecision(2)));
    const step = stepOf(now);
    return html('label', {}, `Weight${of}`,
      this.field(`Weight${of}, slider [N]`, 'range', { min: step, max: most, step: 'any' }, read, write),
      this.field(`Weight${of} [N]`, 'number', { step, min: '0' }, read, write), 'N');
  }

  protected centre(of: string, size: number, object: () => { com: readonly number[] } | undefined): HTMLElement {
    const step = String(10 ** Math.floor(Math.log10(size) - 2));
    const part = (axis: string, k: number) =>
      this.field(`Centre of mass${of}, ${axis} [m]`, 'number', { step }, () => object()?.com[k],
        given((value) => this.model.edit(() => void (object()!.com = object()!.com.map((old, i) => (i === k ? value : old))))));
    const axes = ['x', 'y', 'z'].slice(0, object()!.com.length);
    return html('label', {}, of ? `Its com${of}` : 'Centre of mass', html('span', { class: 'pair' }, ...axes.map(part)), 'm');
  }

  /** The force of what pushes the object. */
  protected push(axes: string[]): HTMLElement {
    const grasp = () => this.model.grasp as unknown as { object: { com: Vec }; loads?: LoadEntry<Vec>[] };
    const now = () => pushOf(grasp()) ?? axes.map(() => 0);
    const step = stepOf(this.heaviest() || 1);
    const part = (axis: string, k: number) =>
      this.field(`Push, ${axis} [N]`, 'number', { step }, () => now()[k],
        given((value) => this.model.edit(() => push(grasp(), now().map((old, i) => (i === k ? value : old)) as unknown as Vec))));
    return html('label', {}, 'Push', html('span', { class: 'pair' }, ...axes.map(part)), 'N');
  }

  private contactTable(): HTMLElement {
    const { model, soft } = this;
    const limits = model.grasp.contacts.map((each) => each.max_normal ?? 0);
    const most = Number((3 * Math.max(this.heaviest(), ...limits)).toPrecision(2));
    const wide = Number((0.2 * model.frame.radius).toPrecision(2));
    const rows = model.grasp.contacts.map((contact, i) => {
      // A field that loses the focus because it vanishes is asked once more.
      const of = () => model.grasp.contacts[i];
      const finger = model.answers.check.contacts[i]!.finger;
      const named = `${finger}${contact.finger ? '' : ` (contact ${i})`}`;
      /** A number, which may be left out for `none`, and a slider, at whose end that is. */
      const cell = (words: string, unit: string, key: 'friction' | 'torsion' | 'min_normal' | 'max_normal', max: number, step: string, none?: number) => {
        const write = (value: number | undefined) =>
          model.edit(() => {
            const each: Partial<Contact<unknown>> = model.grasp.contacts[i]!;
            if (value !== undefined) each[key] = value;
            else if (none !== undefined) delete each[key];
          });
        const read = () => of()?.[key];
        const label = `${words} of ${named}`;
        const placeholder: Attributes = none === undefined ? {} : { placeholder: none ? '∞' : '0' };
        return html('td', {},
          this.field(`${label}${unit}`, 'number', { min: '0', step, ...placeholder }, read, write),
          this.field(`${label}, slider${unit}`, 'range', { min: '0', max: String(max), step: none === undefined ? step : 'any' },
            () => read() ?? none, (value) => write(value === none ? undefined : value)));
      };
      const force = html('td', { class: 'number' });
      this.forces.push(force);
      return html('tr', {},
        html('th', { scope: 'row', title: finger }, finger),
        cell('Friction', '', 'friction', 2, '0.01'),
        ...(soft ? [cell('Torsion', ' [m]', 'torsion', wide, stepOf(wide), 0)] : []),
        cell('Least normal force', ' [N]', 'min_normal', most, stepOf(most), 0),
        cell('Greatest normal force', ' [N]', 'max_normal', most, stepOf(most), most),
        force,
        html('td', { class: 'number' }),
      );
    });
    const heads = ['finger', 'friction μ', ...(soft ? ['torsion [m]'] : []), 'least [N]', 'most [N]', 'normal', 'used'];
    // Where there is no room for the heads, each cell says its own.
    for (const row of rows) [...row.children].forEach((cell, k) => cell.setAttribute('data-head', heads[k]!));
    return html('div', { class: 'scroll' },
      html('table', { class: soft ? 'soft' : '' },
        html('thead', {}, html('tr', {}, ...heads.map((head) => html('th', { scope: 'col' }, head)))),
        html('tbody', {}, ...rows)));
  }
}

/** An empty field leaves things as they are. */
const given = (write: (value: number) => void) => (value: number | undefined) => {
  if (value !== undefined) write(value);
};

export class PlanarControls extends Controls<PlanarModel> {
  protected soft = false;
  protected heaviest = () => this.model.grasp.object.weight;

  protected rows(): HTMLElement[] {
    const { model } = this;
    const object = () => model.grasp.object;
    const turn = given((value) => model.turnTo(value));
    return [
      html('label', {}, 'Posture',
        this.field('Posture, slider [degrees]', 'range', { min: '-180', max: '180', step: 'any' }, () => model.angle, turn),
        this.field('Posture [degrees]', 'number', { step: '1' }, () => model.angle, turn), '°'),
      this.weight('', object),
      this.centre('', model.frame.radius, object as () => { com: readonly number[] }),
      this.push(['x', 'y']),
    ];
  }
}

export class SpatialControls extends Controls<SpatialModel> {
  protected soft = true;
  protected heaviest = () => Math.max(...massesOf(this.model.grasp).map(({ weight }) => weight));

  protected rows(): HTMLElement[] {
    const { model } = this;
    const masses = ownMassesOf(model.grasp);
    const part = (axis: string, k: number) =>
      this.field(`Up, ${axis}`, 'number', { step: '0.1', min: '-1', max: '1' }, () => model.up[k], given((value) => {
        const to = model.up.map((old, i) => (i === k ? value : old)) as unknown as Vec;
        if (length(to) > 0) model.turnTo(unit(to));
      }));
    return [
      html('label', {}, 'Up', html('span', { class: 'pair' }, ...['x', 'y', 'z'].map(part))),
      ...masses.map(({ name }, k) => {
        const mass = () => ownMassesOf(model.grasp)[k];
        const of = masses.length > 1 ? ` ${name}` : '';
        return [this.weight(of, mass), this.centre(of, model.frame.radius, mass as () => { com: readonly number[] } | undefined)];
      }).flat(),
      this.push(['x', 'y', 'z']),
    ];
  }
}

/** The minima, each to be gone to: most important first. */
function buttons(parent: HTMLElement, measure: Measure, unit: GripUnit | null, rows: { kind: Kind; first: string; hold: AnyHeld; what: string; role: string; here: boolean; go: () => void; data: Attributes }[]): void {
  const focused = [...parent.querySelectorAll('button')].indexOf(document.activeElement as HTMLButtonElement);
  parent.replaceChildren(
    ...rows.slice(0, 8).map(({ kind, first, hold, what, role, here, go, data }) => {
      const mark = node('svg', { viewBox: '-8 -8 16 16', class: 'mark', 'aria-hidden': 'true' }, node('path', { d: symbol(kind, [0, 0]) }));
      const button = html('button', { type: 'button', ...data, 'data-value': String(measure.objective === 'grip' ? hold.grip : hold.effort) },
        mark,
        html('span', { class: 'angle' }, first),
        html('span', { class: 'force' }, measure.text(measure.of(hold))),
        html('span', { class: 'also' }, measure.objective === 'grip' ? `√V ${newtons(hold.force_norm)}` : `grip ${gripText(hold.grip, unit)}`),
        html('span', { class: 'what' }, what),
        html('strong', {}, role));
      if (here) button.setAttribute('aria-current', 'true');
      button.addEventListener('click', go);
      return button;
    }),
  );
  parent.querySelectorAll('button')[focused]?.focus();
}

export function drawMinima(parent: HTMLElement, model: PlanarModel): void {
  const { curve, best, measure, gripUnit } = model.answers;
  const here = model.optimum();
  parent.classList.remove('late', 'space');
  parent.removeAttribute('aria-busy');
  buttons(parent, measure, gripUnit, curve.optima.filter((each) => each.type === 'min').map((each) => ({
    kind: each.kind,
    first: degrees(each.angle_deg),
    hold: each,
    what: `${each.manner}, ${each.kind}`,
    role: each.angle_deg === best.best?.angle_deg ? 'best' : each.angle_deg === best.best_pinched?.angle_deg ? 'best pinched' : '',
    here: here === each,
    go: () => model.turnTo(each.angle_deg),
    data: { 'data-angle': String(each.angle_deg) },
  })));
}

export function drawSpatialMinima(parent: HTMLElement, model: SpatialModel): void {
  const { best } = model.found;
  parent.classList.toggle('late', model.outdated);
  parent.setAttribute('aria-busy', String(model.outdated));
  parent.classList.add('space');
  buttons(parent, model.answers.measure, model.answers.gripUnit, (best?.minima ?? []).map((each, k) => ({
    kind: 'smooth' as const,
    first: `(${each.up.map((part) => fixed(part, 3)).join(', ')})`,
    hold: each,
    what: `${each.manner}${each.load === undefined ? '' : `, against ${model.nameOf(each.load)}`}`,
    role: k === 0 ? 'best' : String(each.up) === String(best!.best_pinched?.up) ? 'best pinched' : '',
    here: model.minimum(model.up) === each,
    go: () => model.turnTo(each.up),
    data: { 'data-up': each.up.join() },
  })));
}

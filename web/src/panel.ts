// Numbers to type and to slide, and tables of what they lead to.
import type { Contact } from './grasp';
import { symbol } from './plot';
import type { Model } from './state';
import { node } from './svg';
import { degrees, newtons, percent, plain } from './words';

type Attributes = Record<string, string>;

function html<Name extends keyof HTMLElementTagNameMap>(
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
      const { value, valueAsNumber } = this.element;
      if (value === '' || Number.isFinite(valueAsNumber)) write(value === '' ? undefined : valueAsNumber);
    });
    this.element.addEventListener('blur', () => this.show(true));
  }
  show(always = false): void {
    if (!always && this.element === document.activeElement && this.element.type === 'number') return;
    const value = this.read();
    this.element.value = value === undefined ? '' : String(Number(value.toPrecision(6)));
  }
}

export class Controls {
  private fields: NumberField[] = [];
  private forces: HTMLElement[] = [];
  private shown = '';
  constructor(
    private readonly parent: HTMLElement,
    private readonly model: Model,
  ) {}

  draw(): void {
    const { contacts, name } = this.model.grasp;
    const built = `${contacts.length} ${name}`;
    if (built !== this.shown) this.build();
    this.shown = built;
    for (const field of this.fields) field.show();
    const { hold } = this.model.answers;
    this.forces.forEach((cell, i) => {
      const force = hold.holdable ? hold.contacts[i] : undefined;
      cell.textContent = force ? newtons(force.normal_force) : '–';
      const used = this.forces[i]!.nextElementSibling!;
      used.textContent = force ? (force.state === 'unloaded' ? 'unloaded' : percent(force.friction_used)) : '–';
      used.classList.toggle('at-limit', force?.state === 'slipping');
      cell.classList.toggle('at-limit', !!force && force.limit !== 'none' && force.state !== 'unloaded');
    });
  }

  private field(...parameters: ConstructorParameters<typeof NumberField>): HTMLInputElement {
    const field = new NumberField(...parameters);
    this.fields.push(field);
    return field.element;
  }

  private build(): void {
    this.fields = [];
    this.forces = [];
    const { model } = this;
    const { weight } = model.grasp.object;
    const object = () => model.grasp.object;
    const number = (write: (value: number) => void) => (value: number | undefined) => {
      if (value !== undefined) write(value);
    };
    const setWeight = number((value) => model.edit((grasp) => void (grasp.object.weight = value)));
    const setAngle = number((value) => model.turnTo(value));
    const setCom = (k: 0 | 1) =>
      number((value) =>
        model.edit(({ object }) => {
          object.com = k === 0 ? [value, object.com[1]] : [object.com[0], value];
        }),
      );
    const most = String(Number((3 * weight).toPrecision(2)));
    const step = String(10 ** Math.floor(Math.log10(weight) - 1));
    const place = String(10 ** Math.floor(Math.log10(model.frame.radius) - 2));
    this.parent.replaceChildren(
      html('div', { class: 'rows' },
        html('label', {}, 'Posture',
          this.field('Posture, slider [degrees]', 'range', { min: '-180', max: '180', step: 'any' }, () => model.angle, setAngle),
          this.field('Posture [degrees]', 'number', { step: '1' }, () => model.angle, setAngle), '°'),
        html('label', {}, 'Weight',
          this.field('Weight, slider [N]', 'range', { min: step, max: most, step: 'any' }, () => object().weight, setWeight),
          this.field('Weight [N]', 'number', { step, min: '0' }, () => object().weight, setWeight), 'N'),
        html('label', {}, 'Centre of mass',
          html('span', { class: 'pair' },
            this.field('Centre of mass, x [m]', 'number', { step: place }, () => object().com[0], setCom(0)),
            this.field('Centre of mass, y [m]', 'number', { step: place }, () => object().com[1], setCom(1))), 'm'),
      ),
      this.contactTable(),
    );
  }

  private contactTable(): HTMLElement {
    const { model } = this;
    const rows = model.grasp.contacts.map((given, i) => {
      // A field that loses the focus because it vanishes is asked once more.
      const of = (): Contact | undefined => model.grasp.contacts[i];
      const finger = model.answers.check.contacts[i]!.finger;
      const named = `${finger}${given.finger ? '' : ` (contact ${i})`}`;
      const change = (write: (contact: Contact) => void) => model.edit(({ contacts }) => write(contacts[i]!));
      const friction = (value: number | undefined) => {
        if (value !== undefined) change((contact) => void (contact.friction = value));
      };
      const limit = (key: 'min_normal' | 'max_normal') => (value: number | undefined) =>
        change((contact) => {
          if (value === undefined) delete contact[key];
          else contact[key] = value;
        });
      const force = html('td', { class: 'number' });
      this.forces.push(force);
      return html('tr', {},
        html('th', { scope: 'row' }, finger),
        html('td', {},
          this.field(`Friction of ${named}, slider`, 'range', { min: '0', max: '2', step: '0.01' }, () => of()?.friction, friction),
          this.field(`Friction of ${named}`, 'number', { min: '0', step: '0.01' }, () => of()?.friction, friction)),
        html('td', {}, this.field(`Least normal force of ${named} [N]`, 'number', { min: '0', step: 'any', placeholder: '0' }, () => of()?.min_normal, limit('min_normal'))),
        html('td', {}, this.field(`Greatest normal force of ${named} [N]`, 'number', { min: '0', step: 'any', placeholder: '∞' }, () => of()?.max_normal, limit('max_normal'))),
        force,
        html('td', { class: 'number' }),
      );
    });
    const heads = ['finger', 'friction μ', 'least [N]', 'most [N]', 'normal', 'used'];
    return html('div', { class: 'scroll' },
      html('table', {},
        html('thead', {}, html('tr', {}, ...heads.map((head) => html('th', { scope: 'col' }, head)))),
        html('tbody', {}, ...rows)));
  }
}

/** The minima, each to be gone to. */
export function drawMinima(parent: HTMLElement, model: Model): void {
  const { curve, best } = model.answers;
  const minima = curve.optima.filter((each) => each.type === 'min');
  const focused = [...parent.querySelectorAll('button')].indexOf(document.activeElement as HTMLButtonElement);
  const here = model.optimum();
  parent.replaceChildren(
    ...minima.slice(0, 8).map((each) => {
      const mark = node('svg', { viewBox: '-8 -8 16 16', class: 'mark', 'aria-hidden': 'true' }, node('path', { d: symbol(each.kind, [0, 0]) }));
      const role =
        each.angle_deg === best.best?.angle_deg ? 'best' : each.angle_deg === best.best_pinched?.angle_deg ? 'best pinched' : '';
      const button = html('button', { type: 'button', 'data-angle': String(each.angle_deg), 'data-effort': String(each.effort) },
        mark,
        html('span', { class: 'angle' }, degrees(each.angle_deg)),
        html('span', { class: 'force' }, `${plain(each.force_norm)} N`),
        html('span', { class: 'grip' }, `grip ${newtons(each.grip_force)}`),
        html('span', { class: 'what' }, `${each.manner}, ${each.kind}`),
        html('strong', {}, role));
      if (here === each) button.setAttribute('aria-current', 'true');
      button.addEventListener('click', () => model.turnTo(each.angle_deg));
      return button;
    }),
  );
  parent.querySelectorAll('button')[focused]?.focus();
}

// Why the object is held as it is, in words that come from the answer alone.
import { turningForce, type AnyHold, type Held, type Margins, type Optimum, type Shaken, type SpatialBest } from './core';
import { contains, slope } from './curve';
import type { Point, Vec } from './grasp';
import type { SpatialModel } from './space';
import type { PlanarAnswers } from './state';
import { add, angle as between, cross, dot, length, minus, times } from './turn';
import { radians } from './vector';
import { degrees, fixed, list, newtons, percent, plain, turn, wrapped } from './words';

type AnyHeld = Extract<AnyHold, { holdable: true }>;
type Contacts = { finger: string }[];

const name = (contacts: Contacts, i: number) => {
  const { finger } = contacts[i]!;
  if (finger === String(i)) return `contact ${i}`;
  return contacts.filter((each) => each.finger === finger).length > 1 ? `${finger} (contact ${i})` : finger;
};

/** Paragraphs. */
export function why(answers: PlanarAnswers, margins: Margins | undefined, angle: number, optimum: Optimum | undefined): string[] {
  const { hold, curve, best } = answers;
  if (!hold.holdable) {
    const said = [`${sentence(hold.reason)}`];
    const ends = curve.holdable_arcs_deg.flat().sort((a, b) => Math.abs(wrapped(a - angle)) - Math.abs(wrapped(b - angle)));
    if (ends[0] !== undefined) said.push(`Turned by ${turn(angle, ends[0])} it can be held.`);
    else if (!best.best) said.push('No other posture can be held either.');
    return said;
  }
  return [contactsInWords(answers.check.contacts, hold), further(answers, angle, hold, optimum), compared(answers, angle), margins ? stillHolds(margins) : ''].filter(Boolean);
}

function contactsInWords(contacts: Contacts, hold: AnyHeld): string {
  const named = (test: (each: AnyHeld['contacts'][number]) => boolean) =>
    hold.contacts.flatMap((each, i) => (test(each) ? [name(contacts, i)] : []));
  const slipping = named((each) => each.state === 'slipping');
  const unloaded = named((each) => each.state === 'unloaded');
  const least = named((each) => each.limit === 'min' && each.state !== 'unloaded');
  const most = named((each) => each.limit === 'max');
  const all = (names: string[]) => (names.length > 6 ? `${names.length} of ${contacts.length} contacts` : list(names));
  const verb = (names: string[], one: string, more: string) => `${all(names)} ${names.length > 1 ? more : one}`;
  const parts: string[] = [];
  if (slipping.length) parts.push(`${verb(slipping, 'uses all its friction, at the edge of its cone', 'use all their friction, at the edges of their cones')}`);
  if (most.length) parts.push(`${verb(most, 'presses', 'press')} with the greatest force allowed`);
  if (least.length) parts.push(`${verb(least, 'presses', 'press')} with the least force allowed`);
  if (unloaded.length) parts.push(`${verb(unloaded, 'carries', 'carry')} nothing`);
  if (!slipping.length) {
    const loaded = hold.contacts.filter((each) => each.state !== 'unloaded');
    const used = Math.max(0, ...loaded.map((each) => each.friction_used));
    parts.push(used < 1e-9 ? 'no friction is needed' : `no contact uses more than ${percent(used)} of its friction`);
  }
  const manner = {
    resting: 'It rests on what carries it',
    cradled: 'It would be held without any friction',
    pinched: 'The fingers squeeze it, so that friction carries the weight',
  }[hold.manner];
  return `${manner}: ${parts.join('; ')}.`;
}

/** How much more the posture would hold. */
function stillHolds({ weight, holdable, greatest_weight, friction_factor }: Margins): string {
  if (!holdable || friction_factor === null || friction_factor > 1) return '';
  const friction = friction_factor < 1e-3 ? 'with nearly no friction' : `with no less than ${percent(friction_factor)} of the friction`;
  if (greatest_weight === null) return `Pressing harder, the fingers would hold this weight ${friction}, and a heavier object with forces that grow with its weight.`;
  return `In this posture the fingers still hold up to ${newtons(greatest_weight)} (${plain(greatest_weight / weight)} times the weight), and, pressing harder, this weight ${friction}.`;
}

/** What the posture withstands, within the limits of contacts and drives. */
export function withstands({ acceleration, direction, tilt_deg, proven }: Shaken): string {
  const most = proven ? '' : 'at least ';
  const along = direction.map((part) => fixed(part, 2)).join(', ');
  const shake = acceleration === null ? 'any acceleration' : `${most}${plain(acceleration)} m/s² in any direction, weakest along (${along})`;
  return `Pressing harder, it withstands ${shake}, and ${tilt_deg === 180 ? 'any tilt' : `a tilt of ${most}${degrees(tilt_deg)}`}.`;
}

const leftOut = ({ best, check }: PlanarAnswers, angle: number) =>
  best.options.domain === 'pinching-up' && check.fork_deg !== null && contains(check.fork_deg, angle);

function further(answers: PlanarAnswers, angle: number, hold: Held<Point>, optimum: Optimum | undefined): string {
  const { measure } = answers;
  const said = (side: 1 | -1) => {
    const way = side > 0 ? 'counter-clockwise' : 'clockwise';
    const by = slope(answers.curve, angle, side);
    if (by === undefined && leftOut(answers, angle + 0.01 * side)) return `${way} the postures are in the fork of the fingers, and left out`;
    if (by === undefined) return `turned further ${way} it cannot be held`;
    if (Math.abs(by) < Math.max(1e-6 * measure.of(hold), 5e-10)) return `${way} the ${measure.name} stays level at first`;
    return `${way} it ${by > 0 ? 'rises' : 'falls'} by ${measure.text(Math.abs(by))} per degree`;
  };
  const both = `Turned on, ${said(1)}, and ${said(-1)}.`.replace('Turned on, turned further', 'Turned further');
  if (optimum?.type === 'min' && optimum.kind === 'kink' && optimum.from_deg === undefined)
    return optimum.edges_meet
      ? `Here the edges of the two friction cones meet on the vertical through the centre of mass: a kink, the ${measure.name} rises both ways. ${both}`
      : `A kink: here ${measure.objective === 'grip' ? 'another drive or contact decides' : 'a contact changes what it does'}, and the ${measure.name} rises both ways. ${both}`;
  if (optimum?.type === 'min' && optimum.kind === 'smooth')
    return 'A smooth minimum: a small turn either way costs next to nothing.';
  return both.replace('counter-clockwise it', `counter-clockwise the ${measure.name}`);
}

function compared(answers: PlanarAnswers, angle: number): string {
  const { best, best_pinched } = answers.best;
  const { hold } = answers;
  if (!best || !hold.holdable) return '';
  const same = (each: Optimum) => Math.abs(wrapped(each.angle_deg - angle)) < 1e-7;
  const { measure } = answers;
  const least = (each: Optimum) => `${measure.text(measure.of(each))} at ${degrees(each.angle_deg)}`;
  const domain = answers.best.options.domain === 'all' ? '' : ' outside the fork of the fingers';
  const parts = same(best) ? [`No posture${domain} needs less.`] : [`Least${domain || ' of all'}: ${least(best)}, ${best.manner}.`];
  if (best_pinched && best_pinched.angle_deg !== best.angle_deg)
    parts.push(same(best_pinched) ? 'Of the pinched postures none needs less.' : `Least pinched: ${least(best_pinched)}.`);
  return parts.join(' ');
}

const sentence = (words: string) => `${words.charAt(0).toUpperCase()}${words.slice(1)}${words.endsWith('.') ? '' : '.'}`;

/** The same in space, where the best posture may still be looked for. */
export function whyInSpace(model: SpatialModel, margins: Margins | undefined): string[] {
  const { check, hold } = model.answers;
  const best = model.outdated ? undefined : model.found.best;
  const of = hold.load === undefined ? '' : `Against ${model.nameOf(hold.load)}, which decides: `;
  if (!hold.holdable) {
    const said = [`${of}${of ? hold.reason : sentence(hold.reason)}`];
    if (best?.status === 'unholdable') said.push(`No ${allowed(model)} posture can be held, which is proven.`);
    return said;
  }
  const contacts = contactsInWords(check.contacts, hold);
  return [of ? of + contacts.charAt(0).toLowerCase() + contacts.slice(1) : contacts, steepest(model, hold, margins), best ? comparedInSpace(model, best) : '', margins ? stillHolds(margins) : ''].filter(Boolean);
}

const allowed = ({ answers }: SpatialModel) => (answers.check.tilt ? 'allowed' : 'other');

/** V changes with the posture as the load does, by twice the velocity of the com under y. The grip may
 * have a kink, where y is one of many. */
function steepest(model: SpatialModel, hold: Held<Vec>, margins: Margins | undefined): string {
  const { measure } = model.answers;
  if (model.minimum(hold.up)) return 'A local minimum: no small turn needs less.';
  if (measure.objective === 'grip') return margins?.slopes?.length ? amongSlopes(margins.slopes, measure.of(hold), measure.text) : '';
  const v = hold.dual!.slice(0, 3) as unknown as Vec;
  const w = hold.dual!.slice(3) as unknown as Vec;
  const { com } = model.deciding;
  const gradient = times(turningForce(model.deciding) / hold.force_norm, add(v, cross(w, com)));
  const across = minus(gradient, times(dot(gradient, hold.up), hold.up));
  const perDegree = length(across) * radians(1);
  if (perDegree < 1e-6 * hold.force_norm) return 'A small turn changes next to nothing.';
  return changes(measure.name, newtons(perDegree));
}

const changes = (name: string, most: string) => `Turned on, the ${name} changes by up to ${most} per degree; a turn about the vertical changes nothing.`;

function amongSlopes(slopes: number[], grip: number, text: (shown: number) => string): string {
  const [least, most] = [Math.min(...slopes), Math.max(...slopes)];
  const little = Math.max(1e-4 * grip, 5e-10);
  if (least > little) return `A kink: whatever the turn, the grip rises, by ${text(least)} per degree and more.`;
  if (most < -little) return `A kink: whatever the turn, the grip falls, by ${text(-most)} per degree and more.`;
  const greatest = Math.max(most, -least);
  return greatest < little ? 'A small turn changes next to nothing.' : changes('grip', text(greatest));
}

function comparedInSpace(model: SpatialModel, { best, best_pinched, status, relative_gap, holds }: SpatialBest): string {
  if (!best) return '';
  const here = (each: Held<Vec>) => model.minimum(model.up)?.up.join() === each.up.join();
  const { measure } = model.answers;
  const away = (each: Held<Vec>) => `${measure.text(measure.of(each))}, ${degrees((between(each.up, model.up) * 180) / Math.PI)} from here`;
  const parts = here(best) ? [`No ${allowed(model)} posture needs less`] : [`Least of all: ${away(best)}, ${best.manner}`];
  parts[0] += status === 'optimal' ? ` (proven by ${holds} holds).` : `, as far as ${holds} holds can tell: to ${percent(relative_gap!)} of the ${measure.objective}.`;
  if (best_pinched && String(best_pinched.up) !== String(best.up))
    parts.push(here(best_pinched) ? 'Of the pinched postures none that was found needs less.' : `Least pinched: ${away(best_pinched)}.`);
  return parts.join(' ');
}

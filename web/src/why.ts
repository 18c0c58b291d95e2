// Why the object is held as it is, in words that come from the answer alone.
import type { Held, Optimum } from './core';
import { contains, slope } from './curve';
import type { Answers } from './state';
import { degrees, list, newtons, percent, plain, turn, wrapped } from './words';

const name = (answers: Answers, i: number) => {
  const { contacts } = answers.check;
  const { finger } = contacts[i]!;
  if (finger === String(i)) return `contact ${i}`;
  return contacts.filter((each) => each.finger === finger).length > 1 ? `${finger} (contact ${i})` : finger;
};

/** Paragraphs. */
export function why(answers: Answers, angle: number, optimum: Optimum | undefined): string[] {
  const { hold, curve, best } = answers;
  if (!hold.holdable) {
    const said = [`${sentence(hold.reason)}`];
    const ends = curve.holdable_arcs_deg.flat().sort((a, b) => Math.abs(wrapped(a - angle)) - Math.abs(wrapped(b - angle)));
    if (ends[0] !== undefined) said.push(`Turned by ${turn(angle, ends[0])} it can be held.`);
    else if (!best.best) said.push('No other posture can be held either.');
    return said;
  }
  return [contactsInWords(answers, hold), further(answers, angle, hold, optimum), compared(answers, angle)].filter(Boolean);
}

function contactsInWords(answers: Answers, hold: Held): string {
  const named = (test: (each: Held['contacts'][number]) => boolean) =>
    hold.contacts.flatMap((each, i) => (test(each) ? [name(answers, i)] : []));
  const slipping = named((each) => each.state === 'slipping');
  const unloaded = named((each) => each.state === 'unloaded');
  const least = named((each) => each.limit === 'min' && each.state !== 'unloaded');
  const most = named((each) => each.limit === 'max');
  const verb = (names: string[], one: string, more: string) => `${list(names)} ${names.length > 1 ? more : one}`;
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
    cradled: 'It lies in the fork of the fingers',
    pinched: 'The fingers squeeze it, so that friction carries the weight',
  }[hold.manner];
  return `${manner}: ${parts.join('; ')}.`;
}

const leftOut = ({ best, check }: Answers, angle: number) =>
  best.options.domain === 'pinched' && check.cradled_deg !== null && contains(check.cradled_deg, angle);

function further(answers: Answers, angle: number, hold: Held, optimum: Optimum | undefined): string {
  // In newtons of force norm per degree: d sqrt(V) = dV / (2 sqrt(V)).
  const change = (side: 1 | -1) => {
    const effort = slope(answers.curve, angle, side);
    return effort === undefined ? undefined : effort / (2 * Math.sqrt(hold.effort));
  };
  const said = (side: 1 | -1) => {
    const way = side > 0 ? 'counter-clockwise' : 'clockwise';
    const by = change(side);
    if (by === undefined && leftOut(answers, angle + 0.01 * side)) return `${way} the postures are cradled, and left out`;
    if (by === undefined) return `turned further ${way} it cannot be held`;
    if (Math.abs(by) < 1e-6 * hold.force_norm) return `${way} the force norm stays level at first`;
    return `${way} it ${by > 0 ? 'rises' : 'falls'} by ${newtons(Math.abs(by))} per degree`;
  };
  const both = `Turned on, ${said(1)}, and ${said(-1)}.`.replace('Turned on, turned further', 'Turned further');
  if (optimum?.type === 'min' && optimum.kind === 'kink')
    return optimum.edges_meet
      ? `Here the edges of the two friction cones meet on the vertical through the centre of mass: a kink, the force norm rises both ways. ${both}`
      : `A kink: here a contact changes what it does, and the force norm rises both ways. ${both}`;
  if (optimum?.type === 'min' && optimum.kind === 'smooth')
    return 'A smooth minimum: a small turn either way costs next to nothing.';
  return both.replace('counter-clockwise it', 'counter-clockwise the force norm');
}

function compared(answers: Answers, angle: number): string {
  const { best, best_pinched } = answers.best;
  const { hold } = answers;
  if (!best || !hold.holdable) return '';
  const same = (each: Optimum) => Math.abs(wrapped(each.angle_deg - angle)) < 1e-7;
  const least = (each: Optimum) => `${plain(each.force_norm)} N at ${degrees(each.angle_deg)}`;
  const domain = answers.best.options.domain === 'all' ? '' : ' outside the cradled range';
  const parts = same(best) ? [`No posture${domain} needs less.`] : [`Least${domain || ' of all'}: ${least(best)}, ${best.manner}.`];
  if (best_pinched && best_pinched.angle_deg !== best.angle_deg)
    parts.push(same(best_pinched) ? 'Of the pinched postures none needs less.' : `Least pinched: ${least(best_pinched)}.`);
  return parts.join(' ');
}

const sentence = (words: string) => `${words.charAt(0).toUpperCase()}${words.slice(1)}${words.endsWith('.') ? '' : '.'}`;

import './style.css';
import { size, text as packed } from 'virtual:core';
import { BodyView } from './body';
import { BadGrasp, read, start, type AnyHold, type GripUnit, type Margins, type Objective, type Shaken } from './core';
import { asPng, asSvg, fileName, fromLink, keep, toLink, yaml, type Picture } from './files';
import type { Grasp, PlanarGrasp, SpatialGrasp, Vec } from './grasp';
import { unpacked } from './lzma';
import { gripText, type Measure } from './measure';
import type { Triangles } from './mesh';
import { drawMinima, drawSpatialMinima, html, PlanarControls, SpatialControls } from './panel';
import { asPaper } from './paper';
import { Player } from './player';
import { Plot } from './plot';
import { first, presets, type Preset } from './presets';
import { Scene } from './scene';
import { SpatialModel } from './space';
import { SphereView } from './sphere';
import { PlanarModel } from './state';
import { angle } from './turn';
import { degrees, fixed, newtons, plain, wrapped } from './words';
import { why, whyInSpace, withstands } from './why';

const find = <Kind extends HTMLElement>(id: string) => document.getElementById(id) as Kind;

/** A plain loop is done in no time, which the first picture waits for. */
function bytesOf(base64: string): Uint8Array {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let k = 0; k < text.length; ++k) bytes[k] = text.charCodeAt(k);
  return bytes;
}
const wasm = unpacked(bytesOf(packed), size).buffer;
await start(wasm);

/** A posture as results tell it: in the plane by its angle, too. */
interface Told {
  up: readonly number[];
  angle_deg?: number;
}

/** A grasp in the plane, or in space: its model, its views. */
interface Sheet<Kind extends Grasp> {
  /** @throws BadGrasp, and nothing changes. */
  load(grasp: Kind, mesh?: Triangles): void;
  draw(): void;
  /** The grasp as it is shown, in its posture. */
  current(): Kind;
  pictures(): Picture[];
  turnTo(posture: Told): void;
  gripUnit(): GripUnit | null;
  minimise(objective: Objective): void;
  holdAt(posture: Told, objective: Objective): AnyHold;
}

const objectives = [...document.querySelectorAll<HTMLInputElement>('[name=objective]')];
for (const each of objectives)
  each.addEventListener('change', () => {
    try {
      sheet?.minimise(each.value as Objective);
    } catch (error) {
      if (!(error instanceof BadGrasp)) throw error;
      say(error.message, true);
    }
  });

/** What is least, wherever it is said. */
function drawObjective({ objective }: Measure, unit: GripUnit | null): void {
  for (const each of objectives) {
    each.checked = each.value === objective;
    each.disabled = each.value === 'grip' && unit === null;
  }
  find('no-grip').hidden = unit !== null;
  find('least').textContent = objective === 'grip' ? 'Least grip' : 'Least force norm';
}

/** What is said of a file or a link, until something else is done. */
let notice = { text: '', bad: false };

/** Words that a screen reader says when they change, and only then: in paragraphs, or in one. */
function tell(element: HTMLElement, words: string[], kind: 'p' | 'span'): void {
  const between = kind === 'p' ? '' : ' ';
  if (element.textContent !== words.join(between))
    element.replaceChildren(...words.flatMap((each, k) => [k ? between : '', html(kind, {}, each)]));
}

function drawWords(plays: boolean, at: string, hold: AnyHold, { objective }: Measure, unit: GripUnit | null, reasons: string[], problem: string, warnings: string[]): void {
  // No line ends between a number and its unit.
  const needs = (held: Extract<AnyHold, { holdable: true }>) => {
    const grip = `grip ${gripText(held.grip, unit)}`;
    const effort = [`force norm √V ${newtons(held.force_norm)}`, `effort V ${plain(held.effort)} N²`];
    return objective === 'grip' ? [grip, ...effort] : [...effort, grip];
  };
  tell(find('verdict'), hold.holdable
    ? [`At ${at} ${hold.manner}:`, ...needs(hold).map((each, k) => (k < 2 ? `${each},` : each))]
    : [`At ${at} it cannot be held`], 'span');
  find('verdict').classList.toggle('not-held', !hold.holdable);
  // Nobody wants every posture of a turn read out.
  find('verdict').setAttribute('aria-live', plays ? 'off' : 'polite');
  tell(find('why'), reasons.map((each) => each.replace(/(\d) (?=N|%)/g, '$1\u00a0')), 'p');
  const doubts = warnings.slice(0, 3).map((line) => line.replace(/^\S+: /, ''));
  if (warnings.length > 3) doubts.push(`And ${warnings.length - 3} more warnings.`);
  tell(find('problem'), [notice.text || problem || doubts.join(' ')], 'span');
  find('problem').classList.toggle('bad', notice.text ? notice.bad : problem !== '');
}

/** What takes some tens of holds: asked for as soon as nothing moves, and until then not known. */
class Rest<Known> {
  private of: AnyHold | undefined;
  private known: Known | undefined;
  private timer = 0;
  constructor(private readonly ask: (then: (known: Known) => void) => void, private readonly draw: () => void) {}

  at(hold: AnyHold): Known | undefined {
    if (this.of === hold) return this.known;
    this.of = hold;
    this.known = undefined;
    clearTimeout(this.timer);
    this.timer = window.setTimeout(() => this.ask((known) => {
      if (this.of !== hold) return;
      this.known = known;
      this.draw();
    }), 150);
    return undefined;
  }
}

/** What a posture withstands. Where it can be held, there is a place for that while it is not known. */
function drawShaken(hold: AnyHold, rest: Rest<Shaken>): void {
  const found = hold.holdable ? rest.at(hold) : undefined;
  const element = find('withstands');
  element.hidden = !hold.holdable;
  element.ariaBusy = String(hold.holdable && !found);
  tell(element, found?.holdable ? [withstands(found)] : [], 'span');
}

class PlaneSheet implements Sheet<PlanarGrasp> {
  private readonly model: PlanarModel;
  private readonly scene: Scene;
  private readonly plot: Plot;
  private readonly controls: PlanarControls;
  private readonly rest: Rest<Margins> = new Rest((then) => then(this.model.margins()), () => sheet === this && this.draw());
  private readonly shaken: Rest<Shaken> = new Rest((then) => then(this.model.shaken()), () => sheet === this && this.draw());
  private readonly boxes = {
    squared: find<HTMLInputElement>('squared'),
    logarithmic: find<HTMLInputElement>('logarithmic'),
    bounds: find<HTMLInputElement>('bounds'),
  };
  private readonly pinched = find<HTMLInputElement>('pinched');
  private readonly player: Player<number>;

  constructor(grasp: PlanarGrasp) {
    this.model = new PlanarModel(grasp);
    this.scene = new Scene(find('plane'), this.model);
    this.plot = new Plot(find('plot'), this.model);
    this.controls = new PlanarControls(find('controls'), this.model);
    this.player = new Player(find('turn-plane'), {
      now: () => this.model.angle,
      start: () => this.model.from,
      best: () => this.model.answers.best.best?.angle_deg,
      looking: () => false,
      apart: (a, b) => Math.abs(wrapped(a - b)),
      show: (angle) => this.model.turnTo(angle),
      ask: (to, then) => then(this.model.turning(to)),
      draw: () => sheet === this && this.draw(),
    });
    for (const key of ['squared', 'logarithmic', 'bounds'] as const)
      this.boxes[key].addEventListener('change', () => {
        this.plot.view[key] = this.boxes[key].checked;
        this.draw();
      });
    this.pinched.addEventListener('change', () => this.model.choose(this.pinched.checked ? 'pinching-up' : 'all'));
    this.model.onChange(() => sheet === this && this.draw());
    this.suit();
  }

  private suit(): void {
    this.plot.suitScale();
    this.boxes.logarithmic.checked = this.plot.view.logarithmic;
    this.pinched.checked = this.model.domain === 'pinching-up';
  }

  load(grasp: PlanarGrasp): void {
    this.model.load(grasp);
    this.player.forget();
    this.suit();
    this.controls.forget();
  }

  current(): PlanarGrasp {
    const { grasp, angle, domain } = this.model;
    return { ...structuredClone(grasp), objective: this.model.answers.measure.objective, angle_deg: angle, ...(domain === 'pinching-up' && { domain }) };
  }

  pictures(): Picture[] {
    return [{ overlay: this.scene.picture }, { overlay: this.plot.picture }];
  }

  turnTo({ angle_deg }: Told): void {
    this.model.turnTo(angle_deg!);
  }

  gripUnit(): GripUnit | null {
    return this.model.answers.gripUnit;
  }

  minimise(objective: Objective): void {
    if (objective !== this.model.answers.measure.objective) this.model.minimise(objective);
  }

  holdAt({ angle_deg }: Told, objective: Objective): AnyHold {
    return this.model.holdAt(angle_deg!, objective);
  }

  draw(): void {
    const { answers, angle, problem } = this.model;
    this.scene.draw();
    const { objective } = answers.measure;
    drawObjective(answers.measure, answers.gripUnit);
    this.boxes.squared.parentElement!.hidden = objective === 'grip';
    this.boxes.bounds.disabled = !this.plot.mayShowBounds();
    this.boxes.bounds.parentElement!.hidden = objective === 'grip' || !asPaper(answers.grasp);
    find('key-other').hidden = !this.plot.other();
    find('other').textContent = objective === 'grip' ? 'least force norm √V' : 'least grip F';
    find('key-cradled').hidden = !answers.check.fork_deg;
    find('key-unholdable').hidden = !answers.best.unholdable_arcs.length;
    this.player.draw(answers.grasp, answers.measure);
    this.plot.turning = this.player.drawn;
    this.plot.draw();
    this.controls.draw();
    drawMinima(find('minima'), this.model);
    drawShaken(answers.hold, this.shaken);
    drawWords(this.player.plays, degrees(answers.hold.angle_deg ?? angle), answers.hold, answers.measure, answers.gripUnit, why(answers, this.rest.at(answers.hold), angle, this.model.optimum()), problem, answers.check.warnings);
  }
}

class SpaceSheet implements Sheet<SpatialGrasp> {
  private readonly model: SpatialModel;
  private readonly scene: BodyView;
  private readonly sphere: SphereView;
  private readonly controls: SpatialControls;
  private readonly player: Player<Vec>;
  private readonly rest: Rest<Margins> = new Rest((then) => then(this.model.margins()), () => sheet === this && this.draw());
  private readonly shaken: Rest<Shaken> = new Rest((then) => this.model.askShake(then), () => sheet === this && this.draw());

  constructor(grasp: SpatialGrasp, mesh?: Triangles) {
    this.model = new SpatialModel(wasm, grasp, mesh);
    this.scene = new BodyView(find('space'), this.model);
    this.sphere = new SphereView(find('sphere'), this.model);
    this.controls = new SpatialControls(find('controls'), this.model);
    this.player = new Player(find('turn-space'), {
      now: () => this.model.up,
      start: () => this.model.from,
      best: () => (this.model.outdated ? undefined : this.model.found.best?.best?.up),
      looking: () => this.model.outdated,
      apart: (a, b) => (angle(a, b) * 180) / Math.PI,
      show: (up) => this.model.show(up),
      ask: (to, then) => this.model.askTurn(to, then),
      draw: () => sheet === this && this.draw(),
    });
    const certificate = find<HTMLInputElement>('certificate');
    certificate.addEventListener('change', () => {
      this.sphere.certificate = certificate.checked;
      this.draw();
    });
    this.model.onChange(() => sheet === this && this.draw());
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => sheet === this && this.draw());
  }

  load(grasp: SpatialGrasp, mesh?: Triangles): void {
    this.model.load(grasp, mesh);
    this.player.forget();
    this.controls.forget();
  }

  current(): SpatialGrasp {
    return { ...structuredClone(this.model.grasp), objective: this.model.answers.measure.objective, up: this.model.up };
  }

  pictures(): Picture[] {
    return [this.scene.image, this.sphere.image];
  }

  turnTo({ up }: Told): void {
    this.model.turnTo(up as unknown as Vec);
  }

  gripUnit(): GripUnit | null {
    return this.model.answers.gripUnit;
  }

  minimise(objective: Objective): void {
    if (objective !== this.model.answers.measure.objective) this.model.minimise(objective);
  }

  holdAt({ up }: Told, objective: Objective): AnyHold {
    return this.model.holdAt(up as unknown as Vec, objective);
  }

  draw(): void {
    const { answers, found, problem, outdated } = this.model;
    this.scene.draw();
    this.player.draw(answers.grasp, answers.measure);
    this.sphere.turning = this.player.drawn;
    this.sphere.draw();
    this.controls.draw();
    drawObjective(answers.measure, answers.gripUnit);
    find('key-outside').hidden = !found.sphere?.values.includes(null);
    find('proof').hidden = !this.sphere.certificate;
    find('proof').textContent = this.sphere.said();
    drawSpatialMinima(find('minima'), this.model);
    // Of the posture that was asked for: the object may have turned on since.
    const at = `up (${answers.hold.up.map((part) => fixed(part, 3)).join(', ')})`;
    drawShaken(answers.hold, this.shaken);
    drawWords(this.player.plays, at, answers.hold, answers.measure, answers.gripUnit, whyInSpace(this.model, this.rest.at(answers.hold)), problem, this.model.warnings);
    document.body.dataset.settled = outdated || this.model.turning ? '' : '1';
  }
}

type Shown = Omit<Preset, 'label'>;

let plane: PlaneSheet | undefined;
let space: SpaceSheet | undefined;
let sheet: PlaneSheet | SpaceSheet | undefined;

/** Shows a grasp; one without meaning is refused, and nothing changes. */
function show({ grasp, mesh }: Shown): void {
  if (grasp.dimension === 2) {
    if (plane) plane.load(grasp);
    else plane = new PlaneSheet(grasp);
    sheet = plane;
  } else {
    if (space) space.load(grasp, mesh);
    else space = new SpaceSheet(grasp, mesh);
    sheet = space;
  }
  for (const [id, dimension] of [['plane', 2], ['plot', 2], ['turn-plane', 2], ['space', 3], ['sphere', 3], ['turn-space', 3]] as const)
    find(id).hidden = grasp.dimension !== dimension;
  sheet.draw();
}

/** The grasp that `poise view` wrote into the page, and what it looks like if its shape is a mesh. */
const [given, mesh]: [Grasp | null, Triangles | null] = ['grasp', 'mesh'].map((id) => JSON.parse(find(id).textContent ?? 'null')) as [Grasp | null, Triangles | null];
const all: Preset[] = presets.flatMap(({ grasps }) => grasps);
const select = find<HTMLSelectElement>('preset');
for (const { group, grasps } of presets) {
  const options = document.createElement('optgroup');
  options.label = group;
  options.append(...grasps.map(({ label }) => new Option(label, String(all.findIndex((each) => each.label === label)))));
  select.append(options);
}
const chosen = () => all[Number(select.value)]!;

/** Shows a grasp from elsewhere, which can be chosen again. */
function offer(shown: Shown, label: string): void {
  show(shown);
  const index = all.push({ label, ...shown }) - 1;
  select.prepend(new Option(label, String(index), true, true));
  select.value = String(index);
  document.title = `${label} – Poise`;
}

function say(text: string, bad = false): void {
  notice = { text, bad };
  sheet?.draw();
  if (text) find('problem').scrollIntoView({ block: 'nearest' });
}

/** Opens a grasp file or a result; a bad one changes nothing, and the words are the command line's. */
function open(bytes: Uint8Array, name: string): void {
  try {
    const result = resultIn(bytes);
    if (result) return void say(follow(result, name), true);
    const grasp = read(bytes, name);
    offer({ grasp }, grasp.name ?? name);
    say('');
  } catch (error) {
    if (!(error instanceof BadGrasp)) throw error;
    say(error.message, true);
  }
}

interface Result extends Partial<Told> {
  poise_result: number;
  options?: { objective?: Objective };
  effort?: number;
  grip?: number | null;
  best?: (Told & { effort: number; grip: number | null }) | null;
}

function resultIn(bytes: Uint8Array): Result | undefined {
  try {
    const found = JSON.parse(new TextDecoder().decode(bytes));
    return typeof found?.poise_result === 'number' ? found : undefined;
  } catch {
    return undefined;
  }
}

/** Turns the object as a result says, and asks for what that asked for; one that does not fit what is
 * shown changes nothing, and words say so. */
function follow(result: Result, name: string): string {
  const told = result.best ?? result;
  const { up, angle_deg } = told;
  const planar = up?.length === 2 && typeof angle_deg === 'number';
  if (!sheet || !up || !(planar || up.length === 3)) return `${name}: is a result without a posture to show`;
  if (planar !== (sheet === plane)) return `${name}: is of a grasp in ${planar ? 'the plane' : 'space'}, not of the one that is shown`;
  const posture = { up, ...(planar && { angle_deg }) };
  const objective = result.options?.objective ?? 'effort';
  const hold = sheet.holdAt(posture, objective);
  const value = (of: { effort?: number; grip?: number | null }) => (objective === 'grip' ? of.grip : of.effort) ?? undefined;
  const [here, there] = [hold.holdable ? value(hold) : undefined, value(told)];
  const fits = here === there || (here !== undefined && there !== undefined && Math.abs(here - there) < 1e-6 * there);
  if (fits) {
    if (sheet.gripUnit() !== null) sheet.minimise(objective);
    sheet.turnTo(posture);
  }
  const needs = (each: number | undefined) =>
    each === undefined ? 'cannot be held' : `needs ${objective === 'grip' ? `a grip of ${gripText(each, sheet!.gripUnit())}` : `${plain(each)} N²`}`;
  return fits ? '' : `${name}: is of another grasp than the one that is shown: there its posture ${needs(there)}, here it ${needs(here)}`;
}

/** More than is ever read is not needed to refuse it. */
const most = 2 ** 20 + 8;
const openFile = async (file: File | undefined) => {
  if (!file) return;
  document.body.dataset.opening = '1';
  open(new Uint8Array(await (file.size > most && !file.name.endsWith('.json') ? file.slice(0, most) : file).arrayBuffer()), file.name);
  document.body.dataset.opening = '';
};

async function openLink(): Promise<boolean> {
  const bytes = await fromLink(location.hash);
  if (bytes?.length) open(bytes, 'link');
  else if (bytes) say('link: is damaged, and holds no grasp', true);
  return bytes !== undefined;
}

async function save(as: string): Promise<void> {
  const grasp = sheet!.current();
  const name = fileName(grasp);
  if (as === 'yaml') keep(yaml(grasp), 'application/yaml', `${name}.yaml`);
  if (as === 'json') keep(`${JSON.stringify(grasp, null, 2)}\n`, 'application/json', `${name}.json`);
  if (as === 'svg') keep(asSvg(sheet!.pictures()).text, 'image/svg+xml', `${name}.svg`);
  if (as === 'png') keep(await asPng(sheet!.pictures()), 'image/png', `${name}.png`);
  if (as !== 'link') return;
  history.replaceState(null, '', `#${await toLink(grasp)}`);
  const copied = await navigator.clipboard?.writeText(location.href).then(() => true, () => false);
  say(`The address of this page now holds the grasp${copied ? ', and is copied' : ''}.`);
}

// What plays is to be seen.
find('turn').addEventListener('play', () => find('scene').scrollIntoView({ block: 'nearest' }));
select.addEventListener('change', () => show(chosen()));
find('reset').addEventListener('click', () => show(chosen()));
find('open').addEventListener('click', () => find('file').click());
find<HTMLInputElement>('file').addEventListener('change', async ({ target }) => {
  const input = target as HTMLInputElement;
  await openFile(input.files?.[0]);
  input.value = '';
});
const menu = find<HTMLDetailsElement>('save');
const close = () => {
  // What has the focus does not vanish.
  if (menu.contains(document.activeElement)) menu.querySelector('summary')!.focus();
  menu.open = false;
};
for (const button of menu.querySelectorAll('button'))
  button.addEventListener('click', () => {
    close();
    void save(button.dataset.as!);
  });
addEventListener('keydown', ({ key }) => key === 'Escape' && close());
addEventListener('pointerdown', ({ target }) => menu.contains(target as Node) || (menu.open = false));
// What was said of a file is over as soon as something else is done.
for (const kind of ['pointerdown', 'input', 'change'])
  document.addEventListener(kind, () => notice.text && say(''), { capture: true });
addEventListener('hashchange', () => void openLink());
addEventListener('dragover', (event) => {
  event.preventDefault();
  document.body.classList.add('dropping');
});
addEventListener('dragleave', () => document.body.classList.remove('dropping'));
addEventListener('drop', (event) => {
  event.preventDefault();
  document.body.classList.remove('dropping');
  void openFile(event.dataTransfer?.files[0]);
});

if (given) offer({ grasp: given, ...(mesh && { mesh }) }, given.name ?? 'your grasp');
else {
  select.value = String(all.findIndex(({ label }) => label === first));
  show(chosen());
}
await openLink();
new ResizeObserver(() => sheet?.draw()).observe(document.body);
document.body.dataset.ready = '1';

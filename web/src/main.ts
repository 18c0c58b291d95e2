import './style.css';
import packed from 'virtual:core';
import { BodyView } from './body';
import { start, type AnyHold } from './core';
import type { Grasp, PlanarGrasp, SpatialGrasp } from './grasp';
import { drawMinima, drawSpatialMinima, PlanarControls, SpatialControls } from './panel';
import { asPaper } from './paper';
import { Plot } from './plot';
import { first, presets } from './presets';
import { Scene } from './scene';
import { SpatialModel } from './space';
import { SphereView } from './sphere';
import { PlanarModel } from './state';
import { degrees, fixed, newtons, plain } from './words';
import { why, whyInSpace } from './why';

const find = <Kind extends HTMLElement>(id: string) => document.getElementById(id) as Kind;

async function unpacked(text: string): Promise<ArrayBuffer> {
  const bytes = Uint8Array.from(atob(text), (character) => character.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'));
  return new Response(stream).arrayBuffer();
}
const wasm = await unpacked(packed);
await start(wasm);

/** A grasp in the plane, or in space: its model, its views. */
interface Sheet<Kind extends Grasp> {
  /** @throws BadGrasp, and nothing changes. */
  load(grasp: Kind): void;
  draw(): void;
}

function paragraphs(words: string[]): HTMLElement[] {
  return words.map((each) => {
    const paragraph = document.createElement('p');
    paragraph.textContent = each;
    return paragraph;
  });
}

function drawWords(at: string, hold: AnyHold, reasons: string[], problem: string, warnings: string[]): void {
  find('verdict').textContent = hold.holdable
    ? `At ${at} ${hold.manner}: force norm √V ${newtons(hold.force_norm)}, effort V ${plain(hold.effort)} N², grip force ${newtons(hold.grip_force)}`
    : `At ${at} it cannot be held`;
  find('verdict').classList.toggle('not-held', !hold.holdable);
  find('why').replaceChildren(...paragraphs(reasons));
  find('problem').textContent = problem || warnings.map((line) => line.replace(/^\S+: /, '')).join(' ');
  find('problem').classList.toggle('bad', problem !== '');
}

class PlaneSheet implements Sheet<PlanarGrasp> {
  private readonly model: PlanarModel;
  private readonly scene: Scene;
  private readonly plot: Plot;
  private readonly controls: PlanarControls;
  private readonly boxes = {
    squared: find<HTMLInputElement>('squared'),
    logarithmic: find<HTMLInputElement>('logarithmic'),
    bounds: find<HTMLInputElement>('bounds'),
  };
  private readonly pinched = find<HTMLInputElement>('pinched');

  constructor(grasp: PlanarGrasp) {
    this.model = new PlanarModel(grasp);
    this.scene = new Scene(find('plane'), this.model);
    this.plot = new Plot(find('plot'), this.model);
    this.controls = new PlanarControls(find('controls'), this.model);
    for (const key of ['squared', 'logarithmic', 'bounds'] as const)
      this.boxes[key].addEventListener('change', () => {
        this.plot.view[key] = this.boxes[key].checked;
        this.draw();
      });
    this.pinched.addEventListener('change', () => this.model.choose(this.pinched.checked ? 'pinched' : 'all'));
    this.model.onChange(() => sheet === this && this.draw());
    this.suit();
  }

  private suit(): void {
    this.plot.suitScale();
    this.boxes.logarithmic.checked = this.plot.view.logarithmic;
    this.pinched.checked = this.model.domain === 'pinched';
  }

  load(grasp: PlanarGrasp): void {
    this.model.load(grasp);
    this.suit();
    this.controls.forget();
  }

  draw(): void {
    const { answers, angle, problem } = this.model;
    this.scene.draw();
    this.boxes.bounds.disabled = !asPaper(answers.grasp) || this.plot.view.squared;
    this.boxes.bounds.parentElement!.hidden = !asPaper(answers.grasp);
    find('key-cradled').hidden = !answers.check.cradled_deg;
    find('key-unholdable').hidden = !answers.best.unholdable_arcs.length;
    this.plot.draw();
    this.controls.draw();
    drawMinima(find('minima'), this.model);
    drawWords(degrees(angle), answers.hold, why(answers, angle, this.model.optimum()), problem, answers.check.warnings);
  }
}

class SpaceSheet implements Sheet<SpatialGrasp> {
  private readonly model: SpatialModel;
  private readonly scene: BodyView;
  private readonly sphere: SphereView;
  private readonly controls: SpatialControls;

  constructor(grasp: SpatialGrasp) {
    this.model = new SpatialModel(wasm, grasp);
    this.scene = new BodyView(find('space'), this.model);
    this.sphere = new SphereView(find('sphere'), this.model);
    this.controls = new SpatialControls(find('controls'), this.model);
    const certificate = find<HTMLInputElement>('certificate');
    certificate.addEventListener('change', () => {
      this.sphere.certificate = certificate.checked;
      this.draw();
    });
    this.model.onChange(() => sheet === this && this.draw());
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => sheet === this && this.draw());
  }

  load(grasp: SpatialGrasp): void {
    this.model.load(grasp);
    this.controls.forget();
  }

  draw(): void {
    const { answers, found, up, problem, outdated } = this.model;
    this.scene.draw();
    this.sphere.draw();
    this.controls.draw();
    find('key-outside').hidden = !found.sphere?.efforts.includes(null);
    find('proof').hidden = !this.sphere.certificate;
    find('proof').textContent = this.sphere.said();
    drawSpatialMinima(find('minima'), this.model);
    const at = `up (${up.map((part) => fixed(part, 3)).join(', ')})`;
    drawWords(at, answers.hold, whyInSpace(this.model), problem, answers.check.warnings);
    document.body.dataset.settled = outdated ? '' : '1';
  }
}

let plane: PlaneSheet | undefined;
let space: SpaceSheet | undefined;
let sheet: PlaneSheet | SpaceSheet | undefined;

/** Shows a grasp; one without meaning is refused, and nothing changes. */
function show(grasp: Grasp): void {
  if (grasp.dimension === 2) {
    if (plane) plane.load(grasp);
    else plane = new PlaneSheet(grasp);
    sheet = plane;
  } else {
    if (space) space.load(grasp);
    else space = new SpaceSheet(grasp);
    sheet = space;
  }
  for (const [id, dimension] of [['plane', 2], ['plot', 2], ['space', 3], ['sphere', 3]] as const)
    find(id).hidden = grasp.dimension !== dimension;
  sheet.draw();
}

/** The grasp that `poise view` wrote into the page. */
const given: Grasp | null = JSON.parse(find('grasp').textContent ?? 'null');
const all = new Map(presets.flatMap(({ grasps }) => grasps.map(({ label, grasp }) => [label, grasp])));

const select = find<HTMLSelectElement>('preset');
if (given) {
  const label = given.name ?? 'your grasp';
  select.append(new Option(label, '', true, true));
  document.title = `${label} – Poise`;
}
for (const { group, grasps } of presets) {
  const options = document.createElement('optgroup');
  options.label = group;
  options.append(...grasps.map(({ label }) => new Option(label, label, !given && label === first, !given && label === first)));
  select.append(options);
}
const chosen = () => (select.value ? all.get(select.value)! : given!);
select.addEventListener('change', () => show(chosen()));
find('reset').addEventListener('click', () => show(chosen()));

show(chosen());
new ResizeObserver(() => sheet?.draw()).observe(document.body);
document.body.dataset.ready = '1';

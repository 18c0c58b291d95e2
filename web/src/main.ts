import './style.css';
import type { Domain, Grasp } from './grasp';
import { Controls, drawMinima } from './panel';
import { asPaper } from './paper';
import { Plot } from './plot';
import { first, presets } from './presets';
import { Scene } from './scene';
import { Model } from './state';
import { degrees, newtons, plain } from './words';
import { why } from './why';

const find = <Kind extends HTMLElement>(id: string) => document.getElementById(id) as Kind;

/** The grasp that `poise view` wrote into the page. */
const given: Grasp | null = JSON.parse(find('grasp').textContent ?? 'null');
const all = new Map(presets.flatMap(({ grasps }) => grasps.map(({ label, grasp }) => [label, grasp])));

const begin = given ?? all.get(first)!;
const model = new Model(begin);
const scene = new Scene(find('scene'), model);
const plot = new Plot(find('plot'), model);
const controls = new Controls(find('controls'), model);

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

const squared = find<HTMLInputElement>('squared');
const logarithmic = find<HTMLInputElement>('logarithmic');
const pinched = find<HTMLInputElement>('pinched');
const bounds = find<HTMLInputElement>('bounds');

function suit(): void {
  plot.suitScale();
  logarithmic.checked = plot.view.logarithmic;
  pinched.checked = model.domain === 'pinched';
}

select.addEventListener('change', () => {
  model.load(select.value ? all.get(select.value)! : given!);
  suit();
});
for (const [box, key] of [[squared, 'squared'], [logarithmic, 'logarithmic'], [bounds, 'bounds']] as const)
  box.addEventListener('change', () => {
    plot.view[key] = box.checked;
    draw();
  });
pinched.addEventListener('change', () => {
  const domain: Domain = pinched.checked ? 'pinched' : 'all';
  model.choose(domain);
});
find('reset').addEventListener('click', () => {
  model.load(select.value ? all.get(select.value)! : given!);
  suit();
});

function draw(): void {
  const { answers, angle } = model;
  const { hold } = answers;
  scene.draw();
  const paper = asPaper(answers.grasp);
  bounds.disabled = !paper || plot.view.squared;
  bounds.parentElement!.hidden = !paper;
  find('key-cradled').hidden = !answers.check.cradled_deg;
  find('key-unholdable').hidden = !answers.best.unholdable_arcs.length;
  plot.draw();
  controls.draw();
  drawMinima(find('minima'), model);
  find('verdict').textContent = hold.holdable
    ? `At ${degrees(angle)} ${hold.manner}: force norm √V ${newtons(hold.force_norm)}, effort V ${plain(hold.effort)} N², grip force ${newtons(hold.grip_force)}`
    : `At ${degrees(angle)} it cannot be held`;
  find('verdict').classList.toggle('not-held', !hold.holdable);
  find('why').replaceChildren(
    ...why(answers, angle, model.optimum()).map((words) => {
      const paragraph = document.createElement('p');
      paragraph.textContent = words;
      return paragraph;
    }),
  );
  const problem = find('problem');
  problem.textContent = model.problem || answers.check.warnings.map((line) => line.replace(/^\S+: /, '')).join(' ');
  problem.classList.toggle('bad', model.problem !== '');
}

model.onChange(draw);
suit();
draw();
new ResizeObserver(draw).observe(document.body);
document.body.dataset.ready = '1';


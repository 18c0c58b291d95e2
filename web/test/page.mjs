// The page in the plane: node test/page.mjs
import { execFileSync, spawnSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { gzipSync } from 'node:zlib';
import { choose, drag, expect, finish, frame, minima, minimise, near, objective, open, out, playAndStop, root, sameShake, turnSaid, turnTold, unsaidMeanwhile, verdict, verdictAt, withstood } from './browser.mjs';

const whole = readFileSync(`${root}web/dist/playground.html`);
const compressed = gzipSync(whole, { level: 9 }).length;
console.log(`${whole.length} bytes, ${compressed} compressed`);
expect(whole.length < 1e6 && compressed < 510e3, 'the page is small');

const page = await open(`${root}web/dist/playground.html`);
console.log(`opened in ${page.ready} ms`);

// Fig. 6 of the paper, at its kink; the numbers are those of the program.
const best = JSON.parse(readFileSync(`${root}build/fixtures/ito-fig6.best.effort.json`, 'utf8'));
expect((await verdict(page)).includes('At 30.00° pinched: force norm √V 17.32 N, effort V 300.0 N²'), 'Fig. 6', await verdict(page));
const shown = await minima(page);
expect(shown.length === best.minima.length, 'as many minima as the program finds', shown.length);
shown.forEach((each, k) =>
  expect(near(each.angle, best.minima[k].angle_deg) && near(each.value, best.minima[k].effort), 'a minimum', each));
// Both in one go: what is drawn may be drawn anew in between.
const [meets, com] = await page.evaluate(() =>
  ['.meet.here', '.com .dot'].map((each) => document.querySelector(each).getBoundingClientRect().toJSON()));
expect(Math.abs(meets.x + meets.width / 2 - com.x - com.width / 2) < 0.1, 'the cone edges meet on the vertical');
expect((await page.textContent('#why')).includes('meet on the vertical'), 'it says so');
await page.screenshot({ path: `${out}fig6.png` });
await page.check('#bounds');
await page.screenshot({ path: `${out}fig6-bounds.png` });
await page.uncheck('#bounds');

// The paper's disks, in its range of postures, against its closed form.
await page.check('#pinched');
const { disks } = JSON.parse(execFileSync(`${root}build/paper`, ['--out', `${out}paper`, '--json']));
const labels = await page.$$eval('#preset optgroup:first-of-type option', (all) => all.map((each) => each.label));
expect(labels.length === disks.length, 'as many figures as the program knows');
for (const [k, label] of labels.entries()) {
  await choose(page, label);
  await page.check('#pinched');
  await frame(page);
  const found = await minima(page);
  const wanted = disks[k].minima;
  expect(found.length === wanted.length, label, found, wanted);
  for (const each of wanted)
    expect(found.some(({ angle, value }) => near(angle, each.angle_deg, 1e-6) && near(value, each.effort)), label, each, found);
}

// Examples: as they are held now.
for (const name of ['l-part', 'hexagon-three-fingers']) {
  const hold = JSON.parse(readFileSync(`${root}build/fixtures/${name}.hold.grip.json`, 'utf8'));
  await choose(page, JSON.parse(readFileSync(`${root}build/fixtures/${name}.grasp.json`, 'utf8')).name);
  const words = `At ${hold.angle_deg.toFixed(2)}° ${hold.manner}: grip ${hold.grip.toPrecision(4)} N, force norm √V ${hold.force_norm.toPrecision(4)} N`;
  expect((await verdict(page)).includes(words), words, await verdict(page));
  await page.screenshot({ path: `${out}${name}.png` });
}

// What is withstood, as the program says for the same posture; while something moves it is not known.
const { capacities } = JSON.parse(readFileSync(`${root}build/fixtures/hexagon-three-fingers.capacity.json`, 'utf8'));
await page.getByLabel('Posture [degrees]').fill('90');
const stands = await withstood(page);
sameShake(stands, capacities[0], 'the hexagon');
expect(Math.hypot(...stands.along.map((part, k) => part - capacities[0].shake.direction[k])) < 0.1, 'its weakest direction', stands, capacities[0].shake.direction);
await unsaidMeanwhile(page, () => drag(page, '#plot .posture .knob', 20, 0));
const otherwise = await withstood(page);
expect(otherwise.acceleration > 0 && otherwise.acceleration !== stands.acceleration, 'then it is told anew', otherwise);
await page.screenshot({ path: `${out}withstood.png` });

// What cannot be held, and why.
await page.getByLabel('Posture [degrees]').fill('0');
await frame(page);
expect((await verdict(page)).includes('cannot be held'), 'unholdable', await verdict(page));
expect((await page.textContent('#why')).includes('It would turn'), 'why it cannot be held');
expect(await page.isHidden('#withstands'), 'it withstands nothing');
await page.screenshot({ path: `${out}unholdable.png` });

// A bad number has the words of the command line, and nothing is lost.
await page.getByLabel('Friction of thumb', { exact: true }).fill('-1');
await frame(page);
expect((await page.textContent('#problem')) === 'contacts[2].friction: is -1, must be at least 0', 'a bad number', await page.textContent('#problem'));
expect((await page.locator('.curve').count()) > 0, 'the last curve stays');
await page.getByLabel('Friction of thumb', { exact: true }).fill('0.5');
await frame(page);
expect((await page.textContent('#problem')) === '', 'mended');

// By hand: a finger, the centre of mass, the object, the posture.
await choose(page, 'Fig. 6: φ = 75°, μ = 1 and 1/√3');
await page.evaluate(() => scrollTo(0, 0));  // the numbers are below
const changes = async (what, act) => {
  const before = [await verdict(page), JSON.stringify(await minima(page))];
  await act();
  await frame(page);  // moves may have come only with the release of the button
  const after = [await verdict(page), JSON.stringify(await minima(page))];
  expect(before[0] !== after[0], `${what}: the hold changes`, after[0]);
  return before[1] !== after[1];
};
expect(await changes('a finger', () => drag(page, '.contact .pad', -40, 30)), 'a finger changes the curve');
expect(await changes('the com', () => drag(page, '.com .dot', 25, 10)), 'the com changes the curve');
await page.screenshot({ path: `${out}dragged.png` });
const text = page.locator('.body');
const box = await text.boundingBox();
expect(!(await changes('the object', async () => {
  await page.mouse.move(box.x + box.width / 2, box.y + box.height - 12);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width / 2 + 60, box.y + box.height - 30, { steps: 4 });
  await frame(page);
  await page.mouse.up();
})), 'turning the object leaves the curve as it is');
expect(!(await changes('the posture', () => drag(page, '#plot .posture .knob', 60, 0))), 'as does the handle');
await page.click('#reset');
await frame(page);
expect((await verdict(page)).includes('300.0 N²'), 'start again');

// Where it rests on one finger, the other has nothing to do.
await page.locator('#minima button', { hasText: 'resting' }).first().click();
await frame(page);
expect((await page.locator('#plane .force.label').allTextContents()).sort().join() === '0 N,10.00 N', 'the forces of a rest', await page.locator('#plane .force.label').allTextContents());
expect((await page.locator('td.number').allTextContents()).sort().join() === '0 N,0.0 %,10.00 N,unloaded', 'the same in the table', await page.locator('td.number').allTextContents());
await page.click('#reset');
await frame(page);

// A limit by its slider: at the end there is none.
const slider = page.getByLabel('Greatest normal force of left, slider [N]');
const most = page.getByLabel('Greatest normal force of left [N]');
expect(await changes('a limit', () => slider.fill('12')), 'a limit changes the curve');
expect((await most.inputValue()) === '12', 'the number follows', await most.inputValue());
await slider.focus();
await page.keyboard.press('End');
await frame(page);
expect((await most.inputValue()) === '' && (await verdict(page)).includes('300.0 N²'), 'no limit', await most.inputValue(), await verdict(page));

// What pushes the object: a number, an arrow to drag, and keys.
expect(await page.locator('#plane .tip').isHidden(), 'nothing pushes at first');
expect(await changes('a push', () => page.getByLabel('Push, x [N]').fill('4')), 'a push changes the curve');
expect(await page.locator('#plane .tip').isVisible() && (await page.locator('#plane .arrow.gravity').count()) === 2, 'and has an arrow');
await page.evaluate(() => scrollTo(0, 0));  // the number is below
expect(await changes('its arrow', () => drag(page, '#plane .tip', 25, 10)), 'its arrow is dragged');
await page.locator('#plane .tip').focus();
expect(await changes('a key on it', async () => { await page.keyboard.press('ArrowRight'); await frame(page); }), 'and moved by keys');
await page.click('#reset');
await frame(page);
expect((await verdict(page)).includes('300.0 N²') && (await page.locator('#plane .tip').isHidden()), 'no push', await verdict(page));

// By keyboard.
await page.locator('#plot .posture').focus();
await changes('a key on the posture', async () => { await page.keyboard.press('ArrowRight'); await frame(page); });
expect((await verdict(page)).startsWith('At 31.00°'), 'one degree', await verdict(page));
await page.locator('.contact').first().focus();
expect(await changes('a key on a finger', async () => { await page.keyboard.press('ArrowLeft'); await frame(page); }), 'a key moves a finger');
await page.locator('.com').focus();
expect(await changes('a key on the com', async () => { await page.keyboard.press('ArrowRight'); await frame(page); }), 'a key moves the com');
const reached = new Set();
for (let k = 0; k < 40; ++k) {
  await page.keyboard.press('Tab');
  reached.add(await page.evaluate(() => document.activeElement.getAttribute('aria-label') ?? document.activeElement.id));
}
for (const label of ['preset', 'Posture: turn the object', 'Centre of mass: arrow keys move it', 'Posture', 'Friction of right', 'logarithmic'])
  expect(reached.has(label), `Tab reaches ${label}`, [...reached]);

// The turn, with the numbers of the program: from now to the best, straight and the other way round.
await choose(page, JSON.parse(readFileSync(`${root}build/fixtures/l-part.grasp.json`, 'utf8')).name);
await turnTold(page);
const lPart = JSON.parse(readFileSync(`${root}build/fixtures/l-part.best.grip.json`, 'utf8'));
const { turn } = lPart;
const [straight, other] = [turn, turn.other_way];
const said = await turnSaid(page);
expect(said.head === `The turn to the best posture: ${straight.turn_deg.toFixed(2)}° counter-clockwise`, 'the turn', said);
expect(said.words.startsWith(`On this turn it needs up to a grip of ${straight.peak.toPrecision(4)} N, after ${straight.peak_at.turn_deg.toFixed(2)}° of ${straight.turn_deg.toFixed(2)}°. The other way round, by ${(-other.turn_deg).toFixed(2)}° clockwise,`), 'its peak', said.words);
expect(said.words.includes(`a grip of ${other.peak.toPrecision(4)} N`), 'the other peak', said.words);
expect(said.buttons.join() === 'Play the shorter way round,Play the other way round', 'both can be played', said.buttons);
expect((await page.locator('#turn-plane .peak').count()) === 2 && (await page.locator('#plot .peak').count()) === 2, 'the peaks are marked');
const atPosture = async () => Number((await verdict(page)).match(/^At (-?[\d.]+)°/)[1]);
// By hand: the knob goes along the curve; what is looked at is forgotten by that no more than by playing.
const knobOfTurn = page.locator('#turn-plane .posture');
await knobOfTurn.focus();
for (let k = 0; k < 3; ++k) await page.keyboard.press('ArrowRight');
await frame(page);
expect((await atPosture()) === 3 && (await knobOfTurn.getAttribute('aria-valuetext')).startsWith('3.00° of 131.99°, grip '), 'a key on the turn', await verdict(page));
expect((await turnSaid(page)).words === said.words, 'the turn stays', await turnSaid(page));
// It plays to the end, and stops where it is told to.
const play = page.locator('#turn-plane button').first();
const ended = (to) => verdictAt(page, `At ${to.toFixed(2)}°`);
expect((await playAndStop(page, 'the shorter way round', 20)) === 'Stop the shorter way round', 'while it plays the button stops it');
await frame(page);
const stopped = await atPosture();
expect(stopped > 20 && stopped < 30 && (await play.getAttribute('aria-label')) === 'Play the shorter way round', 'it stops', stopped);
await page.screenshot({ path: `${out}turn.png` });
await play.focus();
await page.keyboard.press('Enter');
await ended(lPart.best.angle_deg);
await frame(page);
expect((await verdict(page)).includes(`grip ${lPart.best.grip.toPrecision(4)} N`) && (await turnSaid(page)).words === said.words, 'it ends at the best', await verdict(page));
await page.locator('#turn-plane button').nth(1).click();
await ended(lPart.best.angle_deg);
// Whoever turns it otherwise has it.
await play.click();
await page.getByLabel('Posture [degrees]').fill('-40');
await turnTold(page);
await frame(page);
const elsewhere = await turnSaid(page);
expect((await atPosture()) === -40 && elsewhere.head === 'The turn to this posture: 40.00° clockwise', 'a turn to elsewhere', elsewhere);
// Who wants no motion sees the peak at rest.
await page.getByLabel('Posture [degrees]').fill('0');
await turnTold(page);
await frame(page);
await page.emulateMedia({ reducedMotion: 'reduce' });
await play.click();
const atPeak = await ended(straight.peak_at.angle_deg);
expect(atPeak.includes(`grip ${straight.peak.toPrecision(4)} N`), 'the peak at rest', atPeak);
await ended(lPart.best.angle_deg);
await page.emulateMedia({ reducedMotion: null });
// Postures that cannot be held are passed, and it says why.
await choose(page, JSON.parse(readFileSync(`${root}build/fixtures/hexagon-three-fingers.grasp.json`, 'utf8')).name);
await page.getByLabel('Posture [degrees]').fill('0');
await turnTold(page);
await frame(page);
const { stdout } = spawnSync(`${root}build/poise`, ['turn', `${root}examples/hexagon-three-fingers.yaml`, '--to', '0', '--json'], { encoding: 'utf8' });
const hexagon = JSON.parse(stdout).turn;
const passed = await turnSaid(page);
expect(hexagon.peak === null && passed.words.includes(hexagon.unholdable[0].posture.reason), 'why it cannot be held on the way', passed);
await page.screenshot({ path: `${out}turn-unholdable.png` });
await choose(page, 'Fig. 6: φ = 75°, μ = 1 and 1/√3');

// How long a drag takes: a frame.
const times = await page.evaluate(async () => {
  const slider = document.querySelector('[aria-label="Friction of right, slider"]');
  const taken = [];
  for (let k = 0; k < 40; ++k) {
    slider.value = String(1 + k / 100);
    slider.dispatchEvent(new Event('input', { bubbles: true }));
    await new Promise((done) => requestAnimationFrame(() => {
      const begin = performance.now();
      setTimeout(() => { taken.push(performance.now() - begin); done(); });
    }));
  }
  return taken.sort((a, b) => a - b);
});
console.log(`a change is drawn in ${times[20].toFixed(1)} ms (median), ${times[38].toFixed(1)} ms (95 %)`);

// What is to be least: two fingers that face each other. Upright each presses with W/(2 mu) and carries
// W/2, whatever is least.
const facing = {
  poise: 1, dimension: 2, name: 'two fingers', angle_deg: 0, object: { weight: 10, com: [0, 0], shape: { disk: { radius: 0.04 } } },
  contacts: [{ position: [-0.04, 0], normal: [1, 0], friction: 0.4, finger: 'left' }, { position: [0.04, 0], normal: [-1, 0], friction: 0.4, finger: 'right' }],
};
writeFileSync(`${out}facing.json`, JSON.stringify(facing));
await page.setInputFiles('#file', `${out}facing.json`);
await page.waitForSelector('body[data-opening=""]');
await frame(page);
const [grip, norm] = [10 / (2 * 0.4), Math.SQRT2 * Math.hypot(10 / 2, 10 / (2 * 0.4))].map((value) => value.toPrecision(4));
expect((await objective(page)) === 'grip' && (await page.textContent('#least')) === 'Least grip', 'the grip, as nothing else is said');
expect((await verdict(page)).includes(`grip ${grip} N, force norm √V ${norm} N`), 'W/(2 mu)', await verdict(page));
expect((await page.textContent('#plot .title')) === 'grip F [N]' && !(await page.isVisible('#squared')) && !(await page.isVisible('#bounds')), 'the axis of the grip');
const knob = () => page.$eval('#plot .posture .knob', (each) => [+each.getAttribute('cx'), +each.getAttribute('cy')]);
const heights = (kind, x) => page.$$eval(`#plot > svg path.${kind}`, (all, x) => {
  const points = all.flatMap((each) => [...each.getAttribute('d').matchAll(/([-\d.e]+)[ ,]([-\d.e]+)/g)].map(([, x, y]) => [+x, +y]));
  return points.filter((point) => Math.abs(point[0] - x) < 1).map(([, y]) => y);
}, x);
const [x, above] = await knob();
const there = { curve: await heights('curve', x), other: await heights('other', x) };
expect(there.curve.some((y) => near(y, above, 0.01)), 'the curve goes through the handle', there, above);
await page.screenshot({ path: `${out}grip.png` });
await minimise(page, 'effort');
const [, below] = await knob();
expect(below < above - 10 && there.other.some((y) => near(y, below, 0.01)), 'the other curve is where it is alone', there, below);
expect((await heights('other', x)).some((y) => near(y, above, 0.01)), 'and the other way round');
expect((await page.textContent('#plot .title')) === 'force norm √V [N]' && (await verdict(page)).includes(`force norm √V ${norm} N, effort V `), 'the effort', await verdict(page));
expect((await page.textContent('#other')) === 'least grip F', 'the key of the other', await page.textContent('#other'));
await page.check('#squared');
await frame(page);
expect((await page.locator('#plot > svg path.other').count()) === 0, 'no newtons on an axis of their squares');
await page.uncheck('#squared');
await page.click('#save summary');
await page.click('[data-as=link]');
await page.waitForFunction(() => location.hash.startsWith('#grasp='));
const linked = await open(`${root}web/dist/playground.html${new URL(page.url()).hash}`);
expect((await objective(linked)) === 'effort' && (await verdict(linked)) === (await verdict(page)), 'a link asks for the same', await verdict(linked));
await linked.close();
await page.locator('[name=objective]:checked').focus();
await page.keyboard.press('ArrowLeft');
await frame(page);
expect((await objective(page)) === 'grip' && (await verdict(page)).includes(`: grip ${grip} N`), 'by a key', await verdict(page));
// What holds without a known direction to close has no grip.
facing.contacts.forEach((contact) => (contact.finger = 'ring'));
writeFileSync(`${out}ring.json`, JSON.stringify(facing));
await page.evaluate(() => delete document.body.dataset.opening);
await page.setInputFiles('#file', `${out}ring.json`);
await page.waitForSelector('body[data-opening=""]');
await frame(page);
expect((await objective(page)) === 'effort' && (await page.isDisabled('[value=grip]')) && (await page.isVisible('#no-grip')), 'no grip');
expect((await verdict(page)).endsWith('grip –'), 'which is said', await verdict(page));

// A greatest force of the drives: the effort has no curve there, and words say so.
facing.contacts.forEach((contact, k) => (contact.finger = ['left', 'right'][k]));
facing.fingers = { left: { max_force: 14 }, right: { max_force: 14 } };
writeFileSync(`${out}limited.json`, JSON.stringify(facing));
await page.evaluate(() => delete document.body.dataset.opening);
await page.setInputFiles('#file', `${out}limited.json`);
await page.waitForSelector('body[data-opening=""]');
await frame(page);
expect((await verdict(page)).includes(`: grip ${grip} N`) && (await page.isHidden('#key-other')) && (await page.isVisible('#key-unholdable')), 'up to the greatest force', await verdict(page));
await page.locator('#objective label', { hasText: 'least effort' }).click();
await frame(page);
expect((await objective(page)) === 'grip' && (await page.textContent('#problem')).includes('which the curve of effort does not take into account'), 'no curve of the effort', await page.textContent('#problem'));

// With a grasp inside, whose name is full of markup.
const grasp = JSON.parse(readFileSync(`${root}build/fixtures/l-part.grasp.json`, 'utf8'));
grasp.name = '</script><img src=x onerror=alert(1)>';
execFileSync(`${root}build/poise`, ['view', '-', '-o', `${out}view.html`], { input: JSON.stringify(grasp) });
const viewed = await open(`${out}view.html`);
expect((await viewed.locator('img').count()) === 0, 'a name is never markup');
expect((await viewed.locator('#preset option:checked').textContent()) === grasp.name, 'its name is shown as it is');
expect((await verdict(viewed)).startsWith('At 0.00°'), 'as it is held now', await verdict(viewed));

for (const colorScheme of ['light', 'dark']) {
  const dark = await open(`${root}web/dist/playground.html`, { colorScheme });
  await dark.screenshot({ path: `${out}${colorScheme}.png` });
  const phone = await open(`${root}web/dist/playground.html`, { width: 390, height: 844, colorScheme });
  const { scroll, client } = await phone.evaluate(() => ({ scroll: document.documentElement.scrollWidth, client: document.documentElement.clientWidth }));
  const cut = await phone.$$eval('.scroll', (all) => all.filter((each) => each.scrollWidth > each.clientWidth).length);
  expect(cut === 0, 'no table is cut');
  expect(scroll <= client, 'nothing is wider than a phone', scroll, client);
  await phone.screenshot({ path: `${out}phone-${colorScheme}.png`, fullPage: true });
}

await finish();

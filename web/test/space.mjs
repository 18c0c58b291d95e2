// The page in space, and its files: node test/space.mjs
import { execFileSync, spawnSync } from 'node:child_process';
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { browser, drag, expect, finish, frame, minimise, near, objective, open, out, patience, playAndStop, root, sameShake, settled, turnSaid, turnTold, unsaidMeanwhile, verdict, verdictAt, withstood } from './browser.mjs';

const built = `${root}web/dist/playground.html`;
const poise = (...parameters) => spawnSync(`${root}build/poise`, parameters, { encoding: 'utf8', cwd: `${out}files` });
mkdirSync(`${out}files`, { recursive: true });

/** What the page would keep as a file. */
async function saved(page, as) {
  await page.click('#save summary');
  const [download] = await Promise.all([page.waitForEvent('download'), page.click(`[data-as=${as}]`)]);
  return readFileSync(await download.path());
}

// Every preset: its numbers are those of the program, digit for digit as they are shown.
const four = (value) => (value === 0 ? '0' : value.toFixed(Math.min(Math.max(3 - Math.floor(Math.log10(value * 1.00005)), 0), 9)));
const fixed = (value, digits) => value.toFixed(digits).replace(/^-(0\.0*)$/, '$1');
const page = await open(built);
const labels = await page.$$eval('#preset option', (all) => all.map(({ label }) => label));
expect(labels.length >= 18, 'as many presets as before', labels.length);
for (const [label, what] of labels.flatMap((each) => [[each, 'grip'], [each, 'effort']])) {
  await page.selectOption('#preset', { label });
  await minimise(page, what);
  const grasp = await saved(page, 'json');
  const space = JSON.parse(grasp).dimension === 3;
  if (space) await settled(page);
  await frame(page);
  // Undefined where the program says that nothing holds it.
  const ask = (command) => {
    const { status, stdout, stderr } = spawnSync(`${root}build/poise`, [command, '-', '--json'], { input: grasp, encoding: 'utf8', maxBuffer: 2 ** 26 });
    if (status !== 0 && status !== 1) throw new Error(`poise ${command}, ${label}: exit ${status}: ${stderr}`);
    return status === 0 ? JSON.parse(stdout) : undefined;
  };
  const shown = await page.$$eval('#minima button', (all) => all.map((each) => Array.from(each.querySelectorAll('span, strong'), (part) => part.textContent).filter(Boolean)));
  const best = ask('best');
  if (!best) {
    expect(shown.length === 0 && label.includes('4(c): '), `${label}: nothing holds it`, shown);
    continue;
  }
  // In space, of postures that need the same grip, rounding decides which one is found.
  const anyUp = space && what === 'grip';
  const wanted = best.minima.slice(0, 8).map((each) => [
    ...(anyUp ? [] : [space ? `(${each.up.map((part) => fixed(part, 3)).join(', ')})` : `${fixed(each.angle_deg, 2)}°`]),
    ...(what === 'grip' ? [`${four(each.grip)} N`, `√V ${four(each.force_norm)} N`] : [`${four(each.force_norm)} N`, `grip ${four(each.grip)} N`]),
  ].join(' '));
  const found = shown.map((parts) => parts.slice(anyUp ? 1 : 0, 3).join(' '));
  expect(found.sort().join('\n') === wanted.sort().join('\n'), `${label}, ${what}`, found, wanted);
  const main = shown.find((parts) => parts.includes('best'));
  expect(main?.[1] === `${four(what === 'grip' ? best.best.grip : best.best.force_norm)} N`, `${label}, ${what}: the best`, main);
  const hold = ask('hold');
  if (!hold) {
    expect((await verdict(page)).includes('cannot be held'), `${label}: not held now`, await verdict(page));
    continue;
  }
  const [norm, grip] = [`force norm √V ${four(hold.force_norm)} N, effort V ${four(hold.effort)} N²`, `grip ${four(hold.grip)} N`];
  const words = `${hold.manner}: ${what === 'grip' ? `${grip}, ${norm}` : `${norm}, ${grip}`}`;
  expect((await verdict(page)).endsWith(words), `${label}, ${what}: now`, words, await verdict(page));
}

// What is withstood, within limits and without; while the object moves it is not known.
for (const name of ['shaken-bottle', 'pick-and-place', 'bottle']) {
  await page.evaluate(() => delete document.body.dataset.opening);
  await page.setInputFiles('#file', `${root}build/fixtures/${name}.grasp.json`);
  await page.waitForSelector('body[data-opening=""]');
  const stands = await withstood(page);
  const { capacities } = JSON.parse(readFileSync(`${root}build/fixtures/${name}.capacity.json`, 'utf8'));
  const least = (of) => Math.min(...capacities.map((each) => of(each) ?? Infinity));
  sameShake(stands, { shake: { acceleration: least(({ shake }) => shake.acceleration) }, tilt_deg: least(({ tilt_deg }) => tilt_deg) }, name);
  await page.locator('#sphere circle.area').focus();
  await unsaidMeanwhile(page, () => page.keyboard.press('ArrowUp'));
}

// By hand.
const shows = async (label) => {
  await page.selectOption('#preset', { label });
  await settled(page);
  await frame(page);
};
const seen = async () => [await verdict(page), await page.textContent('#minima')];
async function changes(what, act) {
  const before = await seen();
  await act();
  await frame(page);
  await settled(page);
  await frame(page);
  const after = await seen();
  expect(before[0] !== after[0], `${what}: the hold changes`, after[0]);
  return before[1] !== after[1];
}
// Three fingers evenly round a cylinder, above its centre of mass: upright each presses with W/(3 mu), and
// a tilt adds to what one of them carries. The colours are those of what is least.
await shows('cylinder in three fingers');
const { object, contacts } = JSON.parse(readFileSync(`${root}build/fixtures/cylinder-three-fingers.grasp.json`, 'utf8'));
for (const what of ['grip', 'effort']) {
  await minimise(page, what);
  await settled(page);
  await frame(page);
  const { best } = JSON.parse(readFileSync(`${root}build/fixtures/cylinder-three-fingers.best.${what}.json`, 'utf8'));
  const legend = await page.$$eval('#sphere .legend text', (all) => all.map((each) => each.textContent));
  expect(legend[0] === four(what === 'grip' ? best.grip : best.force_norm) && legend.includes(what === 'grip' ? 'grip F [N]' : 'force norm √V [N]'), `the colours of ${what}`, legend);
  await page.screenshot({ path: `${out}space-${what}.png` });
}
await minimise(page, 'grip');
expect((await verdict(page)).includes(`: grip ${four(object.weight / (3 * contacts[0].friction))} N, `), 'W/(3 mu)', await verdict(page));
await page.waitForFunction(() => document.querySelector('#why').textContent.includes('Pressing harder'));
expect((await page.textContent('#why')).includes('A kink: whatever the turn, the grip rises'), 'a kink in space', await page.textContent('#why'));
await shows('box in three fingers');
await page.screenshot({ path: `${out}space.png` });
expect(await changes('a finger', () => drag(page, '#space .contact .grab', 25, -6)), 'a finger changes the minima');
const moved = JSON.parse(await saved(page, 'json')).contacts[0];
expect(near(Math.abs(moved.position[1]), 0.03), 'the finger stays on its face', moved.position);
expect(await changes('the com', () => drag(page, '#space .com .dot', 12, 12)), 'the com changes the minima');
expect(!(await changes('the object', async () => {
  const box = await page.locator('#space rect.area').boundingBox();
  await page.mouse.move(box.x + 60, box.y + 60);
  await page.mouse.down();
  await page.mouse.move(box.x + 60, box.y + 90, { steps: 3 });
  await page.mouse.up();
})), 'turning it does not');
const sphere = await page.locator('#sphere circle.area').boundingBox();
const middle = [sphere.x + sphere.width / 2, sphere.y + sphere.height / 2];
expect(!(await changes('a click on the sphere', () => page.mouse.click(middle[0] + 30, middle[1] - 40))), 'nor does a click');
const before = await verdict(page);
await page.mouse.move(...middle);
await page.mouse.down();
await page.mouse.move(middle[0] + 70, middle[1], { steps: 3 });
await page.mouse.up();
await frame(page);
expect((await verdict(page)) === before, 'a turn about the vertical changes nothing', before, await verdict(page));
await changes('a drag on the sphere', async () => {
  await page.mouse.move(...middle);
  await page.mouse.down();
  await page.mouse.move(middle[0], middle[1] + 50, { steps: 3 });
  await page.mouse.up();
});
await page.locator('#minima button').first().click();
await frame(page);
await settled(page);
expect((await page.textContent('#why')).includes('needs less'), 'it says that none needs less', await page.textContent('#why'));
await page.check('#certificate');
await frame(page);
expect(await page.isVisible('#proof'), 'the proof is explained');
await page.screenshot({ path: `${out}proof.png` });
await page.uncheck('#certificate');
await page.click('#reset');
await settled(page);

// The turn: straight, and the way of least peak, with the numbers of the program.
await shows('box between two soft jaws');
await minimise(page, 'grip');
await settled(page);
await turnTold(page);
expect((await turnSaid(page)).head.startsWith('The turn to the best posture: '), 'the turn to the best', await turnSaid(page));
const soft = JSON.parse(readFileSync(`${root}build/fixtures/box-soft-jaws.turn.grip.json`, 'utf8'));
const { turn, then } = soft;
// To a posture as a result tells it, which is exact.
const lookAt = async (hold) => {
  writeFileSync(`${out}files/posture.json`, JSON.stringify({ poise_result: 1, options: { objective: 'grip' }, ...hold }));
  await page.evaluate(() => delete document.body.dataset.opening);
  await page.setInputFiles('#file', `${out}files/posture.json`);
  await page.waitForSelector('body[data-opening=""]');
  await settled(page);
  await frame(page);
  await turnTold(page);
  await frame(page);
};
await lookAt(then);
const said = await turnSaid(page);
expect(said.head === `The turn to this posture: ${turn.turn_deg.toFixed(2)}°`, 'the turn', said);
const told = [...said.words.matchAll(/a grip of ([\d.]+) N/g)].map(([, value]) => +value);
// What encloses the same differs by no more than was asked for.
[turn.peak, turn.way.peak, turn.way.lower_bound].forEach((value, k) => expect(near(told[k], value, 2e-3), 'the peaks', said.words, value));
expect(/^On this turn it needs up to a grip of .* A way of 2 steps needs only a grip of .*; no way needs less than a grip of /.test(said.words), 'in words', said.words);
expect(said.buttons.join() === 'Play the straight turn,Play the way of 2 steps', 'both can be played', said.buttons);
expect((await page.locator('#sphere path.course.straight').count()) > 0 && (await page.locator('#sphere path.course.detour').count()) > 0, 'both are on the sphere');
await page.screenshot({ path: `${out}turn-space.png` });
// Played, the way ends where it leads; at rest its peak needs what it is told to need.
const at = `up (${then.up.map((part) => fixed(part, 3)).join(', ')})`;
const ended = () => verdictAt(page, `At ${at}`);
const sizes = (await page.$$eval('#turn-space button', (all) => all.map((each) => each.textContent.match(/([\d.]+)°/)[1])));
for (const [k, course] of [[1, 'the way of 2 steps'], [0, 'the straight turn']]) {
  expect((await playAndStop(page, course, 5)) === `Stop ${course}`, 'while it plays the button stops it');
  await frame(page);
  expect(!(await verdict(page)).startsWith(`At ${at}`), 'on the way', await verdict(page));
  const needed = [await page.getAttribute('#turn-space .posture', 'aria-valuetext'), await verdict(page)].map((words) => +words.match(/grip ([\d.]+)/)[1]);
  expect(near(needed[0], needed[1], 5e-3), 'the knob tells what is needed', needed);
  await page.getByLabel(`Play ${course}`).click();
  await ended();
  await frame(page);
  expect((await page.getAttribute('#turn-space .posture', 'aria-valuetext')).startsWith(`${sizes[k]}° of `), 'it ends', k);
}
expect((await turnSaid(page)).words === said.words, 'the turn stays', await turnSaid(page));
await page.emulateMedia({ reducedMotion: 'reduce' });
await page.getByLabel('Play the straight turn').click();
const [, after] = said.words.match(/after ([\d.]+)°/);
const atPeak = await (await page.waitForFunction((way) => document.querySelector('#turn-space .posture').ariaValueNow === way && document.querySelector('#verdict').textContent, after)).jsonValue();
expect(near(+atPeak.match(/grip ([\d.]+)/)[1], told[0], 2e-3), 'the peak at rest', atPeak, said.words);
await ended();
await page.emulateMedia({ reducedMotion: null });

// What cannot be held, and why.
await shows('box between two hard jaws');
expect((await page.textContent('#why')).includes('It would turn about the line through contacts 0 and 1'), 'why it falls', await page.textContent('#why'));
await page.screenshot({ path: `${out}space-falls.png` });
await page.getByLabel('Torsion of left [m]').fill('-1');
await frame(page);
expect((await page.textContent('#problem')).startsWith('contacts[0].torsion: is -1'), 'a bad number', await page.textContent('#problem'));
await page.getByLabel('Torsion of left [m]').fill('0');
await frame(page);

// By keyboard.
await page.locator('#save summary').focus();
await page.keyboard.press('Enter');
await page.keyboard.press('Tab');
await page.keyboard.press('Escape');
expect(await page.evaluate(() => !document.querySelector('#save').open && document.activeElement.tagName === 'SUMMARY'), 'a closed menu keeps the focus');
await page.locator('#sphere circle.area').focus();
await changes('a key on the sphere', () => page.keyboard.press('ArrowUp'));
await shows('box in three fingers');  // all of them press in the best posture
await page.locator('#space .contact').first().focus();
expect(await changes('a key on a finger', () => page.keyboard.press('ArrowUp')), 'a key moves a finger');
await page.locator('#space .com').focus();
expect(await changes('a key on the com', () => page.keyboard.press('ArrowRight')), 'a key moves the com');
const reached = new Set();
await page.locator('#preset').focus();
for (let k = 0; k < 45; ++k) {
  await page.keyboard.press('Tab');
  reached.add(await page.evaluate(() => document.activeElement.getAttribute('aria-label') ?? (document.activeElement.id || document.activeElement.textContent)));
}
for (const label of ['reset', 'open', 'Save', 'Posture: turn the object with the arrow keys', 'Centre of mass: arrow keys move it',
  'Sphere of postures: turn it with the arrow keys', 'certificate', 'Up, x', 'Friction of thumb', 'Torsion of thumb [m]'])
  expect(reached.has(label), `Tab reaches ${label}`, [...reached]);

// Files: what is kept is read again, by the program too.
await shows('wet bottle between two soft fingers');
await minimise(page, 'effort');
await settled(page);
for (const as of ['yaml', 'json']) {
  writeFileSync(`${out}files/bottle.${as}`, await saved(page, as));
  const { best } = JSON.parse(poise('best', `bottle.${as}`, '--json').stdout);
  expect(best.objective === 'effort' && near(best.force_norm, 11.5843, 1e-4), `saved as ${as}`, best.force_norm);
  await page.evaluate(() => delete document.body.dataset.opening);
  await page.setInputFiles('#file', `${out}files/bottle.${as}`);
  await page.waitForSelector('body[data-opening=""]');
  await frame(page);
  await settled(page);
  expect((await page.textContent('#problem')) === '', `opened from ${as}`, await page.textContent('#problem'));
}
const drawn = (await saved(page, 'svg')).toString();
expect(drawn.includes('</svg>') && !drawn.includes('var('), 'saved as SVG, with the colours written out');
expect((await saved(page, 'png')).subarray(1, 4).toString() === 'PNG', 'saved as PNG');
await page.click('#save summary');
await page.click('[data-as=link]');
await page.waitForFunction(() => location.hash.startsWith('#grasp='));
const linked = await open(`${built}${new URL(page.url()).hash}`);
await settled(linked);
expect((await verdict(linked)) === (await verdict(page)), 'a link shows the same', await verdict(linked));
await linked.close();
const damaged = await open(`${built}#grasp=abc`);
expect((await damaged.textContent('#problem')) === 'link: is damaged, and holds no grasp', 'a damaged link', await damaged.textContent('#problem'));
expect((await verdict(damaged)).includes('300.0 N²'), 'which loses nothing');
await damaged.close();

// A drop, as the browser hands it over.
const drop = async (name, bytes) => {
  await page.evaluate(([file, content]) => {
    const data = new DataTransfer();
    data.items.add(new File([Uint8Array.from(content)], file));
    window.dispatchEvent(new DragEvent('drop', { dataTransfer: data, cancelable: true }));
  }, [name, [...bytes]]);
  await page.waitForSelector('body[data-opening=""]');
  await frame(page);
  await settled(page);
};
const best = poise('best', 'bottle.yaml', '--json').stdout;
await drop('best.json', Buffer.from(best));
expect((await page.textContent('#problem')) === '', 'a result of this grasp', await page.textContent('#problem'));
expect((await verdict(page)).includes(`force norm √V ${four(JSON.parse(best).best.force_norm)} N`), 'its posture', await verdict(page));
const command = poise('hold', 'bottle.yaml', '--objective', 'grip', '--json').stdout;
await drop('hold.json', Buffer.from(command));
expect((await objective(page)) === 'grip' && (await verdict(page)).includes(`: grip ${four(JSON.parse(command).grip)} N, `), 'a result of the grip', await verdict(page));
await drop('best.json', Buffer.from(best));
expect((await objective(page)) === 'effort', 'and of the effort');
await drop('other.json', readFileSync(`${root}build/fixtures/box-soft-jaws.best.effort.json`));
expect((await page.textContent('#problem')).includes('is of another grasp'), 'a result of another grasp', await page.textContent('#problem'));
expect((await verdict(page)).includes(`force norm √V ${four(JSON.parse(best).best.force_norm)} N`), 'which turns nothing', await verdict(page));
await drop('plane.json', readFileSync(`${root}build/fixtures/l-part.best.effort.json`));
expect((await page.textContent('#problem')) === 'plane.json: is of a grasp in the plane, not of the one that is shown', 'a result of the plane', await page.textContent('#problem'));

// Ten bad files: the words of the program, and nothing is lost.
const good = readFileSync(`${root}examples/bottle.yaml`, 'utf8');
const bad = {
  'empty.yaml': '',
  'list.yaml': '- 1\n- 2\n',
  'bracket.yaml': 'poise: 1\ndimension: 2\nobject: {weight: 10, com: [0, 0}\n',
  'tab.yaml': 'poise: 1\nobject:\n\tweight: 10\n\tcom: [0, 0]\n',
  'bytes.yaml': Buffer.from([0x70, 0xe9, 0x0a]),
  'key.yaml': good.replace('friction: 0.3', 'fricton: 0.3'),
  'negative.yaml': good.replace('mass: 0.75', 'mass: -0.75'),
  'markup.yaml': good.replace('finger: left', '"<img src=x onerror=alert(1)>": 1'),
  'picture.png': Buffer.from('89504e470d0a1a0a', 'hex'),
  'large.yaml': `# ${'x'.repeat(2 ** 20)}\n`,
  'twice.json': '{"poise": 1, "dimension": 2, "dimension": 3}',
};
const state = await seen();
for (const [name, text] of Object.entries(bad)) {
  writeFileSync(`${out}files/${name}`, text);
  await drop(name, Buffer.from(text));
  const words = poise('check', name).stderr.trim().replace(/^poise: /, '');
  expect(words !== '' && (await page.textContent('#problem')) === words, name, words, await page.textContent('#problem'));
  expect((await seen()).join() === state.join(), `${name}: nothing is lost`);
}
expect((await page.locator('img').count()) === 0, 'words from a file are never markup');

// Names full of markup, also within the page of `poise view`.
const markup = '</script><img src=x onerror=alert(1)>';
const named = { ...JSON.parse(readFileSync(`${root}build/fixtures/box-soft-jaws.grasp.json`, 'utf8')), name: markup };
named.contacts[0].finger = markup;
await drop('named.json', Buffer.from(JSON.stringify(named)));
await settled(page);
expect((await page.locator('#preset option:checked').textContent()) === markup, 'the name is shown as it is');
execFileSync(`${root}build/poise`, ['view', '-', '-o', `${out}view-space.html`], { input: JSON.stringify(named) });
const viewed = await open(`${out}view-space.html`);
await settled(viewed);
for (const each of [page, viewed]) {
  expect((await each.locator('img').count()) === 0, 'a name is never markup');
  expect((await each.textContent('#space')).includes('</script>'), 'a finger has its name', await each.textContent('#space'));
}
await viewed.close();

// Nothing leaves the page, even if it wanted to.
const quiet = await browser.newPage();
quiet.setDefaultTimeout(patience);
await quiet.goto(`file://${built}`);
await quiet.waitForSelector('body[data-ready="1"]');
const refused = await quiet.evaluate(async () => {
  const broken = [];
  document.addEventListener('securitypolicyviolation', (event) => broken.push(event.effectiveDirective));
  await fetch('https://localhost/').catch(() => {});
  await new Promise((done) => Object.assign(new Image(), { src: 'https://localhost/x.png', onerror: done, onload: done }));
  return broken.sort().join();
});
expect(refused === 'connect-src,img-src', 'the policy refuses requests', refused);
await quiet.close();

for (const colorScheme of ['light', 'dark'])
  for (const [name, size] of [['space', { width: 1280, height: 900 }], ['phone-space', { width: 390, height: 844 }]]) {
    const shot = await open(built, { ...size, colorScheme });
    await shot.selectOption('#preset', { label: 'cylinder in three fingers' });
    await settled(shot);
    await frame(shot);
    const { scroll, client } = await shot.evaluate(() => ({ scroll: document.documentElement.scrollWidth, client: document.documentElement.clientWidth }));
    const cut = await shot.$$eval('.scroll', (all) => all.filter((each) => each.scrollWidth > each.clientWidth).length);
    expect(cut === 0, 'no table is cut');
    expect(scroll <= client, 'nothing is wider than the window', scroll, client);
    await shot.screenshot({ path: `${out}${name}-${colorScheme}.png`, fullPage: name !== 'space' });
    await shot.close();
  }

await finish();

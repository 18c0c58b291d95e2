// The page as its users meet it, in Chromium. Pictures go to out/page/.
import { mkdirSync } from 'node:fs';
import { chromium } from 'playwright-core';

export const root = new URL('../../', import.meta.url).pathname;
export const out = `${root}out/page/`;
mkdirSync(out, { recursive: true });

let failures = 0;
export function expect(holds, what, ...seen) {
  if (holds) return;
  ++failures;
  console.error('FAILED', what, ...seen);
}
export const near = (a, b, relative = 1e-9) => Math.abs(a - b) <= relative * Math.max(Math.abs(a), Math.abs(b), 1);

/** Waits end as soon as what they wait for is there; this is for a machine with much else to do. */
export const patience = 180000;

export const browser = await chromium.launch({
  timeout: patience,
  executablePath: '/usr/bin/chromium',
  args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--disable-quic', '--no-first-run', '--disable-sync',
    '--disable-background-networking', '--disable-component-update'],
});

export async function open(file, { width = 1280, height = 800, colorScheme = 'light', deviceScaleFactor = 1 } = {}) {
  const page = await browser.newPage({ viewport: { width, height }, colorScheme, deviceScaleFactor });
  page.setDefaultTimeout(patience);
  // Under load the browser now and then has no picture yet; the pictures are for people.
  const picture = page.screenshot.bind(page);
  page.screenshot = (options) => picture(options).catch(() => picture(options));
  page.on('console', (message) => expect(false, 'a console message', message.text()));
  page.on('pageerror', (error) => expect(false, 'an error', error.stack));
  page.on('request', (request) => expect(/^(file|data|blob):/.test(request.url()), 'a request', request.url()));
  const begin = performance.now();
  await page.goto(`file://${file}`);
  await page.waitForSelector('body[data-ready="1"]');
  page.ready = Math.round(performance.now() - begin);
  return page;
}
export const frame = (page) => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
export const verdict = (page) => page.textContent('#verdict');
export const minima = (page) =>
  page.$$eval('#minima button', (all) => all.map(({ dataset }) => ({ angle: +dataset.angle, value: +dataset.value })));
export async function choose(page, label) {
  await page.selectOption('#preset', { label });
  await frame(page);
}
/** What is to be least: grip or effort. */
export async function minimise(page, objective) {
  await page.check(`[name=objective][value=${objective}]`, { force: true });
  await frame(page);
}
export const objective = (page) => page.$eval('[name=objective]:checked', (each) => each.value);
export async function drag(page, selector, dx, dy) {
  const box = await page.$eval(selector, (each) => each.getBoundingClientRect().toJSON());
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + dx / 2, y + dy / 2);
  await page.mouse.move(x + dx, y + dy);
  await frame(page);
  await page.mouse.up();
}

/** In space: everything there is to know has come from the worker. */
export const settled = (page) => page.waitForSelector('body[data-settled="1"]');

/** What the turn takes has been told. What was just changed asks for it with the next frame. */
export const turnTold = async (page) => {
  await frame(page);
  await page.waitForFunction(() => [...document.querySelectorAll('#turn > div:not([hidden])')].every((each) => each.ariaBusy === 'false'));
};
/** Its heading, its words, its buttons. */
export const turnSaid = (page) => page.evaluate(() => {
  const turn = document.querySelector('#turn > div:not([hidden])');
  return { head: turn.querySelector('h2').textContent, words: turn.querySelector('p').textContent, buttons: [...turn.querySelectorAll('button:not([hidden])')].map((each) => each.ariaLabel) };
});

/** What the posture withstands, as soon as that is known; in its numbers. */
export const withstood = async (page) => {
  await frame(page);
  await page.waitForFunction(() => document.querySelector('#withstands').ariaBusy === 'false');
  const words = await page.textContent('#withstands');
  const [, some, along] = words.match(/^Pressing harder, it withstands ([\d.]+) m\/s² in any direction, weakest along \((.*?)\), and /) ?? [];
  const [, tilt] = words.match(/, and a tilt of ([\d.]+)°\.$/) ?? [];
  const acceleration = some ? +some : words.startsWith('Pressing harder, it withstands any acceleration, and ') ? Infinity : NaN;
  return { words, acceleration, along: along?.split(', ').map(Number), tilt: tilt ? +tilt : words.endsWith(', and any tilt.') ? 180 : NaN };
};
/** Whether nothing is said of it whenever another posture is shown, while something is done. */
export async function unsaidMeanwhile(page, act) {
  await page.evaluate(() => {
    const said = (document.querySelector('#withstands').said = []);
    new MutationObserver(() => said.push(document.querySelector('#withstands').textContent)).observe(document.querySelector('#verdict'), { childList: true, subtree: true });
  });
  await act();
  await frame(page);
  const said = await page.$eval('#withstands', (each) => each.said);
  expect(said.length > 0 && said.every((words) => words === ''), 'nothing is said of what is withstood while it moves', said);
}
/** As the program tells it, whose bounds are no farther than 1e-3 from what it found. */
export function sameShake(found, { shake, tilt_deg }, what) {
  expect((found.acceleration === shake.acceleration || near(found.acceleration, shake.acceleration, 2e-3)) && near(found.tilt, tilt_deg, 2e-3), `${what}: what is withstood`, found, shake.acceleration, tilt_deg);
}

/** The verdict, as soon as it begins so: that may soon be over. */
export const verdictAt = async (page, words) => (await page.waitForFunction((begin) => {
  const text = document.querySelector('#verdict').textContent;
  return text.startsWith(begin) && text;
}, words)).jsonValue();

/** Plays a course and stops it after an angle, within the page, as no other clock can be relied on. Gives what the button says before. */
export const playAndStop = (page, course, after) => page.evaluate(([name, angle]) => new Promise((done) => {
  const turn = document.querySelector('#turn > div:not([hidden])');
  const button = turn.querySelector(`button[aria-label="Play ${name}"]`);
  button.click();
  const look = () => {
    if (!(turn.querySelector('.posture').ariaValueNow > angle)) return requestAnimationFrame(look);
    const label = button.ariaLabel;
    button.click();
    done(label);
  };
  requestAnimationFrame(look);
}), [course, after]);

export async function finish() {
  await browser.close();
  console.log(failures ? `${failures} failures` : `The page is as it should be; pictures in ${out}`);
  process.exit(failures ? 1 : 0);
}

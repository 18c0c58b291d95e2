// Draws the pictures of the page for README.md and docs/: npm --prefix web run pictures
import { choose, finish, frame, open, root, settled } from './test/browser.mjs';

const built = `${root}web/dist/playground.html`;
const size = { width: 1280, height: 826, deviceScaleFactor: 1.5 };
// The last words come when nothing has moved for a while.
const told = (page) => page.waitForFunction(() => document.querySelector('#why').textContent.includes('Pressing harder') && document.querySelector('#withstands').ariaBusy === 'false');

const plane = await open(built, size);
await told(plane);
await plane.screenshot({ path: `${root}docs/pictures/page.png` });

const space = await open(built, { ...size, height: 804 });
await choose(space, 'cylinder in three fingers');
await settled(space);
await space.check('#certificate');
await told(space);
await frame(space);
await space.screenshot({ path: `${root}docs/pictures/page-space.png` });

await finish();

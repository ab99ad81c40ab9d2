// The page in a browser: browser.mjs CHROMIUM FOLDER NAME MODE, one JSON object of what was seen.
// MODE: view, still (no slider is moved), or picture (no WebGL). The network is cut off, and whatever asks for it is counted.
import puppeteer from 'puppeteer-core';
import { createHash } from 'node:crypto';
import { pathToFileURL } from 'node:url';

const [chromium, folder, name, mode] = process.argv.slice(2);
const args = ['--no-sandbox', '--disable-dev-shm-usage'];
args.push(...(mode !== 'picture' ? ['--use-angle=swiftshader', '--enable-unsafe-swiftshader'] : ['--disable-gpu', '--disable-3d-apis']));
const browser = await puppeteer.launch({ executablePath: chromium, args, headless: true });
const seen = { console: [], errors: [], requests: [] };

const text = (page, selector) => page.$eval(selector, (element) => element.textContent);
// Until a flight of the view is over and drawn, however slow a frame is: it ends with the first frame after its 500 ms,
// the frame after that draws it, and one more may hold a time from before.
const settle = (page) => page.evaluate(() => new Promise((done) => {
  const frames = (left) => (left ? requestAnimationFrame(() => frames(left - 1)) : done());
  setTimeout(() => frames(4), 600);
}));

async function canvas(page) {
  const picture = await (await page.$('#canvas')).screenshot();
  return createHash('sha256').update(picture).digest('hex');
}

async function state(page) {
  const cell = (id) => page.$$eval(`#${id} td`, (cells) => cells.map((c) => c.textContent));
  return { tolerance: await text(page, '#tolerance'), within: await cell('within'), undecided: await cell('undecided'),
    beyond: await cell('beyond'), value: await page.$eval('#slider', (s) => s.getAttribute('aria-valuenow')),
    canvas: mode !== 'picture' ? await canvas(page) : null };
}

async function lookAtSlider(page) {
  seen.start = await state(page);
  await page.focus('#slider');
  for (const key of ['Home', 'ArrowRight', 'PageUp', 'End']) {
    await page.keyboard.press(key);
    await settle(page);
    seen[key] = await state(page);
  }
  const box = await (await page.$('#slider')).boundingBox();
  await page.mouse.move(box.x + box.width * 0.9, box.y + box.height / 2);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width * 0.3, box.y + box.height / 2, { steps: 4 });
  await page.mouse.up();
  await settle(page);
  seen.dragged = await state(page);
}

async function lookAtView(page) {
  await page.click('.places:not([hidden]) li:nth-child(3) button');
  await settle(page);
  seen.mark = await page.$eval('#mark', (mark) => ({ hidden: mark.hidden, label: mark.textContent, ...mark.getBoundingClientRect().toJSON() }));
  seen.stage = await page.$eval('#canvas', (c) => c.getBoundingClientRect().toJSON());
  seen.pressed = await text(page, '.places button[aria-pressed="true"]');
  seen.place = await canvas(page);
  await page.click('#scale');
  await settle(page);
  seen.log = await canvas(page);
  if (await page.$('[data-direction="1"]')) {
    await page.click('[data-direction="1"]');
    await page.waitForSelector('body[data-shown="1"]');
    await settle(page);
    seen.back = { ...(await state(page)), mesh: await text(page, '#tally-mesh') };
    await page.click('[data-direction="0"]');
    await settle(page);
  }
}

try {
  const page = await browser.newPage();
  await page.setViewport({ width: 1400, height: 1600 });
  page.on('console', (message) => seen.console.push(message.text()));
  page.on('pageerror', (error) => seen.errors.push(String(error)));
  page.on('request', (request) => seen.requests.push(request.url().slice(0, 80)));
  await page.setOfflineMode(true);
  await page.goto(pathToFileURL(`${folder}/${name}.html`).href);
  await page.waitForSelector('body[data-ready]', { timeout: 60000 });
  if (mode !== 'picture') await page.waitForSelector('body[data-shown]', { timeout: 60000 });
  await settle(page);
  seen.ready = await page.$eval('body', (body) => body.dataset.ready);
  seen.title = await page.title();
  seen.word = await text(page, '#word');
  seen.words = await text(page, '#words');
  seen.digits = await text(page, '#digits');
  seen.answer = await text(page, '#answer');
  seen.data = JSON.parse(await text(page, '#data'));
  seen.shown = await page.$$eval('.stage figure img, .stage figure p', (all) =>
    all.filter((e) => e.offsetParent !== null).map((e) => e.textContent || `${e.naturalWidth}x${e.naturalHeight}`));
  seen.wide = await page.evaluate(() => document.documentElement.scrollWidth <= window.innerWidth);
  if (mode === 'still') seen.start = await state(page);
  else await lookAtSlider(page);
  if (mode === 'view') await lookAtView(page);
  await page.pdf({ path: `${folder}/${name}-${mode}.pdf`, preferCSSPageSize: true, printBackground: true });
  await page.setViewport({ width: 390, height: 844 });
  await settle(page);
  seen.narrow = await page.evaluate(() => document.documentElement.scrollWidth <= window.innerWidth);
  console.log(JSON.stringify(seen));
} finally {
  await browser.close();
}

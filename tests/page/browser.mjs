// The page in a browser: browser.mjs CHROMIUM FOLDER NAME MODE, one JSON object of what was seen.
// MODE: view, still (no slider is moved), picture (no WebGL), or index (of a batch). The network is cut off, and every request is counted.
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
  return { tolerance: await text(page, '#tolerance'), within: await text(page, '#within td'), beyond: await text(page, '#beyond td'),
    value: await page.$eval('#slider', (s) => s.getAttribute('aria-valuenow')),
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

// The place that is looked at lies in the middle.
async function lookUnderCursor(page) {
  const { x, y, width, height } = seen.stage;
  await page.mouse.move(x + width / 2, y + height / 2);
  await settle(page);
  seen.read = await text(page, '#readout');
  await page.mouse.click(x + width / 2, y + height / 2);
  await page.mouse.move(1, 1);
  await settle(page);
  seen.kept = await text(page, '#readout');
}

async function lookAtPrint(page) {
  await page.setViewport({ width: 703, height: 1035 });  // A4 without its margins
  await page.emulateMediaType('print');
  await settle(page);
  seen.printed = await page.evaluate(() => {
    const height = document.documentElement.clientHeight;
    const box = (e) => e.getBoundingClientRect().toJSON();
    const isInside = (inner, outer) => inner.bottom <= outer.bottom + 1 && inner.right <= outer.right + 1;
    const isWhole = (e) => [...e.querySelectorAll('tr, li')].filter((row) => row.offsetParent).every((row) => isInside(box(row), box(e)));
    return { height, figures: [...document.querySelectorAll('.way figure')].map(box), footer: box(document.querySelector('footer')),
      whole: [...document.querySelectorAll('.way .places, .way .numbers')].map(isWhole) };
  });
  await page.emulateMediaType('screen');
}

async function lookAtView(page) {
  seen.places = await page.$$eval('.way:not(.other) .places .length', (all) => all.map((e) => e.textContent));
  await page.click('.way:not(.other) .places li:last-child button');
  await settle(page);
  seen.mark = await page.$eval('#mark', (mark) => ({ hidden: mark.hidden, label: mark.textContent, ...mark.getBoundingClientRect().toJSON() }));
  seen.stage = await page.$eval('#canvas', (c) => c.getBoundingClientRect().toJSON());
  seen.pressed = await text(page, '.places button[aria-pressed="true"]');
  seen.place = await canvas(page);
  await lookUnderCursor(page);
  seen.views = [];
  for (const name of ['+z', '-x', 'corner']) {
    await page.click(`[data-view="${name}"]`);
    await settle(page);
    seen.views.push(await canvas(page));
  }
  seen.axes = await page.$$eval('#axes line', (all) => all.map((line) => Math.hypot(line.x2.baseVal.value, line.y2.baseVal.value)));
  seen.ruler = { text: await text(page, '#ruler span'), width: await page.$eval('#ruler i', (i) => i.getBoundingClientRect().width) };
  await page.click('#scale');
  await settle(page);
  seen.log = await canvas(page);
  if (await page.$('[data-direction="1"]')) {
    await page.click('[data-direction="1"]');
    await page.waitForSelector('body[data-shown="1"]');
    await settle(page);
    seen.back = { ...(await state(page)), mesh: await text(page, '.tally-of') };
    await page.click('[data-direction="0"]');
    await settle(page);
  }
}

async function lookAtIndex(page) {
  await page.setViewport({ width: 390, height: 844 });
  await page.goto(pathToFileURL(`${folder}/${name}.html`).href);
  seen.rows = await page.$$eval('tbody tr', (rows) => rows.map((row) => [...row.children].map((cell) => cell.textContent)));
  seen.links = await page.$$eval('tbody a', (all) => all.map((a) => a.getAttribute('href')));
  seen.narrow = await page.evaluate(() => document.documentElement.scrollWidth <= window.innerWidth);
  seen.labels = await page.$$eval('tbody tr:first-child td[data-name]', (all) => all.map((cell) => getComputedStyle(cell, '::before').content));
  seen.least = await page.$$eval('tbody td, tbody th, p, small', (all) => Math.min(...all.map((e) => parseFloat(getComputedStyle(e).fontSize))));
}

async function lookAtPage(page) {
  await page.setViewport({ width: 1400, height: 1600 });
  await page.goto(pathToFileURL(`${folder}/${name}.html`).href);
  await page.waitForSelector('body[data-ready]', { timeout: 60000 });
  if (mode !== 'picture') await page.waitForSelector('body[data-shown]', { timeout: 60000 });
  await settle(page);
  seen.ready = await page.$eval('body', (body) => body.dataset.ready);
  seen.title = await page.title();
  seen.word = await text(page, '#word');
  seen.words = await text(page, '#words');
  seen.run = await page.$$eval('.run code', (all) => all.map((e) => e.textContent));
  seen.answer = await text(page, '#answer');
  seen.data = JSON.parse(await text(page, '#data'));
  seen.shown = await page.$$eval('.no-webgl, .way figure img, .way figure p', (all) =>
    all.filter((e) => e.offsetParent !== null).map((e) => e.textContent || `${e.naturalWidth}x${e.naturalHeight}`));
  seen.rows = await page.$$eval('.legend:not([hidden]) li', (all) => all.map((e) => e.textContent));
  seen.ticks = await page.$$eval('.legend:not([hidden]) .tick', (all) => all.map((e) => e.textContent));
  seen.title_of_bar = await text(page, '.legend:not([hidden]) .what');
  seen.wide = await page.evaluate(() => document.documentElement.scrollWidth <= window.innerWidth);
  if (mode === 'still') seen.start = await state(page);
  else await lookAtSlider(page);
  if (mode === 'view') await lookAtView(page);
  await page.pdf({ path: `${folder}/${name}-${mode}.pdf`, preferCSSPageSize: true, printBackground: true });
  await lookAtPrint(page);
  await page.setViewport({ width: 390, height: 844 });
  await settle(page);
  seen.narrow = await page.evaluate(() => document.documentElement.scrollWidth <= window.innerWidth);
}

try {
  const page = await browser.newPage();
  page.on('console', (message) => seen.console.push(message.text()));
  page.on('pageerror', (error) => seen.errors.push(String(error)));
  page.on('request', (request) => seen.requests.push(request.url().slice(0, 80)));
  await page.setOfflineMode(true);
  await (mode === 'index' ? lookAtIndex(page) : lookAtPage(page));
  console.log(JSON.stringify(seen));
} finally {
  await browser.close();
}

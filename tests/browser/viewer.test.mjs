import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { coloursOf, openBrowser, VIEWER } from './browser.mjs';
import { FOLDER, LAYERS, stepwise, STREAM } from './test-samples.mjs';

let browser;
before(async () => (browser = await openBrowser([VIEWER, FOLDER], { handle: stepwise() })));
after(() => browser.close());

const stat = (page, name) => page.locator(`[data-stat=${name}]`).textContent();

/** Waits until the figure is known. */
const settled = (page, name) =>
  page.waitForFunction(
    (selector) => /\d/.test(document.querySelector(selector).textContent),
    `[data-stat=${name}]`,
  );

/** Waits until the figure differs from a text. */
const changed = (page, name, text) =>
  page.waitForFunction(
    ([selector, old]) => document.querySelector(selector).textContent !== old,
    [`[data-stat=${name}]`, text],
  );

/** Waits until the figure is a text. */
const returned = (page, name, text) =>
  page.waitForFunction(
    ([selector, wanted]) => document.querySelector(selector).textContent === wanted,
    [`[data-stat=${name}]`, text],
  );

test('isostar and Draco are shown, without errors or warnings', async () => {
  const page = await browser.open('?rate=20&sample=gyroid');
  await Promise.all([settled(page, 'isostar-complete'), settled(page, 'draco-complete')]);
  assert.match(await page.locator('#readout').textContent(), /complete/);
  assert.equal(await stat(page, 'draco-vertices'), '34,834');
  assert.match(await page.locator('#headline').textContent(), /smaller|larger/);
  assert.ok((await coloursOf(page, '#stage')) > 200, 'the picture is not blank');
  assert.deepEqual(browser.complaints, []);
  await page.close();
});

test('every layer is shown as its bytes arrive', async () => {
  const page = await browser.open('?rate=Infinity&sample=stepwise');
  const seen = await page.evaluate(
    (layers) =>
      new Promise((resolve) => {
        const seen = new Set();
        const readout = document.querySelector('#readout');
        const look = () => {
          if (!readout.querySelector('b')) return;
          seen.add(readout.textContent);
          if (seen.size === layers) resolve([...seen]);
          else void fetch('next-layer');
        };
        new MutationObserver(look).observe(readout, { childList: true });
        look();
      }),
    LAYERS.length,
  );
  assert.match(seen.at(-1), /complete/);
  await settled(page, 'isostar-complete');
  assert.equal(await page.locator('.ticks i').count(), LAYERS.length);
  assert.deepEqual(browser.complaints, []);
  await page.close();
});

test('the page handles input between two surfaces', async () => {
  const page = await browser.open('?rate=Infinity&sample=stepwise');
  await settled(page, 'isostar-first');
  await page.locator('#wireframe').click();
  assert.equal(await page.locator('#wireframe').getAttribute('aria-pressed'), 'true');
  assert.doesNotMatch(await page.locator('#readout').textContent(), /complete/);
  await page.evaluate(async (layers) => {
    for (let i = 1; i < layers; i++) await fetch('next-layer');
  }, LAYERS.length);
  await settled(page, 'isostar-complete');
  assert.deepEqual(browser.complaints, []);
  await page.close();
});

test('the slider chooses a prefix, the buttons a layer', async () => {
  const page = await browser.open('?rate=Infinity&sample=gyroid');
  await settled(page, 'isostar-complete');
  const whole = await stat(page, 'isostar-vertices');
  const last = await stat(page, 'isostar-bytes');
  await page.locator('#back').click();
  await changed(page, 'isostar-bytes', last);
  await page.locator('#prefix').fill('300');
  await changed(page, 'isostar-vertices', whole);
  assert.doesNotMatch(await page.locator('#readout').textContent(), /complete/);
  await page.locator('#prefix').fill('1000');
  await returned(page, 'isostar-vertices', whole);
  assert.deepEqual(browser.complaints, []);
  await page.close();
});

test('the isovalue slider shows values between, and is hidden for one isovalue', async () => {
  const page = await browser.open('?rate=Infinity&sample=gyroid');
  await settled(page, 'isostar-complete');
  assert.ok(await page.locator('#isovalue').isHidden());
  await page.locator('#sample').selectOption('several');
  await page.locator('#isovalue').waitFor({ state: 'visible' });
  await settled(page, 'isostar-complete');
  const first = await stat(page, 'isostar-vertices');
  const picture = await page.locator('#stage').screenshot();
  await page.locator('#level').fill('150');
  await changed(page, 'isostar-vertices', first);
  assert.match(await page.locator('#isovalue output').textContent(), /in between/);
  await page.waitForTimeout(300);
  assert.notDeepEqual(await page.locator('#stage').screenshot(), picture);
  await page.locator('#level').fill('0');
  await returned(page, 'isostar-vertices', first);
  await page.locator('#level').fill('400');
  await page.waitForFunction(
    () => document.querySelector('#isovalue output').textContent === '0.5',
  );
  assert.deepEqual(browser.complaints, []);
  await page.close();
});

test('chunks can be coloured, where there are any', async () => {
  const page = await browser.open('?rate=Infinity&sample=gyroid');
  await settled(page, 'isostar-complete');
  assert.ok(await page.locator('#chunks').isHidden());
  await page.locator('#sample').selectOption('chunked');
  await page.locator('#chunks').waitFor({ state: 'visible' });
  await settled(page, 'isostar-complete');
  await page.waitForTimeout(500);
  const picture = () => page.locator('#picture').screenshot();
  const plain = await picture();
  await page.keyboard.press('k');
  assert.equal(await page.locator('#chunks').getAttribute('aria-pressed'), 'true');
  for (let tries = 0; tries < 20 && (await picture()).equals(plain); tries++)
    await page.waitForTimeout(100);
  assert.notDeepEqual(await picture(), plain);
  assert.deepEqual(browser.complaints, []);
  await page.close();
});

test('polygonizer, wireframe, comparison, keys', async () => {
  const page = await browser.open('?rate=Infinity&sample=gyroid');
  await settled(page, 'isostar-complete');
  const cubes = await stat(page, 'isostar-triangles');
  await page.locator('input[value=tetrahedra]').check();
  await changed(page, 'isostar-triangles', cubes);
  const before = await page.locator('#stage').screenshot();
  await page.keyboard.press('w');
  await page.waitForTimeout(500);
  assert.equal(await page.locator('#wireframe').getAttribute('aria-pressed'), 'true');
  assert.notDeepEqual(await page.locator('#stage').screenshot(), before);
  await page.keyboard.press('c');
  await page.locator('[data-pane=draco]').waitFor({ state: 'hidden' });
  const unturned = await page.locator('#stage').screenshot();
  await page.locator('#picture').focus();
  await page.keyboard.press('ArrowLeft');
  await page.waitForTimeout(500);
  assert.notDeepEqual(await page.locator('#stage').screenshot(), unturned);
  assert.deepEqual(browser.complaints, []);
  await page.close();
});

test('a damaged file is reported; the user can open another one', async () => {
  const page = await browser.open('?rate=Infinity&sample=broken');
  await page.locator('#message').waitFor({ state: 'visible' });
  assert.match(await page.locator('#message').textContent(), /damaged|too early/);
  await page.locator('#file').setInputFiles(STREAM);
  await settled(page, 'isostar-complete');
  assert.ok(await page.locator('#message').isHidden());
  await page.close();
});

test('nothing overflows on a phone', async () => {
  const page = await browser.open('?rate=Infinity&sample=gyroid');
  await page.setViewportSize({ width: 390, height: 844 });
  await settled(page, 'isostar-complete');
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
  await page.close();
});

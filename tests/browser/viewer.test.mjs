import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { coloursOf, openBrowser, VIEWER } from './page.mjs';
import { FOLDER, LAYERS, slowly, STREAM } from './samples.mjs';

let browser;
before(async () => (browser = await openBrowser([VIEWER, FOLDER], { handle: slowly })));
after(() => browser.close());

const stat = (page, name) => page.locator(`[data-stat=${name}]`).textContent();
const settled = (page, name) => page.waitForFunction((selector) => /\d/.test(document.querySelector(selector).textContent), `[data-stat=${name}]`);

test('a surface and its rival are shown, without a complaint', async () => {
  const page = await browser.open('?rate=20&sample=gyroid');
  await Promise.all([settled(page, 'isostar-complete'), settled(page, 'draco-complete')]);
  assert.match(await page.locator('#readout').textContent(), /complete/);
  assert.equal(await stat(page, 'draco-vertices'), '34,834');
  assert.match(await page.locator('#headline').textContent(), /smaller|larger/);
  assert.ok((await coloursOf(page, '#stage')) > 200, 'the picture is not blank');
  assert.deepEqual(browser.complaints, []);
  await page.close();
});

test('every refinement is seen as its bytes arrive', async () => {
  const page = await browser.open('?rate=Infinity&sample=slow');
  await page.evaluate(() => {
    window.seen = new Set();
    new MutationObserver(() => window.seen.add(document.querySelector('#readout b')?.textContent)).observe(document.querySelector('#readout'), { childList: true });
  });
  await settled(page, 'isostar-complete');
  const seen = await page.evaluate(() => [...window.seen]);
  assert.ok(seen.length >= LAYERS.length - 1, `${seen.length} of ${LAYERS.length}: ${seen.join('; ')}`);  // the first may have been before we looked
  assert.equal(await page.locator('.ticks i').count(), LAYERS.length);
  assert.deepEqual(browser.complaints, []);
  await page.close();
});

/** The longest that the page would have let an input wait, from the first surface to the last. */
async function longestWait() {
  const page = await browser.open('?rate=Infinity&sample=slow');
  await settled(page, 'isostar-first');
  const longest = await page.evaluate(async () => {
    let longest = 0;
    const isOver = () => /\d/.test(document.querySelector('[data-stat=isostar-complete]').textContent);
    const { port1, port2 } = new MessageChannel();
    while (!isOver()) {
      const start = performance.now();
      await new Promise((resolve) => { port1.onmessage = resolve; port2.postMessage(0); });
      longest = Math.max(longest, performance.now() - start);
      await new Promise((resolve) => setTimeout(resolve, 4));
    }
    return longest;
  });
  await page.close();
  return longest;
}

test('the page answers within 50 ms while surfaces arrive', async () => {
  // The best of some: a machine that is busy with other things adds to any one of them.
  let longest = Infinity;
  for (let i = 0; i < 4 && longest >= 50; i++) longest = Math.min(longest, await longestWait());
  assert.ok(longest < 50, `${longest.toFixed(1)} ms`);
});

test('the slider goes back over prefixes, the buttons from layer to layer', async () => {
  const page = await browser.open('?rate=Infinity&sample=gyroid');
  await settled(page, 'isostar-complete');
  const whole = await stat(page, 'isostar-vertices');
  await page.locator('#back').click();
  await page.waitForFunction((text) => document.querySelector('[data-stat=isostar-bytes]').textContent !== text, await stat(page, 'isostar-bytes'));
  await page.locator('#prefix').fill('300');
  await page.waitForFunction((text) => document.querySelector('[data-stat=isostar-vertices]').textContent !== text, whole);
  assert.doesNotMatch(await page.locator('#readout').textContent(), /complete/);
  await page.locator('#prefix').fill('1000');
  await page.waitForFunction((text) => document.querySelector('[data-stat=isostar-vertices]').textContent === text, whole);
  assert.deepEqual(browser.complaints, []);
  await page.close();
});

test('the isovalue slider shows what lies between, and is not there for one isovalue', async () => {
  const page = await browser.open('?rate=Infinity&sample=gyroid');
  await settled(page, 'isostar-complete');
  assert.ok(await page.locator('#isovalue').isHidden());
  await page.locator('#sample').selectOption('several');
  await page.locator('#isovalue').waitFor({ state: 'visible' });
  await settled(page, 'isostar-complete');
  const first = await stat(page, 'isostar-vertices'), picture = await page.locator('#stage').screenshot();
  await page.locator('#level').fill('150');
  await page.waitForFunction((text) => document.querySelector('[data-stat=isostar-vertices]').textContent !== text, first);
  assert.match(await page.locator('#isovalue output').textContent(), /in between/);
  await page.waitForTimeout(300);
  assert.notDeepEqual(await page.locator('#stage').screenshot(), picture);
  await page.locator('#level').fill('0');
  await page.waitForFunction((text) => document.querySelector('[data-stat=isostar-vertices]').textContent === text, first);
  await page.locator('#level').fill('400');
  await page.waitForFunction(() => document.querySelector('#isovalue output').textContent === '0.5');
  assert.deepEqual(browser.complaints, []);
  await page.close();
});

test('polygonizer, wireframe, comparison, keys', async () => {
  const page = await browser.open('?rate=Infinity&sample=gyroid');
  await settled(page, 'isostar-complete');
  const cubes = await stat(page, 'isostar-triangles');
  await page.locator('input[value=tetrahedra]').check();
  await page.waitForFunction((text) => document.querySelector('[data-stat=isostar-triangles]').textContent !== text, cubes);
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

test('a file of the person’s own; a damaged one is told of', async () => {
  const page = await browser.open('?rate=Infinity&sample=broken');
  await page.locator('#message').waitFor({ state: 'visible' });
  assert.match(await page.locator('#message').textContent(), /damaged|too early/);
  await page.locator('#file').setInputFiles(STREAM);
  await settled(page, 'isostar-complete');
  assert.ok(await page.locator('#message').isHidden());
  await page.close();
});

test('nothing overflows on a telephone', async () => {
  const page = await browser.open('?rate=Infinity&sample=gyroid');
  await page.setViewportSize({ width: 390, height: 844 });
  await settled(page, 'isostar-complete');
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
  await page.close();
});

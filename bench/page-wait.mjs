// `npm run bench:page`, after npm run build: the longest time for which the viewer's page blocks
// input while surfaces arrive.
import { openBrowser, VIEWER } from '../tests/browser/browser.mjs';
import { FOLDER, LAYERS, stepwise } from '../tests/browser/test-samples.mjs';
import { addLongestWait } from './measure/longest-wait.mjs';

const ROUNDS = 4;
const LAYER_INTERVAL = 400; // milliseconds

/** Runs in the page: the longest wait for a message, from the first surface to the last. */
async function longestWait(interval) {
  const isComplete = () =>
    /\d/.test(document.querySelector('[data-stat=isostar-complete]').textContent);
  const timer = setInterval(() => void fetch('next-layer'), interval);
  const longest = await window.longestWaitUntil(isComplete);
  clearInterval(timer);
  return longest;
}

const browser = await openBrowser([VIEWER, FOLDER], { handle: stepwise() });
const waits = [];
for (let round = 0; round < ROUNDS; round++) {
  const page = await browser.open('?rate=Infinity&sample=stepwise');
  await page.waitForFunction(() =>
    /\d/.test(document.querySelector('[data-stat=isostar-first]').textContent),
  );
  await addLongestWait(page);
  waits.push(await page.evaluate(longestWait, LAYER_INTERVAL));
  await page.close();
}
await browser.close();
const list = waits.map((wait) => wait.toFixed(1)).join(', ');
console.log(`longest wait of ${LAYERS.length} layers, ${ROUNDS} rounds: ${list} ms`);

// `npm run bench:page`, after npm run build: the longest time for which the viewer's page blocks
// input while surfaces arrive.
import { openBrowser, VIEWER } from '../tests/browser/browser.mjs';
import { FOLDER, LAYERS, stepwise } from '../tests/browser/test-samples.mjs';

const ROUNDS = 4;
const LAYER_INTERVAL = 400; // milliseconds

/** Runs in the page: the longest wait for a message, from the first surface to the last. */
async function longestWait(interval) {
  const isComplete = () =>
    /\d/.test(document.querySelector('[data-stat=isostar-complete]').textContent);
  const timer = setInterval(() => void fetch('next-layer'), interval);
  const { port1, port2 } = new MessageChannel();
  let longest = 0;
  while (!isComplete()) {
    const start = performance.now();
    await new Promise((resolve) => {
      port1.onmessage = resolve;
      port2.postMessage(0);
    });
    longest = Math.max(longest, performance.now() - start);
    await new Promise((resolve) => setTimeout(resolve, 4));
  }
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
  waits.push(await page.evaluate(longestWait, LAYER_INTERVAL));
  await page.close();
}
await browser.close();
const list = waits.map((wait) => wait.toFixed(1)).join(', ');
console.log(`longest wait of ${LAYERS.length} layers, ${ROUNDS} rounds: ${list} ms`);

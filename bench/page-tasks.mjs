// `node bench/page-tasks.mjs STREAM`, after npm run build: for how long a page's main thread is
// busy at once while a stream is fetched and decoded in workers, each surface handed to the page.
import { copyFileSync } from 'node:fs';
import { join } from 'node:path';
import { openBrowser } from '../tests/browser/browser.mjs';
import { makePage } from '../tests/browser/package-page.mjs';

/** Runs in the page: long tasks as the browser counts them, and the longest wait for a message. */
async function observe() {
  const limits = { memory: Infinity, decisions: Infinity };
  const decoder = await window.createDecoder({ limits });
  const longTasks = [];
  const observer = new PerformanceObserver((list) =>
    longTasks.push(...list.getEntries().map(({ duration }) => duration)),
  );
  observer.observe({ type: 'longtask' });
  const { port1, port2 } = new MessageChannel();
  let [longestWait, isRunning] = [0, true];
  const waits = (async () => {
    while (isRunning) {
      const start = performance.now();
      await new Promise((resolve) => {
        port1.onmessage = resolve;
        port2.postMessage(0);
      });
      longestWait = Math.max(longestWait, performance.now() - start);
      await new Promise((resolve) => setTimeout(resolve, 4));
    }
  })();
  let [surfaces, triangles] = [0, 0];
  for await (const surface of decoder.decode(await fetch('/measured.isostar'))) {
    surfaces++;
    triangles = surface.indices.length / 3;
  }
  isRunning = false;
  await waits;
  longTasks.push(...observer.takeRecords().map(({ duration }) => duration));
  return { surfaces, triangles, longTasks, longestWait };
}

const folder = await makePage();
copyFileSync(process.argv[2], join(folder, 'measured.isostar'));
const browser = await openBrowser([folder]);
const page = await browser.open('page/');
await page.waitForFunction(() => window.createDecoder);
const { surfaces, triangles, longTasks, longestWait } = await page.evaluate(observe);
await browser.close();
console.log(
  `${surfaces} surfaces, the last of ${triangles} triangles: ${longTasks.length} tasks over 50 ms` +
    ` (${longTasks.map(Math.round).join(', ') || 'none'}), longest wait ${longestWait.toFixed(1)} ms`,
);

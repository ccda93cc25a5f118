// `node bench/page-tasks.mjs STREAM`, after npm run build: for how long a page's main thread is
// busy at once while a stream is fetched and decoded in workers, each surface handed to the page.
import { openDecoderPage } from './measure/decoder-page.mjs';
import { addLongestWait } from './measure/longest-wait.mjs';

/** Runs in the page: long tasks as the browser counts them, and the longest wait for a message. */
async function observe() {
  const limits = { memory: Infinity, decisions: Infinity };
  const decoder = await window.createDecoder({ limits });
  const longTasks = [];
  const observer = new PerformanceObserver((list) =>
    longTasks.push(...list.getEntries().map(({ duration }) => duration)),
  );
  observer.observe({ type: 'longtask' });
  let isRunning = true;
  const longestWait = window.longestWaitUntil(() => !isRunning);
  let [surfaces, triangles] = [0, 0];
  for await (const surface of decoder.decode(await fetch('/measured.isostar'))) {
    surfaces++;
    triangles = surface.indices.length / 3;
  }
  isRunning = false;
  longTasks.push(...observer.takeRecords().map(({ duration }) => duration));
  return { surfaces, triangles, longTasks, longestWait: await longestWait };
}

const { browser, page } = await openDecoderPage(process.argv[2]);
await addLongestWait(page);
const { surfaces, triangles, longTasks, longestWait } = await page.evaluate(observe);
await browser.close();
console.log(
  `${surfaces} surfaces, the last of ${triangles} triangles: ${longTasks.length} tasks over 50 ms` +
    ` (${longTasks.map(Math.round).join(', ') || 'none'}), longest wait ${longestWait.toFixed(1)} ms`,
);

// `node bench/page-workers.mjs STREAM [RUNS [WORKERS…]]`, after npm run build: how long a page takes
// to decode and polygonize a stream in memory, by the number of workers. Runs of all numbers take
// turns, after one that starts the workers.
import { openDecoderPage } from './measure/decoder-page.mjs';

const [stream, runs = '8', ...numbers] = process.argv.slice(2);
const workers = numbers.length > 0 ? numbers.map(Number) : [1, 2];

/** Runs in the page: by the number of workers, each run's time in milliseconds. */
async function timesOf([runs, workers]) {
  const bytes = new Uint8Array(await (await fetch('/measured.isostar')).arrayBuffer());
  const limits = { memory: Infinity, decisions: Infinity };
  const decoders = await Promise.all(
    workers.map((workers) => window.createDecoder({ workers, limits })),
  );
  const times = workers.map(() => []);
  for (let run = 0; run <= runs; run++)
    for (const [i, decoder] of decoders.entries()) {
      const start = performance.now();
      for await (const _ of decoder.decode(bytes, { refinements: 'last' }));
      if (run > 0) times[i].push(performance.now() - start);
    }
  return times;
}

const { browser, page } = await openDecoderPage(stream);
const times = await page.evaluate(timesOf, [Number(runs), workers]);
await browser.close();
console.log('workers  best, ms  median, ms');
times.forEach((list, i) => {
  const sorted = list.toSorted((a, b) => a - b);
  const [best, median] = [sorted[0], sorted[sorted.length >> 1]];
  console.log(
    `${String(workers[i]).padStart(7)}${best.toFixed(0).padStart(10)}${median.toFixed(0).padStart(12)}`,
  );
});

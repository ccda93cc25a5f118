// Regions of a stream in chunks, read in ranges of bytes by a page, and decoded by its worker.
import assert from 'node:assert/strict';
import { dirname } from 'node:path';
import { after, before, test } from 'node:test';
import { chunkedStream } from '../node/streams.mjs';
import { openBrowser } from './browser.mjs';
import { makePage } from './package-page.mjs';

let browser, page;
const ranges = []; // that were requested of the stream
before(async () => {
  const handle = ({ url, headers }) => {
    if (url === '/chunked.isostar') ranges.push(headers.range);
    return false;
  };
  browser = await openBrowser([await makePage(), dirname(chunkedStream())], { handle });
  page = await browser.open('page/');
  await page.waitForFunction(() => window.createDecoder);
});
after(() => browser.close());

test('a region by ranges, in the worker and in the page, and by the loader', async () => {
  const [whole, ...regions] = await page.evaluate(async () => {
    const sumsOf = (positions) => [positions.length, positions.reduce((sum, x) => sum + x, 0)];
    const decode = async (worker, source, options) => {
      // With several workers, what is estimated outside of the region is rounded otherwise.
      const decoder = await createDecoder({ worker, workers: 1 });
      let last;
      for await (const surface of decoder.decode(source, options)) last = surface;
      decoder.dispose();
      return [last.final, ...sumsOf(last.positions)];
    };
    const source = new RangeSource('/chunked.isostar');
    const region = { min: [3, 2, 5], max: [40, 30, 35] };
    const loader = new IsostarLoader()
      .setDecoderOptions({ workers: 1 })
      .setSurfaceOptions({ region });
    const geometry = await loader.loadAsync('/chunked.isostar');
    loader.dispose();
    return [
      await decode(true, source),
      await decode(true, source, { region }),
      await decode(false, source, { region }),
      await decode(true, await fetch('/chunked.isostar'), { region }),
      [true, ...sumsOf(geometry.getAttribute('position').array)],
    ];
  });
  assert.equal(whole[0], true);
  for (const region of regions) assert.deepEqual(region, regions[0]);
  assert.notDeepEqual(regions[0], whole);
  assert.ok(ranges.includes('bytes=0-16383'));
  assert.ok(ranges.length > 6 && ranges.filter((range) => range === undefined).length === 1);
});

test('an abort ends the requests of a page', async () => {
  const name = await page.evaluate(async () => {
    const decoder = await createDecoder();
    const control = new AbortController();
    const source = new RangeSource('/chunked.isostar', {
      fetch: (address, options) => {
        if (new Headers(options.headers).get('Range') === 'bytes=0-16383')
          return fetch(address, options);
        control.abort();
        return fetch(address, options);
      },
    });
    try {
      for await (const _ of decoder.decode(source, { signal: control.signal }));
    } catch (reason) {
      return reason.name;
    } finally {
      decoder.dispose();
    }
  });
  assert.equal(name, 'AbortError');
  const complaints = browser.complaints.filter((text) => !text.includes("'data:,'"));
  assert.deepEqual(complaints, []);
});

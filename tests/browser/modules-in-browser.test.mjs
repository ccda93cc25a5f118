// Which WebAssembly a page fetches for which stream: on its own thread, in a worker, in several.
import assert from 'node:assert/strict';
import { copyFileSync, readFileSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { after, before, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { chunkedStream, encodeField } from '../node/streams.mjs';
import { openBrowser } from './browser.mjs';
import { makePage } from './package-page.mjs';

const golden = (name) => fileURLToPath(new URL(`../golden/${name}.isostar`, import.meta.url));
const OTHERS = ['near', 'trimmed', 'adaptive', 'topology', 'fitted'];

let browser, page;
let requests = [];
let isMissing = false; // is the module for every stream?
before(async () => {
  const path = chunkedStream();
  encodeField(
    'fittedChunks',
    [150, 140, 145],
    (i, j, k) => Math.sin(i / 9) + Math.cos(j / 8) + Math.sin(k / 11) + 0.1,
    '--chunk',
    '64',
    '--effort',
    '2',
  );
  const folder = await makePage();
  for (const name of ['sphere', ...OTHERS])
    copyFileSync(golden(name), join(folder, `${name}.isostar`));
  writeFileSync(join(folder, 'cut.isostar'), readFileSync(golden('fitted')).subarray(0, 700));
  const handle = ({ url }, response, headers) => {
    requests.push(url);
    if (!isMissing || url !== '/decoder-all.wasm') return false;
    response.writeHead(404, headers).end();
    return true;
  };
  browser = await openBrowser([folder, dirname(path)], { handle });
  page = await browser.open('page/');
  await page.waitForFunction(() => window.createDecoder);
  await page.evaluate(() => {
    /** Of the last surface: is it final, how many triangles; or the error. */
    window.lastOf = async (decoder, name, options) => {
      let last;
      try {
        for await (const surface of decoder.decode(await fetch(`/${name}.isostar`), options))
          last = surface;
      } catch (reason) {
        return `${reason.code}: ${reason.message}`;
      }
      return [last.final, last.indices.length / 3];
    };
    window.decode = async (options, name, surfaceOptions) => {
      const decoder = await createDecoder(options);
      const seen = await lastOf(decoder, name, surfaceOptions);
      decoder.dispose();
      return seen;
    };
  });
});
after(() => browser.close());

/** The result, and whether the module for every stream was fetched. */
async function decode(...args) {
  requests = [];
  const seen = await page.evaluate((list) => window.decode(...list), args);
  return { seen, fetchesAll: requests.includes('/decoder-all.wasm') };
}

const THREADS = {
  'the page’s own thread': { worker: false },
  'a worker': { workers: 1 },
  'several workers': { workers: 3 },
};
for (const [where, options] of Object.entries(THREADS)) {
  test(`a default stream fetches the small module only, in ${where}`, async () => {
    for (const name of ['sphere', 'chunked']) {
      const { seen, fetchesAll } = await decode(options, name);
      assert.equal(seen[0], true, String(seen));
      assert.equal(fetchesAll, false);
    }
  });
  test(`what it lacks is decoded by the other module, in ${where}`, async () => {
    for (const name of OTHERS) {
      const { seen, fetchesAll } = await decode(options, name);
      assert.equal(seen[0], true, `${name}: ${seen}`);
      assert.equal(fetchesAll, true, name);
    }
    const { seen, fetchesAll } = await decode(options, 'sphere', { polygonizer: 'tetrahedra' });
    assert.equal(seen[0], true, String(seen));
    assert.equal(fetchesAll, true);
  });
}

test('chunks that need the other module are shared as well', async () => {
  for (const [name, options] of [
    ['fittedChunks', {}],
    ['chunked', { polygonizer: 'tetrahedra' }],
  ]) {
    const one = await decode({ workers: 1 }, name, options);
    const several = await decode({ workers: 3 }, name, options);
    assert.equal(one.seen[0], true, String(one.seen));
    assert.deepEqual(several.seen, one.seen, name);
    assert.equal(requests.filter((url) => url === '/worker.js').length, 3);
    assert.equal(requests.filter((url) => url === '/decoder-all.wasm').length, 1);
  }
});

test('a cut stream ends in Truncated', async () => {
  assert.match((await decode({}, 'cut')).seen, /^Truncated: /);
});

test('a module that cannot be fetched is an error of the stream alone', async () => {
  isMissing = true;
  const seen = await page.evaluate(async () => {
    window.kept = await createDecoder();
    return [await lastOf(kept, 'fitted'), await lastOf(kept, 'sphere')];
  });
  assert.match(seen[0], /^BadArgument: .*decoder-all\.wasm: HTTP status 404/);
  assert.equal(seen[1][0], true);
  isMissing = false;
  const again = await page.evaluate(() => lastOf(kept, 'fitted'));
  assert.equal(again[0], true, String(again));
  browser.complaints.length = 0; // of the 404
});

test('nothing else was complained of', () => assert.deepEqual(browser.complaints, []));

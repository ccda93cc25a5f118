// Several workers that decode one stream in chunks together.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { after, before, test } from 'node:test';
import { ballStream, chunkedStream } from '../node/streams.mjs';
import { openBrowser } from './browser.mjs';
import { answerWorker, makePage, workerThatDies } from './package-page.mjs';

const DYING = workerThatDies('advance', 5);

let browser, page;
let started = 0; // workers
let helper = 'sound'; // how /worker.js is answered but for the first time: sound, dying, missing
before(async () => {
  const path = chunkedStream();
  ballStream();
  const bytes = readFileSync(path);
  const folder = await makePage();
  writeFileSync(join(folder, 'cut.isostar'), bytes.subarray(0, 30_000));
  writeFileSync(join(folder, 'damaged.isostar'), bytes.fill(7, 50_000, 50_010));
  const handle = (request, response, headers) => {
    if (request.url !== '/worker.js' || ++started === 1 || helper === 'sound') return false;
    return answerWorker(helper === 'missing' ? undefined : DYING, response, headers);
  };
  browser = await openBrowser([folder, dirname(path)], { handle });
  page = await browser.open('page/');
  await page.waitForFunction(() => window.createDecoder);
  await page.evaluate(() => {
    const digest = async ({ buffer }) => {
      const hash = new Uint8Array(await crypto.subtle.digest('SHA-256', buffer));
      return hash.join(' ');
    };
    /** The position of each surface, a digest of the last one, and the error's code. */
    window.decodeWith = async (decoder, name, options) => {
      const seen = { bytes: [], last: undefined, code: undefined };
      try {
        let last;
        for await (const surface of decoder.decode(await fetch(name), options)) {
          seen.bytes.push(surface.bytes);
          last = surface;
        }
        const { positions, normals, indices } = last;
        seen.last = await Promise.all([positions, normals, indices].map(digest));
      } catch (reason) {
        seen.code = reason.code ?? reason.name;
      }
      return seen;
    };
    window.decode = async (workers, name, options) => {
      const decoder = await createDecoder({ workers });
      const seen = await decodeWith(decoder, name, options);
      decoder.dispose();
      return seen;
    };
  });
});
after(() => browser.close());

/** What decode() sees, and how many workers that takes. */
async function run(workers, name, options) {
  started = 0;
  const seen = await page.evaluate(([...args]) => decode(...args), [workers, name, options]);
  return { ...seen, started };
}

test('several workers make the mesh of one', async () => {
  const options = { refinements: 'last' };
  const { started, ...one } = await run(1, '/chunked.isostar', options);
  assert.equal(started, 1);
  assert.equal(one.last.length, 3);
  for (const workers of [2, 3, 5])
    assert.deepEqual(await run(workers, '/chunked.isostar', options), { ...one, started: workers });
});

test('a surface for each layer', async () => {
  const options = { refinements: 'all' };
  const { bytes } = await run(1, '/chunked.isostar', options);
  assert.ok(bytes.length > 8);
  assert.deepEqual((await run(3, '/chunked.isostar', options)).bytes, bytes);
});

test('a stream without chunks takes one worker', async () => {
  assert.equal((await run(4, '/ball.isostar')).started, 1);
});

test('an incomplete and a damaged stream give what they give one worker', async () => {
  for (const [name, code] of [
    ['/cut.isostar', 'Truncated'],
    ['/damaged.isostar', 'Corrupt'],
  ])
    for (const refinements of ['all', 'last']) {
      const { started: _, ...one } = await run(1, name, { refinements });
      const { started, ...two } = await run(2, name, { refinements });
      assert.equal(one.code, code);
      assert.ok(one.bytes.length > 0);
      assert.deepEqual(two, one);
      assert.equal(started, 2);
    }
});

test('without helpers, or when they are lost, one worker decodes alone', async () => {
  const options = { refinements: 'last' };
  const { started: _, ...one } = await run(1, '/chunked.isostar', options);
  for (helper of ['missing', 'dying']) {
    const { started, ...two } = await run(2, '/chunked.isostar', options);
    assert.deepEqual(two, one, helper);
    assert.equal(started, 2);
  }
  helper = 'sound';
  browser.complaints.length = 0; // the browser reports the 404
});

test('helpers serve later streams and several at a time, and are replaced', async () => {
  started = 0;
  helper = 'dying';
  const [first, ...others] = await page.evaluate(async () => {
    window.decoder = await createDecoder({ workers: 2 });
    return [await decodeWith(decoder, '/chunked.isostar', { refinements: 'last' })];
  });
  helper = 'sound';
  assert.equal(others.length, 0);
  const later = await page.evaluate(async () => {
    const options = { refinements: 'last' };
    const one = () => decodeWith(decoder, '/chunked.isostar', options);
    const seen = [await one(), ...(await Promise.all([one(), one(), one()]))];
    decoder.dispose();
    return seen;
  });
  for (const seen of later) assert.deepEqual(seen, first);
  assert.equal(started, 3);
});

test('an abort, a break and dispose() end what helpers do', async () => {
  const names = await page.evaluate(async () => {
    const decoder = await createDecoder({ workers: 3 });
    const control = new AbortController();
    const names = [];
    const take = async (count, then, signal) => {
      try {
        const source = await fetch('/chunked.isostar');
        for await (const _ of decoder.decode(source, { refinements: 'all', signal })) {
          if (--count > 0) continue;
          if (then === 'break') break;
          then();
        }
        names.push('ended');
      } catch (reason) {
        names.push(reason.name);
      }
    };
    await take(5, () => control.abort(), control.signal);
    await take(5, 'break');
    await take(9, 'break');
    await take(5, () => decoder.dispose());
    return names;
  });
  assert.deepEqual(names, ['AbortError', 'ended', 'ended', 'AbortError']);
});

test('limits, and a number of workers that is none', async () => {
  const limits = { vertices: 1000 };
  assert.equal((await run(2, '/chunked.isostar', { limits })).code, 'OverLimit');
  assert.equal((await run(2, '/chunked.isostar', { limits: { memory: 2e6 } })).code, 'OverLimit');
  const codes = await page.evaluate(() =>
    Promise.all(
      [0, 1.5, NaN, '2', null].map((workers) =>
        createDecoder({ workers }).catch((reason) => reason.code),
      ),
    ),
  );
  assert.deepEqual(codes, Array(5).fill('BadArgument'));
  assert.deepEqual(
    browser.complaints.filter((text) => !text.includes("'data:,'")),
    [],
  );
});

// What callers do wrong, or leave undone, with a decoder in a worker; and workers that are lost.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { withMemory } from '../node/small-memory.mjs';
import { largeStream } from '../node/streams.mjs';
import { openBrowser } from './browser.mjs';
import { answerWorker, makePage, workerThatDies } from './package-page.mjs';
import { FOLDER } from './test-samples.mjs';

const DYING = workerThatDies('next', 2);

let browser, page;
let worker = 'sound'; // how /worker.js is answered: sound, dying or missing
before(async () => {
  const folder = await makePage();
  const wasm = readFileSync(join(folder, 'decoder.wasm'));
  writeFileSync(join(folder, 'small.wasm'), withMemory(wasm, 80));
  writeFileSync(join(folder, 'part.wasm'), wasm.subarray(0, wasm.length / 2));
  writeFileSync(join(folder, 'large.isostar'), readFileSync(largeStream()));
  const handle = (request, response, headers) => {
    if (worker === 'sound' || request.url !== '/worker.js') return false;
    return answerWorker(worker === 'missing' ? undefined : DYING, response, headers);
  };
  browser = await openBrowser([folder, FOLDER], { handle });
  page = await open();
});
after(() => browser.close());

/** What the browser complained of since the last call, but for the icon of the page. */
const complaints = () => browser.complaints.splice(0).filter((text) => !text.includes("'data:,'"));

/** A page with helpers, which counts what is posted to workers. */
async function open() {
  const page = await browser.open('page/');
  await page.waitForFunction(() => window.createDecoder);
  await page.evaluate(() => {
    const { postMessage } = Worker.prototype;
    window.posted = [];
    Worker.prototype.postMessage = function (message, transfer) {
      const { type, piece } = message;
      const { byteLength: length, buffer } = piece?.bytes ?? {};
      window.posted.push({ type, length, buffer: buffer?.byteLength });
      return postMessage.call(this, message, transfer);
    };
    window.load = async (path) => new Uint8Array(await (await fetch(path)).arrayBuffer());
    window.last = async (surfaces) => {
      let last;
      for await (const surface of surfaces) last = surface;
      return last;
    };
    /** The code and the message of the error, or whether the surface is final. */
    window.outcome = (surface) =>
      surface.then(
        (surface) => surface?.final ?? 'a decoder',
        (reason) => `${reason.code ?? reason.name}: ${reason.message}`,
      );
  });
  return page;
}

test('of a piece, its own bytes are posted; the caller keeps the buffer', async () => {
  const { posted, ...result } = await page.evaluate(async () => {
    const bytes = await load('/gyroid.isostar');
    const buffer = new Uint8Array(1 << 26);
    const decoder = await createDecoder();
    posted.length = 0;
    const surface = await last(
      decoder.decode(
        (async function* () {
          for (let at = 0; at < bytes.length; at += 50) {
            const length = Math.min(50, bytes.length - at);
            buffer.set(bytes.subarray(at, at + length), 1000);
            yield buffer.subarray(1000, 1000 + length);
            buffer.fill(99, 1000, 1050);
          }
        })(),
      ),
    );
    decoder.dispose();
    return { isFinal: surface.final, left: buffer.length, posted };
  });
  assert.ok(result.isFinal);
  assert.equal(result.left, 1 << 26);
  const pieces = posted.filter(({ type }) => type === 'accept');
  assert.ok(pieces.length > 100);
  assert.ok(pieces.every(({ length, buffer }) => length <= 50 && buffer === length));
});

test('a source that goes on after the end of the stream is stopped', async () => {
  const { isFinal, isReturned, read } = await page.evaluate(async () => {
    const bytes = await load('/gyroid.isostar');
    let isReturned = false;
    let read = 0;
    async function* source() {
      try {
        yield bytes;
        for (const zeros = new Uint8Array(1 << 16); ; read += zeros.length) yield zeros;
      } finally {
        isReturned = true;
      }
    }
    const decoder = await createDecoder();
    const { final } = await last(decoder.decode(source(), { refinements: 'all' }));
    decoder.dispose();
    return { isFinal: final, isReturned, read };
  });
  assert.ok(isFinal && isReturned);
  assert.ok(read < 1e8, `${read} bytes read`);
});

test('iterators that are dropped are ended in the worker', async () => {
  await page.evaluate(async () => {
    const bytes = await load('/gyroid.isostar');
    window.decoder = await createDecoder();
    posted.length = 0;
    const drop = async () => void (await decoder.decode(bytes).next());
    for (let i = 0; i < 20; i++) await drop();
  });
  for (let i = 0; i < 5; i++) {
    await page.requestGC();
    await page.waitForTimeout(50);
  }
  const [stops, isFinal] = await page.evaluate(async () => [
    posted.filter(({ type }) => type === 'stop').length,
    (await last(decoder.decode(await load('/gyroid.isostar')))).final,
  ]);
  assert.ok(stops >= 19, `${stops} of 20`);
  assert.ok(isFinal);
});

test('limits and undefined options reach the worker', async () => {
  const outcomes = await page.evaluate(async () => {
    const bytes = await load('/gyroid.isostar');
    const strict = await createDecoder({ limits: { vertices: 100 } });
    const decode = (options) => outcome(last(strict.decode(bytes, options)));
    const options = { polygonizer: undefined, normals: undefined, frame: undefined };
    const results = [
      await decode(),
      await decode({ limits: { vertices: 1e6, memory: 1000 } }),
      await decode({ limits: { vertices: 1e6 }, refinements: undefined, ...options }),
      await decode({ limits: { vertices: -1 } }),
      await outcome(createDecoder({ limits: { memory: NaN } })),
    ];
    strict.dispose();
    return results.map((result) => String(result).split(':')[0]);
  });
  assert.deepEqual(outcomes, ['OverLimit', 'OverLimit', 'true', 'BadArgument', 'BadArgument']);
});

test('WebAssembly that is none, and a module without memory', async () => {
  const outcomes = await page.evaluate(async () => {
    const small = await createDecoder({ wasm: '/small.wasm' });
    const results = [
      await outcome(last(small.decode(await load('/large.isostar')))),
      await outcome(last(small.decode(await load('/gyroid.isostar')))),
      await outcome(createDecoder({ wasm: '/part.wasm' })),
      await outcome(createDecoder({ wasm: '/page/' })),
      await outcome(createDecoder({ wasm: (await load('/decoder.wasm')).subarray(0, 999) })),
      await outcome(createDecoder({ wasm: (await load('/decoder.wasm')).fill(9, 99, 999) })),
      await outcome(createDecoder({ wasm: await load('/decoder.wasm') })),
    ];
    small.dispose();
    return results.map(String);
  });
  const expected = [
    /^OverLimit: .*memory/,
    /^true$/,
    /^BadArgument: .*part\.wasm: cannot be compiled/,
    /^BadArgument: .*\/page\/: not a WebAssembly module/,
    /^BadArgument: the bytes given as `wasm`: cannot be compiled/,
    /^BadArgument: the bytes given as `wasm`: cannot be compiled/,
    /^a decoder$/,
  ];
  outcomes.forEach((outcome, i) => assert.match(outcome, expected[i]));
  assert.deepEqual(complaints(), []);
});

test('a worker that dies ends its decodes; the next decode has another', async () => {
  worker = 'dying';
  await page.evaluate(async () => {
    window.decoder = await createDecoder();
    window.bytes = await load('/gyroid.isostar');
  });
  worker = 'sound';
  const outcomes = await page.evaluate(async () => {
    const waiting = outcome(decoder.decode(new ReadableStream()).next());
    const results = [await outcome(last(decoder.decode(bytes))), await waiting];
    results.push(await outcome(last(decoder.decode(bytes))));
    results.push(await outcome(last(decoder.decode(bytes))));
    decoder.dispose();
    return results;
  });
  assert.match(outcomes[0], /^OverLimit: .*worker.*struck down/);
  assert.equal(outcomes[1], outcomes[0]);
  assert.deepEqual(outcomes.slice(2), [true, true]);
  assert.deepEqual(complaints(), []);
});

test('a worker that cannot be loaded; later decoders, loaders and elements work', async () => {
  const other = await open();
  const results = [];
  for (worker of ['missing', 'sound'])
    results.push(
      await other.evaluate(async () => {
        window.loader ??= new IsostarLoader();
        window.element ??= document.body.appendChild(document.createElement('isostar-surface'));
        const shown = new Promise((resolve) => {
          element.onload = () => resolve('loaded');
          element.addEventListener('error', ({ detail }) => resolve(detail.sourceError.code), {
            once: true,
          });
        });
        element.src = '/gyroid.isostar';
        return [
          await outcome(createDecoder()),
          await loader.loadAsync('/gyroid.isostar').then(
            () => 'loaded',
            (reason) => reason.code,
          ),
          await shown,
        ];
      }),
    );
  const [failed, ...others] = results[0];
  assert.match(failed, /^BadArgument: the decoder's worker cannot be loaded/);
  assert.deepEqual(others, ['BadArgument', 'BadArgument']);
  assert.deepEqual(results[1], ['a decoder', 'loaded', 'loaded']);
  complaints(); // the browser reports the 404
});

test('a decoder whose new worker cannot be loaded says so, and tries again', async () => {
  const outcomes = [];
  const step = async (kind, create) => {
    worker = kind;
    outcomes.push(
      await page.evaluate(async (create) => {
        if (create) window.decoder = await createDecoder();
        return outcome(last(decoder.decode(await load('/gyroid.isostar'))));
      }, create),
    );
  };
  await step('dying', true);
  await step('missing', false);
  await step('sound', false);
  assert.match(outcomes[0], /^OverLimit: /);
  assert.match(outcomes[1], /^BadArgument: the decoder's worker cannot be loaded/);
  assert.equal(outcomes[2], true);
  complaints();
});

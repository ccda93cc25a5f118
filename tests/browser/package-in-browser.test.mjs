import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { coloursOf, openBrowser } from './browser.mjs';
import { makePage } from './package-page.mjs';
import { FOLDER, LAYERS, stepwise } from './test-samples.mjs';

let browser, page;
before(async () => {
  browser = await openBrowser([await makePage(), FOLDER], { handle: stepwise() });
  page = await browser.open('page/');
  await page.waitForFunction(() => window.createDecoder);
});
after(() => browser.close());

test('worker and page decode the same surface', async () => {
  const [inWorker, inPage] = await page.evaluate(() =>
    Promise.all(
      [true, false].map(async (worker) => {
        const decoder = await createDecoder({ worker });
        let last;
        for await (const surface of decoder.decode(await fetch('/gyroid.isostar'))) last = surface;
        decoder.dispose();
        return [last.final, last.positions.length, last.positions.reduce((sum, x) => sum + x, 0)];
      }),
    ),
  );
  assert.deepEqual(inWorker, inPage);
  assert.equal(inWorker[0], true);
});

test('the worker yields a surface per layer as its bytes arrive', async () => {
  const bytes = await page.evaluate(async () => {
    const decoder = await createDecoder();
    const bytes = [];
    for await (const surface of decoder.decode(await fetch('/stepwise.isostar'))) {
      bytes.push(surface.bytes);
      await fetch('/next-layer');
    }
    decoder.dispose();
    return bytes;
  });
  assert.deepEqual(
    bytes,
    LAYERS.map(({ offset }) => offset),
  );
});

test('errors of the worker have their code', async () => {
  const codes = await page.evaluate(async () => {
    const decoder = await createDecoder();
    const codeOf = async (source, options) => {
      try {
        for await (const _ of decoder.decode(source, options));
      } catch (reason) {
        return reason instanceof IsostarError ? reason.code : reason.name;
      }
    };
    return [
      await codeOf(new TextEncoder().encode('<!doctype html>'.repeat(9))),
      await codeOf(await fetch('/broken.isostar')),
      await codeOf(await fetch('/no-such-file')),
      await codeOf(await fetch('/gyroid.isostar'), { polygonizer: 'pyramids' }),
      await codeOf(new ReadableStream(), { signal: AbortSignal.timeout(30) }),
    ];
  });
  assert.ok(['Corrupt', 'Truncated'].includes(codes.splice(1, 1)[0]));
  assert.deepEqual(codes, ['NotIsostar', 'BadArgument', 'BadArgument', 'TimeoutError']);
  browser.complaints.length = 0; // the browser reports the 404
});

test('dispose rejects what is pending; a missing wasm file is reported', async () => {
  const names = await page.evaluate(async () => {
    const decoder = await createDecoder();
    const waiting = decoder
      .decode(new ReadableStream())
      .next()
      .catch((reason) => reason.name);
    setTimeout(() => decoder.dispose(), 20);
    const missing = createDecoder({ wasm: '/no-such.wasm' }).catch((reason) => reason.code);
    return [
      await waiting,
      await decoder
        .decode(new Uint8Array())
        .next()
        .catch((reason) => reason.name),
      await missing,
    ];
  });
  assert.deepEqual(names, ['AbortError', 'AbortError', 'BadArgument']);
  browser.complaints.length = 0;
});

test('the three.js loader updates one geometry', async () => {
  const { progress, geometries, vertices, box } = await page.evaluate(async () => {
    const loader = new IsostarLoader().setPath('/');
    const geometries = new Set();
    const progress = [];
    const geometry = await loader.loadAsync('stepwise.isostar', (event) => {
      geometries.add(event.geometry);
      progress.push(event.loaded / event.total);
      void fetch('/next-layer');
    });
    geometries.add(geometry);
    loader.dispose();
    return {
      progress,
      geometries: geometries.size,
      vertices: geometry.getAttribute('normal').count,
      box: geometry.boundingBox.max.toArray(),
    };
  });
  assert.equal(geometries, 1);
  assert.ok(vertices > 1000);
  assert.deepEqual(box, [31.5, 59, 98]);
  assert.equal(progress.length, LAYERS.length);
  assert.equal(progress.at(-1), 1);
});

test('the element draws, reports progress, and reacts to keys', async () => {
  const events = await page.evaluate(async () => {
    const element = document.createElement('isostar-surface');
    Object.assign(element, { src: '/gyroid.isostar', alt: 'A gyroid' });
    element.setAttribute('camera-controls', '');
    const events = [];
    for (const type of ['progress', 'level', 'camera-change'])
      element.addEventListener(type, () => events.push(type));
    const loaded = new Promise((resolve, reject) => {
      element.addEventListener('load', resolve);
      element.addEventListener('error', ({ detail }) => reject(detail.sourceError));
    });
    document.body.append(element);
    await loaded;
    return events;
  });
  assert.ok(events.includes('progress') && events.includes('level'));
  const canvas = page.getByRole('application', { name: 'A gyroid' });
  await page.waitForTimeout(300);
  assert.ok((await coloursOf(page, 'isostar-surface')) > 50, 'the picture is not blank');
  const before = await canvas.screenshot();
  await canvas.press('ArrowRight');
  await page.waitForTimeout(300);
  assert.notDeepEqual(await canvas.screenshot(), before);
  assert.deepEqual(browser.complaints, []);
});

test('the element reports a file that is no stream', async () => {
  const type = await page.evaluate(
    () =>
      new Promise((resolve) => {
        const element = document.createElement('isostar-surface');
        element.addEventListener('error', ({ detail }) =>
          resolve([detail.type, detail.sourceError.code]),
        );
        element.src = '/samples.json';
        document.body.append(element);
      }),
  );
  assert.deepEqual(type, ['loadfailure', 'NotIsostar']);
});

// What callers do wrong, or leave undone: it ends in an IsostarError, and the next decode works.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { after, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { createDecoder, IsostarError } from 'isostar';
import { withMemory } from './small-memory.mjs';
import {
  all,
  ballStream,
  gyroidStream,
  inPieces,
  largeStream,
  read,
  severalStream,
} from './streams.mjs';

const gyroidPath = gyroidStream();
const ball = read(ballStream());
const gyroid = read(gyroidPath);
const wasm = readFileSync(new URL('../../web/dist/decoder.wasm', import.meta.url));
const decoder = await createDecoder();
after(() => decoder.dispose());

const last = async (source, options, by = decoder) =>
  (await all(by.decode(source, options))).at(-1);
const isError =
  (code, message = /^[^\n]+$/) =>
  (reason) => {
    assert.ok(reason instanceof IsostarError, String(reason));
    assert.equal(reason.code, code);
    assert.match(reason.message, message);
    return true;
  };
const { positions: expected } = await last(gyroid);

test('buffers are copied when they are handed over', async () => {
  async function* reused() {
    const buffer = new Uint8Array(1 << 16);
    for await (const piece of inPieces(gyroid, 1000)) {
      buffer.set(piece, 5);
      yield buffer.subarray(5, 5 + piece.length);
      assert.equal(buffer.length, 1 << 16, 'it is not detached');
      buffer.fill(99);
    }
  }
  assert.deepEqual((await last(reused())).positions, expected);

  const bytes = gyroid.slice();
  const surfaces = decoder.decode(bytes);
  bytes.fill(99);
  assert.deepEqual((await all(surfaces)).at(-1).positions, expected);
});

/** A source that never waits and never ends: `bytes`, then zeros. */
function endless(bytes) {
  const state = { read: 0, isReturned: false };
  async function* pieces() {
    try {
      const zeros = new Uint8Array(1 << 16);
      yield* inPieces(bytes, 1000);
      for (;;) {
        yield zeros;
        state.read += zeros.length;
      }
    } finally {
      state.isReturned = true;
    }
  }
  return { state, source: pieces() };
}

test('a source that goes on after the end of the stream is stopped', async () => {
  for (const refinements of ['newest', 'all', 'last']) {
    const { source, state } = endless(gyroid);
    assert.deepEqual((await last(source, { refinements })).positions, expected);
    assert.ok(state.isReturned);
    assert.ok(state.read < 1e8, `${state.read} bytes read`);
  }
  let isCancelled = false;
  const stream = new ReadableStream({
    start: (controller) => controller.enqueue(ball),
    pull: (controller) => controller.enqueue(new Uint8Array(1000)),
    cancel: () => void (isCancelled = true),
  });
  assert.equal((await last(stream)).final, true);
  assert.ok(isCancelled);
});

test('a source that goes on after an error is stopped', async () => {
  for (const bytes of [new Uint8Array(3), gyroid.with(gyroid.length >> 1, 77)]) {
    const { source, state } = endless(bytes);
    await assert.rejects(last(source), IsostarError);
    assert.ok(state.isReturned);
  }
});

test('a source is stopped while isovalues still come', async () => {
  const { source, state } = endless(read(severalStream()));
  async function* isovalue() {
    while (!state.isReturned) await new Promise((resolve) => setTimeout(resolve, 5));
    yield 0.25;
  }
  const surfaces = await all(decoder.decode(source, { isovalue: isovalue() }));
  assert.equal(surfaces.at(-1).isovalue, 0.25);
  assert.equal(surfaces.at(-1).final, true);
});

test('a source waits for a slow consumer, and leaves the thread to others', async () => {
  const { source, state } = endless(gyroid);
  const surfaces = decoder.decode(source);
  await surfaces.next();
  await new Promise((resolve) => setTimeout(resolve, 300));
  assert.ok(state.read < 2e7, `${state.read} bytes read`);
  assert.equal((await all(surfaces)).at(-1).final, true);

  const nothing = (async function* () {
    for (;;) yield new Uint8Array();
  })();
  const signal = AbortSignal.timeout(50);
  await assert.rejects(last(nothing, { signal }), { name: 'TimeoutError' });
});

test('iterators that are dropped free their memory', () => {
  const program = fileURLToPath(new URL('drop-iterators.mjs', import.meta.url));
  const drop = (count, ...flags) =>
    JSON.parse(
      execFileSync(process.execPath, [...flags, program, gyroidPath, count], { encoding: 'utf8' }),
    );
  const { some, all, isFinal } = drop(200, '--expose-gc');
  assert.ok(all - some < 3e7, `${((all - some) / 1e6).toFixed(0)} MB more`);
  assert.ok(isFinal);
  const byItself = drop(1000); // 900 MB if the garbage collector does not see the memory
  assert.ok(byItself.all < 6e8, `${(byItself.all / 1e6).toFixed(0)} MB`);
  assert.ok(byItself.isFinal);
});

test('an option that is undefined has its default', async () => {
  const surface = await last(gyroid, {
    polygonizer: undefined,
    frame: undefined,
    normals: undefined,
    refinements: undefined,
    isovalue: undefined,
    signal: undefined,
    limits: undefined,
  });
  assert.deepEqual(surface.positions, expected);
  assert.equal(surface.normals.length, expected.length);
  const none = { wasm: undefined, worker: undefined, workers: undefined, limits: undefined };
  const other = await createDecoder(none);
  const limits = {
    memory: undefined,
    samples: undefined,
    vertices: undefined,
    decisions: undefined,
  };
  assert.deepEqual((await last(gyroid, { limits }, other)).positions, expected);
  other.dispose();
});

test('values that are not among an option’s', async () => {
  for (const options of [
    { polygonizer: 'name' },
    { frame: 'values' },
    { refinements: 'some' },
    { isovalue: '0' },
    { isovalue: null },
    { isovalue: [0] },
    { limits: { memory: NaN } },
    { limits: { samples: -1 } },
    { limits: { vertices: '9' } },
  ])
    await assert.rejects(last(ball, options), isError('BadArgument'), JSON.stringify(options));
  for (const options of [{ limits: { memory: '1 GB' } }, { workers: 0 }, { workers: 1.5 }])
    await assert.rejects(createDecoder(options), isError('BadArgument'), JSON.stringify(options));
});

test('bytes that are not the decoder’s WebAssembly', async (t) => {
  const complaints = ['error', 'warn', 'log'].map((name) => t.mock.method(console, name));
  const html = new TextEncoder().encode('<!doctype html><title>no such page</title>');
  const sources = {
    'no bytes': new Uint8Array(),
    HTML: html,
    'a part': wasm.subarray(0, 3),
    'another part': wasm.subarray(0, 100),
    'almost all': wasm.subarray(0, wasm.length - 1),
    'damaged bytes': new Uint8Array(wasm).fill(0xff, 1000, 1100),
    'an empty module': Uint8Array.of(0, 0x61, 0x73, 0x6d, 1, 0, 0, 0),
    'a number': 42,
  };
  for (const [name, bytes] of Object.entries(sources))
    await assert.rejects(createDecoder({ wasm: bytes }), isError('BadArgument', /`wasm`: /), name);
  complaints.forEach(({ mock }) => assert.equal(mock.callCount(), 0));

  const room = new Uint8Array(wasm.length + 100);
  room.set(wasm, 50);
  const inRoom = await createDecoder({ wasm: room.subarray(50, 50 + wasm.length) });
  room.fill(0);
  assert.deepEqual((await last(gyroid, {}, inRoom)).positions, expected);
  inRoom.dispose();
});

test('addresses that are not the decoder’s WebAssembly', async () => {
  const server = createServer(({ url }, response) => {
    if (url === '/missing') response.writeHead(404).end('<!doctype html>');
    else if (url === '/page') response.end('<!doctype html><title>a page</title>');
    else response.end(wasm.subarray(0, wasm.length / 2));
  });
  await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
  const address = `http://127.0.0.1:${server.address().port}`;
  const fails = (wasm, message) =>
    assert.rejects(createDecoder({ wasm }), isError('BadArgument', message));
  await fails(`${address}/missing`, /\/missing: HTTP status 404/);
  await fails(new URL(`${address}/page`), /\/page: not a WebAssembly module/);
  await fails(`${address}/part`, /\/part: cannot be compiled/);
  await fails(new URL('no-such.wasm', import.meta.url), /no-such\.wasm: /);
  await fails('not an address', /not an address: /);
  server.closeAllConnections();
  await new Promise((resolve) => server.close(resolve));
  await fails(`${address}/any`, /\/any: /);
});

test('a module without memory ends in OverLimit, and the next decode works', async (t) => {
  const complaints = ['error', 'warn'].map((name) => t.mock.method(console, name));
  const large = read(largeStream());
  const small = await createDecoder({ wasm: withMemory(wasm, 80) });
  const busy = small.decode(ball, { refinements: 'all' });
  await busy.next();
  for (let i = 0; i < 3; i++) {
    await assert.rejects(last(large, {}, small), isError('OverLimit', /memory/));
    assert.equal((await last(ball, {}, small)).final, true);
  }
  // What was in progress shares the memory of the module that failed.
  await all(busy).catch(isError('OverLimit', /memory/));
  small.dispose();
  complaints.forEach(({ mock }) => assert.equal(mock.callCount(), 0));
});

test('limits, of a decoder and of one decode', async () => {
  const isOver = isError('OverLimit', /limits/);
  for (const limits of [
    { memory: 1e5 },
    { samples: 64 * 60 * 50 - 1 },
    { vertices: 100 },
    { decisions: 1000 },
  ]) {
    await assert.rejects(last(gyroid, { limits }), isOver, JSON.stringify(limits));
    const strict = await createDecoder({ limits });
    await assert.rejects(last(gyroid, {}, strict), isOver);
    const none = Object.fromEntries(Object.keys(limits).map((name) => [name, Infinity]));
    assert.deepEqual((await last(gyroid, { limits: none }, strict)).positions, expected);
    const other = { memory: 1e8, samples: 1e6, vertices: 1e6, decisions: 1e8, ...limits };
    await assert.rejects(last(gyroid, { limits: other }, strict), isOver);
    strict.dispose();
  }
  const enough = { memory: 1e8, samples: 64 * 60 * 50, vertices: 1e6, decisions: 1e8 };
  assert.deepEqual((await last(gyroid, { limits: enough })).positions, expected);
});

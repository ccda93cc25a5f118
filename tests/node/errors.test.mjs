import assert from 'node:assert/strict';
import { after, test } from 'node:test';
import { createDecoder, IsostarError } from 'isostar';
import { all, ballStream, gyroidStream, inPieces, read } from './streams.mjs';

const ball = read(ballStream());
const gyroid = read(gyroidStream());
const decoder = await createDecoder();
after(() => decoder.dispose());

const failsWith = (code, source, options) =>
  assert.rejects(all(decoder.decode(source, options)), (reason) => {
    assert.ok(reason instanceof IsostarError);
    assert.equal(reason.code, code);
    assert.match(reason.message, /^[^\n]+$/);
    return true;
  });

/** A source that gives some bytes and then stalls. */
function stalled(bytes) {
  const state = { isCancelled: false };
  const stream = new ReadableStream({
    start: (controller) => controller.enqueue(bytes),
    cancel: () => void (state.isCancelled = true),
  });
  return { stream, state };
}

test('a file that is no stream', () =>
  failsWith(
    'NotIsostar',
    new TextEncoder().encode('<!doctype html><p>no such page</p>'.repeat(9)),
  ));
test('no bytes', () => failsWith('Truncated', new Uint8Array()));
test('an incomplete stream gives sound surfaces, then the error', async () => {
  const surfaces = [];
  await assert.rejects(
    async () => {
      for await (const surface of decoder.decode(gyroid.subarray(0, gyroid.length - 9)))
        surfaces.push(surface);
    },
    { code: 'Truncated' },
  );
  assert.ok(surfaces.length > 0);
  assert.ok(surfaces.every(({ final }) => !final));
});
test('a damaged stream gives sound surfaces, then the error', async () => {
  const damaged = gyroid.slice();
  damaged[damaged.length - 20] ^= 4;
  const surfaces = [];
  await assert.rejects(
    async () => {
      for await (const surface of decoder.decode(damaged)) surfaces.push(surface);
    },
    { code: 'Corrupt' },
  );
  assert.ok(surfaces.length > 0);
});

test('wrong arguments', async () => {
  await failsWith('BadArgument', ball, { polygonizer: 'pyramids' });
  await failsWith('BadArgument', ball, { frame: 'toString' });
  await failsWith('BadArgument', ball, { isovalue: 7 });
  await failsWith('BadArgument', 'skull.isostar');
  await failsWith('BadArgument', undefined);
  await failsWith(
    'BadArgument',
    (async function* () {
      yield 'text';
    })(),
  );
  await failsWith('BadArgument', new Response('gone', { status: 404 }));
  await assert.rejects(createDecoder({ worker: true }), { code: 'BadArgument' });
  await assert.rejects(createDecoder({ wasm: new TextEncoder().encode('<!doctype html>') }), {
    code: 'BadArgument',
  });
});

test('the error of a source is passed on unchanged', async () => {
  const reason = new Error('the cable is cut');
  await assert.rejects(
    all(
      decoder.decode(
        (async function* () {
          yield ball.subarray(0, 9);
          throw reason;
        })(),
      ),
    ),
    (thrown) => thrown === reason,
  );
});

test('abort: before decode(), while waiting for bytes, between two layers', async () => {
  await assert.rejects(all(decoder.decode(ball, { signal: AbortSignal.abort() })), {
    name: 'AbortError',
  });

  const { stream, state } = stalled(ball.subarray(0, 20));
  const waiting = new AbortController();
  setTimeout(() => waiting.abort(new Error('enough')), 20);
  await assert.rejects(all(decoder.decode(stream, { signal: waiting.signal })), {
    message: 'enough',
  });
  assert.ok(state.isCancelled);

  const busy = new AbortController();
  const surfaces = decoder.decode(gyroid, { signal: busy.signal, refinements: 'all' });
  await surfaces.next();
  busy.abort();
  await assert.rejects(surfaces.next(), { name: 'AbortError' });
});

test('leaving the loop cancels the source', async () => {
  const { stream, state } = stalled(gyroid.subarray(0, gyroid.length - 1));
  for await (const _ of decoder.decode(stream)) break;
  assert.ok(state.isCancelled);
});

test('dispose rejects pending and later iterations', async () => {
  const doomed = await createDecoder();
  const decoding = all(doomed.decode(stalled(ball.subarray(0, 20)).stream));
  setTimeout(() => doomed.dispose(), 10);
  await assert.rejects(decoding, { name: 'AbortError' });
  await assert.rejects(all(doomed.decode(ball)), { name: 'AbortError' });
  doomed.dispose();
});

test('any single damaged byte ends in an error or in a sound surface', async () => {
  for (let at = 0; at < ball.length; at++) {
    const damaged = ball.slice();
    damaged[at] ^= 1 << (at % 8);
    try {
      for await (const { positions, indices } of decoder.decode(inPieces(damaged, 100))) {
        assert.ok(positions.every(Number.isFinite));
        assert.ok(indices.every((vertex) => vertex < positions.length / 3));
      }
    } catch (reason) {
      assert.ok(reason instanceof IsostarError, `byte ${at}: ${reason}`);
    }
  }
});

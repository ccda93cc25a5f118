// Streams that are read in ranges of bytes, from a server and from a Blob.
import assert from 'node:assert/strict';
import { openAsBlob } from 'node:fs';
import { test } from 'node:test';
import { RangeSource } from 'isostar';
import { asUsual, at, chunked, gyroid, isFirst, lastBy, PATH } from './range-server.mjs';
import { rodStream } from './streams.mjs';

const last = async (source, options) => (await lastBy(asUsual, source, options)).surface;
const whole = await last(chunked);

test('a whole stream is read in two requests', async () => {
  const { surface, requests } = await lastBy(asUsual);
  assert.deepEqual(surface.positions, whole.positions);
  assert.deepEqual(
    requests.map(({ range }) => range),
    ['bytes=0-16383', `bytes=16384-${chunked.length - 1}`],
  );
});
test('a stream of less than 16 KiB is read in one', async () => {
  const { surface, requests } = await lastBy(asUsual, at('ball.isostar'));
  assert.ok(surface.final);
  assert.equal(requests.length, 1);
});

const region = { min: [3, 2, 5], max: [40, 30, 35.5] };
const isIn = ([x, y, z], { min, max }) => [x, y, z].every((c, a) => c >= min[a] && c <= max[a]);
const verticesIn = ({ positions }, box) => {
  const found = [];
  for (let i = 0; i < positions.length; i += 3) {
    const vertex = positions.subarray(i, i + 3);
    if (isIn(vertex, box)) found.push(vertex.join(' '));
  }
  return found.sort();
};

test('of a region only its bytes are read, and its vertices are those of the whole', async () => {
  const { surface, requests } = await lastBy(asUsual, undefined, { region });
  assert.equal(surface.final, true);
  assert.equal(surface.bytes, chunked.length);
  const sent = requests.reduce((sum, { bytes }) => sum + bytes, 0);
  assert.ok(sent < chunked.length / 2, `${sent} of ${chunked.length} bytes`);
  const vertices = verticesIn(whole, region);
  assert.ok(vertices.length > 1000);
  assert.deepEqual(verticesIn(surface, region), vertices);
  assert.notDeepEqual(surface.positions, whole.positions);
  // Other sources give the same.
  assert.deepEqual((await last(chunked, { region })).positions, surface.positions);
});

test('of an index in pages only the pages of the region are read', async () => {
  rodStream();
  const rod = await last(at('rod.isostar'));
  const box = { min: [0, 0, 20000], max: [5, 5, 20100] };
  const { surface, requests } = await lastBy(asUsual, at('rod.isostar'), { region: box });
  assert.equal(surface.final, true);
  const sent = requests.reduce((sum, { bytes }) => sum + bytes, 0);
  assert.ok(sent < surface.bytes / 8, `${sent} of ${surface.bytes} bytes`);
  assert.ok(requests.length < 20, `${requests.length} requests`);
  assert.deepEqual(verticesIn(surface, box), verticesIn(rod, box));
});

test('a stream without chunks is decoded as a whole', async () => {
  const { surface } = await lastBy(asUsual, at('gyroid.isostar'), { region });
  assert.deepEqual(surface.positions, (await last(gyroid)).positions);
  assert.equal(surface.info.chunkSide, 0);
});

test('a server that ignores ranges sends the whole file, once', async () => {
  const { surface, requests } = await lastBy((request, response) => {
    response.end(chunked);
    return true;
  });
  assert.deepEqual(surface.positions, whole.positions);
  assert.equal(requests.length, 1);
});

test('a server that ignores only later ranges', async () => {
  const { surface } = await lastBy((request, response) => {
    if (isFirst(request)) return false;
    response.end(chunked);
    return true;
  });
  assert.deepEqual(surface.positions, whole.positions);
});

test('a server that does not state ranges, as pages may not read them from elsewhere', async () => {
  const hidden = async (...args) => {
    const { status, body } = await fetch(...args);
    return new Response(body, { status });
  };
  for (const name of ['chunked.isostar', 'ball.isostar']) {
    const { surface } = await lastBy(asUsual, at(name, { fetch: hidden }));
    assert.ok(surface.final);
  }
});

test('headers and credentials are sent, and a fetch of one’s own is called', async () => {
  const inits = [];
  const source = at('ball.isostar', {
    headers: { 'X-Token': 'blue' },
    credentials: 'include',
    fetch: (...args) => (inits.push(args[1]), fetch(...args)),
  });
  const { requests } = await lastBy(asUsual, source);
  assert.equal(requests[0].headers['x-token'], 'blue');
  assert.equal(inits[0].credentials, 'include');
});

test('a Blob, and a file of Node', async () => {
  const part = await last(chunked, { region });
  for (const blob of [new Blob([chunked]), await openAsBlob(PATH)]) {
    const source = new RangeSource(blob);
    assert.deepEqual((await last(source)).positions, whole.positions);
    assert.deepEqual((await last(source, { region })).positions, part.positions);
  }
  await assert.rejects(last(new RangeSource(new Blob([chunked.subarray(0, 50_000)]))), {
    code: 'Truncated',
  });
});

test('what is no file, and what is no region', async () => {
  for (const file of [undefined, 7, {}, null])
    assert.throws(() => new RangeSource(file), { name: 'IsostarError', code: 'BadArgument' });
  for (const region of [
    null,
    7,
    {},
    { min: [0, 0, 0] },
    { min: [0, 0], max: [1, 1] },
    { min: [0, 0, 0], max: [1, 1, Infinity] },
    { min: [0, 0, 0], max: [1, 1, '1'] },
    { min: [0, 0, 2], max: [1, 1, 1] },
  ])
    await assert.rejects(last(chunked, { region }), { code: 'BadArgument' });
});

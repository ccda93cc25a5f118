import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { after, test } from 'node:test';
import { createDecoder } from 'isostar';
import {
  all,
  ballStream,
  emptyStream,
  encodeField,
  gyroidStream,
  inPieces,
  isostar,
  read,
} from './streams.mjs';

const gyroidPath = gyroidStream();
const gyroid = read(gyroidPath);
const ball = read(ballStream());
const decoder = await createDecoder();
after(() => decoder.dispose());

const whole = async (bytes, options) =>
  (await all(decoder.decode(bytes, { refinements: 'last', ...options })))[0];
const isSound = ({ positions, normals, indices }) => {
  assert.equal(normals.length, positions.length);
  assert.ok(positions.every(Number.isFinite));
  assert.ok(indices.every((vertex) => vertex < positions.length / 3));
};

test('a whole stream gives the surface that the command line decodes', async () => {
  const surface = await whole(gyroid);
  const info = JSON.parse(isostar('info', gyroidPath, '--json'));
  const mesh = `${gyroidPath}.ply`;
  const report = JSON.parse(isostar('decode', gyroidPath, mesh, '--json'));
  assert.equal(surface.positions.length / 3, report.vertices);
  assert.equal(surface.indices.length / 3, report.triangles);
  assert.equal(surface.bytes, gyroid.length);
  assert.equal(surface.final, true);
  assert.equal(surface.level, surface.levels - 1);
  assert.deepEqual(surface.info.size, [64, 60, 50]);
  assert.deepEqual(surface.info.spacing, [0.5, 1, 2]);
  assert.deepEqual(
    surface.info.layers.map(({ kind, offset }) => [kind, offset]),
    info.layers.map(({ kind, offset }) => [kind, offset]),
  );
  assert.equal(surface.error, info.layers.at(-1).error);
  isSound(surface);
});

test('WebAssembly and native code make the same vertices', async () => {
  const { positions } = await whole(gyroid, { frame: 'grid' });
  const mesh = `${gyroidPath}.grid.ply`;
  isostar('decode', gyroidPath, mesh, '--frame', 'grid');
  const file = readFileSync(mesh);
  const header = file.subarray(0, file.indexOf('end_header\n') + 11);
  const stride = 4 * (header.toString().match(/property float/g) ?? []).length;
  for (let vertex = 0; vertex < positions.length / 3; vertex++)
    for (let axis = 0; axis < 3; axis++)
      assert.equal(
        file.readFloatLE(header.length + vertex * stride + 4 * axis),
        positions[3 * vertex + axis],
        `vertex ${vertex}`,
      );
});

for (const length of [1, 7, 1000])
  test(`pieces of ${length} bytes give every layer, and the same final surface`, async () => {
    const surfaces = await all(decoder.decode(inPieces(gyroid, length), { refinements: 'all' }));
    assert.deepEqual(
      surfaces.map(({ bytes }) => bytes),
      surfaces.at(-1).info.layers.map(({ offset }) => offset),
    );
    assert.deepEqual(
      surfaces.map(({ final }) => final),
      surfaces.map((_, i) => i === surfaces.length - 1),
    );
    assert.deepEqual(surfaces.at(-1).positions, (await whole(gyroid)).positions);
    surfaces.forEach(isSound);
  });

test('every kind of source', async () => {
  const { positions } = await whole(ball);
  const sources = [
    ball,
    Buffer.from(ball),
    inPieces(ball, 50),
    new Response(ball),
    new Response(ball).body,
    new Blob([ball]).stream(),
  ];
  for (const source of sources)
    assert.deepEqual((await all(decoder.decode(source))).at(-1).positions, positions);
});

test('a slow consumer gets the first surface and then only the newest', async () => {
  const surfaces = await all(decoder.decode(gyroid));
  assert.equal(surfaces.length, 2);
  assert.equal(surfaces[0].bytes, surfaces[1].info.layers[0].offset);
  assert.equal(surfaces[1].final, true);
});

test('every prefix of a stream decodes', async () => {
  let before = 0;
  for (let length = 0; length <= ball.length; length++) {
    const surfaces = [];
    const decoding = (async () => {
      for await (const surface of decoder.decode(ball.subarray(0, length), { refinements: 'last' }))
        surfaces.push(surface);
    })();
    if (length === ball.length) await decoding;
    else
      await assert.rejects(
        decoding,
        { name: 'IsostarError', code: 'Truncated' },
        `${length} bytes`,
      );
    const shown = surfaces.at(-1)?.bytes ?? 0;
    assert.ok(shown >= before && shown <= length, `${length} bytes show ${shown}`);
    before = shown;
    surfaces.forEach(isSound);
  }
});

test('options', async () => {
  const cubes = await whole(ball);
  const tetrahedra = await whole(ball, { polygonizer: 'tetrahedra' });
  assert.ok(tetrahedra.positions.length > cubes.positions.length);
  isSound(tetrahedra);
  assert.equal((await whole(ball, { normals: false })).normals.length, 0);
  assert.deepEqual((await whole(ball, { isovalue: 0 })).positions, cubes.positions);
  const world = await whole(gyroid);
  const grid = await whole(gyroid, { frame: 'grid' });
  for (const vertex of [0, 1000])
    assert.ok(
      Math.abs(world.positions[3 * vertex + 2] - 2 * grid.positions[3 * vertex + 2]) < 1e-4,
    );
});

test('several isovalues in a stream, and values between them', async () => {
  const several = read(
    encodeField(
      'several',
      [30, 30, 30],
      (i, j, k) => 10 - Math.hypot(i - 15, j - 15, k - 15),
      '--near',
      '1,2',
    ),
  );
  const radius = ({ positions }) =>
    Math.hypot(positions[0] - 15, positions[1] - 15, positions[2] - 15);
  for (const isovalue of [0, 0.3, 1, 1.5, 2]) {
    const surface = await whole(several, { isovalue });
    isSound(surface);
    assert.equal(surface.isovalue, isovalue);
    assert.deepEqual(surface.info.isovalues, [0, 1, 2]);
    assert.ok(Math.abs(radius(surface) - (10 - isovalue)) < 0.3, `${isovalue}: ${radius(surface)}`);
  }
  assert.equal((await whole(several)).isovalue, 0);
  assert.ok((await whole(several)).info.layers.some(({ isovalue }) => isovalue === 2));
});

test('an iterable of isovalues changes the surface after the last byte', async () => {
  const several = read(
    encodeField(
      'several-by-iterable',
      [30, 30, 30],
      (i, j, k) => 10 - Math.hypot(i - 15, j - 15, k - 15),
      '--near',
      '2',
    ),
  );
  const seen = [];
  let next;
  const isovalue = (async function* () {
    for (let value; (value = await new Promise((resolve) => (next = resolve))) !== undefined;)
      yield value;
  })();
  const wanted = [0.5, 2, 1, undefined];
  for await (const surface of decoder.decode(several, { isovalue, refinements: 'last' })) {
    seen.push(surface.isovalue);
    assert.ok(surface.final);
    next(wanted.shift());
  }
  assert.deepEqual(seen, [0, 0.5, 2, 1]);
});

test('triangles are counter-clockwise from the smaller values; normals point to them', async () => {
  for (const polygonizer of ['cubes', 'tetrahedra']) {
    const { positions, normals, indices } = await whole(ball, { polygonizer });
    const point = (list, vertex) => list.subarray(3 * vertex, 3 * vertex + 3);
    let volume = 0;
    for (let i = 0; i < indices.length; i += 3) {
      const [a, b, c] = [0, 1, 2].map((corner) => point(positions, indices[i + corner]));
      volume +=
        a[0] * (b[1] * c[2] - b[2] * c[1]) +
        a[1] * (b[2] * c[0] - b[0] * c[2]) +
        a[2] * (b[0] * c[1] - b[1] * c[0]);
    }
    assert.ok(
      Math.abs(volume / 6 / ((4 / 3) * Math.PI * 6 ** 3) - 1) < 0.1,
      `${polygonizer}: ${volume / 6}`,
    );
    for (let vertex = 0; vertex < positions.length / 3; vertex++) {
      const [normal, position] = [point(normals, vertex), point(positions, vertex)];
      assert.ok(
        normal[0] * (position[0] - 7.5) +
          normal[1] * (position[1] - 7.5) +
          normal[2] * (position[2] - 7.5) >
          0,
        `${polygonizer}: vertex ${vertex}`,
      );
    }
  }
});

test('an empty surface is a surface', async () => {
  const surface = await whole(read(emptyStream()));
  assert.equal(surface.indices.length, 0);
  assert.equal(surface.final, true);
});

test('several streams decode at the same time', async () => {
  const expected = [await whole(ball), await whole(gyroid)];
  const surfaces = await Promise.all(
    [ball, gyroid].map(async (bytes) => (await all(decoder.decode(inPieces(bytes, 20)))).at(-1)),
  );
  surfaces.forEach(({ positions }, i) => assert.deepEqual(positions, expected[i].positions));
});

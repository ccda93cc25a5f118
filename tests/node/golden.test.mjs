// The golden streams decode to the surfaces of tests/golden/surfaces.txt in WebAssembly, as they do
// natively in tests/golden/golden_test.cpp.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { after, test } from 'node:test';
import { createDecoder } from 'isostar';
import { all } from './streams.mjs';

const decoder = await createDecoder();
after(() => decoder.dispose());

const fileOf = (name) => new URL(`../golden/${name}`, import.meta.url);
const rows = readFileSync(fileOf('surfaces.txt'), 'utf8')
  .split('\n')
  .filter((line) => line && !line.startsWith('#'))
  .map((line) => {
    const [stream, dimension, bytes, isovalue, , vertices, triangles, positions, indices] =
      line.split(' ');
    return {
      stream,
      dimension: Number(dimension),
      isovalue: Number(isovalue),
      surface: {
        bytes: Number(bytes),
        vertices: Number(vertices),
        triangles: Number(triangles),
        positions,
        indices,
      },
    };
  });

/** FNV-1a of 32 bits over integers, each as four bytes, least significant first. */
function checksum(numbers, whole = (n) => n) {
  let sum = 2166136261;
  for (const number of numbers)
    for (let shift = 0; shift < 32; shift += 8)
      sum = Math.imul(sum ^ ((whole(number) >>> shift) & 0xff), 16777619);
  return (sum >>> 0).toString(16);
}

const volumes = rows.filter(({ dimension }) => dimension === 3);

test('the table is not empty', () => assert.ok(volumes.length > 0));

for (const { stream, isovalue, surface } of volumes)
  test(`golden stream ${stream} at ${isovalue}`, async () => {
    const bytes = new Uint8Array(readFileSync(fileOf(`${stream}.isostar`)));
    const polygonizer = (await all(decoder.decode(bytes, { refinements: 'last' })))[0].info
      .polygonizer;
    const [found] = await all(
      decoder.decode(bytes, {
        polygonizer,
        isovalue,
        frame: 'grid',
        normals: false,
        refinements: 'last',
      }),
    );
    assert.equal(found.final, true);
    const { positions, indices } = found;
    assert.deepEqual(
      {
        bytes: found.bytes,
        vertices: positions.length / 3,
        triangles: indices.length / 3,
        positions: checksum(positions, (c) => Math.floor(c * 1024 + 0.5)),
        indices: checksum(indices),
      },
      surface,
    );
  });

for (const name of new Set(
  rows.filter(({ dimension }) => dimension !== 3).map(({ stream }) => stream),
))
  test(`golden stream ${name} is no volume and is refused`, () =>
    assert.rejects(all(decoder.decode(new Uint8Array(readFileSync(fileOf(`${name}.isostar`))))), {
      code: 'UnsupportedVersion',
    }));

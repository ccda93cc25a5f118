// The pieces of a surface: together they are the whole.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { createDecoder } from '../../web/dist/index.js';
import { encodeField } from './streams.mjs';

const SIZE = [130, 40, 70];
const waves = (i, j, k) => Math.sin(i / 5) + Math.cos(j / 4) + Math.sin(k / 6) - 0.3;

async function lastSurface(stream, options) {
  const decoder = await createDecoder();
  let last;
  for await (const surface of decoder.decode(readFileSync(stream), options)) last = surface;
  decoder.dispose();
  return last;
}

/** Each triangle as text, sorted. */
function trianglesOf({ positions, indices }) {
  const corner = (vertex) => positions.subarray(3 * vertex, 3 * vertex + 3).join(' ');
  const triangles = [];
  for (let i = 0; i < indices.length; i += 3)
    triangles.push([...indices.subarray(i, i + 3)].map(corner).join(', '));
  return triangles.sort();
}

for (const frame of ['world', 'grid']) {
  test(`pieces of a stream in chunks are the whole, in the frame ${frame}`, async () => {
    const options = ['--chunk', '64', '--spacing', '0.5,2,1'];
    const surface = await lastSurface(encodeField('waves', SIZE, waves, ...options), { frame });
    const { chunks } = surface;
    assert.equal(chunks.length, 6); // 3 × 1 × 2
    assert.equal(surface.chunks, chunks);
    assert.deepEqual(chunks.flatMap(trianglesOf).sort(), trianglesOf(surface));
    const spacing = frame === 'grid' ? [1, 1, 1] : [0.5, 2, 1];
    for (const { positions, normals, indices, min, max } of chunks) {
      assert.equal(normals.length, positions.length);
      assert.ok(indices.every((vertex) => vertex < positions.length / 3));
      assert.ok(positions.every((x, i) => x >= min[i % 3] && x <= max[i % 3]));
      for (let axis = 0; axis < 3; axis++)
        assert.ok(max[axis] - min[axis] <= 67 * spacing[axis], `${min} … ${max}`);
    }
  });
}

test('a stream of one chunk has one piece', async () => {
  const surface = await lastSurface(encodeField('small', [30, 30, 30], waves), { normals: false });
  const [piece, ...others] = surface.chunks;
  assert.deepEqual(others, []);
  assert.deepEqual(trianglesOf(piece), trianglesOf(surface));
  assert.equal(piece.normals.length, 0);
});

test('surfaces can be posted without their pieces', async () => {
  const surface = await lastSurface(encodeField('small', [30, 30, 30], waves));
  assert.equal(surface.chunks.length, 1);
  assert.deepEqual(structuredClone(surface).positions, surface.positions);
});

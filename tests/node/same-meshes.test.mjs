// Native code and WebAssembly make the same meshes of the same bytes, also of prefixes.
import assert from 'node:assert/strict';
import { createHash } from 'node:crypto';
import { readFileSync } from 'node:fs';
import { after, test } from 'node:test';
import { createDecoder } from 'isostar';
import { all, encodeField, encodeTetrahedra, isostar, read } from './streams.mjs';

const decoder = await createDecoder();
after(() => decoder.dispose());

/** -1 … 1, from a hash of the coordinates. */
const noise = (i, j, k) => {
  let h = 17;
  for (const c of [i, j, k]) h = Math.imul(h ^ c, 0x9e3779b1) ^ (h >>> 15);
  return (h >>> 0) / 2 ** 31 - 1;
};
const waves = (i, j, k) =>
  Math.sin(i / 3) * Math.cos(j / 4) + Math.sin(j / 3) * Math.cos(k / 5) + Math.sin(k / 3) + 0.2;

const streams = {
  waves: encodeField('waves', [33, 20, 27], waves, '--spacing', '1,0.5,2'),
  fitted: encodeField('fitted', [40, 37, 29], waves, '--effort', '2'),
  lossless: encodeField(
    'lossless',
    [20, 17, 9],
    waves,
    '--lossless',
    '--polygonizer',
    'tetrahedra',
  ),
  whole: encodeField(
    'whole',
    [24, 24, 24],
    (i, j, k) => Math.round(1000 * waves(i, j, k)),
    '--max-error',
    '0.01',
  ),
  adaptive: encodeField(
    'adaptive',
    [40, 33, 36],
    (i, j, k) => 13 - Math.hypot(i - 19, j - 16, k - 17),
    '--max-error',
    '0.2',
    '--adaptive',
  ),
  adaptiveFitted: encodeField(
    'adaptiveFitted',
    [40, 33, 36],
    (i, j, k) => 13 - Math.hypot(i - 19, j - 16, k - 17),
    '--max-error',
    '0.2',
    '--adaptive',
    '--effort',
    '2',
  ),
  severalFitted: encodeField(
    'severalFitted',
    [24, 20, 26],
    waves,
    '--near',
    '0.1,-0.2',
    '--effort',
    '2',
    '--polygonizer',
    'tetrahedra',
  ),
  topology: encodeField('topology', [40, 33, 36], waves, '--preserve-topology'),
  several: encodeField(
    'several',
    [24, 20, 26],
    (i, j, k) => Math.round(500 * waves(i, j, k)),
    '--near',
    '7.5,-20',
  ),
  trimmed: encodeTetrahedra(
    'trimmed',
    8,
    (i, j, k) => 4.3 - Math.hypot(i - 4.1, j - 3, k - 4.4),
    '--grid',
    '29',
  ),
  noise: encodeField('noise', [14, 15, 16], noise),
  rough: encodeField(
    'rough',
    [40, 9, 30],
    (i, j, k) => waves(i, j, k) + 0.5 * noise(i, j, k),
    '--max-error',
    '0.2',
  ),
};

const digest = (...arrays) => {
  const hash = createHash('sha256');
  for (const { buffer, byteOffset, byteLength } of arrays)
    hash.update(new Uint8Array(buffer, byteOffset, byteLength));
  return hash.digest('hex');
};

/** Positions, normals and triangles of a binary PLY file. */
function parsePly(file) {
  const end = file.indexOf('end_header\n') + 11;
  const header = file.subarray(0, end).toString();
  const [vertices, faces] = ['vertex', 'face'].map((element) =>
    Number(header.match(new RegExp(`element ${element} (\\d+)`))[1]),
  );
  const stride = 4 * header.match(/property float/g).length;
  const [positions, normals, indices] = [
    new Float32Array(3 * vertices),
    new Float32Array(3 * vertices),
    new Uint32Array(3 * faces),
  ];
  for (let vertex = 0; vertex < vertices; vertex++)
    for (let axis = 0; axis < 3; axis++) {
      positions[3 * vertex + axis] = file.readFloatLE(end + vertex * stride + 4 * axis);
      normals[3 * vertex + axis] = file.readFloatLE(end + vertex * stride + 12 + 4 * axis);
    }
  for (let face = 0, at = end + vertices * stride; face < faces; face++, at += 13)
    for (let corner = 0; corner < 3; corner++)
      indices[3 * face + corner] = file.readUInt32LE(at + 1 + 4 * corner);
  return digest(positions, normals, indices);
}

function nativeMesh(stream, length, polygonizer, isovalue) {
  const mesh = `${stream}.${length}.${polygonizer}.ply`;
  isostar(
    'decode',
    stream,
    mesh,
    '--bytes',
    String(length),
    '--polygonizer',
    polygonizer,
    '--frame',
    'grid',
    '--iso',
    String(isovalue),
  );
  return parsePly(readFileSync(mesh));
}

async function webMesh(bytes, polygonizer, isovalue) {
  const surfaces = [];
  try {
    for await (const surface of decoder.decode(bytes, {
      polygonizer,
      isovalue,
      frame: 'grid',
      refinements: 'last',
    }))
      surfaces.push(surface);
  } catch (error) {
    assert.equal(error.code, 'Truncated');
  }
  const { positions, normals, indices } = surfaces.at(-1);
  return digest(positions, normals, indices);
}

for (const [name, stream] of Object.entries(streams))
  test(`the same meshes of ${name}`, async () => {
    const bytes = read(stream);
    const { layers, isovalues } = (await all(decoder.decode(bytes, { refinements: 'last' })))[0]
      .info;
    const between = isovalues.length > 1 ? [(isovalues[0] + 2 * isovalues[1]) / 3] : [];
    const lengths = [
      layers[0].offset,
      layers[1].offset,
      Math.round(0.4 * bytes.length),
      Math.round(0.7 * bytes.length),
      bytes.length,
    ];
    for (const length of lengths.filter((length) => length >= layers[0].offset))
      for (const polygonizer of ['cubes', 'tetrahedra'])
        for (const isovalue of [...isovalues, ...between])
          assert.equal(
            await webMesh(bytes.subarray(0, length), polygonizer, isovalue),
            nativeMesh(stream, length, polygonizer, isovalue),
            `${polygonizer}, ${length} bytes, ${isovalue}`,
          );
  });

// Streams for tests: small synthetic volumes, encoded by the command line in build/.
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';

const CLI = fileURLToPath(new URL('../../build/isostar', import.meta.url));
const folder = mkdtempSync(join(tmpdir(), 'isostar-test-'));
process.on('exit', () => rmSync(folder, { recursive: true, force: true }));

/** Runs the command line and returns what it prints. */
export const isostar = (...options) =>
  execFileSync(CLI, options, { encoding: 'utf8', stdio: ['ignore', 'pipe', 'ignore'] });

/**
 * A field sampled at (i,j,k), x fastest, encoded at isovalue 0; the result is the stream's path.
 */
export function encodeField(name, [nx, ny, nz], field, ...options) {
  const samples = new Float32Array(nx * ny * nz);
  let n = 0;
  for (let k = 0; k < nz; k++)
    for (let j = 0; j < ny; j++) for (let i = 0; i < nx; i++) samples[n++] = field(i, j, k);
  const volume = join(folder, `${name}.raw`);
  const stream = join(folder, `${name}.isostar`);
  writeFileSync(volume, samples);
  isostar(
    'encode',
    volume,
    stream,
    '--iso',
    '0',
    '--size',
    `${nx},${ny},${nz}`,
    '--type',
    'f32',
    ...options,
  );
  return stream;
}

/**
 * Six tetrahedra in each of n³ unit cubes, rotated and sheared, with a field's values at
 * their corners, encoded at isovalue 0.
 */
export function encodeTetrahedra(name, n, field, ...options) {
  const points = [],
    values = [],
    cells = [];
  for (let k = 0; k <= n; k++)
    for (let j = 0; j <= n; j++)
      for (let i = 0; i <= n; i++) {
        points.push([0.8 * i - 0.6 * j, 0.6 * i + 0.8 * j, k + 0.3 * i].join(' '));
        values.push(field(i, j, k));
      }
  const steps = [1, n + 1, (n + 1) ** 2];
  for (let k = 0; k < n; k++)
    for (let j = 0; j < n; j++)
      for (let i = 0; i < n; i++)
        for (const [a, b, c] of [
          [0, 1, 2],
          [0, 2, 1],
          [1, 0, 2],
          [1, 2, 0],
          [2, 0, 1],
          [2, 1, 0],
        ]) {
          const first = i + steps[1] * j + steps[2] * k;
          cells.push(
            [
              4,
              first,
              first + steps[a],
              first + steps[a] + steps[b],
              first + steps[a] + steps[b] + steps[c],
            ].join(' '),
          );
        }
  const mesh = join(folder, `${name}.vtk`);
  const stream = join(folder, `${name}.isostar`);
  writeFileSync(
    mesh,
    `# vtk DataFile Version 3.0
${name}
ASCII
DATASET UNSTRUCTURED_GRID
POINTS ${points.length} float
${points.join('\n')}
CELLS ${cells.length} ${5 * cells.length}
${cells.join('\n')}
CELL_TYPES ${cells.length}
${cells.map(() => 10).join('\n')}
POINT_DATA ${values.length}
SCALARS f float 1
LOOKUP_TABLE default
${values.join('\n')}
`,
  );
  isostar('encode', mesh, stream, '--iso', '0', ...options);
  return stream;
}

const ball = (size) => (i, j, k) =>
  0.4 * size - Math.hypot(i - size / 2, j - size / 2, k - size / 2) + 0.01;
const gyroid = (period) => (i, j, k) => {
  const [x, y, z] = [i, j, k].map((c) => (2 * Math.PI * c) / period);
  return Math.sin(x) * Math.cos(y) + Math.sin(y) * Math.cos(z) + Math.sin(z) * Math.cos(x) + 0.123;
};

/** A few hundred bytes, so that a test can decode every prefix. */
export const ballStream = () => encodeField('ball', [17, 15, 16], ball(15));
/** Many levels and some ten kilobytes. */
export const gyroidStream = () =>
  encodeField('gyroid', [64, 60, 50], gyroid(25), '--spacing', '0.5,1,2');
/** Takes more than 4 MB to decode. */
export const largeStream = () => encodeField('large', [120, 120, 120], gyroid(25));
/** 2³ chunks on the last level. */
export const chunkedStream = () =>
  encodeField('chunked', [150, 140, 145], gyroid(60), '--chunk', '64');
/** A bent rod in 514 chunks: an index with pages. */
export const rodStream = () =>
  encodeField(
    'rod',
    [6, 6, 32880],
    (x, y, z) => 1.5 - Math.hypot(x - 2.5 - 0.6 * Math.sin(z / 9), y - 2.4 + 0.5 * Math.cos(z / 7)),
    '--chunk',
    '64',
  );
/** Three isovalues: 0, 0.25 and 0.5. */
export const severalStream = () =>
  encodeField('gyroids', [64, 60, 50], gyroid(25), '--near', '0.25,0.5');
export const emptyStream = () => encodeField('empty', [9, 9, 9], () => -1);

export const read = (stream) => new Uint8Array(readFileSync(stream));

/** The bytes in pieces of a length. */
export async function* inPieces(bytes, length) {
  for (let at = 0; at < bytes.length; at += length) yield bytes.subarray(at, at + length);
}

export async function all(surfaces) {
  const list = [];
  for await (const surface of surfaces) list.push(surface);
  return list;
}

// Volumes of any size, made by a program, as NRRD files.
import { closeSync, openSync, readFileSync, writeFileSync, writeSync } from 'node:fs';
import { gunzipSync } from 'node:zlib';

/** Values in 0 … 1 that look random, the same on every machine. */
function noise(i) {
  let h = Math.imul(i ^ (i >>> 15), 0x2c1b3c6d);
  h = Math.imul(h ^ (h >>> 12), 0x297a2d39);
  return ((h ^ (h >>> 15)) >>> 0) / 2 ** 32;
}

/**
 * A box of n³ samples with several materials: a shell of soft matter, a dense core, air in between,
 * a sheet about two samples thick, and noise everywhere. Details keep their size in samples, so
 * that a larger volume has more of them.
 */
function materials(n) {
  const samples = Buffer.alloc(n ** 3);
  const wave = Float64Array.from({ length: n }, (_, i) => Math.sin((2 * Math.PI * i) / 37));
  const cowave = Float64Array.from({ length: n }, (_, i) => Math.cos((2 * Math.PI * i) / 37));
  const centre = (n - 1) / 2;
  let at = 0;
  for (let z = 0; z < n; z++) {
    for (let y = 0; y < n; y++) {
      for (let x = 0; x < n; x++, at++) {
        const r = Math.hypot(x - centre, y - centre, z - centre) / centre;
        const gyroid = wave[x] * cowave[y] + wave[y] * cowave[z] + wave[z] * cowave[x];
        const sheet = 150 * Math.exp(-((gyroid / 0.17) ** 2));
        const material = r < 0.35 ? 190 : r < 0.9 ? 30 + sheet : r < 0.97 ? 110 : 20;
        samples[at] = Math.max(0, Math.min(255, material + 12 * (noise(at) - 0.5)));
      }
    }
  }
  return samples;
}

function header(type, sizes, spacings) {
  const lines = [
    'NRRD0004',
    `type: ${type}`,
    `dimension: ${sizes.length}`,
    `sizes: ${sizes.join(' ')}`,
    `spacings: ${spacings.join(' ')}`,
    'endian: little',
    'encoding: raw',
  ];
  return Buffer.from(`${lines.join('\n')}\n\n`);
}

function write(path, type, sizes, spacings, samples) {
  writeFileSync(path, Buffer.concat([header(type, sizes, spacings), samples]));
}

/** Writes a ball with a radius of 60 samples in the middle of n³; its surface is at 128.5. */
export function writeBall(path, n) {
  const centre = (n - 1) / 2;
  const file = openSync(path, 'w');
  writeSync(file, header('uint8', [n, n, n], [1, 1, 1]));
  const slice = Buffer.alloc(n * n);
  for (let z = 0; z < n; z++) {
    for (let y = 0, at = 0; y < n; y++) {
      for (let x = 0; x < n; x++, at++) {
        const r = Math.hypot(x - centre, y - centre, z - centre);
        slice[at] = Math.max(0, Math.min(255, 128 + 20 * (60 - r)));
      }
    }
    writeSync(file, slice);
  }
  closeSync(file);
}

/** Writes materials of n³ samples; their surface is at 100.5. */
export function writeMaterials(path, n) {
  write(path, 'uint8', [n, n, n], [1, 1, 1], materials(n));
}

/** Writes a gzipped NRRD file of 16-bit samples, repeated on each axis. */
export function writeTiled(path, source, times) {
  const file = readFileSync(source);
  const end = file.indexOf('\n\n');
  const text = file.toString('latin1', 0, end);
  const numbers = (field) =>
    new RegExp(`^${field}: (.*)$`, 'm').exec(text)[1].split(' ').map(Number);
  const [x, y, z] = numbers('sizes');
  const samples = gunzipSync(file.subarray(end + 2));
  const row = 2 * x;
  const rows = [];
  for (let k = 0; k < z * times[2]; k++) {
    for (let j = 0; j < y * times[1]; j++) {
      const from = ((k % z) * y + (j % y)) * row;
      for (let i = 0; i < times[0]; i++) rows.push(samples.subarray(from, from + row));
    }
  }
  const sizes = [x * times[0], y * times[1], z * times[2]];
  write(path, 'uint16', sizes, numbers('spacings'), Buffer.concat(rows));
}

// An elevation image made of nothing, the same on every machine: the example of docs/contours.md and of the benchmark.
import { deflateSync } from 'node:zlib';

export const WIDTH = 257, HEIGHT = 193;

/** In 0 … 1, of integers only. */
function lattice(x, y, seed) {
  let h = Math.imul(x, 374761393) ^ Math.imul(y, 668265263) ^ Math.imul(seed, 1442695041);
  h = Math.imul(h ^ (h >>> 13), 1274126177);
  return ((h ^ (h >>> 16)) >>> 0) / 0xffffffff;
}

const smooth = (t) => t * t * (3 - 2 * t);

function valueNoise(x, y, seed) {
  const [i, j] = [Math.floor(x), Math.floor(y)], [u, v] = [smooth(x - i), smooth(y - j)];
  const row = (k) => lattice(i, k, seed) * (1 - u) + lattice(i + 1, k, seed) * u;
  return row(j) * (1 - v) + row(j + 1) * v;
}

/** An island: hills of six sizes on a dome. */
function elevation(x, y) {
  const dome = 1 - 2.4 * ((x / WIDTH - 0.5) ** 2 + (y / HEIGHT - 0.5) ** 2);
  let hills = 0;
  for (let octave = 0; octave < 6; octave++) hills += (valueNoise((x * 2 ** octave) / 64, (y * 2 ** octave) / 64, octave + 3) - 0.5) / 1.75 ** octave;
  return 0.35 * dome + 0.6 * hills + 0.24;
}

function crc32(bytes) {
  let crc = ~0;
  for (const byte of bytes) {
    crc ^= byte;
    for (let bit = 0; bit < 8; bit++) crc = (crc >>> 1) ^ (crc & 1 ? 0xedb88320 : 0);
  }
  return ~crc >>> 0;
}

function chunk(type, data) {
  const body = Buffer.concat([Buffer.from(type, 'latin1'), data]);
  const framed = Buffer.alloc(body.length + 8);
  framed.writeUInt32BE(data.length, 0);
  body.copy(framed, 4);
  framed.writeUInt32BE(crc32(body), body.length + 4);
  return framed;
}

/** A grey PNG of 8 bits. */
function png(width, height, value) {
  const header = Buffer.alloc(13);
  header.writeUInt32BE(width, 0);
  header.writeUInt32BE(height, 4);
  header[8] = 8;
  const rows = Buffer.alloc((width + 1) * height);
  for (let y = 0; y < height; y++) for (let x = 0; x < width; x++) rows[y * (width + 1) + 1 + x] = Math.round(255 * Math.min(1, Math.max(0, value(x, y))));
  const signature = Buffer.from([0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a]);
  return Buffer.concat([signature, chunk('IHDR', header), chunk('IDAT', deflateSync(rows, { level: 9 })), chunk('IEND', Buffer.alloc(0))]);
}

/** A PNG whose contour at 0.5 is a coast. */
export const terrain = () => png(WIDTH, HEIGHT, elevation);

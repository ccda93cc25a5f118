// A synthetic elevation image, the same on every machine: the example of docs/contours.md and of
// the benchmark.
import { greyPng } from './png.mjs';

export const WIDTH = 257;
export const HEIGHT = 193;

/** A hash of a lattice point, in 0 … 1. Integer arithmetic makes it portable. */
function lattice(x, y, seed) {
  let h = Math.imul(x, 374761393) ^ Math.imul(y, 668265263) ^ Math.imul(seed, 1442695041);
  h = Math.imul(h ^ (h >>> 13), 1274126177);
  return ((h ^ (h >>> 16)) >>> 0) / 0xffffffff;
}

const smooth = (t) => t * t * (3 - 2 * t);

function valueNoise(x, y, seed) {
  const [i, j] = [Math.floor(x), Math.floor(y)];
  const [u, v] = [smooth(x - i), smooth(y - j)];
  const row = (k) => lattice(i, k, seed) * (1 - u) + lattice(i + 1, k, seed) * u;
  return row(j) * (1 - v) + row(j + 1) * v;
}

/** An island: hills of six sizes on a dome. */
function elevation(x, y) {
  const dome = 1 - 2.4 * ((x / WIDTH - 0.5) ** 2 + (y / HEIGHT - 0.5) ** 2);
  let hills = 0;
  for (let i = 0; i < 6; i++) {
    const noise = valueNoise((x * 2 ** i) / 64, (y * 2 ** i) / 64, i + 3);
    hills += (noise - 0.5) / 1.75 ** i;
  }
  return 0.35 * dome + 0.6 * hills + 0.24;
}

/** A PNG file whose contour at 0.5 is a coast. */
export const terrain = () => greyPng(WIDTH, HEIGHT, elevation);

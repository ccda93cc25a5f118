// The pictures of docs/contours.md: an elevation image, its contour encoded, and the contours that
// prefixes of the stream show.
// `node scripts/contours.mjs [FOLDER]`, after npm run build, writes contour-*.svg to docs/images or
// FOLDER and prints the page's table.
import { execFileSync } from 'node:child_process';
import { mkdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { HEIGHT, WIDTH, terrain } from './terrain.mjs';

const here = (path) => fileURLToPath(new URL(`../${path}`, import.meta.url));
const pictures = process.argv[2] ?? here('docs/images');
const quiet = { encoding: 'utf8', stdio: ['ignore', 'pipe', 'ignore'] };
const isostar = (...options) => execFileSync(here('build/isostar'), options, quiet);

mkdirSync(here('build/contours'), { recursive: true });
const image = here('build/contours/terrain.png');
const stream = here('build/contours/terrain.isostar');
writeFileSync(image, terrain());
isostar('encode', image, stream, '--iso', '0.5', '--lossless');
const { layers, vertices, bytes } = JSON.parse(isostar('info', stream, '--json'));
console.log(`${WIDTH} x ${HEIGHT} samples, ${vertices} points, ${bytes} bytes\n`);
console.log('| bytes | layer | RMS distance, pixels | picture |\n|---:|---|---:|---|');
layers.forEach(({ kind, level, offset, error }, i) => {
  const name = `contour-${i}.svg`;
  isostar('decode', stream, join(pictures, name), '--bytes', String(offset));
  const rms = error < 1e-5 ? 0 : error.toPrecision(2);
  console.log(`| ${offset} | ${kind} ${level} | ${rms} | [${name}](images/${name}) |`);
});

// Writes the NRRD volumes of a folder for print_surfaces: `node volume-list.mjs FOLDER OUT` makes
// OUT/volumes.txt and a file of 32-bit floats for each volume. Isovalues are those of the folder's
// README.md, as for the benchmark.
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { basename, join } from 'node:path';
import { gunzipSync } from 'node:zlib';
import { inputsOf } from '../../bench/measure/inputs.mjs';

const ARRAYS = {
  uint8: Uint8Array,
  int16: Int16Array,
  uint16: Uint16Array,
  float: Float32Array,
};

/** Sizes and samples of a little-endian file whose data follow the header. */
function readNrrd(path) {
  const file = readFileSync(path);
  const end = file.indexOf('\n\n') + 2;
  const header = file.subarray(0, end).toString('latin1');
  const field = (name) => header.match(new RegExp(`^${name}: *(.*)$`, 'm'))?.[1].trim();
  const data = field('encoding') === 'raw' ? file.subarray(end) : gunzipSync(file.subarray(end));
  const bytes = Uint8Array.from(data);
  const samples = Float32Array.from(new ARRAYS[field('type')](bytes.buffer));
  return { sizes: field('sizes'), samples };
}

const [folder, out] = process.argv.slice(2);
mkdirSync(out, { recursive: true });
const lines = inputsOf(folder)
  .filter(({ isovalue }) => isovalue !== undefined)
  .map(({ name, volume, isovalue }) => {
    const { sizes, samples } = readNrrd(volume);
    const file = `${basename(volume, '.nrrd')}.f32`;
    writeFileSync(join(out, file), samples);
    return `${name} ${sizes} ${isovalue} ${file}\n`;
  });
writeFileSync(join(out, 'volumes.txt'), lines.join(''));

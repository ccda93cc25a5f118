// `npm run bench [-- OPTIONS]`: isostar against Draco and others. Tables and plots are written to
// bench/out/.
import { mkdirSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';
import { chunks } from './chunks/chunks.mjs';
import { comparison } from './comparison/comparison.mjs';
import { figure6 } from './figure6/figure6.mjs';
import { defaultInputs, inputsOf } from './measure/inputs.mjs';
import { large } from './large/large.mjs';
import { paper } from './paper/paper.mjs';

const { values: options } = parseArgs({
  options: {
    data: { type: 'string' }, // a folder of NRRD files, with isovalues in its README.md
    rate: { type: 'boolean' }, // also against simplified meshes and other codecs, at five distances
    figure6: { type: 'boolean' }, // instead: the paper's figure 6, of the horse and five scans
    paper: { type: 'boolean' }, // instead: the paper's features other than uniform streams
    chunks: { type: 'boolean' }, // instead: the bytes of streams in chunks
    large: { type: 'boolean' }, // instead: volumes of up to 512³ samples
    quick: { type: 'boolean' }, // fewer points and rounds
    threads: { type: 'string', default: '2' }, // of the times with several threads
    effort: { type: 'string' }, // of isostar's encoder; results go to a folder of their own
    only: { type: 'string' }, // surfaces whose name contains this
    build: { type: 'string', default: fileURLToPath(new URL('../build', import.meta.url)) },
  },
});
const folder = options.effort ? `out/effort-${options.effort}` : 'out';
const out = fileURLToPath(new URL(folder, import.meta.url));
const build = resolve(options.build);

const inputs = (options.data ? inputsOf(options.data) : defaultInputs(join(build, 'scans')))
  .filter(({ name }) => name.includes(options.only ?? ''))
  .map((input) => ({ ...input, effort: options.effort }));
mkdirSync(out, { recursive: true });
const modes = { chunks, figure6, large, paper };
const mode = Object.keys(modes).find((name) => options[name]);
const run = modes[mode] ?? comparison;
await run({ build, inputs, options, out });

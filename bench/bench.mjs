// `npm run bench [-- --data DIR] [--rate] [--figure6 | --paper] [--quick] [--effort 2] [--only NAME]`: isostar against Draco and others, tables and plots under bench/out/.
import { mkdirSync, writeFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';
import { atOnce } from './at-once.mjs';
import { changes } from './changes.mjs';
import { mainCriteria, rateCriteria } from './criteria.mjs';
import { figure6, figure6Inputs } from './figure6.mjs';
import { curves, figures } from './figures.mjs';
import { defaultInputs, inputsOf } from './inputs.mjs';
import * as native from './native.mjs';
import { paper } from './paper.mjs';
import { plot } from './plot.mjs';
import { detail, lowRates, overview, rates } from './tables.mjs';
import { printVerdicts } from './verdicts.mjs';
import { wasmTimes } from './wasm.mjs';

const AT_ONCE = 2;  // sizes do not depend on what else the machine does; times do, and are taken one after the other

const { values: options } = parseArgs({
  options: {
    data: { type: 'string' },  // a folder of NRRD files, with isovalues in its README.md
    rate: { type: 'boolean' },  // also against simplified meshes and other codecs, at five distances
    figure6: { type: 'boolean' },  // instead: the paper's figure 6, of the horse and five scans
    paper: { type: 'boolean' },  // instead: what the paper promises beyond uniform streams
    quick: { type: 'boolean' },  // fewer points and rounds
    effort: { type: 'string' },  // of isostar's encoder; results go to a folder of their own
    only: { type: 'string' },  // surfaces whose name contains this
    build: { type: 'string', default: fileURLToPath(new URL('../build', import.meta.url)) },
  },
});
const out = fileURLToPath(new URL(options.effort ? `out/effort-${options.effort}` : 'out', import.meta.url));
const build = resolve(options.build);
const program = join(build, 'isostar_bench');

async function measureSizes(inputs) {
  return atOnce(AT_ONCE, inputs, async (input) => {
    const result = await native.sizes(program, input, options);
    console.log(`${input.name}: ${result.default?.bytes ?? 'no surface, no'} bytes`);
    return result;
  });
}

async function measureTimes(input) {
  const folder = join(out, 'files', input.name);
  mkdirSync(folder, { recursive: true });
  const times = await native.times(program, input, folder, options);
  const [stream, draco] = [join(folder, 'surface.isostar'), join(folder, 'surface.drc')];
  return {
    times,
    wasm: await wasmTimes(build, stream, draco, options.quick ? 200 : 1500),
    memory: { isostar: await native.memory(program, 'isostar', stream), draco: await native.memory(program, 'draco', draco) },
  };
}

function report(all) {
  const rated = options.rate ? [rates(all), lowRates(all)] : [];
  const tables = [overview(all), ...rated, ...all.map(detail)];
  writeFileSync(join(out, 'table.md'), `# isostar against Draco and others\n\n${tables.join('\n\n')}`);
  for (const { name, raw } of all) writeFileSync(join(out, `${name}.svg`), plot(name, curves(raw)));
  console.log(`\n${[overview(all), ...rated].join('\n\n')}`);
  const changed = changes(all, join(out, 'sizes.json'));
  if (changed.length) console.log(`\nbytes against the run before\n  ${changed.join('\n  ')}`);
  printVerdicts('the comparison', mainCriteria(all));
  if (options.rate) printVerdicts('the rate', rateCriteria(all));
}

async function compare(inputs) {
  const surfaces = {};
  const measured = await measureSizes(inputs);
  for (const [place, raw] of measured.entries()) {
    if (raw.triangles === 0) continue;
    const { name } = inputs[place];
    surfaces[name] = { ...raw, ...(await measureTimes(inputs[place])) };
  }
  writeFileSync(join(out, 'results.json'), JSON.stringify({ rate: Boolean(options.rate), surfaces }, null, 1));
  const all = Object.entries(surfaces).map(([name, raw]) => ({ name, raw, ...figures(raw) }));
  if (all.length === 0) throw new Error('bench: nothing to compare');
  report(all);
  console.log(`\nbench/out/: results.json, table.md, ${all.length} plots`);
}

const inputs = (options.data ? inputsOf(options.data) : defaultInputs(join(build, 'scans')))
  .filter(({ name }) => name.includes(options.only ?? ''))
  .map((input) => ({ ...input, effort: options.effort }));
mkdirSync(out, { recursive: true });
if (options.figure6) await figure6((input) => native.figure6(program, input, options), AT_ONCE, figure6Inputs(inputs), out);
else if (options.paper) await paper(build, inputs, options, AT_ONCE, out);
else await compare(inputs);

// `npm run bench`: sizes, distances, times and memory of isostar, Draco and others.
import { mkdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { inParallel } from '../measure/in-parallel.mjs';
import * as native from '../measure/native-program.mjs';
import { wasmTimes } from '../measure/wasm-times.mjs';
import { printVerdicts } from '../output/verdicts.mjs';
import {
  FEWEST_IN_CHUNKS,
  mainCriteria,
  rateCriteria,
  threadCriteria,
} from './comparison-criteria.mjs';
import { plot } from './comparison-plot.mjs';
import { detail, lowRates, overview, rates } from './comparison-tables.mjs';
import { sizeChanges } from './size-changes.mjs';
import { curves, figures } from './surface-figures.mjs';

async function measureSizes(program, inputs, options) {
  return inParallel(native.PARALLEL, inputs, async (input) => {
    const result = await native.sizes(program, input, options);
    console.log(`${input.name}: ${result.default?.bytes ?? 'no surface, no'} bytes`);
    return result;
  });
}

/** One surface at a time: other work on the machine changes times. */
async function measureTimes(build, input, options, folder) {
  mkdirSync(folder, { recursive: true });
  const program = join(build, 'isostar_bench');
  const times = await native.times(program, input, folder, options);
  const [stream, draco] = [join(folder, 'surface.isostar'), join(folder, 'surface.drc')];
  return {
    times,
    wasm: await wasmTimes(build, stream, draco, options.quick ? 200 : 1500),
    memory: {
      isostar: await native.memory(program, 'isostar', stream),
      draco: await native.memory(program, 'draco', draco),
    },
  };
}

function report(all, options, out) {
  const rated = options.rate ? [rates(all), lowRates(all)] : [];
  const tables = [overview(all), ...rated, ...all.map(detail)];
  const title = '# isostar against Draco and others';
  writeFileSync(join(out, 'table.md'), `${title}\n\n${tables.join('\n\n')}`);
  for (const { name, raw } of all) writeFileSync(join(out, `${name}.svg`), plot(name, curves(raw)));
  console.log(`\n${[overview(all), ...rated].join('\n\n')}`);
  const changes = sizeChanges(all, join(out, 'sizes.json'));
  if (changes.length) console.log(`\nbytes against the previous run\n  ${changes.join('\n  ')}`);
  printVerdicts('the comparison', mainCriteria(all));
  printVerdicts(
    `${options.threads} threads, surfaces of ${FEWEST_IN_CHUNKS.toLocaleString('en')} vertices`,
    threadCriteria(all),
  );
  if (options.rate) printVerdicts('the rate', rateCriteria(all));
}

/** Measures each surface, writes tables and plots to `out`, prints tables and verdicts. */
export async function comparison({ build, inputs, options, out }) {
  const surfaces = {};
  const measured = await measureSizes(join(build, 'isostar_bench'), inputs, options);
  for (const [index, raw] of measured.entries()) {
    if (raw.triangles === 0) continue;
    const input = inputs[index];
    const times = await measureTimes(build, input, options, join(out, 'files', input.name));
    surfaces[input.name] = { ...raw, ...times };
  }
  const results = { rate: Boolean(options.rate), surfaces };
  writeFileSync(join(out, 'results.json'), JSON.stringify(results, null, 1));
  const all = Object.entries(surfaces).map(([name, raw]) => ({ name, raw, ...figures(raw) }));
  if (all.length === 0) throw new Error('bench: no surface to compare');
  report(all, options, out);
  console.log(`\nbench/out/: results.json, table.md, ${all.length} plots`);
}

// `npm run bench -- --figure6`: rate and distortion as in the paper's figure 6. Plots and tables
// are written to bench/out/figure6/.
import { mkdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { inParallel } from '../measure/in-parallel.mjs';
import * as native from '../measure/native-program.mjs';
import { bytesAt, envelope } from '../measure/rate-curve.mjs';
import { fixed, kilobytes, table } from '../output/markdown.mjs';
import { CODERS, plotFigure6 } from './figure6-plot.mjs';

const SURFACES = ['horse', 'cthead-500.5', 'mri', 'engine-80.5', 'tooth-600.5', 'headsq-500.5'];
const DISTANCES = [0.2, 0.1, 0.05, 0.02]; // RMS, grid steps

/** The paper's horse and five scans, as far as the folder has them; all inputs if it has none. */
function chosenInputs(inputs) {
  const chosen = SURFACES.map((name) => inputs.find((input) => input.name === name)).filter(
    Boolean,
  );
  return chosen.length > 0 ? chosen : inputs;
}

/** Progressive streams keep every point: between two layers the surface may not change. */
const bytes = (curves, key, rms) =>
  bytesAt(CODERS[key].progressive ? curves[key] : envelope(curves[key]), rms);

function rows(name, curves) {
  return DISTANCES.map((rms) => ({
    name,
    rms,
    ...Object.fromEntries(Object.keys(CODERS).map((key) => [key, bytes(curves, key, rms)])),
  }));
}

const figure6Table = (all) =>
  table(
    all.flatMap(({ name, curves }) => rows(name, curves)),
    [
      ['surface', (row) => (row.rms === DISTANCES[0] ? row.name : '')],
      ['RMS', (row) => row.rms],
      ...Object.entries(CODERS).map(([key, { title }]) => [
        `${title}, kB`,
        (row) => kilobytes(row[key]),
      ]),
    ],
  );

/**
 * The parts of single-rate streams, at the points nearest to RMS 0.1. The paper counts a bit per
 * vertex and a symbol of {=, <, >} per leaf.
 */
const singleRateTable = (all) =>
  table(
    all.map(({ name, curves }) => ({ name, ...nearest(curves.singleRate, 0.1) })),
    [
      ['single rate', (row) => row.name],
      ['RMS', (row) => fixed(row.rms, 3)],
      ['leaves', (row) => row.leaves],
      ['vertices', (row) => row.vertices],
      ['bits per vertex: levels, signs', (row) => fixed((8 * row.connectivity) / row.vertices, 2)],
      ['scalars', (row) => fixed((8 * (row.bytes - row.connectivity)) / row.vertices, 2)],
      [
        'the paper’s count of levels, signs',
        (row) => fixed(1 + (Math.log2(3) * row.leaves) / row.vertices, 2),
      ],
    ],
  );

const nearest = (points, rms) =>
  points
    .filter((point) => point.rms > 0)
    .reduce((a, b) => (Math.abs(Math.log(b.rms / rms)) < Math.abs(Math.log(a.rms / rms)) ? b : a));

/** Measures, draws and prints the surfaces that have triangles. */
export async function figure6({ build, inputs, options, out }) {
  const folder = join(out, 'figure6');
  mkdirSync(folder, { recursive: true });
  const program = join(build, 'isostar_bench');
  const measured = await inParallel(native.PARALLEL, chosenInputs(inputs), async (input) => {
    const curves = await native.figure6(program, input, options);
    console.log(input.name);
    return { name: input.name, curves };
  });
  const all = measured.filter(({ curves }) => curves.prefixes);
  if (all.length === 0) throw new Error('bench: no surface to compare');
  for (const { name, curves } of all)
    writeFileSync(join(folder, `${name}.svg`), plotFigure6(name, curves));
  writeFileSync(
    join(folder, 'results.json'),
    JSON.stringify(Object.fromEntries(all.map(({ name, curves }) => [name, curves])), null, 1),
  );
  const tables = `${figure6Table(all)}\n\n${singleRateTable(all)}\n`;
  writeFileSync(join(folder, 'table.md'), tables);
  console.log(`\n${tables}\nbench/out/figure6/: results.json, table.md, ${all.length} plots`);
}

// `npm run bench -- --figure6`: rate and distortion as in the paper's figure 6, plots and one table under bench/out/figure6/.
import { mkdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { atOnce } from './at-once.mjs';
import { bytesAt, envelope } from './curve.mjs';
import { fixed, kilobytes, table } from './format.mjs';
import { CODERS, plotFigure6 } from './plot-figure6.mjs';

const SURFACES = ['horse', 'cthead-500.5', 'mri', 'engine-80.5', 'tooth-600.5', 'headsq-500.5'];
const DISTANCES = [0.2, 0.1, 0.05, 0.02];  // RMS, grid steps

/** The paper's horse and five scans where the folder has them; all otherwise. */
export function figure6Inputs(inputs) {
  const chosen = SURFACES.map((name) => inputs.find((input) => input.name === name)).filter(Boolean);
  return chosen.length > 0 ? chosen : inputs;
}

/** Progressive streams keep every point: between two layers they may show nothing new. */
const bytes = (curves, key, rms) => bytesAt(CODERS[key].progressive ? curves[key] : envelope(curves[key]), rms);

function rows(name, curves) {
  return DISTANCES.map((rms) => ({ name, rms, ...Object.fromEntries(Object.keys(CODERS).map((key) => [key, bytes(curves, key, rms)])) }));
}

export const figure6Table = (all) =>
  table(all.flatMap(({ name, curves }) => rows(name, curves)), [
    ['surface', (row) => (row.rms === DISTANCES[0] ? row.name : '')],
    ['RMS', (row) => row.rms],
    ...Object.entries(CODERS).map(([key, { title }]) => [`${title}, kB`, (row) => kilobytes(row[key])]),
  ]);

/** What the single-rate streams consist of, at the points nearest to RMS 0.1; the paper promises a bit a vertex and a symbol of {=, <, >} a leaf. */
export const singleRateTable = (all) =>
  table(all.map(({ name, curves }) => ({ name, ...nearest(curves.singleRate, 0.1) })), [
    ['single rate', (row) => row.name],
    ['RMS', (row) => fixed(row.rms, 3)],
    ['leaves', (row) => row.leaves],
    ['vertices', (row) => row.vertices],
    ['bits per vertex: levels, signs', (row) => fixed((8 * row.connectivity) / row.vertices, 2)],
    ['scalars', (row) => fixed((8 * (row.bytes - row.connectivity)) / row.vertices, 2)],
    ['the paper’s count of levels, signs', (row) => fixed(1 + (Math.log2(3) * row.leaves) / row.vertices, 2)],
  ]);

const nearest = (points, rms) =>
  points.filter((point) => point.rms > 0).reduce((a, b) => (Math.abs(Math.log(b.rms / rms)) < Math.abs(Math.log(a.rms / rms)) ? b : a));

/** Draws and prints what measure(input) gives; surfaces without triangles are left out. */
export async function figure6(measure, count, inputs, out) {
  const folder = join(out, 'figure6');
  mkdirSync(folder, { recursive: true });
  const measured = await atOnce(count, inputs, async (input) => {
    const curves = await measure(input);
    console.log(input.name);
    return { name: input.name, curves };
  });
  const all = measured.filter(({ curves }) => curves.prefixes);
  if (all.length === 0) throw new Error('bench: nothing to compare');
  for (const { name, curves } of all) writeFileSync(join(folder, `${name}.svg`), plotFigure6(name, curves));
  writeFileSync(join(folder, 'results.json'), JSON.stringify(Object.fromEntries(all.map(({ name, curves }) => [name, curves])), null, 1));
  const tables = `${figure6Table(all)}\n\n${singleRateTable(all)}\n`;
  writeFileSync(join(folder, 'table.md'), tables);
  console.log(`\n${tables}\nbench/out/figure6/: results.json, table.md, ${all.length} plots`);
}

// `npm run bench -- --chunks`: what it costs to code surfaces in chunks that are independent of
// each other. Tables are written to bench/out/chunks/.
import { mkdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { inParallel } from '../measure/in-parallel.mjs';
import * as native from '../measure/native-program.mjs';
import { fixed, table } from '../output/markdown.mjs';

const SIDES = [128, 64];

const geometricMean = (ratios) =>
  Math.exp(ratios.reduce((sum, ratio) => sum + Math.log(ratio), 0) / ratios.length);

/** The sizes of a stream in chunks of a side, relative to the stream as a whole. */
function ratios({ bytes, layers, chunks }, side) {
  const of = chunks.find((entry) => entry.side === side);
  const relative = (coded) => (bytes - layers + coded) / bytes;
  return {
    contexts: relative(of.continued),
    coarse: relative(of.coarse),
    initial: relative(of.initial),
    seeing: relative(of.coarseSeeingScalars),
    total: of.stream / bytes,
    twice: 1 + of.shared,
    cropped: of.cropped / bytes,
    differing: of.differing,
  };
}

const percent = (ratio) => fixed((ratio - 1) * 100, 2);

function sideTable(all, side) {
  const rows = all.map(({ name, result }) => ({ name, ...ratios(result, side) }));
  const keys = ['contexts', 'initial', 'coarse', 'seeing', 'total', 'twice', 'cropped'];
  const mean = Object.fromEntries(
    keys.map((key) => [key, geometricMean(rows.map((row) => row[key]))]),
  );
  const column = (heading, key) => [heading, (row) => percent(row[key])];
  return table(
    [...rows, { name: `geometric mean of ${rows.length}`, ...mean }],
    [
      [`chunks of ${side}³: larger by, %`, (row) => row.name],
      column('contexts cut', 'contexts'),
      column('+ models anew', 'initial'),
      column('+ models from coarse levels', 'coarse'),
      column('the same, contexts see scalars', 'seeing'),
      column('streams in chunks', 'total'),
      column('last planes twice, vertices', 'twice'),
      column('independent streams', 'cropped'),
      ['vertices that differ', (row) => row.differing ?? ''],
    ],
  );
}

/** Measures and prints the surfaces. */
export async function chunks({ build, inputs, out }) {
  const folder = join(out, 'chunks');
  mkdirSync(folder, { recursive: true });
  const program = join(build, 'isostar_bench');
  const all = await inParallel(native.PARALLEL, inputs, async (input) => {
    const result = await native.chunks(program, input);
    console.log(input.name);
    return { name: input.name, result };
  });
  const tables = SIDES.map((side) => sideTable(all, side)).join('\n\n');
  writeFileSync(join(folder, 'results.json'), JSON.stringify(all, null, 1));
  writeFileSync(join(folder, 'table.md'), `${tables}\n`);
  console.log(`\n${tables}\n\nbench/out/chunks/: results.json, table.md`);
}

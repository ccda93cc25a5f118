// `npm run bench -- --paper`: what the paper promises beyond uniform streams (adaptive, one topology, close by, irregular, two
// dimensions), each as a criterion.
import { existsSync, mkdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { terrain } from '../scripts/terrain.mjs';
import { atOnce } from './at-once.mjs';
import * as native from './native.mjs';
import { paperCriteria } from './paper-criteria.mjs';
import { paperTables } from './paper-tables.mjs';
import { printVerdicts } from './verdicts.mjs';

const ADAPTIVE = ['horse', 'bunny'];
const ADAPTIVE_BOUND = 0.2;  // grid steps
const ONE_TOPOLOGY = ['tooth-600.5', 'neghip', 'horse'];
const CLOSE_BY = ['cthead-500.5', 'mri', 'engine-80.5'];
const FARTHER = 1.02;  // the second isovalue
// Bounds of 2 and 1 % of the longest side in the world, where they count from the tetrahedra; undefined: the default one.
const TETRAHEDRA = [
  { file: 'bluntfin.vtu', isovalue: 1.2, bounds: [undefined, 0.44, 0.22] },
  { file: 'fire.vtu', isovalue: 350, bounds: [undefined, 0.12, 0.06] },
];

/** The isosurfaces of these names, without what the folder lacks. */
const those = (inputs, names) => names.map((name) => inputs.find((input) => input.name === name)).filter(Boolean);

function tetrahedraInputs({ data, only = '' }) {
  return TETRAHEDRA.flatMap(({ file, isovalue, bounds }) => {
    const [name, volume] = [file.replace('.vtu', ''), join(data ?? '', file)];
    if (!data || !name.includes(only) || !existsSync(volume)) return [];
    return bounds.map((worldBound) => ({ name, volume, isovalue, worldBound }));
  });
}

function remarkOnMissing(inputs, { data, only }) {
  if (only) return;
  const names = [...new Set([...ADAPTIVE, ...ONE_TOPOLOGY, ...CLOSE_BY])].filter((name) => !inputs.some((input) => input.name === name));
  const files = TETRAHEDRA.map(({ file }) => file).filter((file) => !data || !existsSync(join(data, file)));
  const missing = [...names, ...files];
  if (missing.length) console.warn(`bench: not measured, as --data FOLDER has not got them: ${missing.join(', ')}`);
}

/** One job for each thing to measure: { criterion, name, work }. */
function jobs(build, inputs, options, folder) {
  const [program, command] = [join(build, 'isostar_bench'), join(build, 'isostar')];
  const job = (criterion, input, work) => ({ criterion, name: [input.name, input.worldBound].filter(Boolean).join(' '), work: async () => ({ ...input, ...(await work()) }) });
  const image = join(folder, 'terrain.png');
  writeFileSync(image, terrain());
  return [
    ...those(inputs, ADAPTIVE).map((input) => job('adaptive', input, () => native.adaptive(program, input, ADAPTIVE_BOUND, options))),
    ...those(inputs, ONE_TOPOLOGY).map((input) => job('topology', input, () => native.topology(program, input))),
    ...those(inputs, CLOSE_BY).map((input) => job('near', input, () => native.near(program, input, FARTHER * input.isovalue))),
    ...tetrahedraInputs(options).map((input) =>
      job('tetrahedra', input, () => native.tetrahedra(program, command, input, join(folder, `${input.name}-${input.worldBound ?? 'default'}.isostar`), options))),
    ...(options.only ? [] : [job('image', { name: 'image' }, () => native.image(program, image, 0.5))]),
  ];
}

/** Measures all that is there, prints tables and verdicts, writes both to bench/out/paper/. */
export async function paper(build, inputs, options, count, out) {
  const folder = join(out, 'paper');
  mkdirSync(folder, { recursive: true });
  remarkOnMissing(inputs, options);
  const waiting = jobs(build, inputs, options, folder);
  if (waiting.length === 0) throw new Error('bench: nothing to measure');
  const measured = { bound: ADAPTIVE_BOUND, adaptive: [], topology: [], near: [], tetrahedra: [], image: [] };
  const results = await atOnce(count, waiting, async ({ criterion, name, work }) => {
    const result = await work();
    console.log(`${criterion}: ${name}`);
    return { criterion, result };
  });
  for (const { criterion, result } of results) measured[criterion].push(result);
  writeFileSync(join(folder, 'results.json'), JSON.stringify(measured, null, 1));
  const tables = paperTables(measured);
  writeFileSync(join(folder, 'table.md'), tables);
  console.log(`\n${tables}`);
  printVerdicts('beyond uniform streams', paperCriteria(measured));
  console.log('\nbench/out/paper/: results.json, table.md');
}

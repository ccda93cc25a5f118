// `npm run bench -- --paper`: the paper's features other than uniform streams (adaptive streams,
// preserved topology, further isovalues, tetrahedral meshes, images), each as a criterion.
import { existsSync, mkdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { terrain } from '../../scripts/terrain.mjs';
import { inParallel } from '../measure/in-parallel.mjs';
import * as native from '../measure/native-program.mjs';
import { printVerdicts } from '../output/verdicts.mjs';
import { paperCriteria } from './paper-criteria.mjs';
import { paperTables } from './paper-tables.mjs';

const ADAPTIVE = ['horse', 'bunny'];
const ADAPTIVE_BOUND = 0.2; // grid steps
const PRESERVED_TOPOLOGY = ['tooth-600.5', 'neghip', 'horse'];
const FURTHER = ['cthead-500.5', 'mri', 'engine-80.5'];
const FURTHER_FACTOR = 1.02; // the second isovalue, over the first one
// Bounds of 2 and 1 % of the longest side, in world units; undefined: the default bound.
const TETRAHEDRA = [
  { file: 'bluntfin.vtu', isovalue: 1.2, bounds: [undefined, 0.44, 0.22] },
  { file: 'fire.vtu', isovalue: 350, bounds: [undefined, 0.12, 0.06] },
];

/** The inputs of these names, as far as the folder has them. */
const those = (inputs, names) =>
  names.map((name) => inputs.find((input) => input.name === name)).filter(Boolean);

function tetrahedraInputs({ data, only = '' }) {
  return TETRAHEDRA.flatMap(({ file, isovalue, bounds }) => {
    const [name, volume] = [file.replace('.vtu', ''), join(data ?? '', file)];
    if (!data || !name.includes(only) || !existsSync(volume)) return [];
    return bounds.map((worldBound) => ({ name, volume, isovalue, worldBound }));
  });
}

function warnOfMissing(inputs, { data, only }) {
  if (only) return;
  const names = [...new Set([...ADAPTIVE, ...PRESERVED_TOPOLOGY, ...FURTHER])].filter(
    (name) => !inputs.some((input) => input.name === name),
  );
  const files = TETRAHEDRA.map(({ file }) => file).filter(
    (file) => !data || !existsSync(join(data, file)),
  );
  const missing = [...names, ...files];
  if (missing.length)
    console.warn(
      `bench: not measured, because --data FOLDER does not hold them: ${missing.join(', ')}`,
    );
}

/** A job per measurement: { criterion, name, work }. */
function jobs(build, inputs, options, folder) {
  const [program, command] = [join(build, 'isostar_bench'), join(build, 'isostar')];
  const job = (criterion, input, work) => ({
    criterion,
    name: [input.name, input.worldBound].filter(Boolean).join(' '),
    work: async () => ({ ...input, ...(await work()) }),
  });
  const image = join(folder, 'terrain.png');
  writeFileSync(image, terrain());
  return [
    ...those(inputs, ADAPTIVE).map((input) =>
      job('adaptive', input, () => native.adaptive(program, input, ADAPTIVE_BOUND, options)),
    ),
    ...those(inputs, PRESERVED_TOPOLOGY).map((input) =>
      job('topology', input, () => native.topology(program, input)),
    ),
    ...those(inputs, FURTHER).map((input) =>
      job('further', input, () =>
        native.furtherIsovalue(program, input, FURTHER_FACTOR * input.isovalue),
      ),
    ),
    ...tetrahedraInputs(options).map((input) =>
      job('tetrahedra', input, () =>
        native.tetrahedra(
          program,
          command,
          input,
          join(folder, `${input.name}-${input.worldBound ?? 'default'}.isostar`),
          options,
        ),
      ),
    ),
    ...(options.only
      ? []
      : [job('image', { name: 'image' }, () => native.image(program, image, 0.5))]),
  ];
}

/** Measures, writes results and tables to bench/out/paper/, prints tables and verdicts. */
export async function paper({ build, inputs, options, out }) {
  const folder = join(out, 'paper');
  mkdirSync(folder, { recursive: true });
  warnOfMissing(inputs, options);
  const waiting = jobs(build, inputs, options, folder);
  if (waiting.length === 0) throw new Error('bench: no input to measure');
  const measured = {
    bound: ADAPTIVE_BOUND,
    adaptive: [],
    topology: [],
    further: [],
    tetrahedra: [],
    image: [],
  };
  const results = await inParallel(native.PARALLEL, waiting, async ({ criterion, name, work }) => {
    const result = await work();
    console.log(`${criterion}: ${name}`);
    return { criterion, result };
  });
  for (const { criterion, result } of results) measured[criterion].push(result);
  writeFileSync(join(folder, 'results.json'), JSON.stringify(measured, null, 1));
  const tables = paperTables(measured);
  writeFileSync(join(folder, 'table.md'), tables);
  console.log(`\n${tables}`);
  printVerdicts('other than uniform streams', paperCriteria(measured));
  console.log('\nbench/out/paper/: results.json, table.md');
}

// The inputs of a benchmark: { name, volume, isovalue }. The name is also a file name; without an
// isovalue the native program takes Otsu's threshold.
import { existsSync, mkdirSync, readFileSync, readdirSync } from 'node:fs';
import { basename, join } from 'node:path';
import { SURFACES, volumeOf } from '../../scripts/sample-scans.mjs';

const SYNTHETIC = ['sphere', 'torus', 'gyroid', 'noise'];

/** The demo's scans, if this machine has or can fetch them, and the native program's fields. */
export function defaultInputs(cache) {
  return [
    ...sampleScans(cache),
    ...SYNTHETIC.map((name) => ({ name, volume: `synthetic:${name}` })),
  ];
}

function sampleScans(cache) {
  try {
    mkdirSync(cache, { recursive: true });
    return SURFACES.map(({ id, scan, isovalue }) => ({
      name: id,
      volume: volumeOf(scan, cache),
      isovalue,
    }));
  } catch (reason) {
    console.warn(`bench: the sample scans are missing: ${reason.message.split('\n')[0]}`);
    return [];
  }
}

/** Every NRRD file of a folder, at each isovalue in the table of its README.md. */
export function inputsOf(folder) {
  const table = isovaluesIn(folder);
  const files = readdirSync(folder)
    .filter((file) => file.endsWith('.nrrd'))
    .sort();
  return files.flatMap((file) => {
    const volume = join(folder, file);
    const stem = basename(file, '.nrrd');
    const isovalues = table.get(file) ?? [];
    if (isovalues.length === 0) return [{ name: stem, volume }];
    return isovalues.map((isovalue) => ({
      name: isovalues.length > 1 ? `${stem}-${isovalue}` : stem,
      volume,
      isovalue,
    }));
  });
}

/**
 * Rows `| name.nrrd | size | type | spacing | isovalue | …`; a name may list several endings:
 * `step_020/045.nrrd`.
 */
function isovaluesIn(folder) {
  const readme = join(folder, 'README.md');
  const table = new Map();
  if (!existsSync(readme)) return table;
  for (const line of readFileSync(readme, 'utf8').split('\n')) {
    const [, names = '', , , , isovalue = ''] = line.split('|').map((cell) => cell.trim());
    if (!names.endsWith('.nrrd') || isovalue === '' || !Number.isFinite(Number(isovalue))) continue;
    for (const file of spelledOut(names))
      table.set(file, [...(table.get(file) ?? []), Number(isovalue)]);
  }
  return table;
}

function spelledOut(names) {
  const [first, ...others] = names.slice(0, -'.nrrd'.length).split('/');
  return [first, ...others.map((ending) => first.slice(0, -ending.length) + ending)].map(
    (stem) => `${stem}.nrrd`,
  );
}

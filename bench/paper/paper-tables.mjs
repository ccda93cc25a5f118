// The tables of `npm run bench -- --paper`.
import { fixed, significant, table } from '../output/markdown.mjs';
import { adaptiveFigures, furtherShare, tetrahedraFigures } from './paper-criteria.mjs';

const EXACT = 1e-5; // a smaller stated error means none

const whole = (bytes) => (bytes === undefined ? '–' : String(Math.round(bytes)));

const adaptiveTable = (bound, all) =>
  table(all.map(adaptiveFigures), [
    [`--max-error ${bound}`, (row) => row.name],
    ['uniform, bytes', (row) => whole(row.sameBound)],
    ['adaptive, bytes', (row) => whole(row.bytes)],
    ['RMS', (row) => significant(row.rms)],
    ['max', (row) => fixed(row.max, 3)],
    ['uniform at that RMS', (row) => whole(row.uniform)],
    ['simplify × Draco at that RMS', (row) => whole(row.simplified)],
  ]);

const topologyTable = (all) =>
  table(all, [
    ['--preserve-topology', (row) => row.name],
    ['uniform, bytes', (row) => row.uniform],
    ['preserved topology, bytes', (row) => row.bytes],
    ['first surface, bytes', (row) => row.layers[0].offset],
    [
      'components, genus of the last layer',
      (row) => `${row.layers.at(-1).components}, ${row.layers.at(-1).genus ?? '–'}`,
    ],
  ]);

const furtherTable = (all) =>
  table(all, [
    ['--near', (row) => `${row.name}, ${fixed(row.other, 2)}`],
    ['first alone, bytes', (row) => row.bytes],
    ['second alone', (row) => row.otherBytes],
    ['second on top', (row) => row.together - row.bytes],
    ['share of its own file', (row) => `${fixed(100 * furtherShare(row), 1)} %`],
  ]);

const tetrahedraTable = (all) =>
  table(all.map(tetrahedraFigures), [
    ['tetrahedra', (row) => row.name],
    ['grid', (row) => row.grid],
    ['bytes', (row) => row.bytes],
    ['RMS there', (row) => significant(row.there.rms)],
    ['max', (row) => significant(row.there.max)],
    ['RMS back', (row) => significant(row.back.rms)],
    ['max', (row) => significant(row.back.max)],
    ['Draco at that RMS', (row) => whole(row.dracoBytes)],
    ['simplify × Draco', (row) => whole(row.simplifiedBytes)],
  ]);

const imageTable = ([{ layers }]) =>
  table(layers, [
    ['image', (row) => `${row.kind} ${row.level}`],
    ['bytes', (row) => row.offset],
    ['RMS', (row) => (row.error < EXACT ? 0 : significant(row.error))],
  ]);

/** A table per kind of measurement; distances are grid steps, of tetrahedra the mesh's unit. */
export function paperTables({ bound, adaptive, topology, further, tetrahedra, image }) {
  const tables = [
    adaptive.length && adaptiveTable(bound, adaptive),
    topology.length && topologyTable(topology),
    further.length && furtherTable(further),
    tetrahedra.length && tetrahedraTable(tetrahedra),
    image.length && imageTable(image),
  ];
  return `${tables.filter(Boolean).join('\n\n')}\n`;
}

// The tables of bench/out/table.md, and the README's table.
import { geometricMean } from '../measure/rate-curve.mjs';
import { ERRORS } from './surface-figures.mjs';
import { fixed, kilobytes, significant, table, times } from '../output/markdown.mjs';

const at = (one, rms) => one.rate.find((point) => point.rms === rms);
const atRms005 = (key) => (one) => times(at(one, 0.05)?.[key]);

export function overview(all) {
  const { threads } = all[0];
  return table(all, [
    ['surface', (one) => one.name],
    ['vertices', (one) => one.vertices],
    ['isostar kB', (one) => kilobytes(one.bytes)],
    ['bits per vertex: connectivity', (one) => fixed(one.connectivity, 2)],
    ['geometry', (one) => fixed(one.geometry, 2)],
    ['RMS', (one) => fixed(one.rms, 4)],
    ['max', (one) => fixed(one.max, 3)],
    ['Draco 10 kB at that RMS', (one) => kilobytes(one.dracoBytes)],
    ['smaller at RMS 0.05', atRms005('draco10')],
    ['decode: native', (one) => times(one.decode)],
    [`${threads} threads`, (one) => times(one.decodeInThreads)],
    ['gain', (one) => fixed(one.decodeGain, 2)],
    ['wasm', (one) => times(one.wasm)],
    ['encode', (one) => times(one.encode7)],
    [`${threads} threads`, (one) => times(one.encode7InThreads)],
    ['gain', (one) => fixed(one.encodeGain, 2)],
    ['memory', (one) => times(one.memory)],
  ]);
}

/** The README's table. */
export const summary = (all) =>
  table(all, [
    ['surface', (one) => one.name],
    ['vertices', (one) => one.vertices],
    ['isostar, kB', (one) => kilobytes(one.bytes)],
    ['Draco at the same distance, kB', (one) => kilobytes(one.dracoBytes)],
    ['times smaller', (one) => fixed(one.dracoBytes && one.dracoBytes / one.bytes, 1)],
    ['RMS distance, grid steps', (one) => fixed(one.rms, 4)],
    ['decoding time, Draco = 1', (one) => fixed(one.decode, 2)],
  ]);

export const rates = (all) =>
  table(
    [...all, meanRates(all)],
    [
      ['times smaller', (one) => one.name],
      ...ERRORS.flatMap((rms) => [
        [`RMS ${rms}: kB`, (one) => kilobytes(at(one, rms).bytes)],
        ['Draco', (one) => fixed(at(one, rms).draco10, 2)],
        ['simplified', (one) => fixed(at(one, rms).simplified, 2)],
      ]),
    ],
  );

function meanRates(all) {
  const mean = (rms, key) =>
    geometricMean(all.map((one) => at(one, rms)[key]).filter((ratio) => ratio !== undefined));
  return {
    name: 'geometric mean',
    rate: ERRORS.map((rms) => ({
      rms,
      draco10: mean(rms, 'draco10'),
      simplified: mean(rms, 'simplified'),
    })),
  };
}

export const lowRates = (all) =>
  table(all, [
    ['RMS: isostar / simplified', (one) => one.name],
    ...all[0].lowRates.map(({ share }, i) => [
      `${100 * share} % of the bytes`,
      (one) =>
        `${significant(one.lowRates[i].isostar)} / ${significant(one.lowRates[i].simplified)}`,
    ]),
  ]);

/** All measurements of one surface. */
export function detail({ name, raw }) {
  const bits = ({ bytes }) => fixed((8 * bytes) / raw.vertices, 2);
  const rows = [
    {
      what: 'isostar',
      ...raw.default,
      milliseconds: raw.times?.decode.isostarPolygonized,
      wasm: raw.wasm?.isostarPolygonized,
    },
    { what: 'isostar, lossless', ...raw.lossless, rms: 0, max: raw.lossless.largestDifference },
    ...(raw.bounds ?? []).map((point) => ({
      what: `isostar, --max-error ${point.maxError}`,
      ...point,
    })),
    ...raw.draco.map((point) => ({
      what: `Draco level ${point.level}, ${point.bits} bits`,
      ...point,
      ...dracoTimes(raw, point),
    })),
    ...(raw.meshopt ?? []).map((point) => ({
      what: `meshoptimizer and zstd, ${point.bits} bits`,
      ...point,
    })),
    ...(raw.zstdVolume ? [{ what: 'the volume, by zstd', bytes: raw.zstdVolume }] : []),
  ];
  const columns = [
    ['', (row) => row.what],
    ['bytes', (row) => row.bytes],
    ['bits per vertex', bits],
    ['RMS', (row) => significant(row.rms)],
    ['max', (row) => significant(row.max)],
    ['decode ms, native', (row) => fixed(row.milliseconds, 1)],
    ['wasm', (row) => fixed(row.wasm, 1)],
  ];
  const { isovalue, vertices, triangles } = raw;
  const counts = `Isovalue ${isovalue}, ${vertices} vertices, ${triangles} triangles.`;
  return `## ${name}\n\n${counts} ![](${name}.svg)\n\n${table(rows, columns)}\n`;
}

function dracoTimes(raw, { level, bits }) {
  if (bits !== 10) return {};
  return {
    milliseconds: raw.times?.decode[`draco${level}`],
    wasm: level === 7 ? raw.wasm?.draco7 : undefined,
  };
}

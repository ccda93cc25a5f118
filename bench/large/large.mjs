// `npm run bench -- --large [--data DIR]`: volumes of up to 512³ samples: times and memory with one
// and two threads, and the bytes that an eighth takes; and one surface in boxes of up to 1024³.
// Tables are written to bench/out/large/.
import { spawnSync } from 'node:child_process';
import { existsSync, mkdirSync, rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { fixed, table } from '../output/markdown.mjs';
import { writeBall, writeMaterials, writeTiled } from './volumes.mjs';

const SIDES = [128, 256, 512];
const BOXES = [128, 256, 512, 1024];
const HEAD = 'cthead.nrrd';

/** Runs the command and returns what it prints as JSON. */
function run(command, ...args) {
  const { status, stdout, stderr } = spawnSync(command, [...args, '--json'], { encoding: 'utf8' });
  if (status !== 0) throw new Error(`${command} ${args.join(' ')}: ${stderr}`);
  return JSON.parse(stdout);
}

/** The box of the first half of the samples on each axis. */
const eighth = (size) => [0, 0, 0, ...size.map((n) => Math.floor(n / 2) - 1)].join(',');

function measure(command, folder, { name, path, isovalue }) {
  const stream = join(folder, 'large.isostar');
  const mesh = join(folder, 'large.stl');
  const encoded = ['1', '2'].map((threads) =>
    run(command, 'encode', path, stream, '--iso', isovalue, '--threads', threads),
  );
  const decoded = ['1', '2'].map((threads) =>
    run(command, 'decode', stream, mesh, '--frame', 'grid', '--threads', threads),
  );
  const info = run(command, 'info', stream);
  const region = run(
    command,
    ...['decode', stream, mesh, '--frame', 'grid', '--threads', '2'],
    ...['--region', eighth(info.size)],
  );
  for (const file of [stream, mesh, path]) rmSync(file);
  const seconds = (report, work) =>
    (report.milliseconds[work] + report.milliseconds.polygonize) / 1e3;
  return {
    name,
    vertices: info.vertices,
    bytes: info.bytes,
    encode: encoded.map(({ milliseconds }) => milliseconds.encode / 1e3),
    encodeMemory: encoded.map(({ peakMemory }) => peakMemory),
    decode: decoded.map((report) => seconds(report, 'decode')),
    decodeMemory: decoded.map(({ peakMemory }) => peakMemory),
    region: region.bytes / info.bytes,
    regionTime: seconds(region, 'decode'),
  };
}

/** What it costs to decode a surface that does not grow with its box. */
function measureBox(command, folder, n) {
  const path = join(folder, 'volume.nrrd');
  const stream = join(folder, 'large.isostar');
  const mesh = join(folder, 'large.stl');
  writeBall(path, n);
  run(command, 'encode', path, stream, '--iso', '128.5', '--chunk', '128');
  const runs = Array.from({ length: 5 }, () =>
    run(command, 'decode', stream, mesh, '--frame', 'grid', '--threads', '1'),
  );
  const { bytes, vertices } = run(command, 'info', stream);
  for (const file of [stream, mesh, path]) rmSync(file);
  const best = (work) => Math.min(...runs.map(({ milliseconds }) => milliseconds[work]));
  return {
    n,
    bytes,
    vertices,
    decode: best('decode'),
    polygonize: best('polygonize'),
    memory: Math.min(...runs.map(({ peakMemory }) => peakMemory)),
  };
}

/** Measures and prints the volumes. */
export async function large({ build, options, out }) {
  const folder = join(out, 'large');
  mkdirSync(folder, { recursive: true });
  const command = join(build, 'isostar');
  const path = join(folder, 'volume.nrrd');
  const results = SIDES.filter((n) => !options.quick || n < 512).map((n) => {
    writeMaterials(path, n);
    return measure(command, folder, { name: `materials ${n}³`, path, isovalue: '100.5' });
  });
  const head = options.data && join(options.data, HEAD);
  if (head && existsSync(head) && !options.quick) {
    writeTiled(path, head, [2, 2, 4]);
    results.push(measure(command, folder, { name: 'CT head, 2 × 2 × 4', path, isovalue: '500.5' }));
  }
  const boxes = BOXES.filter((n) => !options.quick || n < 512).map((n) =>
    measureBox(command, folder, n),
  );
  const megabytes = (bytes) => fixed(bytes / 1e6, 0);
  const both = (values, digits) => values.map((value) => fixed(value, digits)).join(', ');
  const text = table(results, [
    ['volume', (row) => row.name],
    ['vertices', (row) => row.vertices],
    ['kB', (row) => fixed(row.bytes / 1e3, 0)],
    ['bits a vertex', (row) => fixed((8 * row.bytes) / row.vertices, 2)],
    ['encode, s, 1 and 2 threads', (row) => both(row.encode, 2)],
    ['MB', (row) => row.encodeMemory.map(megabytes).join(', ')],
    ['decode and polygonize, s', (row) => both(row.decode, 2)],
    ['MB', (row) => row.decodeMemory.map(megabytes).join(', ')],
    ['an eighth: part of the bytes', (row) => fixed(row.region, 3)],
    ['s, 2 threads', (row) => fixed(row.regionTime, 2)],
  ]);
  const boxText = table(boxes, [
    ['box', (row) => `${row.n}³`],
    ['vertices', (row) => row.vertices],
    ['kB', (row) => fixed(row.bytes / 1e3, 1)],
    ['decode, ms', (row) => fixed(row.decode, 0)],
    ['polygonize, ms', (row) => fixed(row.polygonize, 0)],
    ['MB', (row) => megabytes(row.memory)],
  ]);
  writeFileSync(join(folder, 'large.md'), `${text}\n${boxText}`);
  console.log(`${text}\n${boxText}`);
}

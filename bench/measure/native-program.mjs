// Runs build/isostar_bench, which prints JSON.
import { spawn } from 'node:child_process';
import { once } from 'node:events';
import { text } from 'node:stream/consumers';

/** How many runs go on at the same time if only sizes and distances matter, and not times. */
export const PARALLEL = 2;

async function run(program, args) {
  const child = spawn(program, args, { stdio: ['ignore', 'pipe', 'inherit'] });
  const [output, [status]] = await Promise.all([text(child.stdout), once(child, 'close')]);
  if (status !== 0) throw new Error(`${args.join(' ')}: exit status ${status}`);
  return JSON.parse(output);
}

const subject = ({ volume, isovalue, effort }) => [
  volume,
  ...(isovalue === undefined ? [] : ['--iso', String(isovalue)]),
  ...(effort === undefined ? [] : ['--effort', effort]),
];

export const sizes = (program, input, { rate, quick }) =>
  run(program, [
    'sizes',
    ...subject(input),
    ...(rate ? ['--rate'] : []),
    ...(quick ? ['--points', '2000', '--prefixes', '6'] : []),
  ]);

export const figure6 = (program, input, { quick }) =>
  run(program, [
    'figure6',
    ...subject(input),
    ...(quick ? ['--points', '2000', '--prefixes', '6'] : []),
  ]);

export const times = (program, input, folder, { quick, threads }) =>
  run(program, [
    'times',
    ...subject(input),
    '--keep',
    folder,
    '--milliseconds',
    quick ? '200' : '1500',
    '--threads',
    threads,
  ]);

export const memory = (program, codec, file) => run(program, ['memory', codec, file]);

const accuracy = ({ quick }, more = []) => (quick ? ['--points', '2000', ...more] : []);

export const adaptive = (program, input, maxError, options) =>
  run(program, [
    'adaptive',
    ...subject(input),
    '--max-error',
    String(maxError),
    ...accuracy(options, ['--prefixes', '6']),
  ]);

export const topology = (program, input) => run(program, ['topology', ...subject(input)]);

export const furtherIsovalue = (program, input, isovalue) =>
  run(program, ['near', ...subject(input), '--near', String(isovalue)]);

export const chunks = (program, input) => run(program, ['chunks', ...subject(input)]);

export const image = (program, file, isovalue) =>
  run(program, ['image', file, '--iso', String(isovalue)]);

/** Encodes with the command line, then measures the stream. */
export async function tetrahedra(
  program,
  command,
  { volume, isovalue, worldBound },
  stream,
  options,
) {
  const given = ['--iso', String(isovalue)];
  const bound = worldBound ? ['--max-error', String(worldBound), '--units', 'world'] : [];
  await run(command, ['encode', volume, stream, ...given, ...bound, '--json']);
  return run(program, ['tetrahedra', volume, stream, ...given, ...accuracy(options)]);
}

// Mutates files of formats that the command line reads in a child process, and runs the command on
// them: `children.mjs SECONDS ISOSTAR SEEDS FINDINGS`. The command must end by itself with status 0
// or 1 and one line of words, within limits of time and memory that follow from the file's length.
// A file with which it does not lands in FINDINGS; exit status 1.
import { spawnSync } from 'node:child_process';
import { mkdirSync, mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { extname, join } from 'node:path';

const [seconds, command, seeds, findings] = process.argv.slice(2);
const KINDS = ['dicom', 'vtk', 'nrrd', 'meta_image', 'nifti', 'tiff'];
const EXTENSIONS = { nrrd: '.nrrd', meta_image: '.mha', nifti: '.nii', tiff: '.tif' };
/** Children may use 8 s of processor time and 1 GB; the rest is the command's own. */
const MOST_MS = 15_000;
const MOST_KILOBYTES = 3_000_000;

/** Of a linear congruential generator; SEED in the environment repeats a run. */
let state = Number(process.env.SEED ?? Date.now() % 2 ** 32);
console.log(`seed: ${state}`);
const random = (below) => {
  state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
  return Math.floor((state / 2 ** 32) * below);
};
const oneOf = (list) => list[random(list.length)];

const NUMBERS = ['0', '-1', '1', '255', '65536', '2147483647', '4294967296', '1e30', 'nan', ''];
const WORDS = [0, 1, 0x7f, 0xff, 0xffff, 0x7fffffff, 0xffffffff, 0x10000000];

/** One change of bytes: flip, overwrite, cut, repeat, delete, or another number in words. */
function mutated(bytes) {
  const at = random(bytes.length);
  switch (random(7)) {
    case 0:
      bytes[at] ^= 1 << random(8);
      return bytes;
    case 1:
      bytes[at] = random(256);
      return bytes;
    case 2:
      if (at + 4 <= bytes.length) bytes.writeUInt32LE(oneOf(WORDS), at);
      return bytes;
    case 3:
      return bytes.subarray(0, at);
    case 4: {
      const piece = bytes.subarray(at, at + random(64));
      return Buffer.concat([bytes.subarray(0, at), piece, bytes.subarray(at)]);
    }
    case 5:
      return Buffer.concat([bytes.subarray(0, at), bytes.subarray(at + random(16))]);
    default: {
      const text = bytes.toString('latin1');
      const numbers = [...text.matchAll(/-?\d+(\.\d+)?/g)];
      if (numbers.length === 0) return bytes;
      const { index, 0: old } = oneOf(numbers);
      const changed = text.slice(0, index) + oneOf(NUMBERS) + text.slice(index + old.length);
      return Buffer.from(changed, 'latin1');
    }
  }
}

/** What is wrong with how the command ended; empty if nothing is. */
function wrong(path) {
  const target = path + '.isostar';
  const run = spawnSync(
    'bash',
    [
      '-c',
      `ulimit -v ${MOST_KILOBYTES}; exec "$@"`,
      '-',
      command,
      ...['encode', path, target, '--iso', '0.5'],
    ],
    { encoding: 'utf8', timeout: MOST_MS, killSignal: 'SIGKILL' },
  );
  rmSync(target, { force: true });
  if (run.error) return run.error.message;
  if (run.signal) return `ended by ${run.signal}`;
  if (run.status !== 0 && run.status !== 1) return `status ${run.status}: ${run.stderr}`;
  const lines = run.stderr.trim().split('\n');
  if (run.status === 1 && (lines.length !== 1 || lines[0] === '')) return `words: ${run.stderr}`;
  return '';
}

const files = KINDS.flatMap((kind) =>
  readdirSync(join(seeds, kind), { withFileTypes: true })
    .filter((entry) => entry.isFile())
    .map(({ name }) => ({
      kind,
      extension: EXTENSIONS[kind] ?? extname(name),
      bytes: readFileSync(join(seeds, kind, name)),
    })),
);
mkdirSync(findings, { recursive: true });
const folder = mkdtempSync(join(tmpdir(), 'isostar-children-'));
const end = Date.now() + Number(seconds) * 1000;
let executions = 0;
let found = 0;
let slowest = 0;
while (Date.now() < end) {
  const { kind, extension, bytes } = oneOf(files);
  let changed = Buffer.from(bytes);
  for (let i = random(4); i >= 0 && changed.length > 0; i -= 1) changed = mutated(changed);
  const path = join(folder, 'input' + extension);
  writeFileSync(path, changed);
  const start = Date.now();
  const what = wrong(path);
  slowest = Math.max(slowest, Date.now() - start);
  executions += 1;
  if (what === '') continue;
  found += 1;
  const kept = join(findings, `${kind}-${state.toString(16)}${extension}`);
  writeFileSync(kept, changed);
  console.log(`finding ${kept}: ${what}`);
}
rmSync(folder, { recursive: true });
console.log(`slowest: ${slowest} ms`);
console.log(`executions: ${executions}`);
process.exitCode = found > 0 ? 1 : 0;

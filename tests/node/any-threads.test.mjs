// The codec has no threads. Measuring and converting have: their results are the same however the
// threads are scheduled, on one core or on all.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { ballStream, encodeTetrahedra, gyroidStream } from './streams.mjs';

const CLI = fileURLToPath(new URL('../../build/isostar', import.meta.url));
const RUNS = 3;

/** What `isostar` prints, on one core or on all. */
const isostar = (onOneCore, ...options) => {
  const [command, ...first] = onOneCore ? ['taskset', '-c', firstCore(), CLI] : [CLI];
  return execFileSync(command, [...first, ...options], {
    encoding: 'utf8',
    stdio: ['ignore', 'pipe', 'ignore'],
  });
};

/** A core that this process may use. */
const firstCore = () =>
  readFileSync('/proc/self/status', 'utf8').match(/^Cpus_allowed_list:\s*(\d+)/m)[1];

/** Calls `make(onOneCore)` several times and expects the same each time. */
function expectSame(make) {
  const first = make(true);
  for (let run = 0; run < RUNS; run++) assert.deepEqual(make(false), first);
}

test('tetrahedra are converted to the same bytes', () => {
  const ball = (i, j, k) => 4.3 - Math.hypot(i - 4.1, j - 3, k - 4.4);
  const mesh = encodeTetrahedra('threads', 8, ball).replace('.isostar', '.vtk');
  expectSame((onOneCore) => {
    isostar(onOneCore, 'encode', mesh, `${mesh}.isostar`, '--iso', '0', '--grid', '29');
    return readFileSync(`${mesh}.isostar`);
  });
});

test('models are converted to the same bytes', () => {
  const stream = ballStream();
  const model = `${stream}.ply`;
  isostar(false, 'decode', stream, model);
  expectSame((onOneCore) => {
    isostar(onOneCore, 'encode', model, `${model}.isostar`, '--grid', '40');
    return readFileSync(`${model}.isostar`);
  });
});

test('distances are the same', () => {
  const [a, b] = [ballStream(), gyroidStream()];
  const mesh = `${a}.threads.ply`;
  isostar(false, 'decode', a, mesh);
  expectSame((onOneCore) => isostar(onOneCore, 'compare', mesh, b, '--json'));
});

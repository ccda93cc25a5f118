// Neither the command nor the package uses the network by itself. What pages request is checked by
// tests/browser/browser.mjs.
import assert from 'node:assert/strict';
import { execFileSync, spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync, readdirSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { ballStream, encodeTetrahedra } from './streams.mjs';

const root = (path) => fileURLToPath(new URL(`../../${path}`, import.meta.url));
const folder = mkdtempSync(join(tmpdir(), 'isostar-network-'));
after(() => rmSync(folder, { recursive: true, force: true }));

const guard = join(folder, 'network_guard.so');
execFileSync('g++', ['-shared', '-fPIC', root('tests/native/network_guard.cpp'), '-o', guard]);
const guarded = (command, ...options) =>
  spawnSync(command, options, { env: { ...process.env, LD_PRELOAD: guard }, encoding: 'utf8' });

test('the guard ends a program that opens a connection', () => {
  const { signal, status } = guarded('bash', '-c', 'exec 3<>/dev/tcp/127.0.0.1/9');
  assert.ok(signal === 'SIGABRT' || status === 134);
});

test('the command encodes and decodes without a socket', () => {
  const [raw, tetrahedra] = [ballStream(), encodeTetrahedra('mesh', 4, (i, j, k) => i + j + k - 5)];
  const isostar = (...options) => {
    const { status, signal, stderr } = guarded(root('build/isostar'), ...options);
    assert.equal(status, 0, signal ?? stderr);
  };
  const out = join(folder, 'out.isostar');
  const size = ['--size', '17,15,16', '--type', 'f32'];
  isostar('encode', raw.replace('.isostar', '.raw'), out, '--iso', '0', ...size);
  isostar('info', out);
  isostar('decode', out, join(folder, 'mesh.ply'));
  isostar('compare', join(folder, 'mesh.ply'), out);
  // Read by VTK, in a child process.
  isostar('encode', tetrahedra.replace('.isostar', '.vtk'), out, '--iso', '0');
});

test('the package names no address', () => {
  const dist = root('web/dist');
  for (const file of readdirSync(dist).filter((name) => name.endsWith('.js')))
    assert.doesNotMatch(readFileSync(join(dist, file), 'utf8'), /\b(?:https?|wss?):\/\//, file);
});

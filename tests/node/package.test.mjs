import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, readFileSync } from 'node:fs';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';

const here = (path) => fileURLToPath(new URL(path, import.meta.url));
const manifest = JSON.parse(readFileSync(here('../../web/package.json'), 'utf8'));
const node = (...options) =>
  execFileSync(process.execPath, options, {
    cwd: here('.'),
    encoding: 'utf8',
    stdio: ['ignore', 'pipe', 'pipe'],
  });

test('each entry can be imported without a DOM', () => {
  for (const entry of ['isostar', 'isostar/three', 'isostar/element', 'isostar/worker'])
    node(
      '--input-type=module',
      '-e',
      `await import('${entry}'); if (globalThis.document) throw 'a DOM'`,
    );
});

test('each entry names files that exist, types first', () => {
  for (const target of Object.values(manifest.exports)) {
    if (typeof target === 'object') assert.equal(Object.keys(target)[0], 'types');
    for (const file of typeof target === 'object' ? Object.values(target) : [target])
      assert.ok(existsSync(here(`../../web/${file}`)), file);
  }
});

test('decodes under a policy without code from strings', () => {
  const program = `
    import { createDecoder } from 'isostar';
    import { ballStream, read } from './streams.mjs';
    const decoder = await createDecoder();
    for await (const { indices } of decoder.decode(read(ballStream())))
      if (indices.length === 0) throw 'no triangles';`;
  node('--disallow-code-generation-from-strings', '--input-type=module', '-e', program);
});

test('the raw module exports exactly what src/codec/raw.ts declares', async () => {
  const { default: createModule } = await import('../../build/wasm/decoder.js');
  const raw = await createModule({ wasmBinary: readFileSync(here('../../web/dist/decoder.wasm')) });
  const declared = readFileSync(here('../../web/src/codec/raw.ts'), 'utf8').split(
    'export interface RawDecoder',
  )[1];
  const names = [...declared.matchAll(/^ {2}(\w+)\(/gm)].map(([, name]) => name);
  const ofEmbind = ['isAliasOf', 'clone', 'delete', 'isDeleted', 'deleteLater', 'constructor'];
  const actual = Object.getOwnPropertyNames(raw.Decoder.prototype).filter(
    (name) => !ofEmbind.includes(name),
  );
  assert.deepEqual(actual.sort(), names.filter((name) => name !== 'delete').sort());
});

test('the version is the same as in CMakeLists.txt', () => {
  assert.equal(
    readFileSync(here('../../CMakeLists.txt'), 'utf8').match(
      /project\(isostar VERSION ([\d.]+)/,
    )[1],
    manifest.version,
  );
});

test('the WebAssembly stays small', () => {
  const most = 109_500; // bytes; what this exceeds must be worth it
  const wasm = readFileSync(here('../../web/dist/decoder.wasm'));
  const gzipped = gzipSync(wasm, { level: 9 }).length;
  assert.ok(gzipped < most, `${gzipped} bytes`);
});

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

/** The names of the methods that src/codec/raw.ts declares. */
const declared = [
  ...readFileSync(here('../../web/src/codec/raw.ts'), 'utf8')
    .split('export interface RawDecoder')[1]
    .matchAll(/^ {2}(\w+)\(/gm),
].map(([, name]) => name);

test('decoder-all.wasm exports exactly what src/codec/raw.ts declares', async () => {
  const { default: createModule } = await import('../../web/dist/decoder-all.js');
  const wasmBinary = readFileSync(here('../../web/dist/decoder-all.wasm'));
  const raw = await createModule({ wasmBinary });
  const ofEmbind = ['isAliasOf', 'clone', 'delete', 'isDeleted', 'deleteLater', 'constructor'];
  const actual = Object.getOwnPropertyNames(raw.Decoder.prototype).filter(
    (name) => !ofEmbind.includes(name),
  );
  assert.deepEqual(actual.sort(), declared.filter((name) => name !== 'delete').sort());
});

test('decoder.wasm exports the same as functions', async () => {
  const wasm = readFileSync(here('../../web/dist/decoder.wasm'));
  const names = WebAssembly.Module.exports(await WebAssembly.compile(wasm)).map(({ name }) => name);
  const beside = ['create', 'memory', '_initialize'];
  const ofEmscripten = [
    ...['__indirect_function_table', '__errno_location', 'stackSave', 'stackRestore', 'stackAlloc'],
  ];
  assert.deepEqual(names.sort(), [...declared, ...beside, ...ofEmscripten].sort());
});

test('the version is the same as in CMakeLists.txt', () => {
  assert.equal(
    readFileSync(here('../../CMakeLists.txt'), 'utf8').match(
      /project\(isostar VERSION ([\d.]+)/,
    )[1],
    manifest.version,
  );
});

// Bytes after gzip; what exceeds them must be worth it.
for (const [file, most] of Object.entries({
  'decoder.wasm': 69_500,
  'decoder-all.wasm': 103_500,
}))
  test(`${file} stays small`, () => {
    const wasm = readFileSync(here(`../../web/dist/${file}`));
    const gzipped = gzipSync(wasm, { level: 9 }).length;
    assert.ok(gzipped < most, `${gzipped} bytes`);
  });

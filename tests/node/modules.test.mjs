// Default streams take the small WebAssembly; what it lacks takes the one for every stream, which
// is read when it is needed, not before.
import assert from 'node:assert/strict';
import files from 'node:fs/promises';
import { readFileSync } from 'node:fs';
import { syncBuiltinESMExports } from 'node:module';
import { basename } from 'node:path';
import { test } from 'node:test';
import { createDecoder } from 'isostar';
import { all, ballStream, encodeField, inPieces, read } from './streams.mjs';

const golden = (name) =>
  new Uint8Array(readFileSync(new URL(`../golden/${name}.isostar`, import.meta.url)));
const wasmOf = (name) => readFileSync(new URL(`../../web/dist/${name}.wasm`, import.meta.url));

const readFile = files.readFile;
let wasm = []; // that was read
files.readFile = (path, ...rest) => {
  if (String(path).endsWith('.wasm')) wasm.push(basename(String(path)));
  return readFile(path, ...rest);
};
syncBuiltinESMExports();

/** The last surface, and which files it took. */
async function decode(bytes, options) {
  wasm = [];
  const decoder = await createDecoder();
  const surfaces = await all(decoder.decode(bytes, options));
  decoder.dispose();
  return { surface: surfaces.at(-1), surfaces, wasm };
}

const lossless = read(
  encodeField('lossless', [20, 17, 9], (i, j, k) => i + Math.sin(j) - k, '--lossless'),
);

const small = ['sphere', 'knot', 'placed', 'tetrahedra', 'chunks', 'pages', 'empty'];
for (const name of small)
  test(`${name} takes the small module`, async () => {
    const { wasm, surface } = await decode(golden(name));
    assert.deepEqual(wasm, ['decoder.wasm']);
    assert.equal(surface.final, true);
  });

test('a lossless stream, its normals and a region take the small module', async () => {
  assert.deepEqual((await decode(lossless)).wasm, ['decoder.wasm']);
  const region = { min: [0, 0, 0], max: [9, 9, 9] };
  assert.deepEqual((await decode(golden('chunks'), { region })).wasm, ['decoder.wasm']);
});

for (const name of ['near', 'trimmed', 'adaptive', 'topology', 'fitted'])
  test(`${name} takes the module for every stream`, async () => {
    const { wasm, surface, surfaces } = await decode(golden(name), { refinements: 'all' });
    assert.deepEqual(wasm, ['decoder.wasm', 'decoder-all.wasm']);
    assert.ok(surface.final && surface.indices.length > 0);
    const pieces = inPieces(golden(name), 7);
    const slow = await decode(pieces, { refinements: 'all' });
    assert.deepEqual(
      slow.surfaces.filter(({ bytes }) => surfaces.some((one) => one.bytes === bytes)).length,
      surfaces.length,
    );
    assert.deepEqual(slow.surface.positions, surface.positions);
  });

test('the other polygonizer takes the module for every stream', async () => {
  for (const bytes of [golden('knot'), golden('tetrahedra'), golden('chunks')]) {
    const { wasm, surface } = await decode(bytes, { polygonizer: 'tetrahedra' });
    assert.deepEqual(wasm, ['decoder.wasm', 'decoder-all.wasm']);
    assert.ok(surface.final && surface.indices.length > 0);
  }
});

test('both make the same surface', async () => {
  const decoder = await createDecoder({ wasm: wasmOf('decoder-all') });
  for (const name of small) {
    const [last] = await all(decoder.decode(golden(name), { refinements: 'last' }));
    const { surface } = await decode(golden(name));
    for (const property of ['positions', 'normals', 'indices', 'info', 'error', 'bytes'])
      assert.deepEqual(surface[property], last[property], `${name}: ${property}`);
  }
  decoder.dispose();
});

test('the module for every stream is read once', async () => {
  wasm = [];
  const decoder = await createDecoder();
  const names = ['near', 'sphere', 'fitted', 'adaptive'];
  await Promise.all(names.map((name) => all(decoder.decode(golden(name)))));
  await all(decoder.decode(golden('topology')));
  assert.deepEqual(wasm, ['decoder.wasm', 'decoder-all.wasm']);
  decoder.dispose();
});

test('what no page decodes takes no further module', async () => {
  for (const name of ['image', 'sequence']) {
    wasm = [];
    const decoder = await createDecoder();
    await assert.rejects(all(decoder.decode(golden(name))), { code: 'UnsupportedVersion' });
    assert.deepEqual(wasm, ['decoder.wasm']);
    decoder.dispose();
  }
});

test('a module of the caller’s own is all that is used', async () => {
  wasm = [];
  const own = await createDecoder({ wasm: wasmOf('decoder-all') });
  for (const name of ['sphere', 'near', 'fitted', 'chunks'])
    assert.ok((await all(own.decode(golden(name)))).at(-1).final, name);
  own.dispose();
  const less = await createDecoder({ wasm: wasmOf('decoder') });
  const lacks = { code: 'BadArgument', message: /`wasm`: .*decoder-all\.wasm/ };
  await assert.rejects(all(less.decode(golden('fitted'))), lacks);
  await assert.rejects(all(less.decode(read(ballStream()), { polygonizer: 'tetrahedra' })), lacks);
  assert.ok((await all(less.decode(golden('sphere')))).at(-1).final);
  less.dispose();
  assert.deepEqual(wasm, []);
});

test('damaged headers take no further module', async () => {
  const bytes = golden('fitted');
  bytes[8] ^= 0x55;
  wasm = [];
  const decoder = await createDecoder();
  await assert.rejects(all(decoder.decode(bytes)), ({ code }) => code !== 'BadArgument');
  assert.deepEqual(wasm, ['decoder.wasm']);
  decoder.dispose();
});

test('a cut stream of each kind gives its sound surfaces, then Truncated', async () => {
  for (const name of ['near', 'adaptive', 'topology', 'fitted']) {
    const decoder = await createDecoder();
    const seen = [];
    await assert.rejects(
      async () => {
        const cut = golden(name);
        for await (const one of decoder.decode(cut.subarray(0, 0.8 * cut.length))) seen.push(one);
      },
      { code: 'Truncated' },
    );
    assert.ok(seen.length > 0 && !seen.at(-1).final, name);
    decoder.dispose();
  }
});

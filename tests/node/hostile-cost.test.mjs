// The module's memory stays within the stated bound on the streams that cost a decoder most.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readdirSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { createDecoder, IsostarError } from 'isostar';
import { gyroidStream } from './streams.mjs';

const search = fileURLToPath(
  new URL('../../build/tests/hostile/isostar_cost_search', import.meta.url),
);
const folder = mkdtempSync(join(tmpdir(), 'isostar-test-'));
after(() => rmSync(folder, { recursive: true, force: true }));

/** Bytes beside the limit: models, the module's own, and a chunk of input. */
const BESIDE = 8e6;
/** Copies of the stream in the module, while the decoder's copy grows. */
const COPIES = 3;
/** Emscripten lets memory grow by a fifth more than is needed. */
const GROWTH = 1.2;

/** The memories of the modules that are instantiated from now on. */
function memoriesOf(t) {
  const memories = [];
  const { instantiate } = WebAssembly;
  t.mock.method(WebAssembly, 'instantiate', async (...args) => {
    const result = await instantiate(...args);
    const { exports } = result.instance ?? result;
    memories.push(...Object.values(exports).filter((one) => one instanceof WebAssembly.Memory));
    return result;
  });
  return memories;
}

async function expectWithin(t, bytes, limits, name) {
  for (const refinements of ['last', 'all'])
    for (const polygonizer of ['cubes', 'tetrahedra']) {
      const memories = memoriesOf(t);
      const decoder = await createDecoder({ limits });
      try {
        for await (const surface of decoder.decode(bytes, { refinements, polygonizer }))
          assert.ok(surface.indices.length % 3 === 0);
      } catch (reason) {
        assert.ok(reason instanceof IsostarError, String(reason));
      }
      decoder.dispose();
      t.mock.restoreAll();
      const most = GROWTH * (limits.memory + COPIES * bytes.length + BESIDE);
      for (const { buffer } of memories)
        assert.ok(
          buffer.byteLength <= most,
          `${name}, ${refinements}, ${polygonizer}: ${buffer.byteLength} bytes of ${most}`,
        );
      assert.ok(memories.length > 0);
    }
}

test('costly streams stay within the memory allowed', async (t) => {
  execFileSync(search, ['0', '6', folder], { stdio: 'ignore' });
  const names = readdirSync(folder);
  assert.ok(names.length > 10);
  for (const name of names)
    await expectWithin(
      t,
      readFileSync(join(folder, name)),
      { memory: 2 ** 23, decisions: 2 ** 22 },
      name,
    );
});

test('sound streams stay within the memory allowed', async (t) => {
  const gyroid = readFileSync(gyroidStream());
  for (const memory of [1e6, 2e6, 4e6, 8e6, 32e6])
    await expectWithin(t, gyroid, { memory }, `gyroid, ${memory}`);
});

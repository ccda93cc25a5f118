import assert from 'node:assert/strict';
import { appendFileSync, cpSync, mkdirSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { offences } from './layering.mjs';

const root = fileURLToPath(new URL('../..', import.meta.url));
const copy = mkdtempSync(join(tmpdir(), 'isostar-layering-'));
after(() => rmSync(copy, { recursive: true, force: true }));

test('every include follows the arrows', () => assert.deepEqual(offences(root), []));

const added = [
  ['shared/src/decode.cpp', '#include "field.h"'],
  ['shared/src/decode.cpp', '#include "source_distance.h"'],
  ['shared/src/polygonizer.cpp', '#include "models.h"'],
  ['shared/src/lattice.h', '#include "bricks.h"'],
  ['shared/src/bytes.h', '#include <fstream>'],
  ['shared/src/encode.cpp', '#  include <thread>'],
  ['shared/src/stream.cpp', '#include <glm/vec3.hpp>'],
  ['shared/src/layers.h', '#include <itkImage.h>'],
  ['native/main.cpp', '#include "stream.h"'],
  ['native/bench/figure6/octree_codec.cpp', '#include "layers.h"'],
  ['native/bench/figure6.cpp', '#include "bricks.h"'],
  ['wasm/bindings.cpp', '#include "../shared/src/layers.h"'],
];
for (const [file, line] of added)
  test(`${line} is noticed in ${file}`, () => {
    for (const folder of ['shared', 'native', 'wasm', 'web']) {
      rmSync(join(copy, folder), { recursive: true, force: true });
      mkdirSync(join(copy, folder));
    }
    for (const folder of ['shared', 'native', 'wasm']) cpSync(join(root, folder), join(copy, folder), { recursive: true });
    appendFileSync(join(copy, file), `\n${line}\n`);
    const found = offences(copy);
    assert.equal(found.length, 1);
    assert.ok(found[0].startsWith(`${file} may not include `), found[0]);
  });

test('a new file wants a place', () => {
  writeFileSync(join(copy, 'shared/src/novelty.h'), '#include <vector>\n');
  assert.ok(offences(copy).includes('shared/src/novelty.h is in no part of tests/layering/layering.mjs'));
});

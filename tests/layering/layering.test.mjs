import assert from 'node:assert/strict';
import {
  appendFileSync,
  cpSync,
  mkdirSync,
  mkdtempSync,
  readFileSync,
  rmSync,
  writeFileSync,
} from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { ARROWS, offences, picture } from './layering.mjs';

const root = fileURLToPath(new URL('../..', import.meta.url));
const copy = mkdtempSync(join(tmpdir(), 'isostar-layering-'));
after(() => rmSync(copy, { recursive: true, force: true }));

test('every include follows the arrows', () => assert.deepEqual(offences(root), []));

test('arrows between folders run one way', () => {
  const folders = Object.keys(ARROWS);
  for (const from of folders)
    for (const to of ARROWS[from])
      assert.ok(folders.indexOf(to) < folders.indexOf(from), `${from} → ${to}`);
});

test('the architecture shows the picture', () => {
  const text = readFileSync(join(root, 'docs/architecture.md'), 'utf8');
  assert.ok(text.includes(picture()), 'node tests/layering/layering.mjs --picture prints it');
});

const added = [
  ['shared/src/decoder/decoder.cpp', '#include "encoder/core/field.h"'],
  ['shared/src/decoder/decoder.cpp', '#include "scalars/scalars.h"'],
  ['shared/src/surface/polygonizer.cpp', '#include "entropy/models.h"'],
  ['shared/src/container/bytes.h', '#include <fstream>'],
  ['shared/src/encoder/volume_encoder.cpp', '#  include <thread>'],
  ['shared/src/container/stream.cpp', '#include <glm/vec3.hpp>'],
  ['shared/src/coding/codec_state.h', '#include <itkImage.h>'],
  ['native/main.cpp', '#include "container/stream.h"'],
  ['native/bench/figure6/octree_codec.cpp', '#include "coding/codec_state.h"'],
  ['native/bench/figure6.cpp', '#include "grid/signs.h"'],
  ['wasm/bindings.cpp', '#include "../shared/src/coding/codec_state.h"'],
];
function newCopy() {
  for (const folder of ['shared', 'native', 'wasm', 'web']) {
    rmSync(join(copy, folder), { recursive: true, force: true });
    mkdirSync(join(copy, folder));
  }
  for (const folder of ['shared', 'native', 'wasm'])
    cpSync(join(root, folder), join(copy, folder), { recursive: true });
}
for (const [file, line] of added)
  test(`${line} is noticed in ${file}`, () => {
    newCopy();
    appendFileSync(join(copy, file), `\n${line}\n`);
    const found = offences(copy);
    assert.equal(found.length, 1);
    assert.ok(found[0].startsWith(`${file} may not include `), found[0]);
  });

test('a circle of includes is noticed', () => {
  newCopy();
  appendFileSync(join(copy, 'shared/src/grid/lattice.h'), '\n#include "grid/signs.h"\n');
  assert.ok(offences(copy).some((line) => line.includes('grid/lattice.h → grid/signs.h')));
});

test('a new folder wants arrows', () => {
  newCopy();
  mkdirSync(join(copy, 'shared/src/novelty'));
  writeFileSync(join(copy, 'shared/src/novelty/novelty.h'), '#include <vector>\n');
  assert.match(offences(copy).join('\n'), /novelty\.h is in a folder that .* does not know/);
});

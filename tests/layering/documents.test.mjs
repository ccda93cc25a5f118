import assert from 'node:assert/strict';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { namesIn, staleNames } from './documents.mjs';

test('all exists that the documents name', () =>
  assert.deepEqual(staleNames(fileURLToPath(new URL('../..', import.meta.url))), []));

test('names are found where documents have them', () => {
  const text =
    'The `Lattice` (`lattice.h`, `native/main.cpp`) calls `forEachMember(set, visit)`; no `-Os`, see [b](b.md), [c](https://c.md).\n```\nbase_coder ← encode.cpp\n```\n';
  assert.deepEqual(namesIn(text), {
    files: ['lattice.h', 'main.cpp', 'encode.cpp'],
    stems: ['base_coder'],
    identifiers: ['Lattice', 'forEachMember'],
    links: ['b.md'],
  });
});

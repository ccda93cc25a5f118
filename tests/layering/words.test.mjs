import assert from 'node:assert/strict';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { refusedIn, refusedWords, repeatedNames, twins } from './words.mjs';

const root = fileURLToPath(new URL('../..', import.meta.url));

test('no word is used that the glossary refuses', () => assert.deepEqual(refusedWords(root), []));

test('no two files have one name', () => assert.deepEqual(repeatedNames(root), []));

test('refused words are found, others are not', () => {
  assert.deepEqual(refusedIn('shared/src/grid/a.h', '// the fresh rows\nint newAxes;'), [
    'shared/src/grid/a.h:1 says "fresh"',
  ]);
  assert.deepEqual(refusedIn('README.md', 'on a fresh clone'), []);
  assert.equal(refusedIn('web/a.ts', '// tells the worker\nconst toldBefore = 1;').length, 2);
});

test('twins are found, common names are not', () =>
  assert.deepEqual(twins(['a/b.h', 'c/b.h', 'a/index.ts', 'b/index.ts']), ['a/b.h and c/b.h']));

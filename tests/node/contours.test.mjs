import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { createDecoder } from 'isostar';
import { all } from './streams.mjs';

const root = fileURLToPath(new URL('../../', import.meta.url));

test('an elevation image: from a first contour of under 30 bytes to a lossless one', (t) => {
  const folder = mkdtempSync(join(tmpdir(), 'isostar-contours-'));
  t.after(() => rmSync(folder, { recursive: true, force: true }));
  const printed = execFileSync(process.execPath, [join(root, 'scripts/contours.mjs'), folder], {
    encoding: 'utf8',
  });
  const rows = [...printed.matchAll(/^\| (\d+) \| (\w+ \d+) \| (\S+) \|/gm)].map(
    ([, bytes, , error]) => [Number(bytes), Number(error)],
  );
  assert.ok(rows[0][0] < 30, `the first contour takes ${rows[0][0]} bytes`);
  assert.equal(rows.at(-1)[1], 0);
  rows.forEach(([, error], i) => {
    if (i > 0) assert.ok(error < rows[i - 1][1], 'the error falls with each layer');
    const svg = readFileSync(join(folder, `contour-${i}.svg`), 'utf8');
    assert.match(svg, /viewBox="0 0 256 192"/);
    assert.match(svg, /<path fill="none"[^>]* d="M[-\d. MLZe]+"\/>/);
  });
});

test('contours are refused with a message that names them', async (t) => {
  const stream = new Uint8Array(readFileSync(join(root, 'build/contours/terrain.isostar')));
  const decoder = await createDecoder();
  t.after(() => decoder.dispose());
  await assert.rejects(all(decoder.decode(stream)), {
    name: 'IsostarError',
    code: 'UnsupportedVersion',
    message: /contours of an image/,
  });
});

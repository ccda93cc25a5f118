// A folder of samples for the viewer: a gyroid, and as its rival a mesh that comes with draco3d.
import { copyFileSync, mkdtempSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { gyroidStream, isostar, severalStream } from '../node/streams.mjs';

const folder = mkdtempSync(join(tmpdir(), 'isostar-samples-'));
process.on('exit', () => rmSync(folder, { recursive: true, force: true }));

const stream = gyroidStream();
const bunny = join(createRequire(import.meta.url).resolve('draco3d'), '../bunny.drc');
copyFileSync(stream, join(folder, 'gyroid.isostar'));
copyFileSync(severalStream(), join(folder, 'several.isostar'));
copyFileSync(bunny, join(folder, 'bunny.drc'));
writeFileSync(join(folder, 'broken.isostar'), readFileSync(stream).subarray(0, 2000).fill(7, 1500));
const sample = (id, file, extra) => ({ id, title: id, note: 'made by a test', stream: file, bytes: statSync(stream).size, ...extra });
writeFileSync(join(folder, 'samples.json'), JSON.stringify({
  samples: [
    sample('gyroid', 'gyroid.isostar', { draco: { file: 'bunny.drc', bytes: statSync(bunny).size, settings: 'a bunny', error: 0.1 } }),
    sample('several', 'several.isostar'),
    sample('slow', 'slow.isostar'),
    sample('broken', 'broken.isostar'),
  ],
}));

export const FOLDER = folder;
export const STREAM = stream;
export const LAYERS = JSON.parse(isostar('info', stream, '--json')).layers;

/** Answers slow.isostar a layer at a time, so that a page has time for each. */
export function slowly(request, response, headers) {
  if (!request.url.endsWith('/slow.isostar')) return false;
  const bytes = readFileSync(stream);
  response.writeHead(200, { ...headers, 'Content-Length': bytes.length });
  let sent = 0;
  const ends = LAYERS.map(({ offset }) => offset);
  const timer = setInterval(() => {
    const end = ends.shift();
    if (end === undefined) {
      clearInterval(timer);
      response.end(bytes.subarray(sent));
    } else response.write(bytes.subarray(sent, (sent = end)));
  }, 400);
  return true;
}

// A folder of samples for the viewer: gyroids, and as Draco's file a mesh that comes with draco3d.
import { copyFileSync, mkdtempSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { chunkedStream, gyroidStream, isostar, severalStream } from '../node/streams.mjs';

const folder = mkdtempSync(join(tmpdir(), 'isostar-samples-'));
process.on('exit', () => rmSync(folder, { recursive: true, force: true }));

const stream = gyroidStream();
const bunny = join(createRequire(import.meta.url).resolve('draco3d'), '../bunny.drc');
copyFileSync(stream, join(folder, 'gyroid.isostar'));
copyFileSync(severalStream(), join(folder, 'several.isostar'));
copyFileSync(chunkedStream(), join(folder, 'chunked.isostar'));
copyFileSync(bunny, join(folder, 'bunny.drc'));
const damaged = readFileSync(stream).subarray(0, 2000).fill(7, 1500);
writeFileSync(join(folder, 'broken.isostar'), damaged);

const sample = (id, file, extra) => ({
  id,
  title: id,
  note: 'made by a test',
  stream: file,
  bytes: statSync(stream).size,
  ...extra,
});
const draco = { file: 'bunny.drc', bytes: statSync(bunny).size, settings: 'a bunny', error: 0.1 };
const samples = [
  sample('gyroid', 'gyroid.isostar', { draco }),
  sample('several', 'several.isostar'),
  sample('chunked', 'chunked.isostar'),
  sample('stepwise', 'stepwise.isostar'),
  sample('broken', 'broken.isostar'),
];
writeFileSync(join(folder, 'samples.json'), JSON.stringify({ samples }));

export const FOLDER = folder;
export const STREAM = stream;
export const LAYERS = JSON.parse(isostar('info', stream, '--json')).layers;

/**
 * A request handler for serve(). It answers stepwise.isostar with the first layer, and sends one
 * more layer at each request for next-layer, so that a page never has more layers than it has asked
 * for.
 */
export function stepwise() {
  const bytes = readFileSync(stream);
  const ends = LAYERS.map(({ offset }) => offset);
  let transfer; // the last one begun
  const sendLayer = () => {
    if (!transfer || transfer.layer === ends.length) return;
    const begin = transfer.layer === 0 ? 0 : ends[transfer.layer - 1];
    const end = ends[transfer.layer++];
    transfer.response.write(bytes.subarray(begin, end));
    if (transfer.layer === ends.length) transfer.response.end(bytes.subarray(end));
  };
  return (request, response, headers) => {
    if (request.url.endsWith('/stepwise.isostar')) {
      response.writeHead(200, { ...headers, 'Content-Length': bytes.length });
      transfer = { response, layer: 0 };
      sendLayer();
    } else if (request.url.endsWith('/next-layer')) {
      response.writeHead(204, headers).end();
      sendLayer();
    } else return false;
    return true;
  };
}

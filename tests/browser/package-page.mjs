// A page as a user of the package would bundle it, in a folder to be served.
import { build } from 'esbuild';
import { copyFileSync, mkdirSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';

const dist = fileURLToPath(new URL('../../web/dist/', import.meta.url));
const folder = mkdtempSync(join(tmpdir(), 'isostar-page-'));
process.on('exit', () => rmSync(folder, { recursive: true, force: true }));

const PAGE = `<!doctype html>
<title>test</title>
<link rel="icon" href="data:,">
<script type="module" src="../main.js"></script>
<body></body>`;

const SCRIPT = `
  import { createDecoder, IsostarError, RangeSource } from 'isostar';
  import { IsostarLoader } from 'isostar/three';
  import 'isostar/element';
  Object.assign(window, { createDecoder, IsostarError, IsostarLoader, RangeSource });`;

/**
 * esbuild does not follow `new URL(…, import.meta.url)`, so the worker, its imports and the
 * WebAssembly are put beside the bundle.
 */
export async function makePage() {
  const options = { bundle: true, format: 'esm', logLevel: 'error', outdir: folder };
  await build({
    ...options,
    stdin: { contents: SCRIPT, resolveDir: fileURLToPath(new URL('.', import.meta.url)) },
    entryNames: 'main',
  });
  await build({ ...options, entryPoints: [join(dist, 'worker.js')] });
  for (const file of ['decoder.wasm', 'decoder-all.wasm', 'decoder-all.js'])
    copyFileSync(join(dist, file), join(folder, file));
  mkdirSync(join(folder, 'page'));
  writeFileSync(join(folder, 'page', 'index.html'), PAGE);
  return folder;
}

/** Loads the real worker, and throws in it at a request of a type, the `nth` time. */
export const workerThatDies = (type, nth) => `import '/worker.js?sound';
let count = 0;
addEventListener('message', ({ data }) => {
  if (data.type === '${type}' && ++count === ${nth}) throw new Error('struck down');
});`;

/** Answers /worker.js instead of the server: a script that is there, or none. */
export function answerWorker(script, response, headers) {
  if (script === undefined) response.writeHead(404, headers).end();
  else response.writeHead(200, { ...headers, 'Content-Type': 'text/javascript' }).end(script);
  return true;
}

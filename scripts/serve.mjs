// A small static server: the first of several folders that has the file answers, under the strictest policy that the viewer works with.
import { createReadStream } from 'node:fs';
import { stat } from 'node:fs/promises';
import { createServer } from 'node:http';
import { extname, join, normalize } from 'node:path';

const TYPES = {
  '.html': 'text/html; charset=utf-8',
  '.js': 'text/javascript',
  '.css': 'text/css',
  '.json': 'application/json',
  '.svg': 'image/svg+xml',
  '.wasm': 'application/wasm',
};
const HEADERS = {
  'Content-Security-Policy':
    "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; worker-src 'self'; style-src 'self'; object-src 'none'; base-uri 'none'",
  'X-Content-Type-Options': 'nosniff',
  'Cache-Control': 'no-cache',
};

/** The file that an address names; nothing for one that names none, or badly. */
async function find(folders, url) {
  let path;
  try {
    path = decodeURIComponent(new URL(url, 'http://any').pathname);
  } catch {
    return;
  }
  if (path.includes('\0')) return;
  if (path.endsWith('/')) path += 'index.html';
  for (const folder of folders) {
    const file = join(folder, normalize(path));  // a normalized absolute path cannot climb out of the folder
    const found = await stat(file).catch(() => undefined);
    if (found?.isFile()) return { file, size: found.size };
  }
}

/** Serves the folders and resolves to the page's address; port 0 takes any that is free. `handle` may answer first. */
export function serve(folders, { port = 0, host = '127.0.0.1', handle = () => false } = {}) {
  const server = createServer(async (request, response) => {
    if (handle(request, response, HEADERS)) return;
    const found = await find(folders, request.url);
    if (!found) return response.writeHead(404, HEADERS).end();
    const type = TYPES[extname(found.file)] ?? 'application/octet-stream';
    response.writeHead(200, { ...HEADERS, 'Content-Type': type, 'Content-Length': found.size });
    if (request.method === 'HEAD') response.end();
    else createReadStream(found.file).pipe(response);
  });
  return new Promise((resolve, reject) => {
    server.once('error', reject);
    server.listen(port, host, () => resolve({ server, address: `http://${host}:${server.address().port}/` }));
  });
}

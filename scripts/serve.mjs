// A small static file server over several folders, with the strictest content security policy under
// which the viewer works.
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
const POLICY = [
  "default-src 'self'",
  "script-src 'self' 'wasm-unsafe-eval'",
  "worker-src 'self'",
  "style-src 'self'",
  "object-src 'none'",
  "base-uri 'none'",
];
const HEADERS = {
  'Content-Security-Policy': POLICY.join('; '),
  'X-Content-Type-Options': 'nosniff',
  'Cache-Control': 'no-cache',
};

/** The file at an address, in the first folder that has it; undefined if there is none. */
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
    // A normalized absolute path cannot lead out of the folder.
    const file = join(folder, normalize(path));
    const found = await stat(file).catch(() => undefined);
    if (found?.isFile()) return { file, size: found.size };
  }
}

/**
 * Serves the folders and resolves to { server, address }. Port 0 takes any free port. `handle` may
 * answer a request first and then returns true.
 */
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
    server.listen(port, host, () =>
      resolve({ server, address: `http://${host}:${server.address().port}/` }),
    );
  });
}

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

/** The one range of bytes that a request asks for, of a file of `size` bytes; undefined if none. */
function rangeOf({ headers }, size) {
  const [, first, last] = /^bytes=(\d+)-(\d*)$/.exec(headers.range ?? '') ?? [];
  if (first === undefined || Number(first) >= size) return;
  return { start: Number(first), end: Math.min(last ? Number(last) : Infinity, size - 1) };
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
    const { file, size } = found;
    const range = rangeOf(request, size);
    const { start, end } = range ?? { start: 0, end: Math.max(0, size - 1) };
    response.writeHead(range ? 206 : 200, {
      ...HEADERS,
      'Accept-Ranges': 'bytes',
      'Content-Type': TYPES[extname(file)] ?? 'application/octet-stream',
      'Content-Length': range ? end + 1 - start : size,
      ...(range && { 'Content-Range': `bytes ${start}-${end}/${size}` }),
    });
    if (request.method === 'HEAD') response.end();
    else createReadStream(file, { start, end }).pipe(response);
  });
  return new Promise((resolve, reject) => {
    server.once('error', reject);
    server.listen(port, host, () =>
      resolve({ server, address: `http://${host}:${server.address().port}/` }),
    );
  });
}

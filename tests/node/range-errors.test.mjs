// What servers do wrong with ranges, and what ends their requests.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { IsostarError } from 'isostar';
import {
  asked,
  asUsual,
  at,
  chunked,
  decodeBy,
  isFirst,
  lastBy,
  limitsOf,
  sendRange,
} from './range-server.mjs';
import { all } from './streams.mjs';

const fails = (handle, code, message, source) =>
  assert.rejects(lastBy(handle, source), (reason) => {
    assert.ok(reason instanceof IsostarError, String(reason));
    assert.equal(reason.code, code);
    assert.match(reason.message, message);
    return true;
  });

test('status of HTTP', async () => {
  const status = (code, from) => (request, response) => {
    if (!request.headers.range.startsWith(from)) return false;
    response.writeHead(code).end('<!doctype html>');
    return true;
  };
  const missing = at('no-such.isostar');
  await fails(asUsual, 'BadArgument', /no-such\.isostar: HTTP status 404 Not Found$/, missing);
  await fails(status(503, ''), 'BadArgument', /chunked\.isostar: HTTP status 503/);
  await fails(status(500, 'bytes=1'), 'BadArgument', /HTTP status 500/);
  await fails(status(416, 'bytes=1'), 'BadArgument', /HTTP status 416/);
  await fails(status(204, ''), 'BadArgument', /HTTP status 204/);
});

test('a server that sends other bytes than were requested', async () => {
  const { length } = chunked;
  for (const range of [
    `bytes 1-16383/${length}`,
    `bytes 0-16382/${length}`,
    `bytes 0-16384/${length}`,
    `bytes 0-16383/99`,
    'bytes */9',
    'lines 0-16383/9',
    '',
  ])
    await fails(
      (request, response) => sendRange(request, response, { 'Content-Range': range }),
      'BadArgument',
      /asked for bytes 0-16383 and answered with ".*"$/,
    );
  const tooLong = (request, response) =>
    sendRange(
      request,
      response,
      { 'Content-Range': `bytes 0-16383/${length}`, 'Content-Length': 20000 },
      chunked.subarray(0, 20000),
    );
  await fails(tooLong, 'BadArgument', /more bytes came/);
});

test('a server that sends the wrong bytes', () =>
  fails(
    (request, response) => {
      if (isFirst(request)) return false;
      return sendRange(request, response, {}, new Uint8Array(asked(request).length));
    },
    'Corrupt',
    /./,
  ));

test('a file that changes between two requests', async () => {
  let count = 0;
  const by = (fields) => (request, response) => sendRange(request, response, fields(count++));
  await fails(
    by((n) => ({ ETag: `"${n}"` })),
    'Corrupt',
    /chunked\.isostar: the file changed/,
  );
  const length = by((n) => ({
    'Content-Range': n % 2 === 0 ? `bytes 0-16383/${chunked.length}` : 'bytes 16384-16385/16386',
  }));
  count = 0;
  await fails(length, 'Corrupt', /the file changed/);
});

test('a file that ends early', async () => {
  const cut = chunked.subarray(0, 50_000);
  const seen = [];
  const { surfaces } = decodeBy((request, response) => {
    const bytes = asked(request, cut);
    const [first] = limitsOf(request);
    const range = `bytes ${first}-${first + bytes.length - 1}/${cut.length}`;
    return sendRange(request, response, { 'Content-Range': range }, bytes);
  });
  await assert.rejects(
    async () => {
      for await (const { bytes } of surfaces) seen.push(bytes);
    },
    { name: 'IsostarError', code: 'Truncated' },
  );
  assert.ok(seen.at(-1) > 16384);
});

test('what fails besides is passed on unchanged', async () => {
  const reason = new Error('the cable is cut');
  const source = at('chunked.isostar', { fetch: () => Promise.reject(reason) });
  await assert.rejects(lastBy(asUsual, source), (thrown) => thrown === reason);
});

test('an abort and a break end the requests', async () => {
  /** Answers the first request, begins to answer the others, and goes no further. */
  const stalled = (request, response) => {
    if (isFirst(request)) return false;
    response.writeHead(206, { 'Content-Range': `bytes 16384-${chunked.length - 1}/*` });
    return response.write(chunked.subarray(16384, 20000));
  };
  const closed = async (requests) => {
    while (!requests.every(({ isClosed }) => isClosed))
      await new Promise((resolve) => setTimeout(resolve, 5));
    return requests.length;
  };
  const control = new AbortController();
  setTimeout(() => control.abort(new Error('enough')), 100);
  const aborted = decodeBy(stalled, undefined, { signal: control.signal });
  await assert.rejects(all(aborted.surfaces), { message: 'enough' });
  assert.equal(await closed(aborted.requests), 2);

  const left = decodeBy(stalled);
  for await (const _ of left.surfaces) break;
  await closed(left.requests);
});

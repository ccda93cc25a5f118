// A server of test streams that counts its requests and answers as a test wishes.
import { dirname } from 'node:path';
import { after } from 'node:test';
import { createDecoder, RangeSource } from 'isostar';
import { serve } from '../../scripts/serve.mjs';
import { all, ballStream, chunkedStream, gyroidStream, read } from './streams.mjs';

export const PATH = chunkedStream();
export const chunked = read(PATH);
export const gyroid = read(gyroidStream());
ballStream();

let answer; // instead of the server's own
let requests = []; // since the last decode began: range, headers, bytes that were sent, isClosed

/** A handler's answer of the server's own: files and ranges of them. */
export const asUsual = () => false;

const { server, address } = await serve([dirname(PATH)], {
  handle(request, response, fields) {
    const { headers } = request;
    const one = { range: headers.range, headers, bytes: 0, isClosed: false };
    for (const name of ['write', 'end']) {
      const send = response[name];
      response[name] = (...args) => {
        if (args[0] instanceof Uint8Array) one.bytes += args[0].length;
        return send.apply(response, args);
      };
    }
    response.on('close', () => (one.isClosed = true));
    requests.push(one);
    return answer(request, response, fields);
  },
});
const decoder = await createDecoder();
after(() => {
  decoder.dispose();
  server.closeAllConnections();
  server.close();
});

/** A stream on the server. */
export const at = (name, options) => new RangeSource(address + name, options);

/** The surfaces of a source, while the server answers by `handle`. `requests` is filled meanwhile. */
export function decodeBy(handle, source = at('chunked.isostar'), options) {
  answer = handle;
  requests = [];
  return { requests, surfaces: decoder.decode(source, options) };
}

/** The last one of these surfaces, and the requests that were made. */
export async function lastBy(handle, source, options) {
  const { requests, surfaces } = decodeBy(handle, source, { refinements: 'last', ...options });
  return { surface: (await all(surfaces)).at(-1), requests };
}

/** Answers a range of the stream in chunks with other fields in its head, or with other bytes. */
export function sendRange(request, response, fields = {}, bytes = asked(request)) {
  const [first] = limitsOf(request);
  const range = `bytes ${first}-${first + bytes.length - 1}/${chunked.length}`;
  response.writeHead(206, { 'Content-Range': range, 'Content-Length': bytes.length, ...fields });
  response.end(bytes);
  return true;
}

/** First and last byte of a range. */
export const limitsOf = ({ headers }) => headers.range.match(/\d+/g).map(Number);
/** What a request asks for, of the stream in chunks or of another one. */
export function asked(request, of = chunked) {
  const [first, last] = limitsOf(request);
  return of.subarray(first, last + 1);
}
export const isFirst = ({ headers }) => headers.range.startsWith('bytes=0-');

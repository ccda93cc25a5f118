import { IsostarError } from '../api/errors.js';
import type { Source } from '../api/surface.js';

type Piece = Uint8Array<ArrayBufferLike>;

/** The pieces of any source; `return` cancels the source, also while a read is pending. */
export function piecesOf(source: Source): AsyncIterator<Piece> {
  if (source instanceof Uint8Array) return once(source);
  if (typeof Response !== 'undefined' && source instanceof Response)
    return piecesOfResponse(source);
  if (!source || typeof source !== 'object') throw notASource();
  if ('getReader' in source) return piecesOfStream(source);
  if (Symbol.asyncIterator in source) return source[Symbol.asyncIterator]();
  throw notASource();
}

const notASource = () =>
  new IsostarError(
    'BadArgument',
    'the source must be a ReadableStream, an AsyncIterable, a Uint8Array or a Response',
  );

async function* once(bytes: Piece): AsyncGenerator<Piece> {
  yield bytes;
}

function piecesOfResponse(response: Response): AsyncIterator<Piece> {
  const { ok, url, status, statusText } = response;
  if (!ok)
    throw new IsostarError(
      'BadArgument',
      `${url || 'the response'}: HTTP status ${status} ${statusText}`.trim(),
    );
  return response.body ? piecesOfStream(response.body) : once(new Uint8Array());
}

// Some browsers' ReadableStream is not async-iterable, and its own iterator cannot be cancelled
// while a read is pending.
function piecesOfStream(stream: ReadableStream<Piece>): AsyncIterator<Piece> {
  const reader = stream.getReader();
  return {
    next: () => reader.read() as Promise<IteratorResult<Piece>>,
    return: async () => {
      await reader.cancel();
      return { done: true, value: undefined };
    },
  };
}

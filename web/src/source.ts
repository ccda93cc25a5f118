import { IsostarError } from './errors.js';
import type { Source } from './surface.js';

type Piece = Uint8Array<ArrayBufferLike>;

/** The pieces of any source; `return` gives the source up, also in the middle of a read. */
export function piecesOf(source: Source): AsyncIterator<Piece> {
  if (source instanceof Uint8Array) return once(source);
  if (typeof Response !== 'undefined' && source instanceof Response) return piecesOfResponse(source);
  if (!source || typeof source !== 'object') throw noSource();
  if ('getReader' in source) return piecesOfStream(source);
  if (Symbol.asyncIterator in source) return source[Symbol.asyncIterator]();
  throw noSource();
}

const noSource = () => new IsostarError('BadArgument', 'a source is a ReadableStream, an AsyncIterable, a Uint8Array or a Response');

async function* once(bytes: Piece): AsyncGenerator<Piece> {
  yield bytes;
}

function piecesOfResponse(response: Response): AsyncIterator<Piece> {
  if (!response.ok)
    throw new IsostarError('BadArgument', `${response.url || 'the server'} answers ${response.status} ${response.statusText}`.trim());
  return response.body ? piecesOfStream(response.body) : once(new Uint8Array());
}

// ReadableStream is not async-iterable everywhere, and its own iterator cannot be cancelled while a read is pending.
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

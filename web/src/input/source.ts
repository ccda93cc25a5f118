import { IsostarError } from '../api/errors.js';
import type { Source } from '../api/surface.js';

type Piece = Uint8Array<ArrayBufferLike>;
/** A piece in a buffer of its own, to which the caller has no reference. */
export type OwnPiece = Uint8Array<ArrayBuffer>;

/** A source that is not read yet. */
export interface HeldSource {
  /**
   * Begins to read. The pieces are copies; `return` cancels the source, also while a read is
   * pending.
   */
  open(): AsyncIterator<OwnPiece>;
}

/** Copies a Uint8Array at once; of other sources, each piece is copied when it arrives. */
export function hold(source: Source): HeldSource {
  if (!(source instanceof Uint8Array)) return { open: () => copies(piecesOf(source)) };
  const copy = new Uint8Array(source);
  return { open: () => once(copy) };
}

function copies(pieces: AsyncIterator<Piece>): AsyncIterator<OwnPiece> {
  return {
    async next() {
      const next = await pieces.next();
      if (next.done) return next;
      if (!(next.value instanceof Uint8Array))
        throw new IsostarError('BadArgument', 'a piece of the source is not a Uint8Array');
      return { done: false, value: new Uint8Array(next.value) };
    },
    async return() {
      await pieces.return?.();
      return { done: true, value: undefined };
    },
  };
}

function piecesOf(source: Exclude<Source, Uint8Array>): AsyncIterator<Piece> {
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

async function* once<Bytes>(bytes: Bytes): AsyncGenerator<Bytes> {
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

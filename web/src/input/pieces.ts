import { IsostarError } from '../api/errors.js';
import type { ByteRange } from './byte-ranges.js';

/** Some bytes of a stream, in a buffer of their own to which the caller has no reference. */
export interface Piece {
  readonly bytes: Uint8Array<ArrayBuffer>;
  /** Where in the stream they begin. */
  readonly offset: number;
}

/** A source that is being read. `return` cancels it, also while a read is pending. */
export interface Pieces extends AsyncIterator<Piece, void> {
  /**
   * States which bytes are still to be read, in order, instead of those stated before. Sources
   * without it are read from end to end.
   */
  want?(ranges: readonly ByteRange[]): void;
}

export type ByteIterator = AsyncIterator<Uint8Array<ArrayBufferLike>>;

/** Copies bytes as they arrive. The first of them are at `offset` in the stream. */
export function copies(bytes: ByteIterator, offset = 0): Pieces {
  return {
    async next() {
      const { done, value } = await bytes.next();
      if (done) return { done, value: undefined };
      if (!(value instanceof Uint8Array))
        throw new IsostarError('BadArgument', 'a piece of the source is not a Uint8Array');
      const piece = { bytes: new Uint8Array(value), offset };
      offset += value.length;
      return { done: false, value: piece };
    },
    async return() {
      await bytes.return?.();
      return { done: true, value: undefined };
    },
  };
}

/**
 * Some browsers' ReadableStream is not async-iterable, and its own iterator cannot be cancelled
 * while a read is pending.
 */
export function bytesOf(stream: ReadableStream<Uint8Array<ArrayBufferLike>>): ByteIterator {
  const reader = stream.getReader();
  return {
    next: () => reader.read() as Promise<IteratorResult<Uint8Array<ArrayBufferLike>>>,
    return: async () => {
      await reader.cancel();
      return { done: true, value: undefined };
    },
  };
}

import { IsostarError } from '../api/errors.js';
import type { Source } from '../api/surface.js';
import { badStatus } from './http-file.js';
import { type ByteIterator, bytesOf, copies, type Pieces } from './pieces.js';
import { RangeSource } from './range-source.js';

/** A source that is not read yet. */
export interface HeldSource {
  open(): Pieces;
}

/** Copies a Uint8Array at once; of other sources, each piece is copied when it arrives. */
export function hold(source: Source): HeldSource {
  if (source instanceof RangeSource) return source;
  if (!(source instanceof Uint8Array)) return { open: () => copies(iterate(source)) };
  const piece = { bytes: new Uint8Array(source), offset: 0 };
  return { open: () => once(piece) };
}

function iterate(source: Exclude<Source, Uint8Array | RangeSource>): ByteIterator {
  if (typeof Response !== 'undefined' && source instanceof Response) return bytesOfBody(source);
  if (!source || typeof source !== 'object') throw notASource();
  if ('getReader' in source) return bytesOf(source);
  if (Symbol.asyncIterator in source) return source[Symbol.asyncIterator]();
  throw notASource();
}

const notASource = () =>
  new IsostarError(
    'BadArgument',
    'the source must be a ReadableStream, an AsyncIterable, a Uint8Array, a Response' +
      ' or a RangeSource',
  );

async function* once<Value>(value: Value): AsyncGenerator<Value, void> {
  yield value;
}

function bytesOfBody(response: Response): ByteIterator {
  if (!response.ok) throw badStatus(response, response.url || 'the response');
  return response.body ? bytesOf(response.body) : once(new Uint8Array());
}

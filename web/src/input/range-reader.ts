import { IsostarError } from '../api/errors.js';
import { type ByteRange, joined } from './byte-ranges.js';
import { bytesOf, copies, type Piece, type Pieces } from './pieces.js';
import type { Part, RangeFile } from './range-file.js';

/** Read before anything is known of the stream. Most headers with their index are shorter. */
const FIRST = { begin: 0, end: 1 << 14 };
/**
 * Up to this many bytes between two ranges are read although they are not wanted. With 4 KiB an
 * eighth of 512³ samples takes a third fewer requests, and a tenth more bytes.
 */
const MOST_GAP = 1 << 11;
/** Requests in progress at a time. Their answers are used in order. */
const MOST_REQUESTS = 4;

/** Reads the ranges of a file that are wanted, in order. */
export class RangeReader implements Pieces {
  readonly #file: RangeFile;
  readonly #pieces = this.#read();
  readonly #stop = new AbortController();
  readonly #parts: Promise<Part>[] = []; // requested and not used yet
  #wanted: ByteRange[] = [FIRST]; // and not requested yet
  #requested = 0; // the end of the last range requested
  #isAtEnd = false; // will the file give no more?
  #wake = () => {};

  constructor(file: RangeFile) {
    this.#file = file;
  }

  want(ranges: readonly ByteRange[]): void {
    this.#wanted = joined(ranges, MOST_GAP)
      .map(({ begin, end }) => ({ begin: Math.max(begin, this.#requested), end }))
      .filter(({ begin, end }) => begin < end);
    this.#request();
    this.#wake();
  }

  next(): Promise<IteratorResult<Piece, void>> {
    return this.#pieces.next();
  }

  /** Ends what is in progress; next() may then reject or stay pending. */
  async return(): Promise<IteratorResult<Piece, void>> {
    this.#stop.abort();
    return { done: true, value: undefined };
  }

  async *#read(): AsyncGenerator<Piece, void> {
    for (;;) {
      this.#request();
      const part = this.#parts[0];
      if (part) {
        yield* this.#piecesOf(await part);
        this.#parts.shift();
      } else if (this.#isAtEnd) {
        return;
      } else {
        await new Promise<void>((resolve) => (this.#wake = resolve));
      }
    }
  }

  async *#piecesOf({ begin, end = Infinity, body }: Part): AsyncGenerator<Piece, void> {
    if (end === Infinity) this.#isAtEnd = true;
    const pieces = copies(bytesOf(body), begin);
    let at = begin;
    for (let next = await pieces.next(); !next.done; next = await pieces.next()) {
      at += next.value.bytes.length;
      if (at > end) throw new IsostarError('BadArgument', 'more bytes came than were requested');
      yield next.value;
    }
    if (at < end) this.#isAtEnd = true; // for the decoder the stream is incomplete
  }

  #request(): void {
    const { length = Infinity } = this.#file;
    while (!this.#isAtEnd && this.#parts.length < MOST_REQUESTS) {
      const range = this.#wanted.shift();
      if (!range) return;
      this.#requested = range.end;
      this.#isAtEnd = range.end > length;
      if (range.begin >= length) return;
      const part = this.#file.open(range, this.#stop.signal);
      part.catch(() => {}); // reported when it is used
      this.#parts.push(part);
    }
  }
}

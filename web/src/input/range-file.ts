import type { ByteRange } from './byte-ranges.js';

/** A file that is read in parts. */
export interface RangeFile {
  /** In bytes; undefined as long as it is not known. */
  readonly length: number | undefined;
  /** Requests the bytes of a range, of which those beyond the end of the file are left out. */
  open(range: ByteRange, signal: AbortSignal): Promise<Part>;
}

/** What a file gives for a range. */
export interface Part {
  readonly begin: number;
  /** Undefined: the file gives all that it has from `begin` on. */
  readonly end: number | undefined;
  readonly body: ReadableStream<Uint8Array<ArrayBufferLike>>;
}

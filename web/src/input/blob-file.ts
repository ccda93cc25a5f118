import type { ByteRange } from './byte-ranges.js';
import type { Part, RangeFile } from './range-file.js';

export class BlobFile implements RangeFile {
  readonly #blob: Blob;

  constructor(blob: Blob) {
    this.#blob = blob;
  }

  get length(): number {
    return this.#blob.size;
  }

  async open({ begin, end }: ByteRange): Promise<Part> {
    const body = this.#blob.slice(begin, end).stream();
    return { begin, end: Math.min(end, this.length), body };
  }
}

import { IsostarError } from '../api/errors.js';
import { BlobFile } from './blob-file.js';
import { HttpFile, type HttpOptions } from './http-file.js';
import type { Pieces } from './pieces.js';
import { RangeReader } from './range-reader.js';

/**
 * A file of which only the bytes that a decoder needs are read: by HTTP `Range` requests, or from a
 * Blob. Of a server that answers with the whole file, the file is read as it comes. Can be decoded
 * any number of times, each of which reads it anew.
 */
export class RangeSource {
  readonly #file: string | Blob;
  readonly #options: HttpOptions;

  /** `file`: its address, or a Blob, in Node from `fs.openAsBlob`. */
  constructor(file: string | URL | Blob, options: HttpOptions = {}) {
    if (file instanceof URL) file = file.href;
    if (typeof file !== 'string' && !(file instanceof Blob))
      throw new IsostarError('BadArgument', 'a RangeSource needs an address or a Blob');
    this.#file = file;
    this.#options = { ...options };
  }

  /** Begins to read; called by decode(). */
  open(): Pieces {
    const file = this.#file;
    return new RangeReader(
      file instanceof Blob ? new BlobFile(file) : new HttpFile(file, this.#options),
    );
  }
}

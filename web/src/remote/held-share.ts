import { IsostarError } from '../api/errors.js';
import type { SurfaceOptions } from '../api/surface.js';
import type { Lease } from '../codec/instances.js';
import { copyOf } from '../codec/mesh-part.js';
import { type ShareNumber, StreamDecoder } from '../codec/stream-decoder.js';
import type { Piece } from '../input/pieces.js';

/**
 * A share of a stream that this worker decodes for another one. Calls are done in their order.
 * After one has failed, all fail for its reason.
 */
export class HeldShare {
  #calls: Promise<StreamDecoder>; // resolves to the decoder when all calls are done
  #end = () => {};

  constructor(lease: Promise<Lease>, options: SurfaceOptions, share: ShareNumber) {
    this.#calls = this.#begin(lease, options, share);
  }

  accept(piece: Piece): void {
    this.#call((decoder) => decoder.accept(piece)).catch(() => {});
  }

  finish(): void {
    this.#call((decoder) => decoder.finish()).catch(() => {});
  }

  /** Resolves to what others need before the share can go on, if that is so. */
  advance(results: readonly Uint8Array[]): Promise<Uint8Array<ArrayBuffer> | undefined> {
    return this.#call((decoder) => {
      takeAll(decoder, results);
      decoder.advance();
      if (decoder.failure) throw decoder.failure;
      return decoder.needsOthers ? decoder.results() : undefined;
    });
  }

  results(): Promise<Uint8Array<ArrayBuffer>> {
    return this.#call((decoder) => decoder.results());
  }

  mesh(results: readonly Uint8Array[], isovalue: number): Promise<ReturnType<typeof copyOf>> {
    return this.#call((decoder) => {
      takeAll(decoder, results);
      decoder.polygonize(isovalue);
      return copyOf(decoder.part());
    });
  }

  delete(): void {
    const end = () => this.#end();
    this.#calls.then(end, end);
  }

  async #begin(
    lease: Promise<Lease>,
    options: SurfaceOptions,
    share: ShareNumber,
  ): Promise<StreamDecoder> {
    const { module, drop, end } = await lease;
    const decoder = new StreamDecoder(module, options, drop, share);
    this.#end = () => {
      decoder.delete();
      end();
    };
    return decoder;
  }

  #call<Result>(work: (decoder: StreamDecoder) => Result): Promise<Result> {
    const before = this.#calls;
    const result = before.then(work);
    this.#calls = result.then(() => before);
    this.#calls.catch(() => {}); // the next answer has it
    return result;
  }
}

function takeAll(decoder: StreamDecoder, results: readonly Uint8Array[]): void {
  if (!results.every((one) => decoder.take(one)))
    throw new IsostarError('Corrupt', 'these are no results of another share');
}

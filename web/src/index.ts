import { IsostarError } from './api/errors.js';
import type { Decoder, Limits } from './api/surface.js';
import { checkLimits } from './codec/limits.js';
import type { WasmSource } from './codec/load-module.js';

export { IsostarError, type IsostarErrorCode } from './api/errors.js';
export type * from './api/surface.js';
export { RangeSource } from './input/range-source.js';
export type { HttpOptions } from './input/http-file.js';
export type { WasmSource } from './codec/load-module.js';

export interface DecoderOptions {
  /**
   * The decoder's WebAssembly: its address or its bytes. By default this package's own
   * `decoder.wasm` and, when a stream or its options need what that one lacks, `decoder-all.wasm`
   * with `decoder-all.js`. A file given here is the only one that is used: `decoder-all.wasm`
   * decodes every stream; with `decoder.wasm` a stream that needs more ends in a `BadArgument`.
   */
  wasm?: WasmSource | undefined;
  /** Decode in a worker; by default true on pages and false elsewhere. */
  worker?: boolean | undefined;
  /**
   * How many workers may decode a stream together. Only streams in chunks, which large surfaces
   * are, take more than one; the others start with the first of these. Each worker has the limits
   * for itself. By default as many as the machine has processors, at most 4. No effect without
   * `worker`.
   */
  workers?: number | undefined;
  /** What decoding each stream may cost. */
  limits?: Limits | undefined;
}

const isPage = typeof document !== 'undefined' && typeof Worker !== 'undefined';

/**
 * A decoder can be reused: it decodes any number of streams, also at the same time. Throws an
 * `IsostarError` with code `BadArgument` if the WebAssembly or the worker cannot be loaded.
 */
export async function createDecoder({
  wasm,
  worker = isPage,
  workers = Math.min(globalThis.navigator?.hardwareConcurrency ?? 1, 4),
  limits,
}: DecoderOptions = {}): Promise<Decoder> {
  checkLimits(limits);
  if (!Number.isInteger(workers) || workers < 1)
    throw new IsostarError('BadArgument', 'workers must be a whole number from 1 on');
  if (!worker) return (await import('./codec/local-decoder.js')).LocalDecoder.create(wasm, limits);
  if (!isPage)
    throw new IsostarError('BadArgument', 'a worker is possible only on pages; pass worker: false');
  return (await import('./remote/remote-decoder.js')).RemoteDecoder.create(wasm, limits, workers);
}

import { IsostarError } from './errors.js';
import type { WasmSource } from './load-module.js';
import type { Decoder } from './surface.js';

export { IsostarError, type IsostarErrorCode } from './errors.js';
export type { WasmSource } from './load-module.js';
export type * from './surface.js';

export interface DecoderOptions {
  /** The decoder's WebAssembly: its address or its bytes; by default `decoder.wasm` of this package. */
  wasm?: WasmSource;
  /** Decode in a worker: by default on pages, and not elsewhere. */
  worker?: boolean;
}

const isPage = typeof document !== 'undefined' && typeof Worker !== 'undefined';

/** A decoder is worth keeping: it serves any number of streams, also at the same time. */
export async function createDecoder({ wasm, worker = isPage }: DecoderOptions = {}): Promise<Decoder> {
  if (!worker) return (await import('./local-decoder.js')).LocalDecoder.create(wasm);
  if (!isPage) throw new IsostarError('BadArgument', 'a worker can be had on pages only; pass worker: false');
  return (await import('./remote-decoder.js')).RemoteDecoder.create(wasm);
}

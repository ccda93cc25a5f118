import { IsostarError } from './api/errors.js';
import type { Decoder } from './api/surface.js';
import type { WasmSource } from './codec/load-module.js';

export { IsostarError, type IsostarErrorCode } from './api/errors.js';
export type * from './api/surface.js';
export type { WasmSource } from './codec/load-module.js';

export interface DecoderOptions {
  /** The decoder's WebAssembly: its address or its bytes; by default this package's own. */
  wasm?: WasmSource;
  /** Decode in a worker; by default true on pages and false elsewhere. */
  worker?: boolean;
}

const isPage = typeof document !== 'undefined' && typeof Worker !== 'undefined';

/** A decoder can be reused: it decodes any number of streams, also at the same time. */
export async function createDecoder({
  wasm,
  worker = isPage,
}: DecoderOptions = {}): Promise<Decoder> {
  if (!worker) return (await import('./codec/local-decoder.js')).LocalDecoder.create(wasm);
  if (!isPage)
    throw new IsostarError('BadArgument', 'a worker is possible only on pages; pass worker: false');
  return (await import('./remote/remote-decoder.js')).RemoteDecoder.create(wasm);
}

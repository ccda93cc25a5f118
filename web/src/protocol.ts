import type { IsostarErrorCode } from './errors.js';
import type { WasmSource } from './load-module.js';
import type { Surface, SurfaceOptions } from './surface.js';

/** Page to worker. A decode is named by the page's number for it. */
export type Request =
  | { type: 'open'; wasm: Exclude<WasmSource, URL> | undefined }
  | { type: 'decode'; id: number; options: SurfaceOptions }
  | { type: 'piece'; id: number; piece: Uint8Array }
  | { type: 'end'; id: number }
  | { type: 'turn'; id: number; isovalue: number | undefined }
  | { type: 'settle'; id: number }
  | { type: 'next'; id: number }
  | { type: 'stop'; id: number };

/** Worker to page: one reply to `open` (id 0) and one to each `next`. */
export type Reply =
  | { type: 'opened'; id: 0 }
  | { type: 'surface'; id: number; surface: Surface }
  | { type: 'done'; id: number }
  | { type: 'failed'; id: number; code: IsostarErrorCode | undefined; message: string };

import type { IsostarErrorCode } from '../api/errors.js';
import type { Surface, SurfaceOptions } from '../api/surface.js';
import type { WasmSource } from '../codec/load-module.js';
import type { ByteRange } from '../input/byte-ranges.js';
import type { Piece } from '../input/pieces.js';

/** Page to worker. `id` is the page's number for one call of decode(). */
export type Request =
  | { type: 'open'; id: 0; wasm: Exclude<WasmSource, URL> | undefined }
  | { type: 'decode'; id: number; options: SurfaceOptions }
  | { type: 'accept'; id: number; piece: Piece }
  | { type: 'finish'; id: number }
  | { type: 'beginIsovalues'; id: number }
  | { type: 'setIsovalue'; id: number; isovalue: number }
  | { type: 'endIsovalues'; id: number }
  | { type: 'next'; id: number }
  | { type: 'stop'; id: number };

/** Worker to page: one reply to `open` (id 0) and one to each `next`. */
export type Reply =
  | { type: 'opened'; id: 0 }
  | { type: 'surface'; id: number; surface: Surface }
  | { type: 'done'; id: number }
  | { type: 'failed'; id: number; code: IsostarErrorCode | undefined; message: string };

/** Worker to page, at any time: what the inbox reports to its feed. */
export type Report =
  | { type: 'taken'; id: number; weight: number }
  | { type: 'wanted'; id: number; ranges: readonly ByteRange[] }
  | { type: 'enough'; id: number };

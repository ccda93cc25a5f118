import type { IsostarErrorCode } from '../api/errors.js';
import type { SurfaceOptions } from '../api/surface.js';
import type { WasmSource } from '../codec/load-module.js';
import type { copyOf } from '../codec/mesh-part.js';
import type { ShareNumber } from '../codec/stream-decoder.js';
import type { WholeSurface } from '../codec/surface-chunks.js';
import type { ByteRange } from '../input/byte-ranges.js';
import type { Piece } from '../input/pieces.js';

export interface OpenOptions {
  readonly wasm: Exclude<WasmSource, URL> | WebAssembly.Module | undefined;
  /** How many workers of its own it may start. */
  readonly helpers?: number;
}

/**
 * Page to worker, and worker to helper. `id` is the sender's number for one call of decode(), or
 * for one share of a stream.
 */
export type Request =
  | ({ type: 'open'; id: 0 } & OpenOptions)
  | { type: 'decode'; id: number; options: SurfaceOptions }
  | { type: 'accept'; id: number; piece: Piece }
  | { type: 'finish'; id: number }
  | { type: 'beginIsovalues'; id: number }
  | { type: 'setIsovalue'; id: number; isovalue: number }
  | { type: 'endIsovalues'; id: number }
  | { type: 'next'; id: number }
  | { type: 'stop'; id: number }
  | ShareRequest;

export interface ShareOptions {
  readonly options: SurfaceOptions;
  readonly share: ShareNumber;
  /** The module for every stream, if the stream needs it. */
  readonly all: WebAssembly.Module | undefined;
}

/** Worker to helper, beside `accept`, `finish` and `stop`. */
export type ShareRequest =
  | ({ type: 'share'; id: number } & ShareOptions)
  | { type: 'advance'; id: number; results: readonly Uint8Array[] }
  | { type: 'results'; id: number }
  | { type: 'mesh'; id: number; results: readonly Uint8Array[]; isovalue: number };

/** The reverse: one reply to `open` (id 0) and to each `next`, `advance`, `results` and `mesh`. */
export type Reply =
  | { type: 'opened'; id: 0 }
  | { type: 'surface'; id: number; surface: WholeSurface }
  | { type: 'done'; id: number }
  | { type: 'results'; id: number; results: Uint8Array<ArrayBuffer> | undefined }
  | { type: 'part'; id: number; part: ReturnType<typeof copyOf> }
  | { type: 'failed'; id: number; code: IsostarErrorCode | undefined; message: string };

/** Worker to page, at any time: what the inbox reports to its feed. */
export type Report =
  | { type: 'taken'; id: number; weight: number }
  | { type: 'wanted'; id: number; ranges: readonly ByteRange[] }
  | { type: 'enough'; id: number };

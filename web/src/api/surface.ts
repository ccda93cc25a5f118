import type { RangeSource } from '../input/range-source.js';

/**
 * Which surface is made of the decoded scalars: one vertex per crossing axis edge, as marching
 * cubes has, or one polygon per crossing tetrahedron.
 */
export type Polygonizer = 'cubes' | 'tetrahedra';

/** `world` applies spacing, origin and direction; `grid` puts sample (i,j,k) at point (i,j,k). */
export type Frame = 'world' | 'grid';

/** A box along the axes of a frame, its boundary included. */
export interface Region {
  readonly min: readonly [number, number, number];
  readonly max: readonly [number, number, number];
}

/** One piece of the stream after which the decoded surface is better. */
export interface Layer {
  readonly kind: 'base' | 'refinement' | 'domain' | 'geometry';
  /** Refinement level: 0 is the base. */
  readonly level: number;
  /** The layer is complete after this many bytes of the stream. */
  readonly offset: number;
  /** Bytes of this layer alone. */
  readonly bytes: number;
  /** RMS distance to the source's surface, in grid steps, as the encoder determined it. */
  readonly error: number;
  /** The isovalue whose surface the layer codes. */
  readonly isovalue: number;
}

/** The contents of the stream's header, and the heads of the layers decoded so far. */
export interface StreamInfo {
  /** Of the stream format. */
  readonly version: number;
  /** 3; other streams are refused with an `IsostarError`. */
  readonly dimension: number;
  /** Samples along x, y, z. */
  readonly size: readonly [number, number, number];
  readonly origin: readonly [number, number, number];
  readonly spacing: readonly [number, number, number];
  /** Row-major 3×3: world = origin + direction · (spacing ∘ index). */
  readonly direction: readonly number[];
  /** The first isovalue, then the further ones in the order in which they are coded. */
  readonly isovalues: readonly number[];
  /** The polygonizer whose surface the bound holds for. */
  readonly polygonizer: Polygonizer;
  readonly lossless: boolean;
  /** The encoder's `--effort`: 2 takes longer to decode. */
  readonly effort: number;
  /** Cells of a chunk on a side; 0 if each level is one chunk. */
  readonly chunkSide: number;
  /** The bound that the encoder was given, in grid steps; 0 for lossless streams. */
  readonly maxError: number;
  /** Of the final surface that `cubes` makes. */
  readonly vertices: number;
  /** Bytes of the header and of the layer heads so far. */
  readonly headerBytes: number;
  /** Of the whole stream. */
  readonly bytes: number;
  readonly layers: readonly Layer[];
}

/** The surface that a prefix of the stream describes. The arrays belong to the caller. */
export interface Surface {
  /** x, y, z of each vertex. */
  readonly positions: Float32Array<ArrayBuffer>;
  /** One unit vector per vertex, towards smaller values; empty if not requested. */
  readonly normals: Float32Array<ArrayBuffer>;
  /** Three vertices per triangle, counter-clockwise seen from the side of smaller values. */
  readonly indices: Uint32Array<ArrayBuffer>;
  /** Length of the prefix. */
  readonly bytes: number;
  /** Refinement level: 0 is the base, `levels - 1` the source's own grid. */
  readonly level: number;
  readonly levels: number;
  /**
   * The isovalue of this surface. If it is not one of the stream's own, the surface is estimated
   * from the isovalues around it.
   */
  readonly isovalue: number;
  /**
   * RMS distance to the source's surface in grid steps, after the last complete layer of the
   * nearest of the stream's isovalues.
   */
  readonly error: number;
  /** No better surface will come. */
  readonly final: boolean;
  readonly info: StreamInfo;
  /** `decode`: of all layers so far; `polygonize`: of this surface. */
  readonly milliseconds: { readonly decode: number; readonly polygonize: number };
  /**
   * The same surface in pieces, by chunk of a stream in chunks, else one: for renderers that draw
   * only what is in view. Made when it is asked for; not copied when the surface is posted.
   */
  readonly chunks: readonly SurfaceChunk[];
}

/** A part of a surface, with vertices of its own. Arrays as of `Surface`. */
export interface SurfaceChunk {
  readonly positions: Float32Array<ArrayBuffer>;
  readonly normals: Float32Array<ArrayBuffer>;
  readonly indices: Uint32Array<ArrayBuffer>;
  /** The smallest and the largest coordinates of its vertices. */
  readonly min: readonly [number, number, number];
  readonly max: readonly [number, number, number];
}

/**
 * Where the bytes of a stream come from. They are copied when they are handed over: a `Uint8Array`
 * by decode(), the pieces of other sources as they arrive. The caller's buffers are never detached
 * and may be reused then. A source is read to the end of the stream at most, then cancelled.
 */
export type Source =
  | ReadableStream<Uint8Array<ArrayBufferLike>>
  | AsyncIterable<Uint8Array<ArrayBufferLike>>
  | Uint8Array<ArrayBufferLike>
  | Response
  | RangeSource;

/**
 * What decoding one stream may cost. A stream that would cost more ends in an `IsostarError` with
 * code `OverLimit`. Numbers from 0 on; `Infinity` removes a limit.
 */
export interface Limits {
  /**
   * Bytes that the decoder uses, including the mesh while it is made. Not included are the bytes of
   * the stream, which may take as much again. Default: 512 MiB.
   */
  memory?: number | undefined;
  /** Samples of the source's grid. Default: 2³¹. */
  samples?: number | undefined;
  /** Vertices of a surface. Default: 2²⁶. */
  vertices?: number | undefined;
  /**
   * Yes/no decisions that are decoded, which bounds the time; each visit of a brick of 8×8×8
   * vertices counts as 64 more. Default: 2²⁸.
   */
  decisions?: number | undefined;
}

/** An option that is undefined has its default. */
export interface SurfaceOptions {
  /** Default: `cubes`. */
  polygonizer?: Polygonizer | undefined;
  /** Default: `world`. */
  frame?: Frame | undefined;
  /** Default: true. */
  normals?: boolean | undefined;
  /** One of the stream's isovalues, or a value between two of them; by default its first. */
  isovalue?: number | undefined;
  /**
   * Only this box, in the frame of `frame`, is decoded at full precision, the rest on coarse levels:
   * within it vertices are those of the whole stream. Streams without chunks (see
   * `StreamInfo.chunkSide`) are decoded as a whole. From a `RangeSource` only the bytes for it are
   * read.
   */
  region?: Region | undefined;
  /**
   * `newest` (default): the first surface as early as possible, then always the best one for the
   * bytes at hand, without those that are out of date already; `all`: one surface per layer;
   * `last`: only the best one of the whole source.
   */
  refinements?: 'newest' | 'all' | 'last' | undefined;
  /** Each limit that is not given here is that of `createDecoder`. */
  limits?: Limits | undefined;
}

export interface DecodeOptions extends Omit<SurfaceOptions, 'isovalue'> {
  /**
   * One of the stream's isovalues, or a value between two of them; by default its first. An
   * iterable, of a slider's values for example, changes the isovalue each time, also after the last
   * byte; the iteration over surfaces then ends when the iterable does.
   */
  isovalue?: number | AsyncIterable<number> | undefined;
  /** Aborting stops the download and the decoding; the iteration throws the signal's reason. */
  signal?: AbortSignal | undefined;
}

export interface Decoder {
  /**
   * The surfaces of a stream, each better than the last, as its bytes arrive. A damaged or
   * incomplete stream yields the surfaces that are sound and then throws an `IsostarError`. After
   * any error the decoder can be used again. An iteration that is not finished should be ended by
   * `return()`, which leaving a `for await` loop does; one that is dropped keeps its memory until
   * it is garbage-collected.
   */
  decode(source: Source, options?: DecodeOptions): AsyncIterableIterator<Surface>;
  /** Frees memory and worker; iterations in progress throw an AbortError. */
  dispose(): void;
}

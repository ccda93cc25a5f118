/** Which surface is made of the decoded scalars: as marching cubes has it, or one polygon per crossing tetrahedron. */
export type Polygonizer = 'cubes' | 'tetrahedra';

/** `world` applies spacing, origin and direction; `grid` puts sample (i,j,k) at point (i,j,k). */
export type Frame = 'world' | 'grid';

/** One piece of the stream after which the decoded surface is better. */
export interface Layer {
  readonly kind: 'base' | 'refinement' | 'domain' | 'geometry';
  readonly level: number;
  /** The layer is complete after this many bytes of the stream. */
  readonly offset: number;
  readonly bytes: number;
  /** RMS distance to the source's surface, in grid steps, as the encoder determined it. */
  readonly error: number;
  /** Whose surface it tells. */
  readonly isovalue: number;
}

/** What the stream's header tells, and the heads of the layers decoded so far. */
export interface StreamInfo {
  readonly version: number;
  /** 3; other streams are refused with an `IsostarError`. */
  readonly dimension: number;
  readonly size: readonly [number, number, number];
  readonly origin: readonly [number, number, number];
  readonly spacing: readonly [number, number, number];
  /** Row-major 3×3: world = origin + direction · (spacing ∘ index). */
  readonly direction: readonly number[];
  /** The first one, then further ones in the order in which they are told. */
  readonly isovalues: readonly number[];
  readonly polygonizer: Polygonizer;
  readonly lossless: boolean;
  /** As the encoder's `--effort`: 2 takes longer to decode. */
  readonly effort: number;
  readonly maxError: number;
  /** Of the complete surface that `cubes` makes. */
  readonly vertices: number;
  readonly headerBytes: number;
  /** Of the whole stream. */
  readonly bytes: number;
  readonly layers: readonly Layer[];
}

/** What a prefix of the stream shows. The arrays are the caller's own. */
export interface Surface {
  /** x, y, z of each vertex. */
  readonly positions: Float32Array<ArrayBuffer>;
  /** Unit vectors towards smaller values, one a vertex; empty when not asked for. */
  readonly normals: Float32Array<ArrayBuffer>;
  /** Three vertices a triangle, counter-clockwise seen from the side of smaller values. */
  readonly indices: Uint32Array<ArrayBuffer>;
  /** Length of the prefix that this surface shows. */
  readonly bytes: number;
  /** 0 is the base; `levels - 1` the source's own grid. */
  readonly level: number;
  readonly levels: number;
  /** Whose surface it is; where it is none of the stream's own, it is drawn from what is known of those around it. */
  readonly isovalue: number;
  /** RMS distance to the source's surface in grid steps, after the last complete layer of the nearest of the stream's isovalues. */
  readonly error: number;
  /** No better surface will come. */
  readonly final: boolean;
  readonly info: StreamInfo;
  /** `decode`: of all layers so far; `polygonize`: of this surface. */
  readonly milliseconds: { readonly decode: number; readonly polygonize: number };
}

export type Source =
  | ReadableStream<Uint8Array<ArrayBufferLike>>
  | AsyncIterable<Uint8Array<ArrayBufferLike>>
  | Uint8Array<ArrayBufferLike>
  | Response;

export interface SurfaceOptions {
  polygonizer?: Polygonizer;
  frame?: Frame;
  normals?: boolean;
  /** One of the stream's isovalues, or one between two of them; by default its first. */
  isovalue?: number;
  /**
   * `newest`: the first surface early, then always the best that the bytes at hand allow, skipping those that are stale
   * already; `all`: one surface a layer; `last`: only the best of the whole source.
   */
  refinements?: 'newest' | 'all' | 'last';
}

export interface DecodeOptions extends Omit<SurfaceOptions, 'isovalue'> {
  /**
   * One of the stream's isovalues, or one between two of them; by default its first. Several as they come, from a slider say,
   * turn the surface to each, also after the last byte: the iteration ends when they do.
   */
  isovalue?: number | AsyncIterable<number>;
  /** Aborting stops the download and the decoding; the iteration throws the signal's reason. */
  signal?: AbortSignal;
}

export interface Decoder {
  /**
   * The surfaces of a stream, better and better, as its bytes arrive. A damaged or broken-off stream gives the surfaces that
   * are sound and then throws an `IsostarError`.
   */
  decode(source: Source, options?: DecodeOptions): AsyncIterableIterator<Surface>;
  /** Frees memory and worker; iterations under way throw an AbortError. */
  dispose(): void;
}

/** A value of an enumeration, as Embind makes it or a number. */
type Enumerator = object | number;

/**
 * The module that wasm/bindings.cpp exports, and plain-module.ts makes of wasm/exports.cpp;
 * declared by hand, a test compares the names. Views into its memory are valid until the next call.
 */
export interface RawModule {
  /** The whole memory. */
  readonly HEAPU8: Uint8Array;
  /** The limits; NaN stands for the default of the C++ `isostar::Limits`. */
  Decoder: new (memory: number, samples: number, vertices: number, decisions: number) => RawDecoder;
  /** Those that the module has. */
  Polygonizer: { cubes: Enumerator; tetrahedra?: Enumerator };
  Frame: { world: Enumerator; grid: Enumerator };
}

/** The C++ `isostar::Decoder`, under the same names. */
export interface RawDecoder {
  setRegion(
    x0: number,
    y0: number,
    z0: number,
    x1: number,
    y1: number,
    z1: number,
    frame: Enumerator,
  ): void;
  room(bytes: number): Uint8Array;
  /** `offset`: where in the stream the bytes in the room begin. */
  accept(bytes: number, offset: number): void;
  /** The first wanted bytes from `from` on; equal: none are wanted. */
  wantedBegin(from: number): number;
  wantedEnd(from: number): number;
  setShare(number: number, of: number): void;
  needsOthers(): boolean;
  results(): Uint8Array;
  takeResults(bytes: number): boolean;
  finish(): void;
  advance(): boolean;
  /** Is the stream sound so far, and does only the module for every stream decode it? */
  lacks(): boolean;
  isFinal(): boolean;
  level(): number;
  levels(): number;
  bytes(): number;
  info(): import('../api/surface.js').StreamInfo;
  error(): string;
  describeError(): string;
  makeMesh(polygonizer: Enumerator, frame: Enumerator, normals: boolean, isovalue: number): string;
  positions(): Float32Array;
  normals(): Float32Array;
  indices(): Uint32Array;
  /** Of each `isostar::MeshRun`: order, first vertex, vertices, corners. */
  runs(): Uint32Array;
  delete(): void;
}

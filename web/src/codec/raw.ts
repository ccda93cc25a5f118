/**
 * The module that wasm/bindings.cpp exports, declared by hand; a test compares the names. Views
 * into its memory are valid until the next call.
 */
export interface RawModule {
  /** The whole memory. */
  HEAPU8: Uint8Array;
  /** The limits; NaN stands for the default of the C++ `isostar::Limits`. */
  Decoder: new (memory: number, samples: number, vertices: number, decisions: number) => RawDecoder;
  Polygonizer: { cubes: object; tetrahedra: object };
  Frame: { world: object; grid: object };
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
    frame: object,
  ): string;
  room(bytes: number): Uint8Array;
  /** `offset`: where in the stream the bytes in the room begin. */
  accept(bytes: number, offset: number): void;
  /** The first wanted bytes from `from` on; equal: none are wanted. */
  wantedBegin(from: number): number;
  wantedEnd(from: number): number;
  setShare(number: number, of: number): string;
  needsOthers(): boolean;
  results(): Uint8Array;
  takeResults(bytes: number): boolean;
  finish(): void;
  advance(): boolean;
  isFinal(): boolean;
  level(): number;
  levels(): number;
  bytes(): number;
  info(): import('../api/surface.js').StreamInfo;
  error(): string;
  describeError(): string;
  makeMesh(polygonizer: object, frame: object, normals: boolean, isovalue: number): string;
  positions(): Float32Array;
  normals(): Float32Array;
  indices(): Uint32Array;
  /** Of each `isostar::MeshRun`: order, first vertex, vertices, corners. */
  runs(): Uint32Array;
  delete(): void;
}

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
  room(bytes: number): Uint8Array;
  accept(bytes: number): void;
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
  delete(): void;
}

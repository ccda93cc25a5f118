/**
 * The module that wasm/bindings.cpp exports, declared by hand; a test compares the names. Views
 * into its memory are valid until the next call.
 */
export interface RawModule {
  Decoder: new () => RawDecoder;
  Polygonizer: { cubes: object; tetrahedra: object };
  Frame: { world: object; grid: object };
}

/** The C++ `isostar::Decoder`, under the same names. */
export interface RawDecoder {
  room(bytes: number): Uint8Array;
  accept(bytes: number): void;
  finish(): void;
  advance(): boolean;
  ready(): boolean;
  isFinal(): boolean;
  level(): number;
  levels(): number;
  bytes(): number;
  rmsError(): number;
  info(): import('../api/surface.js').StreamInfo;
  error(): string;
  describeError(): string;
  makeMesh(polygonizer: object, frame: object, normals: boolean, isovalue: number): string;
  positions(): Float32Array;
  normals(): Float32Array;
  indices(): Uint32Array;
  delete(): void;
}

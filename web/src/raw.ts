/** What wasm/bindings.cpp exports, by hand; a test compares the names. Views are valid until the next call. */
export interface RawDecoder {
  room(bytes: number): Uint8Array;
  accept(bytes: number): void;
  finish(): void;
  advance(): boolean;
  ready(): boolean;
  complete(): boolean;
  level(): number;
  levels(): number;
  bytes(): number;
  rmsError(): number;
  info(): import('./surface.js').StreamInfo;
  error(): string;
  describeError(): string;
  makeMesh(polygonizer: object, frame: object, normals: boolean, isovalue: number): string;
  positions(): Float32Array;
  normals(): Float32Array;
  triangles(): Uint32Array;
  delete(): void;
}

export interface RawModule {
  Decoder: new () => RawDecoder;
  Polygonizer: { cubes: object; tetrahedra: object };
  Frame: { world: object; grid: object };
}

/** The part of draco3d that the page uses; the package has no types of its own. */
declare module 'draco3d/draco_decoder_nodejs.js' {
  interface Mesh {
    num_points(): number;
    num_faces(): number;
  }
  interface Decoder {
    DecodeArrayToMesh(
      bytes: Uint8Array,
      size: number,
      mesh: Mesh,
    ): { ok(): boolean; error_msg(): string };
    GetAttributeId(mesh: Mesh, kind: number): number;
    GetAttribute(mesh: Mesh, id: number): object;
    GetAttributeDataArrayForAllPoints(
      mesh: Mesh,
      attribute: object,
      type: number,
      size: number,
      pointer: number,
    ): boolean;
    GetTrianglesUInt32Array(mesh: Mesh, size: number, pointer: number): boolean;
  }
  export interface DracoModule {
    Decoder: new () => Decoder;
    Mesh: new () => Mesh;
    POSITION: number;
    DT_FLOAT32: number;
    HEAPU8: Uint8Array<ArrayBuffer>;
    _malloc(size: number): number;
    _free(pointer: number): void;
    destroy(object: object): void;
  }
  const createModule: (options: { wasmBinary: ArrayBuffer }) => Promise<DracoModule>;
  export default createModule;
}

import createDracoModule, { type DracoModule } from 'draco3d/draco_decoder_nodejs.js';
import dracoWasm from 'draco3d/draco_decoder.wasm?url';
import type { DracoSurface } from './draco.ts';

const ready: Promise<DracoModule> = fetch(dracoWasm)
  .then((response) => response.arrayBuffer())
  .then((wasmBinary) => createDracoModule({ wasmBinary }));

self.onmessage = async ({ data }: MessageEvent<{ id: number; bytes?: Uint8Array }>) => {
  try {
    const draco = await ready;
    if (!data.bytes) return self.postMessage({ id: data.id });
    const surface = decode(draco, data.bytes);
    const transfer = [surface.positions.buffer, surface.normals.buffer, surface.indices.buffer];
    self.postMessage({ id: data.id, surface }, { transfer });
  } catch (reason) {
    self.postMessage({ id: data.id, failure: String((reason as Error).message ?? reason) });
  }
};

function decode(draco: DracoModule, bytes: Uint8Array): DracoSurface {
  const start = performance.now();
  const decoder = new draco.Decoder();
  const mesh = new draco.Mesh();
  try {
    const status = decoder.DecodeArrayToMesh(bytes, bytes.length, mesh);
    if (!status.ok()) throw new Error(`Draco: ${status.error_msg()}`);
    const attribute = decoder.GetAttribute(mesh, decoder.GetAttributeId(mesh, draco.POSITION));
    const positions = fromHeap(draco, 12 * mesh.num_points(), (size, pointer) =>
      decoder.GetAttributeDataArrayForAllPoints(mesh, attribute, draco.DT_FLOAT32, size, pointer),
    );
    const indices = fromHeap(draco, 12 * mesh.num_faces(), (size, pointer) =>
      decoder.GetTrianglesUInt32Array(mesh, size, pointer),
    );
    const surface = { positions: new Float32Array(positions), indices: new Uint32Array(indices) };
    const decoded = performance.now();
    const normals = normalsOf(surface.positions, surface.indices);
    return {
      ...surface,
      normals,
      milliseconds: { decode: decoded - start, normals: performance.now() - decoded },
    };
  } finally {
    draco.destroy(mesh);
    draco.destroy(decoder);
  }
}

function fromHeap(
  draco: DracoModule,
  size: number,
  fill: (size: number, pointer: number) => void,
): ArrayBuffer {
  const pointer = draco._malloc(size);
  try {
    fill(size, pointer);
    return draco.HEAPU8.slice(pointer, pointer + size).buffer;
  } finally {
    draco._free(pointer);
  }
}

/** Draco's files carry no normals. Weighted by area, as three.js computes them. */
function normalsOf(positions: Float32Array, indices: Uint32Array): Float32Array<ArrayBuffer> {
  const normals = new Float32Array(positions.length);
  for (let i = 0; i < indices.length; i += 3) {
    const a = 3 * indices[i]!,
      b = 3 * indices[i + 1]!,
      c = 3 * indices[i + 2]!;
    const ux = positions[b]! - positions[a]!,
      uy = positions[b + 1]! - positions[a + 1]!,
      uz = positions[b + 2]! - positions[a + 2]!;
    const vx = positions[c]! - positions[a]!,
      vy = positions[c + 1]! - positions[a + 1]!,
      vz = positions[c + 2]! - positions[a + 2]!;
    const nx = uy * vz - uz * vy,
      ny = uz * vx - ux * vz,
      nz = ux * vy - uy * vx;
    for (const vertex of [a, b, c]) {
      normals[vertex]! += nx;
      normals[vertex + 1]! += ny;
      normals[vertex + 2]! += nz;
    }
  }
  for (let i = 0; i < normals.length; i += 3) {
    const length = Math.hypot(normals[i]!, normals[i + 1]!, normals[i + 2]!) || 1;
    for (let axis = 0; axis < 3; axis++) normals[i + axis]! /= length;
  }
  return normals;
}

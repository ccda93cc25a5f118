// Times of isostar's WebAssembly decoder and of npm's draco3d, in turns in one Node process, until
// the caller has positions and indices.
import draco3d from 'draco3d';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';

const FEWEST_ROUNDS = 5;

/** The module that decodes everything, without the package's script: draco3d has none either. */
async function isostarModule(build) {
  const { default: create } = await import(pathToFileURL(join(build, 'wasm/decoder-all.js')));
  return create({ wasmBinary: readFileSync(join(build, 'wasm/decoder-all.wasm')) });
}

function decodeIsostar(module, bytes, normals) {
  const decoder = new module.Decoder(NaN, NaN, NaN, NaN);
  decoder.room(bytes.length).set(bytes);
  decoder.accept(bytes.length, 0);
  decoder.finish();
  while (decoder.advance());
  const error = decoder.makeMesh(
    module.Polygonizer.cubes,
    module.Frame.world,
    normals,
    decoder.info().isovalues[0],
  );
  if (!decoder.isFinal() || error !== 'None')
    throw new Error(`isostar: ${decoder.error()}, ${error}`);
  const surface = [
    decoder.positions().slice(),
    decoder.indices().slice(),
    decoder.normals().slice(),
  ];
  decoder.delete();
  return surface;
}

function decodeDraco(module, bytes) {
  const decoder = new module.Decoder();
  const mesh = new module.Mesh();
  const status = decoder.DecodeArrayToMesh(bytes, bytes.length, mesh);
  if (!status.ok()) throw new Error(`Draco: ${status.error_msg()}`);
  const attribute = decoder.GetAttribute(mesh, decoder.GetAttributeId(mesh, module.POSITION));
  const positions = fromHeap(module, 12 * mesh.num_points(), (size, pointer) =>
    decoder.GetAttributeDataArrayForAllPoints(mesh, attribute, module.DT_FLOAT32, size, pointer),
  );
  const indices = fromHeap(module, 12 * mesh.num_faces(), (size, pointer) =>
    decoder.GetTrianglesUInt32Array(mesh, size, pointer),
  );
  module.destroy(mesh);
  module.destroy(decoder);
  return [positions, indices];
}

function fromHeap(module, size, fill) {
  const pointer = module._malloc(size);
  fill(size, pointer);
  const copy = module.HEAPU8.slice(pointer, pointer + size);
  module._free(pointer);
  return copy;
}

/** The shortest times in milliseconds. */
export async function wasmTimes(build, streamFile, dracoFile, milliseconds) {
  const [isostar, draco] = await Promise.all([
    isostarModule(build),
    draco3d.createDecoderModule({}),
  ]);
  const stream = readFileSync(streamFile);
  const dracoBytes = readFileSync(dracoFile);
  const contenders = {
    isostarPolygonized: () => decodeIsostar(isostar, stream, false),
    isostarWithNormals: () => decodeIsostar(isostar, stream, true),
    draco7: () => decodeDraco(draco, dracoBytes),
  };
  const best = Object.fromEntries(Object.keys(contenders).map((name) => [name, Infinity]));
  const start = performance.now();
  for (let round = 0; round < FEWEST_ROUNDS || performance.now() - start < milliseconds; round++) {
    for (const [name, contend] of Object.entries(contenders)) {
      const lap = performance.now();
      contend();
      best[name] = Math.min(best[name], performance.now() - lap);
    }
  }
  return best;
}

// Compiled and never run: the package in a user's strict TypeScript.
import {
  createDecoder,
  IsostarError,
  RangeSource,
  type Decoder,
  type IsostarErrorCode,
  type Limits,
  type Region,
  type Surface,
} from 'isostar';
import { IsostarLoader } from 'isostar/three';
import type { IsostarSurfaceElement } from 'isostar/element';
import type { BufferGeometry } from 'three';

const decoder: Decoder = await createDecoder({
  worker: false,
  workers: 2,
  wasm: new URL('https://example.org/decoder.wasm'),
  limits: { memory: 1e9, samples: Infinity, decisions: 1e9 },
});
const response = await fetch('skull.isostar');
try {
  for await (const surface of decoder.decode(response, {
    signal: AbortSignal.timeout(1000),
    polygonizer: 'tetrahedra',
    isovalue: 1,
    limits: { vertices: 1e6, memory: undefined } satisfies Limits,
  })) {
    const { positions, indices, info, error, final }: Surface = surface;
    console.log(
      positions.length + indices.length + info.size[2] + error,
      final,
      info.layers[0]?.kind === 'base',
    );
  }
} catch (reason) {
  if (reason instanceof IsostarError) console.log(reason.code satisfies IsostarErrorCode);
}
const region: Region = { min: [0, 0, 0], max: [9, 9, 9.5] };
const ranges = new RangeSource(new URL('https://example.org/skull.isostar'), {
  headers: { 'X-Token': 'blue' },
  credentials: 'include',
  fetch,
});
decoder.decode(ranges, { region, frame: 'grid' });
decoder.decode(new RangeSource(new Blob()), { region: undefined });
// @ts-expect-error: two numbers
decoder.decode(ranges, { region: { min: [0, 0], max: [9, 9] } });
// @ts-expect-error: not a polygonizer
decoder.decode(new Uint8Array(), { polygonizer: 'pyramids' });
// @ts-expect-error: not a number
decoder.decode(new Uint8Array(), { limits: { memory: '1 GB' } });
// Options that are undefined have their defaults, also under exactOptionalPropertyTypes.
decoder.decode(new Uint8Array(), {
  polygonizer: undefined,
  frame: undefined,
  normals: undefined,
  isovalue: undefined,
  refinements: undefined,
  limits: undefined,
  signal: undefined,
});
await createDecoder({ wasm: undefined, worker: undefined, workers: undefined, limits: undefined });
decoder.dispose();

const loader = new IsostarLoader()
  .setPath('samples/')
  .setSurfaceOptions({ frame: 'grid', limits: { memory: 1e8 } });
const geometry: BufferGeometry = await loader.loadAsync('skull.isostar', ({ surface, loaded }) =>
  console.log(surface.level, loaded),
);
console.log(geometry);

declare const element: IsostarSurfaceElement;
element.src = 'skull.isostar';

import type { StreamInfo } from '../api/surface.js';
import type { RawDecoder, RawModule } from './raw.js';

/** What wasm/exports.cpp exports. Each function but `create` takes the decoder's address first. */
type Exports = Record<keyof RawDecoder | 'create', (...values: number[]) => number> & {
  memory: WebAssembly.Memory;
  _initialize(): void;
};

const KINDS = ['base', 'refinement', 'domain', 'geometry'];

/** Does a module export plain functions, not those of Embind? */
export const isPlain = (compiled: WebAssembly.Module): boolean =>
  WebAssembly.Module.exports(compiled).some(({ name }) => name === 'create');

/** The interface of raw.ts, made of plain functions. */
export async function plainModule(compiled: WebAssembly.Module): Promise<RawModule> {
  const instance = await WebAssembly.instantiate(compiled, {
    env: { emscripten_notify_memory_growth() {} },
    wasi_snapshot_preview1: {
      proc_exit() {
        throw new WebAssembly.RuntimeError('no memory');
      },
    },
  });
  const exports = instance.exports as unknown as Exports;
  const { memory } = exports;
  exports._initialize();

  /** The numbers of a view: its address and its length. */
  const viewOf =
    <View>(Type: new (buffer: ArrayBuffer, begin: number, length: number) => View) =>
    (at: number) => {
      const [begin, length] = new Uint32Array(memory.buffer, at, 2);
      return new Type(memory.buffer, begin!, length!);
    };
  const textAt = (at: number) => {
    const bytes = new Uint8Array(memory.buffer);
    let text = '';
    for (; bytes[at]; at++) text += String.fromCharCode(bytes[at]!);
    return text;
  };
  const results: Partial<Record<string, (result: number) => unknown>> = {
    room: viewOf(Uint8Array),
    results: viewOf(Uint8Array),
    positions: viewOf(Float32Array),
    normals: viewOf(Float32Array),
    indices: viewOf(Uint32Array),
    runs: viewOf(Uint32Array),
    info: (at) => infoOf([...viewOf(Float64Array)(at)]),
    error: textAt,
    describeError: textAt,
    makeMesh: textAt,
    ...Object.fromEntries(
      ['advance', 'isFinal', 'lacks', 'needsOthers', 'takeResults'].map((name) => [name, Boolean]),
    ),
  };

  class Decoder {
    readonly at: number;
    constructor(...limits: number[]) {
      this.at = exports.create(...limits);
    }
  }
  for (const name of Object.keys(exports) as (keyof RawDecoder)[])
    if (typeof exports[name] === 'function')
      Object.defineProperty(Decoder.prototype, name, {
        value(this: Decoder, ...values: number[]) {
          const result = exports[name](this.at, ...values);
          const convert = results[name];
          return convert ? convert(result >>> 0) : result;
        },
      });
  return {
    get HEAPU8() {
      return new Uint8Array(memory.buffer);
    },
    Decoder: Decoder as unknown as RawModule['Decoder'],
    Polygonizer: { cubes: 0 },
    Frame: { world: 0, grid: 1 },
  };
}

/** The numbers that exports.cpp writes, in order: how many of each; 0: one that is no list. */
const FIELDS = {
  version: 0,
  dimension: 0,
  size: 3,
  origin: 3,
  spacing: 3,
  direction: 9,
  polygonizer: 0,
  lossless: 0,
  effort: 0,
  chunkSide: 0,
  maxError: 0,
  vertices: 0,
  headerBytes: 0,
  bytes: 0,
};
const LAYER_FIELDS = { kind: 0, level: 0, offset: 0, bytes: 0, error: 0, isovalue: 0 };

function infoOf(numbers: number[]): StreamInfo {
  const take = <Names extends Record<string, number>>(names: Names) =>
    Object.fromEntries(
      Object.entries(names).map(([name, count]) => [
        name,
        count > 0 ? numbers.splice(0, count) : numbers.shift(),
      ]),
    ) as Record<keyof Names, number>;
  const fields = take(FIELDS);
  const isovalues = numbers.splice(0, numbers.shift());
  const layers = [];
  while (numbers.length > 0) {
    const layer = take(LAYER_FIELDS);
    layers.push({
      ...layer,
      kind: KINDS.find((kind) => kind.charCodeAt(0) === layer.kind),
      isovalue: isovalues[layer.isovalue],
    });
  }
  return {
    ...fields,
    isovalues,
    polygonizer: fields.polygonizer === 0 ? 'cubes' : 'tetrahedra',
    lossless: fields.lossless !== 0,
    layers,
  } as unknown as StreamInfo;
}

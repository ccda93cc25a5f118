import { IsostarError, type IsostarErrorCode } from '../api/errors.js';
import type { Layer, StreamInfo, Surface, SurfaceOptions } from '../api/surface.js';
import type { Inbox, Input } from '../input/inbox.js';
import { pause } from './pause.js';
import type { RawDecoder, RawModule } from './raw.js';

const DEFAULTS = {
  polygonizer: 'cubes',
  frame: 'world',
  normals: true,
  refinements: 'newest',
} as const;

/** What a stream of another dimension than 3 holds. */
const CONTENTS: Record<number, string> = {
  2: 'the contours of an image',
  4: 'a sequence of volumes',
};

/** One stream in the raw decoder: turns input into surfaces. */
export class Session {
  readonly #module: RawModule;
  readonly #raw: RawDecoder;
  readonly #options: SurfaceOptions & Required<Omit<SurfaceOptions, 'isovalue'>>;
  #isovalue: number | undefined;
  #decodeTime = 0;

  constructor(module: RawModule, options: SurfaceOptions) {
    this.#options = { ...DEFAULTS, ...options };
    this.#isovalue = options.isovalue;
    check('polygonizer', this.#options.polygonizer, module.Polygonizer);
    check('frame', this.#options.frame, module.Frame);
    this.#module = module;
    this.#raw = new module.Decoder();
  }

  async *surfaces(inbox: Inbox): AsyncGenerator<Surface, void, undefined> {
    const { refinements } = this.#options;
    let isFirst = true;
    let isStale = false; // is a better surface possible than the last one?
    for (let input = await inbox.take(); input; input = await inbox.take()) {
      const isOtherIsovalue = this.#setIsovalue(input.isovalue);
      this.#accept(input);
      while (this.#advance()) {
        isStale = true;
        if (refinements === 'all' || (refinements === 'newest' && isFirst)) {
          yield this.#surface();
          isFirst = isStale = false;
        }
        await pause(); // an abort may be pending
        inbox.throwIfFailed();
      }
      const failure = this.#failure();
      const isLast = input.isEnd || failure !== undefined;
      const isDue = isLast
        ? isStale || (isFirst && this.#raw.isFinal())
        : isStale && refinements !== 'last';
      if (isOtherIsovalue || isDue) {
        yield this.#surface();
        isFirst = isStale = false;
      }
      if (failure) throw failure;
    }
  }

  delete(): void {
    this.#raw.delete();
  }

  #accept({ pieces, isEnd }: Input): void {
    for (const piece of pieces) {
      this.#raw.room(piece.length).set(piece);
      this.#raw.accept(piece.length);
    }
    if (isEnd) this.#raw.finish();
  }

  /** Returns whether that makes another surface. */
  #setIsovalue(isovalue: number | undefined): boolean {
    if (isovalue === undefined || isovalue === this.#isovalue) return false;
    this.#isovalue = isovalue;
    return this.#raw.level() >= 0;
  }

  #advance(): boolean {
    const start = performance.now();
    const isBetter = this.#raw.advance();
    this.#decodeTime += performance.now() - start;
    return isBetter;
  }

  #failure(): IsostarError | undefined {
    const code = this.#raw.error();
    if (code === 'None') return undefined;
    const { dimension } = this.#raw.info();
    const message =
      dimension === 3
        ? this.#raw.describeError()
        : `the stream holds ${CONTENTS[dimension]}; this decoder reads volumes only`;
    return new IsostarError(code as IsostarErrorCode, message);
  }

  #surface(): Surface {
    const raw = this.#raw;
    const { polygonizer, frame, normals } = this.#options;
    const info = raw.info();
    const isovalue = this.#isovalue ?? info.isovalues[0]!;
    checkIsovalue(info, isovalue);
    const start = performance.now();
    const code = raw.makeMesh(
      this.#module.Polygonizer[polygonizer],
      this.#module.Frame[frame],
      normals,
      isovalue,
    );
    if (code !== 'None')
      throw new IsostarError(code as IsostarErrorCode, 'no surface can be made from the stream');
    const polygonize = performance.now() - start;
    return {
      // Copies: a view becomes invalid when the module's memory grows.
      positions: raw.positions().slice() as Float32Array<ArrayBuffer>,
      normals: raw.normals().slice() as Float32Array<ArrayBuffer>,
      indices: raw.indices().slice() as Uint32Array<ArrayBuffer>,
      bytes: raw.bytes(),
      level: raw.level(),
      levels: raw.levels(),
      isovalue,
      error: errorAt(info, isovalue),
      final: raw.isFinal(),
      info,
      milliseconds: { decode: this.#decodeTime, polygonize },
    };
  }
}

function check(name: string, value: string, values: object): void {
  if (!Object.hasOwn(values, value))
    throw new IsostarError('BadArgument', `unknown ${name} "${value}"`);
}

function checkIsovalue({ isovalues }: StreamInfo, wanted: number): void {
  if (wanted >= Math.min(...isovalues) && wanted <= Math.max(...isovalues)) return;
  const held =
    isovalues.length > 1
      ? `isovalues ${isovalues.join(', ')} and the values between them`
      : `isovalue ${isovalues[0]}`;
  throw new IsostarError('BadArgument', `the stream holds ${held}, not ${wanted}`);
}

/** The error after the last layer of the nearest isovalue that has any layers. */
function errorAt({ layers }: StreamInfo, wanted: number): number {
  const distance = ({ isovalue }: Layer) => Math.abs(isovalue - wanted);
  const nearest = layers.reduce<Layer | undefined>(
    (best, layer) => (best && distance(best) < distance(layer) ? best : layer),
    undefined,
  );
  return nearest?.error ?? 0;
}

import { IsostarError, type IsostarErrorCode } from './errors.js';
import type { Arrival, Inbox } from './inbox.js';
import { pause } from './pause.js';
import type { RawDecoder, RawModule } from './raw.js';
import type { Layer, StreamInfo, Surface, SurfaceOptions } from './surface.js';

const DEFAULTS = { polygonizer: 'cubes', frame: 'world', normals: true, refinements: 'newest' } as const;

const KINDS: Record<number, string> = { 2: 'the contours of an image', 4: 'a sequence of volumes' };

/** One stream on its way through the raw decoder. */
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
    let isStale = false;  // the surface shown last: a better one could be made
    for (let arrival = await inbox.arrival(); arrival; arrival = await inbox.arrival()) {
      const isTurned = this.#turn(arrival.isovalue);
      this.#feed(arrival);
      while (this.#advance()) {
        isStale = true;
        if (refinements === 'all' || (refinements === 'newest' && isFirst)) {
          yield this.#surface();
          isFirst = isStale = false;
        }
        await pause();  // lets an abort in
        inbox.throwIfFailed();
      }
      const failure = this.#failure();
      const isLast = arrival.isEnd || failure !== undefined;
      if (isTurned || (isLast ? isStale || (isFirst && this.#raw.complete()) : isStale && refinements !== 'last')) {
        yield this.#surface();
        isFirst = isStale = false;
      }
      if (failure) throw failure;
    }
  }

  delete(): void {
    this.#raw.delete();
  }

  #feed({ pieces, isEnd }: Arrival): void {
    for (const piece of pieces) {
      this.#raw.room(piece.length).set(piece);
      this.#raw.accept(piece.length);
    }
    if (isEnd) this.#raw.finish();
  }

  /** Is there a surface to be shown at another isovalue? */
  #turn(isovalue: number | undefined): boolean {
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
    const message = dimension === 3 ? this.#raw.describeError() : `the stream holds ${KINDS[dimension]}; this decoder shows volumes`;
    return new IsostarError(code as IsostarErrorCode, message);
  }

  #surface(): Surface {
    const raw = this.#raw;
    const { polygonizer, frame, normals } = this.#options;
    const info = raw.info();
    const isovalue = this.#isovalue ?? info.isovalues[0]!;
    checkIsovalue(info, isovalue);
    const start = performance.now();
    const code = raw.makeMesh(this.#module.Polygonizer[polygonizer], this.#module.Frame[frame], normals, isovalue);
    if (code !== 'None') throw new IsostarError(code as IsostarErrorCode, 'no surface can be made of the stream');
    const polygonize = performance.now() - start;
    return {
      // Copies: a view dies when the module's memory grows.
      positions: raw.positions().slice() as Float32Array<ArrayBuffer>,
      normals: raw.normals().slice() as Float32Array<ArrayBuffer>,
      indices: raw.triangles().slice() as Uint32Array<ArrayBuffer>,
      bytes: raw.bytes(),
      level: raw.level(),
      levels: raw.levels(),
      isovalue,
      error: errorAt(info, isovalue),
      final: raw.complete(),
      info,
      milliseconds: { decode: this.#decodeTime, polygonize },
    };
  }
}

function check(name: string, value: string, values: object): void {
  if (!Object.hasOwn(values, value)) throw new IsostarError('BadArgument', `there is no ${name} "${value}"`);
}

function checkIsovalue({ isovalues }: StreamInfo, wanted: number): void {
  if (wanted >= Math.min(...isovalues) && wanted <= Math.max(...isovalues)) return;
  const held = isovalues.length > 1 ? `isovalues ${isovalues.join(', ')} and what lies between` : `isovalue ${isovalues[0]}`;
  throw new IsostarError('BadArgument', `the stream holds the ${held}, not ${wanted}`);
}

/** As the last layer states it of the nearest isovalue that has any. */
function errorAt({ layers }: StreamInfo, wanted: number): number {
  const away = ({ isovalue }: Layer) => Math.abs(isovalue - wanted);
  return layers.reduce<Layer | undefined>((best, layer) => (best && away(best) < away(layer) ? best : layer), undefined)?.error ?? 0;
}

import { IsostarError, type IsostarErrorCode } from './errors.js';
import type { Inbox } from './inbox.js';
import { pause } from './pause.js';
import type { RawDecoder, RawModule } from './raw.js';
import type { StreamInfo, Surface, SurfaceOptions } from './surface.js';

const DEFAULTS = { polygonizer: 'cubes', frame: 'world', normals: true, refinements: 'newest' } as const;

const KINDS: Record<number, string> = { 2: 'the contours of an image', 4: 'a sequence of volumes' };

/** One stream on its way through the raw decoder. */
export class Session {
  readonly #module: RawModule;
  readonly #raw: RawDecoder;
  readonly #options: SurfaceOptions & Required<Omit<SurfaceOptions, 'isovalue'>>;
  #decodeTime = 0;

  constructor(module: RawModule, options: SurfaceOptions) {
    this.#options = { ...DEFAULTS, ...options };
    check('polygonizer', this.#options.polygonizer, module.Polygonizer);
    check('frame', this.#options.frame, module.Frame);
    this.#module = module;
    this.#raw = new module.Decoder();
  }

  async *surfaces(inbox: Inbox): AsyncGenerator<Surface, void, undefined> {
    const { refinements } = this.#options;
    let isFirst = true;
    let isStale = false;  // the surface shown last: a better one could be made
    for (let more = true; more; ) {
      more = await inbox.arrival();
      this.#feed(more ? inbox.take() : undefined);
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
      const isLast = !more || failure !== undefined;
      if (isLast ? isStale || (isFirst && this.#raw.complete()) : isStale && refinements !== 'last') {
        yield this.#surface();
        isFirst = isStale = false;
      }
      if (failure) throw failure;
    }
  }

  delete(): void {
    this.#raw.delete();
  }

  #feed(pieces: Uint8Array[] | undefined): void {
    for (const piece of pieces ?? []) {
      this.#raw.room(piece.length).set(piece);
      this.#raw.accept(piece.length);
    }
    if (!pieces) this.#raw.finish();
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
    const { polygonizer, frame, normals, isovalue } = this.#options;
    const info = raw.info();
    checkIsovalue(info, isovalue);
    const start = performance.now();
    const code = raw.makeMesh(this.#module.Polygonizer[polygonizer], this.#module.Frame[frame], normals);
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
      error: raw.rmsError(),
      final: raw.complete(),
      info,
      milliseconds: { decode: this.#decodeTime, polygonize },
    };
  }
}

function check(name: string, value: string, values: object): void {
  if (!Object.hasOwn(values, value)) throw new IsostarError('BadArgument', `there is no ${name} "${value}"`);
}

function checkIsovalue({ isovalues }: StreamInfo, wanted: number | undefined): void {
  if (wanted !== undefined && !isovalues.includes(wanted))
    throw new IsostarError('BadArgument', `the stream holds the isovalue ${isovalues.join(', ')}, not ${wanted}`);
}

import { IsostarError, type IsostarErrorCode } from '../api/errors.js';
import type {
  Frame,
  Layer,
  Polygonizer,
  StreamInfo,
  Surface,
  SurfaceOptions,
} from '../api/surface.js';
import type { ByteRange } from '../input/byte-ranges.js';
import type { Inbox, Input } from '../input/inbox.js';
import { pause } from './pause.js';
import type { RawDecoder, RawModule } from './raw.js';

const POLYGONIZERS = ['cubes', 'tetrahedra'];
const FRAMES = ['world', 'grid'];
const REFINEMENTS = ['newest', 'all', 'last'];

/** How many bytes are copied into the module at once. */
const CHUNK = 1 << 20;

/** What a stream of another dimension than 3 holds. */
const CONTENTS: Record<number, string> = {
  2: 'the contours of an image',
  4: 'a sequence of volumes',
};

/** One stream in the raw decoder: turns input into surfaces. */
export class Session {
  readonly #module: RawModule;
  readonly #raw: RawDecoder;
  readonly #onLost: () => void;
  readonly #polygonizer: Polygonizer;
  readonly #frame: Frame;
  readonly #normals: boolean;
  readonly #refinements: 'newest' | 'all' | 'last';
  #isovalue: number | undefined;
  #isLost = false;
  #hasHeader = false;
  #decodeTime = 0;

  /** `onLost` is called if the module fails and cannot be called again. */
  constructor(
    module: RawModule,
    {
      polygonizer = 'cubes',
      frame = 'world',
      normals = true,
      refinements = 'newest',
      region,
      isovalue,
      limits = {},
    }: SurfaceOptions,
    onLost: () => void,
  ) {
    check('polygonizer', polygonizer, POLYGONIZERS);
    check('frame', frame, FRAMES);
    check('refinements', refinements, REFINEMENTS);
    this.#module = module;
    this.#onLost = onLost;
    this.#polygonizer = polygonizer;
    this.#frame = frame;
    this.#normals = normals;
    this.#refinements = refinements;
    this.#isovalue = isovalue;
    const { memory = NaN, samples = NaN, vertices = NaN, decisions = NaN } = limits;
    this.#raw = this.#run(() => new module.Decoder(memory, samples, vertices, decisions));
    if (region) this.#raw.setRegion(...region.min, ...region.max, module.Frame[frame]);
  }

  async *surfaces(inbox: Inbox): AsyncGenerator<Surface, void, undefined> {
    const refinements = this.#refinements;
    let isFirst = true;
    let isStale = false; // is a better surface possible than the last one?
    for (let input = await inbox.take(); input; input = await inbox.take()) {
      const isOtherIsovalue = this.#setIsovalue(input.isovalue);
      this.#run(() => this.#accept(input));
      while (this.#advance(inbox)) {
        isStale = true;
        if (refinements === 'all' || (refinements === 'newest' && isFirst)) {
          yield this.#run(() => this.#surface());
          isFirst = isStale = false;
        }
        await pause(); // an abort may be pending
        inbox.throwIfFailed();
      }
      const failure = this.#run(() => this.#failure());
      const isLast = input.isEnd || failure !== undefined || this.#raw.isFinal();
      const isDue = isLast
        ? isStale || (isFirst && this.#raw.isFinal())
        : isStale && refinements !== 'last';
      if (isOtherIsovalue || isDue) {
        yield this.#run(() => this.#surface());
        isFirst = isStale = false;
      }
      if (failure) throw failure;
    }
  }

  delete(): void {
    try {
      if (!this.#isLost) this.#run(() => this.#raw.delete());
    } catch {} // the module is lost, and its memory with it
  }

  /** Calls the module, which ends by a trap when it has no more memory. */
  #run<Result>(work: () => Result): Result {
    try {
      return work();
    } catch (reason) {
      // RangeError: the thread's stack is full, or there is no memory for a copy.
      if (!(reason instanceof WebAssembly.RuntimeError || reason instanceof RangeError))
        throw reason;
      this.#isLost = true;
      this.#onLost();
      throw new IsostarError('OverLimit', 'the surface needs more memory than is available');
    }
  }

  #accept({ pieces, isEnd }: Input): void {
    for (const { bytes, offset } of pieces.splice(0))
      for (let at = 0; at < bytes.length; at += CHUNK) {
        const chunk = bytes.subarray(at, at + CHUNK);
        this.#raw.room(chunk.length).set(chunk);
        this.#raw.accept(chunk.length, offset + at);
      }
    if (isEnd) this.#raw.finish();
  }

  /** Returns whether that makes another surface. */
  #setIsovalue(isovalue: number | undefined): boolean {
    if (isovalue === undefined || isovalue === this.#isovalue) return false;
    this.#isovalue = isovalue;
    return this.#raw.level() >= 0;
  }

  #advance(inbox: Inbox): boolean {
    return this.#run(() => {
      const start = performance.now();
      const isBetter = this.#raw.advance();
      this.#decodeTime += performance.now() - start;
      this.#want(inbox);
      return isBetter;
    });
  }

  /** States which bytes are needed. From the header on that does not change any more. */
  #want(inbox: Inbox): void {
    if (!this.#hasHeader) {
      this.#hasHeader = this.#raw.levels() > 0;
      inbox.want([...this.#wanted()]);
    }
    if (this.#wanted().next().done) inbox.close();
  }

  *#wanted(): Generator<ByteRange, void> {
    for (let at = 0; ;) {
      const [begin, end] = [this.#raw.wantedBegin(at), this.#raw.wantedEnd(at)];
      if (begin === end) return;
      yield { begin, end };
      at = end;
    }
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
    const info = raw.info();
    const isovalue = this.#isovalue ?? info.isovalues[0]!;
    checkIsovalue(info, isovalue);
    const start = performance.now();
    const code = raw.makeMesh(
      this.#module.Polygonizer[this.#polygonizer],
      this.#module.Frame[this.#frame],
      this.#normals,
      isovalue,
    );
    if (code !== 'None')
      throw new IsostarError(
        code as IsostarErrorCode,
        code === 'OverLimit'
          ? 'the surface is larger than the limits allow'
          : 'no surface can be made from the stream',
      );
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

function check(name: string, value: string, values: readonly string[]): void {
  if (!values.includes(value)) throw new IsostarError('BadArgument', `unknown ${name} "${value}"`);
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

import { IsostarError, type IsostarErrorCode } from '../api/errors.js';
import type { Frame, Polygonizer, StreamInfo, SurfaceOptions } from '../api/surface.js';
import type { ByteRange } from '../input/byte-ranges.js';
import type { Piece } from '../input/pieces.js';
import { copyOf, type Mesh, type MeshPart } from './mesh-part.js';
import type { RawDecoder, RawModule } from './raw.js';

const POLYGONIZERS = ['cubes', 'tetrahedra'];
const FRAMES = ['world', 'grid'];

/** How many bytes are copied into the module at once. */
const MOST_AT_ONCE = 1 << 20;

/** What a stream of another dimension than 3 holds. */
const CONTENTS: Record<number, string> = {
  2: 'the contours of an image',
  4: 'a sequence of volumes',
};

/** One of several decoders of a stream, number 0 … of - 1. */
export interface ShareNumber {
  readonly number: number;
  readonly of: number;
}

/**
 * One stream, or a share of it, in the raw decoder. All but delete() may throw an `IsostarError`
 * with code `OverLimit`, when the module has no more memory.
 */
export class StreamDecoder {
  readonly #module: RawModule;
  readonly #raw: RawDecoder;
  readonly #onLost: () => void;
  readonly #polygonizer: Polygonizer;
  readonly #frame: Frame;
  readonly #normals: boolean;
  #isLost = false;

  /** `onLost` is called if the module fails and cannot be called again. */
  constructor(
    module: RawModule,
    { polygonizer = 'cubes', frame = 'world', normals = true, region, limits = {} }: SurfaceOptions,
    onLost: () => void,
    share?: ShareNumber,
  ) {
    check('polygonizer', polygonizer, POLYGONIZERS);
    check('frame', frame, FRAMES);
    this.#module = module;
    this.#onLost = onLost;
    this.#polygonizer = polygonizer;
    this.#frame = frame;
    this.#normals = normals;
    const { memory = NaN, samples = NaN, vertices = NaN, decisions = NaN } = limits;
    this.#raw = this.#run(() => new module.Decoder(memory, samples, vertices, decisions));
    if (region) this.#raw.setRegion(...region.min, ...region.max, module.Frame[frame]);
    if (share) this.#raw.setShare(share.number, share.of);
  }

  accept({ bytes, offset }: Piece): void {
    this.#run(() => {
      for (let at = 0; at < bytes.length; at += MOST_AT_ONCE) {
        const length = this.#fill(bytes.subarray(at, at + MOST_AT_ONCE));
        this.#raw.accept(length, offset + at);
      }
    });
  }

  finish(): void {
    this.#raw.finish();
  }

  /** Decodes a layer, or a share of it. True if the surface is better for it. */
  advance(): boolean {
    return this.#run(() => this.#raw.advance());
  }

  /** Is the layer's own share decoded, and are the results of other shares needed? */
  get needsOthers(): boolean {
    return this.#raw.needsOthers();
  }

  /** What other shares need of this one; empty if nothing. */
  results(): Uint8Array<ArrayBuffer> {
    return this.#run(() => this.#raw.results().slice() as Uint8Array<ArrayBuffer>);
  }

  /** Takes the results of another share. False if they are none. */
  take(results: Uint8Array): boolean {
    return this.#run(() => this.#raw.takeResults(this.#fill(results)));
  }

  /** The bytes at `from` or after that are needed, in order. */
  *wanted(from = 0): Generator<ByteRange, void> {
    for (let at = from; ;) {
      const [begin, end] = [this.#raw.wantedBegin(at), this.#raw.wantedEnd(at)];
      if (begin === end) return;
      yield { begin, end };
      at = end;
    }
  }

  get info(): StreamInfo {
    return this.#raw.info();
  }
  /** 0 before the header has arrived. */
  get levels(): number {
    return this.#raw.levels();
  }
  /** -1 before the base is decoded. */
  get level(): number {
    return this.#raw.level();
  }
  get bytes(): number {
    return this.#raw.bytes();
  }
  /** Is another module needed for the stream? */
  get lacks(): boolean {
    return this.#raw.lacks();
  }
  get isFinal(): boolean {
    return this.#raw.isFinal();
  }

  /** Why advance() goes no further, if that is an error. */
  get failure(): IsostarError | undefined {
    const code = this.#raw.error();
    if (code === 'None') return undefined;
    const { dimension } = this.info;
    const message =
      dimension === 3
        ? this.#raw.describeError()
        : `the stream holds ${CONTENTS[dimension]}; this decoder reads volumes only`;
    return new IsostarError(code as IsostarErrorCode, message);
  }

  /** Makes the mesh, or the share of it, that part() then returns. */
  polygonize(isovalue: number): void {
    const code = this.#run(() =>
      this.#raw.makeMesh(
        this.#module.Polygonizer[this.#polygonizer]!,
        this.#module.Frame[this.#frame],
        this.#normals,
        isovalue,
      ),
    );
    if (code === 'None') return;
    throw new IsostarError(
      code as IsostarErrorCode,
      code === 'OverLimit'
        ? 'the surface is larger than the limits allow'
        : 'no surface can be made from the stream',
    );
  }

  /** Views that are valid until the module is called again. */
  part(): MeshPart {
    return {
      positions: this.#raw.positions(),
      normals: this.#raw.normals(),
      indices: this.#raw.indices(),
      runs: this.#raw.runs(),
    };
  }

  /** The mesh of a whole stream. */
  mesh(isovalue: number): Mesh {
    this.polygonize(isovalue);
    return this.#run(() => copyOf(this.part()));
  }

  delete(): void {
    try {
      if (!this.#isLost) this.#run(() => this.#raw.delete());
    } catch {} // the module is lost, and its memory with it
  }

  /** Returns how many bytes are now in the room. */
  #fill(bytes: Uint8Array): number {
    this.#raw.room(bytes.length).set(bytes);
    return bytes.length;
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
}

function check(name: string, value: string, values: readonly string[]): void {
  if (!values.includes(value)) throw new IsostarError('BadArgument', `unknown ${name} "${value}"`);
}

import { IsostarError } from '../api/errors.js';
import type { Layer, StreamInfo, SurfaceOptions } from '../api/surface.js';
import type { Inbox, Input } from '../input/inbox.js';
import type { Piece } from '../input/pieces.js';
import type { Lease } from './instances.js';
import type { Mesh } from './mesh-part.js';
import { pause } from './pause.js';
import { type ShareNumber, StreamDecoder } from './stream-decoder.js';
import type { WholeSurface } from './surface-chunks.js';
import { type BeginShares, Team, TeamFailure } from './team.js';

const REFINEMENTS = ['newest', 'all', 'last'];

/** One stream: turns input into surfaces. */
export class Session {
  #lease: Lease;
  readonly #leaseAll: () => Promise<Lease>;
  readonly #options: SurfaceOptions;
  #beginShares: BeginShares | undefined; // until it is known whether the stream is divided
  #own: StreamDecoder;
  #team: Team | undefined; // which #own belongs to
  readonly #accepted: Piece[] = []; // as long as they may be needed again
  #isFinished = false;
  #statedEnd = 0; // of the bytes that were stated to be needed
  #shown = 0; // the position of the last surface
  #isovalue: number | undefined;
  #decodeTime = 0;

  /** Ends the lease, and that of `leaseAll`, which is called if the stream needs it. */
  constructor(
    lease: Lease,
    leaseAll: () => Promise<Lease>,
    options: SurfaceOptions,
    beginShares?: BeginShares,
  ) {
    const { refinements = 'newest' } = options;
    if (!REFINEMENTS.includes(refinements))
      throw new IsostarError('BadArgument', `unknown refinements "${refinements}"`);
    this.#lease = lease;
    this.#leaseAll = leaseAll;
    this.#options = options;
    this.#beginShares = beginShares;
    this.#isovalue = options.isovalue;
    this.#own = this.#decoderOf();
  }

  async *surfaces(inbox: Inbox): AsyncGenerator<WholeSurface, void, undefined> {
    const { refinements = 'newest' } = this.#options;
    let isFirst = true;
    let isStale = false; // is a better surface possible than the last one?
    for (let input = await inbox.take(); input; input = await inbox.take()) {
      const isOtherIsovalue = this.#setIsovalue(input.isovalue);
      this.#accept(input);
      while (await this.#advance(inbox)) {
        isStale = true;
        if (refinements === 'all' || (refinements === 'newest' && isFirst)) {
          yield* this.#surface(inbox);
          isFirst = isStale = false;
        }
        await pause(); // an abort may be pending
        inbox.throwIfFailed();
      }
      const { failure, isFinal } = this.#own;
      const isLast = input.isEnd || failure !== undefined || isFinal;
      const isDue = isLast ? isStale || (isFirst && isFinal) : isStale && refinements !== 'last';
      if (isOtherIsovalue || isDue) {
        yield* this.#surface(inbox);
        isFirst = isStale = false;
      }
      if (failure) throw failure;
    }
  }

  delete(): void {
    this.#team?.end();
    this.#own.delete();
    this.#lease.end();
  }

  #decoderOf(share?: ShareNumber): StreamDecoder {
    return new StreamDecoder(this.#lease.module, this.#options, this.#lease.drop, share);
  }

  #accept({ pieces, isEnd }: Input): void {
    const decoder = this.#team ?? this.#own;
    const mayBeNeeded = this.#team || this.#beginShares || this.#own.levels === 0;
    for (const piece of pieces.splice(0)) {
      decoder.accept(piece);
      if (mayBeNeeded) this.#accepted.push(piece);
    }
    if (isEnd) decoder.finish();
    this.#isFinished ||= isEnd;
  }

  #acceptAgain(): void {
    const decoder = this.#team ?? this.#own;
    for (const piece of this.#accepted) decoder.accept(piece);
    if (this.#isFinished) decoder.finish();
  }

  /** Returns whether that makes another surface. */
  #setIsovalue(isovalue: number | undefined): boolean {
    if (isovalue === undefined || isovalue === this.#isovalue) return false;
    this.#isovalue = isovalue;
    return this.#own.level >= 0;
  }

  async #advance(inbox: Inbox): Promise<boolean> {
    let isBetter = await this.#decodeLayer(inbox);
    if (this.#own.lacks) {
      await this.#changeModule();
      inbox.throwIfFailed();
      isBetter = await this.#decodeLayer(inbox);
    }
    this.#want(inbox);
    return isBetter;
  }

  /** Goes on with the module for every stream. So far no layer is decoded. */
  async #changeModule(): Promise<void> {
    const lease = await this.#leaseAll();
    this.delete();
    this.#lease = lease;
    this.#own = this.#decoderOf();
    this.#acceptAgain();
  }

  async #decodeLayer(inbox: Inbox): Promise<boolean> {
    const start = performance.now();
    try {
      return await this.#decodeInTeam(inbox);
    } finally {
      this.#decodeTime += performance.now() - start;
    }
  }

  async #decodeInTeam(inbox: Inbox): Promise<boolean> {
    const { levels, lacks } = this.#own;
    if (levels > 0 && !lacks && !this.#beginShares && !this.#team) this.#accepted.splice(0);
    try {
      if (levels > 0 && !lacks && this.#beginShares) await this.#divide(this.#beginShares);
      return await (this.#team ?? this.#own).advance();
    } catch (reason) {
      if (!(reason instanceof TeamFailure)) throw reason;
      return this.#decodeAlone(inbox);
    }
  }

  /** Divides a stream in chunks among other threads, and repeats what is decoded already. */
  async #divide(beginShares: BeginShares): Promise<void> {
    this.#beginShares = undefined;
    const most = chunksOf(this.#own.info) - 1;
    const others = most > 0 ? await beginShares(most, this.#options, this.#lease) : [];
    if (others.length === 0) return void this.#accepted.splice(0);
    const { bytes } = this.#own;
    this.#own.delete();
    this.#own = this.#decoderOf({ number: 0, of: others.length + 1 });
    this.#team = new Team(this.#own, others);
    this.#acceptAgain();
    while (this.#own.bytes < bytes && (await this.#team.advance()));
  }

  /**
   * Decodes the stream anew without other threads, up to a better surface than the last one. So the
   * errors of a stream, and the sound surfaces before them, do not depend on who decodes it.
   */
  async #decodeAlone(inbox: Inbox): Promise<boolean> {
    this.#team?.end();
    this.#team = undefined;
    this.#own.delete();
    this.#own = this.#decoderOf();
    this.#acceptAgain();
    this.#accepted.splice(0);
    while (this.#own.advance()) {
      if (this.#own.bytes > this.#shown) return true;
      await pause();
      inbox.throwIfFailed();
    }
    return false;
  }

  /** States which bytes are needed, whenever it turns out that these are more. */
  #want(inbox: Inbox): void {
    if (!this.#own.wanted(this.#statedEnd).next().done) {
      const ranges = [...this.#own.wanted()];
      this.#statedEnd = ranges.at(-1)!.end;
      inbox.want(ranges);
    }
    if (this.#own.wanted().next().done) inbox.close();
  }

  /** The surface; none if it turns out that there is no better one than the last. */
  async *#surface(inbox: Inbox): AsyncGenerator<WholeSurface, void> {
    const isovalue = this.#isovalue ?? this.#own.info.isovalues[0]!;
    checkIsovalue(this.#own.info, isovalue);
    const start = performance.now();
    const mesh = await this.#mesh(isovalue, inbox);
    if (!mesh) return;
    const polygonize = performance.now() - start;
    const { info, bytes, level, levels, isFinal } = this.#own;
    this.#shown = bytes;
    yield {
      positions: mesh.positions,
      normals: mesh.normals,
      indices: mesh.indices,
      bytes,
      level,
      levels,
      isovalue,
      error: errorAt(info, isovalue),
      final: isFinal,
      info,
      milliseconds: { decode: this.#decodeTime, polygonize },
    };
  }

  async #mesh(isovalue: number, inbox: Inbox): Promise<Mesh | undefined> {
    try {
      return await (this.#team ?? this.#own).mesh(isovalue);
    } catch (reason) {
      if (!(reason instanceof TeamFailure)) throw reason;
    }
    return (await this.#decodeAlone(inbox)) ? this.#own.mesh(isovalue) : undefined;
  }
}

/** How many chunks the last level has. */
function chunksOf({ size, chunkSide }: StreamInfo): number {
  if (chunkSide === 0) return 1;
  return size.reduce(
    (count, samples) => count * Math.max(1, Math.ceil((samples - 1) / chunkSide)),
    1,
  );
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

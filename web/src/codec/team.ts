import type { SurfaceOptions } from '../api/surface.js';
import type { Piece } from '../input/pieces.js';
import type { Lease } from './instances.js';
import { joinMesh, type Mesh, type MeshPart } from './mesh-part.js';
import type { StreamDecoder } from './stream-decoder.js';

/**
 * Begins other shares of a stream, numbers 1 and on, at most `most`; none if there are no threads
 * for them. `lease`: of the module that decodes the first share.
 */
export type BeginShares = (
  most: number,
  options: SurfaceOptions,
  lease: Lease,
) => Promise<OtherShare[]>;

/** A share of a stream that is decoded elsewhere. It answers in the order of the calls. */
export interface OtherShare {
  accept(piece: Piece): void;
  finish(): void;
  /** Takes the results of others and goes on. Resolves to its own, where others need them. */
  advance(results: readonly Uint8Array[]): Promise<Uint8Array | undefined>;
  results(): Promise<Uint8Array | undefined>;
  mesh(results: readonly Uint8Array[], isovalue: number): Promise<MeshPart>;
  /** Frees the share; what is pending is left pending or fails. */
  end(): void;
}

/** Why shares cannot make the surface together. One decoder alone may, or says what is wrong. */
export class TeamFailure extends Error {}

/** Decodes the first share of a stream here and the others elsewhere, at the same time. */
export class Team {
  readonly #own: StreamDecoder;
  readonly #others: readonly OtherShare[];
  #hasFailed = false; // has another share?

  constructor(own: StreamDecoder, others: readonly OtherShare[]) {
    this.#own = own;
    this.#others = others;
  }

  accept(piece: Piece): void {
    for (const other of this.#others) other.accept(piece);
    this.#own.accept(piece);
  }

  finish(): void {
    for (const other of this.#others) other.finish();
    this.#own.finish();
  }

  /** Decodes a layer. Does not wait for others whose share of it is not needed yet. */
  async advance(): Promise<boolean> {
    const theirs = this.#fromAll((other) => other.advance([]));
    let isBetter = this.#own.advance();
    if (this.#own.needsOthers) {
      const results = [this.#own.results(), ...(await theirs)];
      void this.#fromAll((other, i) => other.advance(without(i + 1, results)));
      this.#takeAll(without(0, results));
      isBetter = this.#own.advance();
    }
    if (this.#hasFailed || this.#own.failure) throw new TeamFailure();
    return isBetter;
  }

  async mesh(isovalue: number): Promise<Mesh> {
    const own = this.#own.results();
    if (own.length === 0) return this.#own.mesh(isovalue); // each share has the whole
    const results = [own, ...(await this.#fromAll((other) => other.results()))];
    const theirs = this.#fromAll((other, i) => other.mesh(without(i + 1, results), isovalue));
    this.#takeAll(without(0, results));
    this.#own.polygonize(isovalue);
    const parts = await theirs;
    return joinMesh([this.#own.part(), ...parts]);
  }

  end(): void {
    for (const other of this.#others) other.end();
  }

  #takeAll(results: readonly Uint8Array[]): void {
    if (!results.every((one) => this.#own.take(one))) throw new TeamFailure();
  }

  #fromAll<Answer>(call: (other: OtherShare, i: number) => Promise<Answer>): Promise<Answer[]> {
    const answers = Promise.all(this.#others.map(call)).catch(() => {
      this.#hasFailed = true;
      throw new TeamFailure();
    });
    answers.catch(() => {}); // it need not be waited for
    return answers;
  }
}

/** The results of all shares but one. One that has none is not where the others are. */
function without(share: number, results: readonly (Uint8Array | undefined)[]): Uint8Array[] {
  return results.flatMap((one, i) => {
    if (!one) throw new TeamFailure();
    return i === share ? [] : [one];
  });
}

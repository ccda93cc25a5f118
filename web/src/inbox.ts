import { IsostarError } from './errors.js';
import { piecesOf } from './source.js';
import type { Source } from './surface.js';

/** What there is to do: pieces, the end of all pieces, another isovalue. */
export interface Arrival {
  readonly pieces: Uint8Array[];
  readonly isEnd: boolean;
  readonly isovalue: number | undefined;
}

/** Bytes that have arrived and not been taken yet: a late taker finds all of them at once, and the newest isovalue. */
export class Inbox {
  #pieces: Uint8Array[] = [];
  #ended = false;
  #endTaken = false;
  #isovalue: number | undefined;
  #isSettled = true;
  #failure: { readonly reason: unknown } | undefined;
  #wake = () => {};

  push(piece: Uint8Array): void {
    this.#pieces.push(piece);
    this.#wake();
  }

  end(): void {
    this.#ended = true;
    this.#wake();
  }

  /** From now on another isovalue may come, until settle(). */
  turn(isovalue?: number): void {
    this.#isSettled = false;
    this.#isovalue = isovalue ?? this.#isovalue;
    this.#wake();
  }

  settle(): void {
    this.#isSettled = true;
    this.#wake();
  }

  /** Whoever waits, and whoever asks from now on, gets `reason` thrown. */
  fail(reason: unknown): void {
    this.#failure ??= { reason };
    this.#wake();
  }

  throwIfFailed(): void {
    if (this.#failure) throw this.#failure.reason;
  }

  /** Waits for something to do; nothing when nothing more will come. */
  async arrival(): Promise<Arrival | undefined> {
    while (!this.#failure && !this.#isDue) {
      if (this.#endTaken && this.#isSettled) return undefined;
      await new Promise<void>((resolve) => (this.#wake = resolve));
    }
    this.throwIfFailed();
    const pieces = this.#pieces.splice(0);
    const isEnd = this.#ended && pieces.length === 0 && !this.#endTaken;
    this.#endTaken ||= isEnd;
    const isovalue = this.#isovalue;
    this.#isovalue = undefined;
    return { pieces, isEnd, isovalue };
  }

  get #isDue(): boolean {
    return this.#pieces.length > 0 || (this.#ended && !this.#endTaken) || this.#isovalue !== undefined;
  }
}

/** Carries isovalues into the inbox as they come; the result gives their source up. */
export function turnWith(inbox: Pick<Inbox, 'turn' | 'settle' | 'fail'>, isovalues: AsyncIterable<number>): () => void {
  const numbers = isovalues[Symbol.asyncIterator]();
  inbox.turn();
  void (async () => {
    try {
      for (let next = await numbers.next(); !next.done; next = await numbers.next()) inbox.turn(next.value);
      inbox.settle();
    } catch (reason) {
      inbox.fail(reason);
    }
  })();
  return () => void numbers.return?.()?.catch(() => {});
}

/** Carries a source's pieces into the inbox as they come; the result gives the source up. */
export function readInto(inbox: Pick<Inbox, 'push' | 'end' | 'fail'>, source: Source): () => void {
  const pieces = piecesOf(source);
  void (async () => {
    try {
      for (let next = await pieces.next(); !next.done; next = await pieces.next()) {
        if (!(next.value instanceof Uint8Array)) throw new IsostarError('BadArgument', 'the source gave something other than a Uint8Array');
        inbox.push(next.value);
      }
      inbox.end();
    } catch (reason) {
      inbox.fail(reason);
    }
  })();
  return () => void pieces.return?.()?.catch(() => {});
}

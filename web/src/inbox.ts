import { IsostarError } from './errors.js';
import { piecesOf } from './source.js';
import type { Source } from './surface.js';

/** Bytes that have arrived and not been taken yet: a late taker finds all of them at once. */
export class Inbox {
  #pieces: Uint8Array[] = [];
  #ended = false;
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

  /** Whoever waits, and whoever asks from now on, gets `reason` thrown. */
  fail(reason: unknown): void {
    this.#failure ??= { reason };
    this.#wake();
  }

  throwIfFailed(): void {
    if (this.#failure) throw this.#failure.reason;
  }

  /** True when there is something to take, false when nothing more will come. */
  async arrival(): Promise<boolean> {
    while (!this.#failure && !this.#ended && this.#pieces.length === 0)
      await new Promise<void>((resolve) => (this.#wake = resolve));
    this.throwIfFailed();
    return this.#pieces.length > 0;
  }

  take(): Uint8Array[] {
    return this.#pieces.splice(0);
  }
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

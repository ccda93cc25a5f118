import { IsostarError } from '../api/errors.js';
import type { Source } from '../api/surface.js';
import { piecesOf } from './source.js';

/** What a decoder takes from its inbox in one go. */
export interface Input {
  readonly pieces: Uint8Array[];
  /** All pieces have been taken before. */
  readonly isEnd: boolean;
  /** The isovalue to show from now on. */
  readonly isovalue: number | undefined;
}

/**
 * Bytes and isovalues that have arrived and have not been taken yet. A late take() returns all
 * bytes at once, and only the newest isovalue.
 */
export class Inbox {
  #pieces: Uint8Array[] = [];
  #isFinished = false;
  #isEndTaken = false;
  #isovalue: number | undefined;
  #mayChangeIsovalue = false;
  #failure: { readonly reason: unknown } | undefined;
  #wake = () => {};

  accept(piece: Uint8Array): void {
    this.#pieces.push(piece);
    this.#wake();
  }

  /** No more bytes will come. */
  finish(): void {
    this.#isFinished = true;
    this.#wake();
  }

  /** From now on isovalues may come, until endIsovalues(). */
  beginIsovalues(): void {
    this.#mayChangeIsovalue = true;
  }

  setIsovalue(isovalue: number): void {
    this.#isovalue = isovalue;
    this.#wake();
  }

  endIsovalues(): void {
    this.#mayChangeIsovalue = false;
    this.#wake();
  }

  /** A pending take() and all later ones throw `reason`; the first reason counts. */
  fail(reason: unknown): void {
    this.#failure ??= { reason };
    this.#wake();
  }

  throwIfFailed(): void {
    if (this.#failure) throw this.#failure.reason;
  }

  /** Waits for input; undefined when no more will come. */
  async take(): Promise<Input | undefined> {
    while (!this.#failure && !this.#hasInput) {
      if (this.#isEndTaken && !this.#mayChangeIsovalue) return undefined;
      await new Promise<void>((resolve) => (this.#wake = resolve));
    }
    this.throwIfFailed();
    const pieces = this.#pieces.splice(0);
    const isEnd = this.#isFinished && pieces.length === 0 && !this.#isEndTaken;
    this.#isEndTaken ||= isEnd;
    const isovalue = this.#isovalue;
    this.#isovalue = undefined;
    return { pieces, isEnd, isovalue };
  }

  get #hasInput(): boolean {
    const isEndDue = this.#isFinished && !this.#isEndTaken;
    return this.#pieces.length > 0 || isEndDue || this.#isovalue !== undefined;
  }
}

type ByteSink = Pick<Inbox, 'accept' | 'finish' | 'fail'>;
type IsovalueSink = Pick<Inbox, 'beginIsovalues' | 'setIsovalue' | 'endIsovalues' | 'fail'>;

/** Sends a source's pieces on as they arrive. The result cancels the source. */
export function sendSource(source: Source, sink: ByteSink): () => void {
  const pieces = piecesOf(source);
  void (async () => {
    try {
      for (let next = await pieces.next(); !next.done; next = await pieces.next()) {
        if (!(next.value instanceof Uint8Array))
          throw new IsostarError('BadArgument', 'a piece of the source is not a Uint8Array');
        sink.accept(next.value);
      }
      sink.finish();
    } catch (reason) {
      sink.fail(reason);
    }
  })();
  return () => void pieces.return?.()?.catch(() => {});
}

/** Sends isovalues on as they arrive. The result cancels their source. */
export function sendIsovalues(isovalues: AsyncIterable<number>, sink: IsovalueSink): () => void {
  const numbers = isovalues[Symbol.asyncIterator]();
  sink.beginIsovalues();
  void (async () => {
    try {
      for (let next = await numbers.next(); !next.done; next = await numbers.next())
        sink.setIsovalue(next.value);
      sink.endIsovalues();
    } catch (reason) {
      sink.fail(reason);
    }
  })();
  return () => void numbers.return?.()?.catch(() => {});
}

import type { ByteRange } from './byte-ranges.js';
import type { Piece } from './pieces.js';

/** What a decoder takes from its inbox in one go. */
export interface Input {
  readonly pieces: Piece[];
  /** All pieces have been taken before. */
  readonly isEnd: boolean;
  /** The isovalue to show from now on. */
  readonly isovalue: number | undefined;
}

/** What an inbox reports to the feed that fills it. */
export interface InboxEvents {
  /** Pieces of this weight were taken. */
  taken(weight: number): void;
  /** These bytes are still needed. */
  wanted(ranges: readonly ByteRange[]): void;
  /** No more bytes are needed. */
  enough(): void;
}

/** What a piece costs while it waits, in bytes. Many small pieces cost more than their bytes. */
export const weightOf = ({ bytes }: Piece): number => bytes.byteLength + 256;

/**
 * Bytes and isovalues that have arrived and have not been taken yet. A late take() returns all
 * bytes at once, and only the newest isovalue.
 */
export class Inbox {
  readonly #events: InboxEvents;
  #isClosed = false;
  #pieces: Piece[] = [];
  #isFinished = false;
  #isEndTaken = false;
  #isovalue: number | undefined;
  #mayChangeIsovalue = false;
  #failure: { readonly reason: unknown } | undefined;
  #wake = () => {};

  constructor(events: InboxEvents) {
    this.#events = events;
  }

  accept(piece: Piece): void {
    if (this.#isClosed) return;
    this.#pieces.push(piece);
    this.#wake();
  }

  /** No more bytes will come. */
  finish(): void {
    this.#isFinished = true;
    this.#wake();
  }

  /** States which bytes are still needed, instead of those stated before. */
  want(ranges: readonly ByteRange[]): void {
    if (!this.#isClosed) this.#events.wanted(ranges);
  }

  /** Bytes that were not taken yet are dropped, and later ones ignored. */
  close(): void {
    if (this.#isClosed) return;
    this.#isClosed = this.#isFinished = this.#isEndTaken = true;
    this.#pieces = [];
    this.#events.enough();
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
    if (pieces.length > 0)
      this.#events.taken(pieces.reduce((sum, piece) => sum + weightOf(piece), 0));
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

type IsovalueSink = Pick<Inbox, 'beginIsovalues' | 'setIsovalue' | 'endIsovalues' | 'fail'>;

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
  return () => void (async () => numbers.return?.())().catch(() => {});
}

import { pause } from '../codec/pause.js';
import type { ByteRange } from './byte-ranges.js';
import { type Inbox, weightOf } from './inbox.js';
import type { Pieces } from './pieces.js';

/** What may wait in an inbox before its source is read on, in bytes. */
const MOST_WAITING = 1 << 24;
/** For how long a source that never waits may keep the thread, in milliseconds. */
const TURN = 10;

type ByteSink = Pick<Inbox, 'accept' | 'finish' | 'fail'>;

/** Sends a source's pieces to an inbox, here or in a worker, as they arrive. */
export class Feed {
  readonly #pieces: Pieces;
  #waiting = 0;
  #isStopped = false;
  #resume = () => {};

  constructor(pieces: Pieces, sink: ByteSink) {
    this.#pieces = pieces;
    void this.#run(sink);
  }

  /** Pieces of this weight have left the inbox. */
  taken(weight: number): void {
    this.#waiting -= weight;
    this.#resume();
  }

  /** The bytes to be read from now on, where the source can leave others out. */
  want(ranges: readonly ByteRange[]): void {
    if (!this.#isStopped) this.#pieces.want?.(ranges);
  }

  /** No more bytes are needed. Cancels the source, whose errors no longer matter. */
  stop(): void {
    if (this.#isStopped) return;
    this.#isStopped = true;
    this.#resume();
    void this.#pieces.return?.().catch(() => {});
  }

  async #run(sink: ByteSink): Promise<void> {
    try {
      let due = performance.now() + TURN;
      for (;;) {
        const next = await this.#pieces.next();
        if (this.#isStopped) return;
        if (next.done) return sink.finish();
        this.#waiting += weightOf(next.value);
        sink.accept(next.value);
        while (this.#waiting > MOST_WAITING && !this.#isStopped)
          await new Promise<void>((resolve) => (this.#resume = resolve));
        if (performance.now() < due) continue;
        await pause();
        due = performance.now() + TURN;
      }
    } catch (reason) {
      if (!this.#isStopped) sink.fail(reason);
    }
  }
}

import { createDecoder, IsostarError, type DecodeOptions, type Decoder, type Polygonizer, type Source, type Surface } from 'isostar';
import type { Download } from './download.ts';
import { idle } from './idle.ts';
import { Newest } from './newest.ts';

const DEBOUNCE = 60;  // milliseconds

export interface TrackEvents {
  /** `isLive`: of the bytes as they arrive; otherwise of the prefix that was asked for. */
  surface(surface: Surface, isLive: boolean): void;
  failure(reason: unknown): void;
}

/** What is shown of one stream: its bytes as they arrive, or a prefix of those that are here. */
export class Track {
  readonly #decoder: Promise<Decoder> = createDecoder();
  readonly #events: TrackEvents;
  #polygonizer: Polygonizer = 'cubes';
  #download: Download | undefined;
  #prefix: number | undefined;
  #isovalue: number | undefined;
  #turns = new Newest<number>();
  #run = new AbortController();
  #pending: { surface: Surface; isLive: boolean } | undefined;

  constructor(events: TrackEvents) {
    this.#events = events;
  }

  /** Resolves when the decoder is loaded. */
  async ready(): Promise<void> {
    await this.#decoder;
  }

  play(download: Download): void {
    this.#download = download;
    this.#prefix = undefined;
    this.#isovalue = undefined;
    void this.#restart();
  }

  /** Shows another isovalue: of the stream as it is decoded already, of a prefix from its beginning. */
  turn(isovalue: number): void {
    this.#isovalue = isovalue;
    if (this.#prefix === undefined) this.#turns.put(isovalue);
    else void this.#restart(DEBOUNCE);
  }

  setPolygonizer(polygonizer: Polygonizer): void {
    this.#polygonizer = polygonizer;
    void this.#restart();
  }

  /** Shows the first bytes only. */
  scrub(bytes: number): void {
    this.#prefix = bytes;
    void this.#restart(DEBOUNCE);
  }

  async #restart(delay = 0): Promise<void> {
    this.#run.abort();
    this.#run = new AbortController();
    this.#pending = undefined;
    const { signal } = this.#run;
    if (delay) await new Promise((resolve) => setTimeout(resolve, delay));
    const download = this.#download;
    if (!download || signal.aborted) return;
    const options = { signal, polygonizer: this.#polygonizer };
    if (this.#prefix !== undefined) {
      const isovalue = this.#isovalue === undefined ? {} : { isovalue: this.#isovalue };
      await this.#show(download.prefix(this.#prefix), { ...options, ...isovalue, refinements: 'last' }, false);
      return;
    }
    this.#turns = new Newest();
    if (this.#isovalue !== undefined) this.#turns.put(this.#isovalue);
    await this.#show(download.pieces(), { ...options, isovalue: this.#turns }, true);
  }

  async #show(source: Source, options: DecodeOptions & { signal: AbortSignal }, isLive: boolean): Promise<void> {
    try {
      for await (const surface of (await this.#decoder).decode(source, options)) this.#present(surface, isLive);
    } catch (reason) {
      const isPrefixEnd = !isLive && reason instanceof IsostarError && reason.code === 'Truncated';
      if (!options.signal.aborted && !isPrefixEnd) this.#events.failure(reason);
    }
  }

  /** Hands the surface on when the page is idle: of several by then only the newest. */
  #present(surface: Surface, isLive: boolean): void {
    const isWaiting = this.#pending !== undefined;
    this.#pending = { surface, isLive };
    if (!isWaiting) void idle().then(() => this.#presentPending());
  }

  #presentPending(): void {
    const pending = this.#pending;
    this.#pending = undefined;
    if (pending) this.#events.surface(pending.surface, pending.isLive);
  }
}

import {
  createDecoder,
  IsostarError,
  type DecodeOptions,
  type Decoder,
  type Polygonizer,
  type Source,
  type Surface,
} from 'isostar';
import type { Download } from './download.ts';
import { idle } from '../idle.ts';
import { Newest } from './newest.ts';

const DEBOUNCE = 60; // milliseconds

export interface TrackEvents {
  /** `isLive`: of the bytes as they arrive; otherwise of the prefix that scrub() chose. */
  surface(surface: Surface, isLive: boolean): void;
  failure(reason: unknown): void;
}

/** Decodes one stream: its bytes as they arrive, or a prefix of those received. */
export class Track {
  readonly #decoder: Promise<Decoder> = createDecoder();
  readonly #events: TrackEvents;
  #polygonizer: Polygonizer = 'cubes';
  #download: Download | undefined;
  #prefix: number | undefined;
  #isovalue: number | undefined;
  #isovalues = new Newest<number>();
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

  /** Shows another isovalue. A prefix is decoded again; the whole stream is not. */
  setIsovalue(isovalue: number): void {
    this.#isovalue = isovalue;
    if (this.#prefix === undefined) this.#isovalues.put(isovalue);
    else void this.#restart(DEBOUNCE);
  }

  setPolygonizer(polygonizer: Polygonizer): void {
    this.#polygonizer = polygonizer;
    void this.#restart();
  }

  /** Shows a prefix only. */
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
      await this.#show(
        download.prefix(this.#prefix),
        { ...options, ...isovalue, refinements: 'last' },
        false,
      );
      return;
    }
    this.#isovalues = new Newest();
    if (this.#isovalue !== undefined) this.#isovalues.put(this.#isovalue);
    await this.#show(download.pieces(), { ...options, isovalue: this.#isovalues }, true);
  }

  async #show(
    source: Source,
    options: DecodeOptions & { signal: AbortSignal },
    isLive: boolean,
  ): Promise<void> {
    try {
      for await (const surface of (await this.#decoder).decode(source, options))
        this.#present(surface, isLive);
    } catch (reason) {
      const isPrefixEnd = !isLive && reason instanceof IsostarError && reason.code === 'Truncated';
      if (!options.signal.aborted && !isPrefixEnd) this.#events.failure(reason);
    }
  }

  /** Passes the surface on when the page is idle; of several surfaces only the newest. */
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

import type { Download } from '../stream/download.ts';
import { bytes, duration } from './format.ts';
import type { Figures, Statistics } from './statistics.ts';

/** One of the two codecs: its transfer, its figures, its caption in the view. */
export class Side {
  readonly name: 'isostar' | 'draco';
  readonly #statistics: Statistics;
  readonly #caption: HTMLElement;
  #figures: Figures = {};
  #download: Download | undefined;
  #begin = 0;

  constructor(name: 'isostar' | 'draco', statistics: Statistics) {
    this.name = name;
    this.#statistics = statistics;
    this.#caption = document.querySelector(`[data-pane=${name}]`)!;
  }

  get figures(): Readonly<Figures> {
    return this.#figures;
  }

  get download(): Download | undefined {
    return this.#download;
  }

  /** A new run begins. */
  begin(begin: number, download: Download | undefined): void {
    this.#download?.cancel();
    this.#download = download;
    this.#begin = begin;
    this.#figures = {};
    this.#statistics.show(this.name, this.#figures);
    this.update();
  }

  /** Adds figures to those known so far. */
  addFigures(figures: Figures): void {
    Object.assign(this.#figures, figures);
    this.#statistics.show(this.name, this.#figures);
    this.update();
  }

  /** Milliseconds since the run began. */
  elapsed(): number {
    return performance.now() - this.#begin;
  }

  /** Updates the caption. */
  update(): void {
    const received = this.#download?.length ?? 0;
    const total = this.#download?.total;
    this.#caption.querySelector('progress')!.value = total ? Math.min(1, received / total) : 0;
    this.#caption.querySelector('[data-role=state]')!.textContent = this.#state(received, total);
  }

  #state(received: number, total: number | undefined): string {
    if (!this.#download) return '';
    if (this.#figures.complete !== undefined)
      return `complete after ${duration(this.#figures.complete)}`;
    if (this.#download.isOver) return 'decoding';
    const amount = total ? `${bytes(received)} of ${bytes(total)}` : bytes(received);
    return `${(this.elapsed() / 1000).toFixed(1)} s, ${amount}`;
  }
}

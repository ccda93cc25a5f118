import type { Layer, Surface } from 'isostar';
import { bytes } from './format.ts';

const STEPS = 1000;

/** The slider over a stream's bytes: how many were received and are shown, where layers end. */
export class Timeline {
  readonly #root: HTMLElement;
  readonly #input: HTMLInputElement;
  #total = 0;
  #received = 0;
  #shown = 0;
  #layers: readonly Layer[] = [];

  constructor(root: HTMLElement, onScrub: (bytes: number) => void) {
    this.#root = root;
    this.#input = root.querySelector('input')!;
    this.#input.addEventListener('input', () => onScrub(this.#bytesAt(this.#input.valueAsNumber)));
    this.#button(
      'back',
      () => this.#layers.findLast(({ offset }) => offset < this.#shown),
      onScrub,
    );
    this.#button('forward', () => this.#layers.find(({ offset }) => offset > this.#shown), onScrub);
  }

  clear(): void {
    this.#total = this.#received = this.#shown = 0;
    this.#layers = [];
    this.#input.value = String(STEPS);
    this.#element('.ticks').replaceChildren();
    this.#element('output').textContent = '';
    this.#draw();
  }

  /** `total`: bytes of the whole stream, if known already. */
  receive(count: number, total: number | undefined): void {
    this.#received = count;
    if (total !== undefined && total !== this.#total) {
      this.#total = total;
      this.#drawTicks();
    }
    this.#draw();
  }

  /** `isLive`: the surface follows the download and not the slider. */
  show({ bytes: shown, info, level, levels, final }: Surface, isLive: boolean): void {
    this.#shown = shown;
    if (info.layers.length > this.#layers.length) {
      this.#total = Math.max(this.#total, info.bytes);
      this.#layers = info.layers;
      this.#drawTicks();
    }
    if (isLive) this.#input.value = String(STEPS * this.#share(shown));
    const kind = this.#layers.findLast(({ offset }) => offset <= shown)?.kind;
    const text = `${bytes(shown)} of ${bytes(this.#total)}`;
    const rest = `level ${level + 1} of ${levels}${final ? ', complete' : kind ? `, ${kind}` : ''}`;
    this.#element('output').replaceChildren(
      Object.assign(document.createElement('b'), { textContent: text }),
      ` · ${rest}`,
    );
    this.#input.setAttribute('aria-valuetext', `${text}, ${rest}`);
    this.#draw();
  }

  #draw(): void {
    this.#element('.received').style.transform = `scaleX(${this.#share(this.#received)})`;
    this.#element('.shown').style.transform = `scaleX(${this.#share(this.#shown)})`;
    this.#element<HTMLButtonElement>('#back').disabled = !this.#layers.some(
      ({ offset }) => offset < this.#shown,
    );
    this.#element<HTMLButtonElement>('#forward').disabled = !this.#layers.some(
      ({ offset }) => offset > this.#shown,
    );
  }

  #drawTicks(): void {
    const ticks = this.#layers.flatMap((layer, i) => {
      const tick = document.createElement('i');
      tick.className = layer.kind;
      tick.style.left = `${100 * this.#share(layer.offset)}%`;
      const isLastOfLevel = this.#layers[i + 1]?.level !== layer.level;
      if (!isLastOfLevel) return [tick];
      const label = Object.assign(document.createElement('b'), {
        textContent: String(layer.level + 1),
      });
      label.style.left = tick.style.left;
      return [tick, label];
    });
    this.#element('.ticks').replaceChildren(...ticks);
  }

  // Each level takes about four times the bytes of the one before. A square root spreads them.
  #share(count: number): number {
    return this.#total === 0 ? 0 : Math.sqrt(Math.min(1, count / this.#total));
  }

  #bytesAt(step: number): number {
    return Math.round(this.#total * (step / STEPS) ** 2);
  }

  #button(id: string, find: () => Layer | undefined, onScrub: (bytes: number) => void): void {
    this.#element(`#${id}`).addEventListener('click', () => {
      const layer = find();
      if (!layer) return;
      this.#input.value = String(STEPS * this.#share(layer.offset));
      onScrub(layer.offset);
    });
  }

  #element<E extends HTMLElement = HTMLElement>(selector: string): E {
    return this.#root.querySelector<E>(selector)!;
  }
}

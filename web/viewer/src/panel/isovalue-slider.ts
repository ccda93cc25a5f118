import type { Surface } from 'isostar';

const STEPS = 400;

/** The slider over a stream's isovalues and the values between; hidden if there is only one. */
export class IsovalueSlider {
  readonly #root: HTMLElement;
  readonly #input: HTMLInputElement;
  #isovalues: readonly number[] = [];

  constructor(root: HTMLElement, onChange: (isovalue: number) => void) {
    this.#root = root;
    this.#input = root.querySelector('input')!;
    this.#input.addEventListener('input', () => {
      const isovalue = this.#snapped(this.#low + (this.#input.valueAsNumber / STEPS) * this.#range);
      this.#write(isovalue);
      onChange(isovalue);
    });
  }

  clear(): void {
    this.#isovalues = [];
    this.#root.hidden = true;
  }

  /** Only a stream's first surface has an effect. */
  show({ info, isovalue }: Surface): void {
    if (this.#isovalues.length > 0 || info.isovalues.length < 2) return;
    this.#isovalues = info.isovalues;
    this.#root.hidden = false;
    this.#input.value = String(this.#stepOf(isovalue));
    this.#root.querySelector('.marks')!.replaceChildren(
      ...info.isovalues.map((each) => {
        const mark = document.createElement('i');
        mark.style.left = `${(100 * this.#stepOf(each)) / STEPS}%`;
        return mark;
      }),
    );
    this.#write(isovalue);
  }

  /** One of the stream's own isovalues if the slider is close to it. */
  #snapped(isovalue: number): number {
    const reach = this.#range / 60;
    return this.#isovalues.find((each) => Math.abs(each - isovalue) < reach) ?? isovalue;
  }

  #write(isovalue: number): void {
    const digits = Math.max(0, Math.min(12, 2 - Math.floor(Math.log10(this.#range))));
    const isCoded = this.#isovalues.includes(isovalue);
    const text = `${isCoded ? isovalue : isovalue.toFixed(digits)}`;
    this.#root.querySelector('output')!.textContent = isCoded ? text : `${text}, in between`;
    this.#input.setAttribute(
      'aria-valuetext',
      isCoded ? text : `${text}, estimated from the isovalues around it`,
    );
  }

  #stepOf(isovalue: number): number {
    return (STEPS * (isovalue - this.#low)) / this.#range;
  }
  get #low(): number {
    return Math.min(...this.#isovalues);
  }
  get #range(): number {
    return Math.max(...this.#isovalues) - this.#low;
  }
}

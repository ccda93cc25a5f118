/** An endless series of values. A late reader gets only the newest one. */
export class Newest<Value> implements AsyncIterable<Value> {
  #waiting: { value: Value } | undefined;
  #wake = () => {};

  put(value: Value): void {
    this.#waiting = { value };
    this.#wake();
  }

  async *[Symbol.asyncIterator](): AsyncGenerator<Value, void> {
    for (;;) {
      while (!this.#waiting) await new Promise<void>((resolve) => (this.#wake = resolve));
      const { value } = this.#waiting;
      this.#waiting = undefined;
      yield value;
    }
  }
}

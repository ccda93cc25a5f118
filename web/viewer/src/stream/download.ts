import { throttle } from './throttle.ts';

export interface Origin {
  open(
    signal: AbortSignal,
  ): Promise<{ stream: ReadableStream<Uint8Array>; total: number | undefined }>;
}

export const fromAddress = (address: string): Origin => ({
  async open(signal) {
    const response = await fetch(address, { signal });
    if (!response.ok || !response.body)
      throw new Error(`${address}: HTTP status ${response.status} ${response.statusText}`.trim());
    return {
      stream: response.body,
      total: Number(response.headers.get('Content-Length')) || undefined,
    };
  },
});

export const fromFile = (file: File): Origin => ({
  open: async () => ({ stream: file.stream(), total: file.size }),
});

/** A transfer that keeps its bytes, so that any prefix can be decoded again while more arrive. */
export class Download {
  readonly #controller = new AbortController();
  readonly #ended: Promise<void>;
  #bytes = new Uint8Array(1 << 16);
  #length = 0;
  #total: number | undefined;
  #isOver = false;
  #failure: { readonly reason: unknown } | undefined;
  #wakes: (() => void)[] = [];

  constructor(origin: Origin, bitsPerSecond: number) {
    this.#ended = this.#receive(origin, bitsPerSecond);
  }

  get length(): number {
    return this.#length;
  }

  /** The number of all bytes, if known. */
  get total(): number | undefined {
    return this.#isOver ? this.#length : this.#total;
  }

  get isOver(): boolean {
    return this.#isOver;
  }

  prefix(length = this.#length): Uint8Array<ArrayBuffer> {
    return this.#bytes.slice(0, Math.min(length, this.#length));
  }

  /** The whole file; throws if the transfer failed. */
  async whole(): Promise<Uint8Array<ArrayBuffer>> {
    await this.#ended;
    if (this.#failure) throw this.#failure.reason;
    return this.prefix();
  }

  /** All bytes from the first on: those received so far at once, the rest as they arrive. */
  async *pieces(): AsyncGenerator<Uint8Array> {
    for (let sent = 0; ;) {
      if (sent < this.#length) {
        const end = this.#length; // more may arrive during the yield
        yield this.#bytes.slice(sent, end);
        sent = end;
      } else if (this.#failure) throw this.#failure.reason;
      else if (this.#isOver) return;
      else await new Promise<void>((resolve) => this.#wakes.push(resolve));
    }
  }

  cancel(): void {
    this.#controller.abort();
  }

  async #receive(origin: Origin, bitsPerSecond: number): Promise<void> {
    const { signal } = this.#controller;
    try {
      const { stream, total } = await origin.open(signal);
      this.#total = total;
      const paced = Number.isFinite(bitsPerSecond)
        ? stream.pipeThrough(throttle(bitsPerSecond), { signal })
        : stream;
      const reader = paced.getReader();
      for (let next = await reader.read(); !next.done; next = await reader.read()) {
        signal.throwIfAborted();
        this.#keep(next.value);
      }
    } catch (reason) {
      this.#failure = { reason };
    }
    this.#isOver = true;
    this.#wakeAll();
  }

  #keep(piece: Uint8Array): void {
    if (this.#length + piece.length > this.#bytes.length) {
      const larger = new Uint8Array(2 * (this.#length + piece.length));
      larger.set(this.#bytes.subarray(0, this.#length));
      this.#bytes = larger;
    }
    this.#bytes.set(piece, this.#length);
    this.#length += piece.length;
    this.#wakeAll();
  }

  #wakeAll(): void {
    for (const wake of this.#wakes.splice(0)) wake();
  }
}

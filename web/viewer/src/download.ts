import { throttle } from './throttle.ts';

export interface Origin {
  open(signal: AbortSignal): Promise<{ stream: ReadableStream<Uint8Array>; total: number | undefined }>;
}

export const fromAddress = (address: string): Origin => ({
  async open(signal) {
    const response = await fetch(address, { signal });
    if (!response.ok || !response.body) throw new Error(`${address} answers ${response.status} ${response.statusText}`);
    return { stream: response.body, total: Number(response.headers.get('Content-Length')) || undefined };
  },
});

export const fromFile = (file: File): Origin => ({ open: async () => ({ stream: file.stream(), total: file.size }) });

/** A transfer whose bytes are kept, so that any prefix can be decoded again while the rest still arrives. */
export class Download {
  readonly #controller = new AbortController();
  readonly #ended: Promise<void>;
  #bytes = new Uint8Array(1 << 16);
  #length = 0;
  #total: number | undefined;
  #isOver = false;
  #failure: { readonly reason: unknown } | undefined;
  #wake: (() => void)[] = [];

  constructor(origin: Origin, bitsPerSecond: number) {
    this.#ended = this.#receive(origin, bitsPerSecond);
  }

  get length(): number {
    return this.#length;
  }

  /** Of all its bytes, where that is known. */
  get total(): number | undefined {
    return this.#isOver ? this.#length : this.#total;
  }

  get isOver(): boolean {
    return this.#isOver;
  }

  prefix(length = this.#length): Uint8Array<ArrayBuffer> {
    return this.#bytes.slice(0, Math.min(length, this.#length));
  }

  /** The whole file; throws where the transfer failed. */
  async whole(): Promise<Uint8Array<ArrayBuffer>> {
    await this.#ended;
    if (this.#failure) throw this.#failure.reason;
    return this.prefix();
  }

  /** All bytes from the first, those that are here at once and the rest as they come. */
  async *pieces(): AsyncGenerator<Uint8Array> {
    for (let sent = 0; ; ) {
      if (sent < this.#length) {
        yield this.#bytes.slice(sent, this.#length);
        sent = this.#length;
      } else if (this.#failure) throw this.#failure.reason;
      else if (this.#isOver) return;
      else await new Promise<void>((resolve) => this.#wake.push(resolve));
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
      const paced = Number.isFinite(bitsPerSecond) ? stream.pipeThrough(throttle(bitsPerSecond), { signal }) : stream;
      const reader = paced.getReader();
      for (let next = await reader.read(); !next.done; next = await reader.read()) {
        signal.throwIfAborted();
        this.#keep(next.value);
      }
    } catch (reason) {
      this.#failure = { reason };
    }
    this.#isOver = true;
    this.#tell();
  }

  #keep(piece: Uint8Array): void {
    if (this.#length + piece.length > this.#bytes.length) {
      const larger = new Uint8Array(2 * (this.#length + piece.length));
      larger.set(this.#bytes.subarray(0, this.#length));
      this.#bytes = larger;
    }
    this.#bytes.set(piece, this.#length);
    this.#length += piece.length;
    this.#tell();
  }

  #tell(): void {
    for (const wake of this.#wake.splice(0)) wake();
  }
}

export interface DracoSurface {
  readonly positions: Float32Array<ArrayBuffer>;
  readonly normals: Float32Array<ArrayBuffer>;
  readonly indices: Uint32Array<ArrayBuffer>;
  readonly milliseconds: { readonly decode: number; readonly normals: number };
}

interface Reply {
  readonly id: number;
  readonly surface: DracoSurface;
  readonly failure?: string;
}

/** Draco's decoder, in a worker of its own. */
export class Draco {
  readonly #worker = new Worker(new URL('./draco-worker.ts', import.meta.url), { type: 'module' });
  readonly #waiting = new Map<number, (reply: Reply) => void>();
  #lastId = 0;

  constructor() {
    this.#worker.onmessage = ({ data }: MessageEvent<Reply>) => {
      this.#waiting.get(data.id)?.(data);
      this.#waiting.delete(data.id);
    };
  }

  /** Resolves when the decoder is loaded. */
  async ready(): Promise<void> {
    await this.#request({});
  }

  async decode(bytes: Uint8Array): Promise<DracoSurface> {
    return (await this.#request({ bytes })).surface;
  }

  async #request(message: { bytes?: Uint8Array }): Promise<Reply> {
    const id = ++this.#lastId;
    this.#worker.postMessage({ id, ...message });
    const reply = await new Promise<Reply>((resolve) => this.#waiting.set(id, resolve));
    if (reply.failure) throw new Error(reply.failure);
    return reply;
  }
}

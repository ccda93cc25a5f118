import { IsostarError } from './errors.js';
import { readInto, turnWith } from './inbox.js';
import type { WasmSource } from './load-module.js';
import { disposed } from './disposed.js';
import type { Reply, Request } from './protocol.js';
import type { Decoder, DecodeOptions, Source, Surface } from './surface.js';

/** Decodes in a worker of its own; the page only passes bytes on. */
export class RemoteDecoder implements Decoder {
  readonly #worker: Worker;
  readonly #waiting = new Map<number, { resolve: (reply: Reply) => void; reject: (reason: unknown) => void }>();
  #end: unknown;  // why no reply will come any more
  #lastId = 0;

  private constructor(worker: Worker) {
    this.#worker = worker;
    worker.onmessage = ({ data }: MessageEvent<Reply>) => {
      this.#waiting.get(data.id)?.resolve(data);
      this.#waiting.delete(data.id);
    };
    worker.onerror = (event) => this.#close(new Error(`the decoder's worker failed: ${event.message || 'it could not be loaded'}`));
  }

  static async create(wasm?: WasmSource): Promise<RemoteDecoder> {
    const decoder = new RemoteDecoder(new Worker(new URL('./worker.js', import.meta.url), { type: 'module' }));
    const address = wasm instanceof URL ? wasm.href : typeof wasm === 'string' ? new URL(wasm, document.baseURI).href : wasm;
    decoder.#post({ type: 'open', wasm: address });
    try {
      await decoder.#reply(0);
    } catch (reason) {
      decoder.dispose();
      throw reason;
    }
    return decoder;
  }

  async *decode(source: Source, { signal, isovalue, ...options }: DecodeOptions = {}): AsyncGenerator<Surface, void, undefined> {
    signal?.throwIfAborted();
    const id = ++this.#lastId;
    let sourceFailure: { reason: unknown } | undefined;
    const fail = (reason: unknown) => {
      sourceFailure ??= { reason };
      this.#waiting.get(id)?.reject(reason);
      this.#waiting.delete(id);
    };
    const giveUp = readInto(
      { push: (piece) => this.#post({ type: 'piece', id, piece }), end: () => this.#post({ type: 'end', id }), fail },
      source,
    );
    const abort = () => fail(signal?.reason);
    signal?.addEventListener('abort', abort);
    this.#post({ type: 'decode', id, options: typeof isovalue === 'number' ? { ...options, isovalue } : options });
    const turn = (isovalue?: number) => this.#post({ type: 'turn', id, isovalue });
    const stopTurning = typeof isovalue === 'object' ? turnWith({ turn, settle: () => this.#post({ type: 'settle', id }), fail }, isovalue) : undefined;
    try {
      for (;;) {
        if (sourceFailure) throw sourceFailure.reason;
        this.#post({ type: 'next', id });
        const reply = await this.#reply(id);
        if (reply.type !== 'surface') return;
        yield reply.surface;
      }
    } finally {
      giveUp();
      stopTurning?.();
      this.#post({ type: 'stop', id });
      signal?.removeEventListener('abort', abort);
    }
  }

  dispose(): void {
    this.#close(disposed());
  }

  #post(request: Request): void {
    if (!this.#end) this.#worker.postMessage(request);
  }

  async #reply(id: number): Promise<Reply> {
    if (this.#end) throw this.#end;
    const reply = await new Promise<Reply>((resolve, reject) => this.#waiting.set(id, { resolve, reject }));
    if (reply.type !== 'failed') return reply;
    throw reply.code ? new IsostarError(reply.code, reply.message) : new Error(reply.message);
  }

  #close(reason: unknown): void {
    this.#end ??= reason;
    this.#worker.terminate();
    for (const { reject } of this.#waiting.values()) reject(this.#end);
    this.#waiting.clear();
  }
}

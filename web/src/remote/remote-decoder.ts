import { IsostarError } from '../api/errors.js';
import type { Decoder, DecodeOptions, Source, Surface } from '../api/surface.js';
import { disposed } from '../codec/disposed.js';
import type { WasmSource } from '../codec/load-module.js';
import { sendIsovalues, sendSource } from '../input/inbox.js';
import type { Reply, Request } from './protocol.js';

interface Waiting {
  resolve(reply: Reply): void;
  reject(reason: unknown): void;
}

/** Decodes in a worker of its own; the page only passes bytes on. */
export class RemoteDecoder implements Decoder {
  readonly #worker: Worker;
  readonly #waiting = new Map<number, Waiting>();
  #end: unknown; // why no more replies will come
  #lastId = 0;

  private constructor(worker: Worker) {
    this.#worker = worker;
    worker.onmessage = ({ data }: MessageEvent<Reply>) => {
      this.#waiting.get(data.id)?.resolve(data);
      this.#waiting.delete(data.id);
    };
    worker.onerror = ({ message }) =>
      this.#close(new Error(`the decoder's worker failed: ${message || 'it did not load'}`));
  }

  static async create(wasm?: WasmSource): Promise<RemoteDecoder> {
    // Relative to the bundle in dist/.
    const worker = new Worker(new URL('./worker.js', import.meta.url), { type: 'module' });
    const decoder = new RemoteDecoder(worker);
    decoder.#post({ type: 'open', wasm: absolute(wasm) });
    try {
      await decoder.#reply(0);
    } catch (reason) {
      decoder.dispose();
      throw reason;
    }
    return decoder;
  }

  async *decode(
    source: Source,
    { signal, isovalue, ...options }: DecodeOptions = {},
  ): AsyncGenerator<Surface, void, undefined> {
    signal?.throwIfAborted();
    const id = ++this.#lastId;
    let failure: { reason: unknown } | undefined;
    const fail = (reason: unknown) => {
      failure ??= { reason };
      this.#waiting.get(id)?.reject(reason);
      this.#waiting.delete(id);
    };
    const abort = () => fail(signal?.reason);
    const inbox = this.#inbox(id);
    const cancelSource = sendSource(source, { ...inbox, fail });
    signal?.addEventListener('abort', abort);
    this.#post({
      type: 'decode',
      id,
      options: typeof isovalue === 'number' ? { ...options, isovalue } : options,
    });
    const cancelIsovalues =
      typeof isovalue === 'object' ? sendIsovalues(isovalue, { ...inbox, fail }) : undefined;
    try {
      for (;;) {
        if (failure) throw failure.reason;
        this.#post({ type: 'next', id });
        const reply = await this.#reply(id);
        if (reply.type !== 'surface') return;
        yield reply.surface;
      }
    } finally {
      cancelSource();
      cancelIsovalues?.();
      this.#post({ type: 'stop', id });
      signal?.removeEventListener('abort', abort);
    }
  }

  dispose(): void {
    this.#close(disposed());
  }

  /** The inbox at the other end, in the worker. */
  #inbox(id: number) {
    return {
      accept: (piece: Uint8Array) => this.#post({ type: 'accept', id, piece }),
      finish: () => this.#post({ type: 'finish', id }),
      beginIsovalues: () => this.#post({ type: 'beginIsovalues', id }),
      setIsovalue: (isovalue: number) => this.#post({ type: 'setIsovalue', id, isovalue }),
      endIsovalues: () => this.#post({ type: 'endIsovalues', id }),
    };
  }

  #post(request: Request): void {
    if (!this.#end) this.#worker.postMessage(request);
  }

  async #reply(id: number): Promise<Reply> {
    if (this.#end) throw this.#end;
    const reply = await new Promise<Reply>((resolve, reject) =>
      this.#waiting.set(id, { resolve, reject }),
    );
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

/** A URL object cannot be posted, and a relative address means something else in the worker. */
function absolute(wasm: WasmSource | undefined): Exclude<WasmSource, URL> | undefined {
  if (wasm instanceof URL) return wasm.href;
  return typeof wasm === 'string' ? new URL(wasm, document.baseURI).href : wasm;
}

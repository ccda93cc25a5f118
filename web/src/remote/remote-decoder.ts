import type { Decoder, DecodeOptions, Limits, Source, Surface } from '../api/surface.js';
import { Cleanup, cleanUpAfter } from '../codec/cleanup.js';
import { disposed } from '../codec/disposed.js';
import type { WasmSource } from '../codec/load-module.js';
import { sortOptions } from '../codec/options.js';
import { withChunks } from '../codec/surface-chunks.js';
import { Feed } from '../input/feed.js';
import { sendIsovalues } from '../input/inbox.js';
import type { Piece } from '../input/pieces.js';
import { hold, type HeldSource } from '../input/source.js';
import type { OpenOptions } from './protocol.js';
import { type Call, WorkerLink } from './worker-link.js';

/** Decodes in a worker of its own; the page only passes bytes on. */
export class RemoteDecoder implements Decoder {
  readonly #open: OpenOptions;
  readonly #limits: Limits | undefined;
  #link: Promise<WorkerLink> | undefined;
  #isDisposed = false;
  #lastId = 0;

  private constructor(open: OpenOptions, limits: Limits | undefined) {
    this.#open = open;
    this.#limits = limits;
  }

  /** `workers`: how many may decode a stream together. */
  static async create(
    wasm: WasmSource | undefined,
    limits: Limits | undefined,
    workers: number,
  ): Promise<RemoteDecoder> {
    const decoder = new RemoteDecoder({ wasm: postable(wasm), helpers: workers - 1 }, limits);
    await decoder.#connect();
    return decoder;
  }

  decode(source: Source, options: DecodeOptions = {}): AsyncGenerator<Surface, void, undefined> {
    const cleanup = new Cleanup();
    return cleanUpAfter(this.#decode(hold(source), options, cleanup), cleanup);
  }

  dispose(): void {
    this.#isDisposed = true;
    void this.#link?.then((link) => link.close(disposed())).catch(() => {});
    this.#link = undefined;
  }

  async *#decode(
    source: HeldSource,
    options: DecodeOptions,
    cleanup: Cleanup,
  ): AsyncGenerator<Surface, void, undefined> {
    const { signal, isovalues, surface } = sortOptions(options, this.#limits);
    const link = await this.#connect();
    signal?.throwIfAborted();
    const pieces = source.open();
    const id = ++this.#lastId;
    const call = link.begin(id);
    try {
      link.post({ type: 'decode', id, options: surface });
      cleanup.add(() => {
        link.post({ type: 'stop', id });
        link.end(id);
      });
      const inbox = inboxAt(link, id, call);
      const feed = (call.feed = new Feed(pieces, inbox));
      cleanup.add(() => feed.stop());
      if (isovalues) cleanup.add(sendIsovalues(isovalues, inbox));
      const abort = () => call.fail(signal?.reason);
      signal?.addEventListener('abort', abort);
      cleanup.add(() => signal?.removeEventListener('abort', abort));
      for (;;) {
        call.throwIfFailed();
        link.post({ type: 'next', id });
        const reply = await call.reply();
        if (reply.type !== 'surface') return;
        yield withChunks(reply.surface, surface.frame);
      }
    } finally {
      cleanup.run();
    }
  }

  /** The worker, which is started anew if the last one was lost. */
  #connect(): Promise<WorkerLink> {
    if (this.#isDisposed) return Promise.reject(disposed());
    if (this.#link) return this.#link;
    const forget = () => {
      if (this.#link === link) this.#link = undefined;
    };
    const link = WorkerLink.open(startWorker, this.#open, forget);
    link.catch(forget);
    return (this.#link = link);
  }
}

// Relative to the bundle in dist/.
const startWorker = () => new Worker(new URL('./worker.js', import.meta.url), { type: 'module' });

/** The inbox at the other end, in the worker. */
function inboxAt(link: WorkerLink, id: number, call: Call) {
  return {
    accept: (piece: Piece) => link.post({ type: 'accept', id, piece }, [piece.bytes.buffer]),
    finish: () => link.post({ type: 'finish', id }),
    beginIsovalues: () => link.post({ type: 'beginIsovalues', id }),
    setIsovalue: (isovalue: number) => link.post({ type: 'setIsovalue', id, isovalue }),
    endIsovalues: () => link.post({ type: 'endIsovalues', id }),
    fail: (reason: unknown) => call.fail(reason),
  };
}

/**
 * A URL object cannot be posted, a relative address means something else in the worker, and of a
 * view the whole buffer would be posted.
 */
function postable(wasm: WasmSource | undefined): Exclude<WasmSource, URL> | undefined {
  if (wasm instanceof URL) return wasm.href;
  if (typeof wasm === 'string') return new URL(wasm, document.baseURI).href;
  if (wasm instanceof ArrayBuffer) return wasm.slice(0);
  if (!ArrayBuffer.isView(wasm)) return wasm;
  return new Uint8Array(wasm.buffer, wasm.byteOffset, wasm.byteLength).slice();
}

import { IsostarError } from '../api/errors.js';
import type { Decoder, DecodeOptions, Source, Surface, SurfaceOptions } from '../api/surface.js';
import { Inbox, sendIsovalues, sendSource } from '../input/inbox.js';
import { disposed } from './disposed.js';
import { loadModule, type WasmSource } from './load-module.js';
import type { RawModule } from './raw.js';
import { Session } from './session.js';

/** Decodes in the current thread: a worker's, Node's, or a page's that wants no worker. */
export class LocalDecoder implements Decoder {
  readonly #wasm: WasmSource | undefined;
  #module: RawModule | undefined;
  #isDisposed = false;
  readonly #inboxes = new Set<Inbox>();

  private constructor(wasm: WasmSource | undefined, module: RawModule) {
    this.#wasm = wasm;
    this.#module = module;
  }

  static async create(wasm?: WasmSource): Promise<LocalDecoder> {
    return new LocalDecoder(wasm, await loadModule(wasm));
  }

  async *decode(
    source: Source,
    { signal, isovalue, ...options }: DecodeOptions = {},
  ): AsyncGenerator<Surface, void, undefined> {
    signal?.throwIfAborted();
    const inbox = new Inbox();
    const cancelSource = sendSource(source, inbox);
    const cancelIsovalues =
      typeof isovalue === 'object' ? sendIsovalues(isovalue, inbox) : undefined;
    const abort = () => inbox.fail(signal?.reason);
    signal?.addEventListener('abort', abort);
    try {
      yield* this.decodeInbox(
        inbox,
        typeof isovalue === 'number' ? { ...options, isovalue } : options,
      );
    } finally {
      cancelSource();
      cancelIsovalues?.();
      signal?.removeEventListener('abort', abort);
    }
  }

  /** Decodes the bytes of an inbox that the caller fills. */
  async *decodeInbox(
    inbox: Inbox,
    options: SurfaceOptions,
  ): AsyncGenerator<Surface, void, undefined> {
    if (this.#isDisposed) throw disposed();
    this.#inboxes.add(inbox);
    const module = (this.#module ??= await loadModule(this.#wasm));
    const session = new Session(module, options);
    let isAborted = false;
    try {
      yield* session.surfaces(inbox);
    } catch (reason) {
      isAborted = reason instanceof WebAssembly.RuntimeError;
      throw isAborted
        ? new IsostarError('OverLimit', 'the surface needs more memory than is available')
        : reason;
    } finally {
      this.#inboxes.delete(inbox);
      if (!isAborted) session.delete();
      else if (this.#module === module) this.#module = undefined; // it cannot be called again
    }
  }

  dispose(): void {
    this.#isDisposed = true;
    this.#module = undefined;
    for (const inbox of this.#inboxes) inbox.fail(disposed());
  }
}

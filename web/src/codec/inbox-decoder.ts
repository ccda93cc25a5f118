import type { Surface, SurfaceOptions } from '../api/surface.js';
import type { Inbox } from '../input/inbox.js';
import { Cleanup } from './cleanup.js';
import { disposed } from './disposed.js';
import { loadModule, type WasmSource } from './load-module.js';
import type { RawModule } from './raw.js';
import { Session } from './session.js';

/**
 * A module whose memory is larger than this, in bytes, serves no further streams. Memory never
 * shrinks; it is freed with the module, and the garbage collector takes it into account.
 */
const MOST_KEPT = 1 << 26;

/** The decoder in the current thread, without the reading of sources: its caller fills inboxes. */
export class InboxDecoder {
  readonly #instantiate: () => Promise<RawModule>;
  #module: Promise<RawModule> | undefined;
  #isDisposed = false;
  readonly #inboxes = new Set<Inbox>();

  private constructor(instantiate: () => Promise<RawModule>) {
    this.#instantiate = instantiate;
  }

  static async create(wasm?: WasmSource): Promise<InboxDecoder> {
    const decoder = new InboxDecoder(await loadModule(wasm));
    await decoder.#instance();
    return decoder;
  }

  /** The surfaces of one stream. `cleanup` frees what they need if their iterator is dropped. */
  async *decode(
    inbox: Inbox,
    options: SurfaceOptions,
    cleanup = new Cleanup(),
  ): AsyncGenerator<Surface, void, undefined> {
    if (this.#isDisposed) throw disposed();
    this.#inboxes.add(inbox);
    cleanup.add(() => this.#inboxes.delete(inbox));
    try {
      let instance = this.#instance();
      if (isLarge(await instance)) {
        this.#forget(instance);
        instance = this.#instance();
      }
      const module = await instance;
      const session = new Session(module, options, () => this.#forget(instance));
      cleanup.add(() => {
        session.delete();
        if (isLarge(module)) this.#forget(instance);
      });
      yield* session.surfaces(inbox);
    } finally {
      cleanup.run();
    }
  }

  dispose(): void {
    this.#isDisposed = true;
    this.#module = undefined;
    for (const inbox of this.#inboxes) inbox.fail(disposed());
  }

  /** The module, which is instantiated anew if the last one failed. */
  #instance(): Promise<RawModule> {
    if (this.#module) return this.#module;
    const instance = this.#instantiate();
    instance.catch(() => this.#forget(instance));
    return (this.#module = instance);
  }

  #forget(instance: Promise<RawModule>): void {
    if (this.#module === instance) this.#module = undefined;
  }
}

const isLarge = ({ HEAPU8 }: RawModule) => HEAPU8.length > MOST_KEPT;

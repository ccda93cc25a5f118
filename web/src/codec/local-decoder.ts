import type { Decoder, DecodeOptions, Limits, Source, Surface } from '../api/surface.js';
import { Feed } from '../input/feed.js';
import { Inbox, sendIsovalues } from '../input/inbox.js';
import { hold, type HeldSource } from '../input/source.js';
import { Cleanup, cleanUpAfter } from './cleanup.js';
import { InboxDecoder } from './inbox-decoder.js';
import { loadModule, type WasmSource } from './load-module.js';
import { Modules } from './modules.js';
import { sortOptions } from './options.js';
import { withChunks } from './surface-chunks.js';

/** Decodes in the current thread: Node's, a worker's, or a page's that wants no worker. */
export class LocalDecoder implements Decoder {
  readonly #decoder: InboxDecoder;
  readonly #limits: Limits | undefined;

  private constructor(decoder: InboxDecoder, limits: Limits | undefined) {
    this.#decoder = decoder;
    this.#limits = limits;
  }

  static async create(wasm?: WasmSource, limits?: Limits): Promise<LocalDecoder> {
    const modules = await Modules.of(await loadModule(wasm));
    return new LocalDecoder(new InboxDecoder(modules), limits);
  }

  decode(source: Source, options: DecodeOptions = {}): AsyncGenerator<Surface, void, undefined> {
    const cleanup = new Cleanup();
    return cleanUpAfter(this.#decode(hold(source), options, cleanup), cleanup);
  }

  dispose(): void {
    this.#decoder.dispose();
  }

  async *#decode(
    source: HeldSource,
    options: DecodeOptions,
    cleanup: Cleanup,
  ): AsyncGenerator<Surface, void, undefined> {
    const { signal, isovalues, surface } = sortOptions(options, this.#limits);
    signal?.throwIfAborted();
    const pieces = source.open();
    const inbox = new Inbox({
      taken: (weight) => feed.taken(weight),
      wanted: (ranges) => feed.want(ranges),
      enough: () => feed.stop(),
    });
    const feed = new Feed(pieces, inbox);
    cleanup.add(() => feed.stop());
    try {
      if (isovalues) cleanup.add(sendIsovalues(isovalues, inbox));
      const abort = () => inbox.fail(signal?.reason);
      signal?.addEventListener('abort', abort);
      cleanup.add(() => signal?.removeEventListener('abort', abort));
      for await (const one of this.#decoder.decode(inbox, surface, cleanup))
        yield withChunks(one, surface.frame);
    } finally {
      cleanup.run();
    }
  }
}

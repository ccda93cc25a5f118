import type { SurfaceOptions } from '../api/surface.js';
import type { Inbox } from '../input/inbox.js';
import { Cleanup } from './cleanup.js';
import { disposed } from './disposed.js';
import type { Modules } from './modules.js';
import { Session } from './session.js';
import type { WholeSurface } from './surface-chunks.js';
import type { BeginShares } from './team.js';

/** The decoder in the current thread, without the reading of sources: its caller fills inboxes. */
export class InboxDecoder {
  readonly #modules: Modules;
  readonly #beginShares: BeginShares | undefined;
  #isDisposed = false;
  readonly #inboxes = new Set<Inbox>();

  /** `beginShares`: for streams in chunks, if there are other threads for them. */
  constructor(modules: Modules, beginShares?: BeginShares) {
    this.#modules = modules;
    this.#beginShares = beginShares;
  }

  /** The surfaces of one stream. `cleanup` frees what they need if their iterator is dropped. */
  async *decode(
    inbox: Inbox,
    options: SurfaceOptions,
    cleanup = new Cleanup(),
  ): AsyncGenerator<WholeSurface, void, undefined> {
    if (this.#isDisposed) throw disposed();
    this.#inboxes.add(inbox);
    cleanup.add(() => this.#inboxes.delete(inbox));
    try {
      const lease = await this.#modules.lease(options.polygonizer);
      const leaseAll = () => this.#modules.leaseAll();
      const session = new Session(lease, leaseAll, options, this.#beginShares);
      cleanup.add(() => session.delete());
      yield* session.surfaces(inbox);
    } finally {
      cleanup.run();
    }
  }

  dispose(): void {
    this.#isDisposed = true;
    this.#modules.clear();
    for (const inbox of this.#inboxes) inbox.fail(disposed());
  }
}

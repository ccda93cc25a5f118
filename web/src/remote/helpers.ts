import type { SurfaceOptions } from '../api/surface.js';
import type { Lease } from '../codec/instances.js';
import type { OtherShare } from '../codec/team.js';
import { RemoteShare } from './remote-share.js';
import { WorkerLink } from './worker-link.js';

/** Workers that the decoder's worker starts when it needs them, for shares of its streams. */
export class Helpers {
  readonly #wasm: WebAssembly.Module;
  readonly #links: (Promise<WorkerLink> | undefined)[];
  #lastId = 0;

  constructor(wasm: WebAssembly.Module, count: number) {
    this.#wasm = wasm;
    this.#links = new Array<undefined>(count).fill(undefined);
  }

  /** As of `BeginShares`. */
  async begin(
    most: number,
    options: SurfaceOptions,
    { isOfAll, compiled }: Lease,
  ): Promise<OtherShare[]> {
    const count = Math.min(most, this.#links.length);
    const opening = Array.from({ length: count }, (_, i) => this.#link(i));
    const links = await Promise.all(opening).catch(() => []); // without helpers it works as well
    const of = links.length + 1;
    const all = isOfAll ? compiled : undefined;
    return links.map(
      (link, i) =>
        new RemoteShare(link, ++this.#lastId, { options, share: { number: i + 1, of }, all }),
    );
  }

  /** A helper, which is started anew if the last one was lost. */
  #link(i: number): Promise<WorkerLink> {
    const forget = () => {
      if (this.#links[i] === link) this.#links[i] = undefined;
    };
    const link = (this.#links[i] ??= WorkerLink.open(startHelper, { wasm: this.#wasm }, forget));
    link.catch(forget);
    return link;
  }
}

/**
 * Another worker of the same script. By its own address: bundlers would follow a relative one round
 * in a circle.
 */
const startHelper = () => new Worker(self.location.href, { type: 'module' });

import type { Polygonizer } from '../api/surface.js';
import { Instances, type Lease } from './instances.js';
import { type LoadedModule, loadedModule } from './load-module.js';

/**
 * The WebAssembly of a thread: a module that decodes most streams, or the one that the caller gave,
 * and one that decodes every stream, which is loaded when a stream needs it.
 */
export class Modules {
  readonly #first: Instances;
  readonly #loadAll: () => Promise<LoadedModule>;
  #all: Promise<Instances> | undefined;

  private constructor(first: Instances, loadAll: () => Promise<LoadedModule>) {
    this.#first = first;
    this.#loadAll = loadAll;
  }

  /** Makes the first module at once, so that its errors come to light. */
  static async of(loaded: LoadedModule): Promise<Modules> {
    return new Modules(await Instances.of(loaded), loaded.loadAll);
  }

  /** For a stream of which nothing is known yet. */
  async lease(polygonizer: Polygonizer = 'cubes'): Promise<Lease> {
    const lease = await this.#first.lease();
    if (polygonizer !== 'tetrahedra' || lease.module.Polygonizer.tetrahedra) return lease;
    lease.end();
    return this.leaseAll();
  }

  /** For a stream that the first module lacks. `compiled`: by another thread. */
  async leaseAll(compiled?: WebAssembly.Module): Promise<Lease> {
    const loading = (this.#all ??= this.#load(compiled));
    loading.catch(() => {
      if (this.#all === loading) this.#all = undefined; // the next stream tries again
    });
    return { ...(await (await loading).lease()), isOfAll: true };
  }

  /** Nobody gets these instances any more. */
  clear(): void {
    this.#first.clear();
    void this.#all?.then((all) => all.clear()).catch(() => {});
  }

  async #load(compiled: WebAssembly.Module | undefined): Promise<Instances> {
    return Instances.of(compiled ? loadedModule(compiled) : await this.#loadAll());
  }
}

import type { LoadedModule } from './load-module.js';
import type { RawModule } from './raw.js';

/**
 * A module whose memory is larger than this, in bytes, serves no further streams. Memory never
 * shrinks; it is freed with the module, and the garbage collector takes it into account.
 */
const MOST_KEPT = 1 << 26;

/** A module that serves one stream. */
export interface Lease {
  readonly module: RawModule;
  /** The same for another thread. */
  readonly compiled: WebAssembly.Module;
  /** Is it the module for every stream, which other threads may not have? */
  readonly isOfAll: boolean;
  /** The module has failed: nobody gets it any more. */
  drop(): void;
  /** The stream is deleted. */
  end(): void;
}

/** The module for the streams of a thread, which is instantiated anew when it has become large. */
export class Instances {
  readonly #loaded: LoadedModule;
  #module: Promise<RawModule> | undefined;

  private constructor(loaded: LoadedModule) {
    this.#loaded = loaded;
  }

  /** Makes the first module at once, so that its errors come to light. */
  static async of(loaded: LoadedModule): Promise<Instances> {
    const instances = new Instances(loaded);
    await instances.#instance();
    return instances;
  }

  async lease(): Promise<Lease> {
    let instance = this.#instance();
    if (isLarge(await instance)) {
      this.#forget(instance);
      instance = this.#instance();
    }
    const module = await instance;
    const drop = () => this.#forget(instance);
    const { compiled } = this.#loaded;
    return { module, compiled, isOfAll: false, drop, end: () => void (isLarge(module) && drop()) };
  }

  /** Nobody gets the last module any more. */
  clear(): void {
    this.#module = undefined;
  }

  /** The module, which is instantiated anew if the last one failed. */
  #instance(): Promise<RawModule> {
    if (this.#module) return this.#module;
    const instance = this.#loaded.instantiate();
    instance.catch(() => this.#forget(instance));
    return (this.#module = instance);
  }

  #forget(instance: Promise<RawModule>): void {
    if (this.#module === instance) this.#module = undefined;
  }
}

const isLarge = ({ HEAPU8 }: RawModule) => HEAPU8.length > MOST_KEPT;

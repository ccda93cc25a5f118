/** What must be undone when an iteration ends or is dropped. */
export class Cleanup {
  #tasks: (() => void)[] = [];

  add(task: () => void): void {
    this.#tasks.push(task);
  }

  /** Runs each task once, the newest first. */
  run(): void {
    for (const task of this.#tasks.splice(0).reverse()) task();
  }
}

const dropped = new FinalizationRegistry<Cleanup>((cleanup) => cleanup.run());

/**
 * Runs `cleanup` when `owner` is garbage-collected, for callers that drop an iterator without
 * return(). The tasks must not refer to `owner`: it would then never be collected.
 */
export function cleanUpAfter<Owner extends object>(owner: Owner, cleanup: Cleanup): Owner {
  dropped.register(owner, cleanup);
  return owner;
}

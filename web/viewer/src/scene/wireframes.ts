/** Edges of triangles, found in a worker: half a million triangles would block the page. */
export class Wireframes {
  readonly #worker = new Worker(new URL('./wireframe-worker.ts', import.meta.url), {
    type: 'module',
  });
  readonly #waiting = new Map<number, (edges: Uint32Array) => void>();
  #lastId = 0;

  constructor() {
    this.#worker.onmessage = ({
      data: { id, edges },
    }: MessageEvent<{ id: number; edges: Uint32Array }>) => {
      this.#waiting.get(id)?.(edges);
      this.#waiting.delete(id);
    };
  }

  /** Pairs of vertices, for line segments. */
  edgesOf(indices: Uint32Array): Promise<Uint32Array> {
    const id = ++this.#lastId;
    this.#worker.postMessage({ id, indices });
    return new Promise((resolve) => this.#waiting.set(id, resolve));
  }
}

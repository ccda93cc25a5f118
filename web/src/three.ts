import {
  Box3,
  BufferAttribute,
  BufferGeometry,
  Loader,
  type LoadingManager,
  Sphere,
  Vector3,
} from 'three';
import { boundsOf } from './display/bounds.js';
import {
  createDecoder,
  type Decoder,
  type DecoderOptions,
  RangeSource,
  type Source,
  type Surface,
  type SurfaceOptions,
} from './index.js';

/** Passed to `onProgress` at each refinement. `geometry` is the same object each time. */
export type IsostarProgress = ProgressEvent & {
  readonly geometry: BufferGeometry;
  readonly surface: Surface;
};

/** Loads `.isostar` streams into a BufferGeometry that is refined as bytes arrive. */
export class IsostarLoader extends Loader<BufferGeometry> {
  #decoder: Promise<Decoder> | undefined;
  #decoderOptions: DecoderOptions = {};
  #surfaceOptions: SurfaceOptions = {};

  constructor(manager?: LoadingManager) {
    super(manager);
  }

  /** WebAssembly, worker and limits. Call it before preload() and load(). */
  setDecoderOptions(options: DecoderOptions): this {
    this.#decoderOptions = options;
    return this;
  }

  /** Polygonizer, frame, normals, isovalue, region, refinements, limits. */
  setSurfaceOptions(options: SurfaceOptions): this {
    this.#surfaceOptions = options;
    return this;
  }

  /** Fetches the decoder before it is needed. */
  preload(): this {
    void this.#ready().catch(() => {}); // load() reports it
    return this;
  }

  override load(
    url: string,
    onLoad: (geometry: BufferGeometry) => void,
    onProgress?: (event: IsostarProgress) => void,
    onError?: (reason: unknown) => void,
  ): void {
    const address = this.manager.resolveURL(this.path + url);
    this.manager.itemStart(address);
    this.#load(address, onProgress)
      .then(onLoad)
      .catch((reason: unknown) => {
        this.manager.itemError(address);
        if (onError) onError(reason);
        else console.error(reason);
      })
      .finally(() => this.manager.itemEnd(address));
  }

  override loadAsync(
    url: string,
    onProgress?: (event: IsostarProgress) => void,
  ): Promise<BufferGeometry> {
    return new Promise((resolve, reject) => this.load(url, resolve, onProgress, reject));
  }

  /** The best surface of a stream in memory. */
  parse(
    bytes: ArrayBuffer | Uint8Array,
    onLoad: (geometry: BufferGeometry) => void,
    onError: (reason: unknown) => void = console.error,
  ): void {
    this.#parse(new Uint8Array(bytes as ArrayBuffer))
      .then(onLoad)
      .catch(onError);
  }

  dispose(): void {
    void this.#decoder?.then((decoder) => decoder.dispose()).catch(() => {});
    this.#decoder = undefined;
  }

  async #load(
    address: string,
    onProgress?: (event: IsostarProgress) => void,
  ): Promise<BufferGeometry> {
    const decoder = this.#ready();
    const isOpen = this.withCredentials || this.crossOrigin !== 'anonymous';
    const options = {
      headers: this.requestHeader,
      credentials: isOpen ? ('include' as const) : ('same-origin' as const),
    };
    const source = this.#surfaceOptions.region
      ? new RangeSource(address, options)
      : await fetch(address, options);
    return this.#decode(await decoder, source, onProgress);
  }

  async #parse(bytes: Uint8Array): Promise<BufferGeometry> {
    return this.#decode(await this.#ready(), bytes);
  }

  async #decode(
    decoder: Decoder,
    source: Source,
    onProgress?: (event: IsostarProgress) => void,
  ): Promise<BufferGeometry> {
    const geometry = new BufferGeometry();
    const options = this.#surfaceOptions;
    const refinements = options.refinements ?? (onProgress ? 'newest' : 'last');
    for await (const surface of decoder.decode(source, { ...options, refinements })) {
      showSurface(geometry, surface, options);
      if (!onProgress) continue;
      const progress = new ProgressEvent('progress', {
        lengthComputable: true,
        loaded: surface.bytes,
        total: surface.info.bytes,
      });
      onProgress(Object.assign(progress, { geometry, surface }));
    }
    return geometry;
  }

  #ready(): Promise<Decoder> {
    if (this.#decoder) return this.#decoder;
    const decoder = createDecoder(this.#decoderOptions);
    const forget = () => {
      if (this.#decoder === decoder) this.#decoder = undefined; // the next load() tries again
    };
    decoder.catch(forget);
    return (this.#decoder = decoder);
  }
}

/** Replaces a geometry's contents by a surface. */
export function showSurface(
  geometry: BufferGeometry,
  surface: Surface,
  { frame }: SurfaceOptions = {},
): void {
  geometry.dispose(); // frees the buffers of the previous surface
  geometry.setAttribute('position', new BufferAttribute(surface.positions, 3));
  if (surface.normals.length > 0)
    geometry.setAttribute('normal', new BufferAttribute(surface.normals, 3));
  else geometry.deleteAttribute('normal');
  geometry.setIndex(new BufferAttribute(surface.indices, 1));
  const [minimum, maximum] = boundsOf(surface.info, frame);
  geometry.boundingBox = new Box3(new Vector3(...minimum), new Vector3(...maximum));
  geometry.boundingSphere = geometry.boundingBox.getBoundingSphere(new Sphere());
}

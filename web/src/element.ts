import type { Decoder, Polygonizer, Surface } from './index.js';
import { createDecoder } from './index.js';
import { SurfaceView } from './display/surface-view.js';

const STYLE = `
  :host { display: block; position: relative; width: 300px; height: 300px; contain: content; }
  :host([hidden]) { display: none; }
  canvas { display: block; width: 100%; height: 100%; }
  canvas:focus-visible { outline: 2px solid Highlight; outline-offset: -2px; }
  progress { position: absolute; inset: 0 0 auto; width: 100%; height: 3px; border: 0; }
  progress { appearance: none; background: transparent; }
  progress::-webkit-progress-bar { background: transparent; }
  progress[hidden] { display: none; }
`;

// All elements of a page share one worker.
let sharedDecoder: Promise<Decoder> | undefined;

// On a server there is no HTMLElement, and an import must not fail there.
const Base = (globalThis.HTMLElement ?? class {}) as typeof HTMLElement;

/**
 * `<isostar-surface src="skull.isostar" alt="A skull" camera-controls></isostar-surface>`
 *
 * Attributes: `src`, `alt`, `polygonizer`, `camera-controls`, `camera-orbit="30deg 80deg 100%"`,
 * `auto-rotate`, `loading="lazy"`. Events: `progress` (detail.totalProgress 0 … 1), `level`
 * (detail: the surface), `load`, `error` (detail.type, detail.sourceError), `camera-change`. Parts:
 * `canvas`, `progress-bar`. The CSS property `--surface-color` sets the surface's colour.
 */
export class IsostarSurfaceElement extends Base {
  static readonly observedAttributes = [
    'src',
    'alt',
    'polygonizer',
    'camera-controls',
    'camera-orbit',
    'auto-rotate',
  ];

  #canvas: HTMLCanvasElement | undefined;
  #progress: HTMLProgressElement | undefined;
  #view: SurfaceView | undefined;
  #run = new AbortController();
  #visibility: IntersectionObserver | undefined;
  #surface: Surface | undefined;

  /** The surface on display. */
  get surface(): Surface | undefined {
    return this.#surface;
  }

  get src(): string | null {
    return this.getAttribute('src');
  }
  set src(value: string | null) {
    this.#reflect('src', value);
  }

  get alt(): string | null {
    return this.getAttribute('alt');
  }
  set alt(value: string | null) {
    this.#reflect('alt', value);
  }

  connectedCallback(): void {
    this.#build();
    this.#view = new SurfaceView(this.#canvas!, () =>
      this.dispatchEvent(new CustomEvent('camera-change')),
    );
    this.#configure();
    if (this.getAttribute('loading') !== 'lazy') return void this.#load();
    this.#visibility = new IntersectionObserver((entries) => {
      if (!entries.some(({ isIntersecting }) => isIntersecting)) return;
      this.#visibility?.disconnect();
      void this.#load();
    });
    this.#visibility.observe(this);
  }

  disconnectedCallback(): void {
    this.#run.abort();
    this.#visibility?.disconnect();
    this.#view?.dispose();
    this.#view = undefined;
  }

  attributeChangedCallback(name: string): void {
    if (!this.#view) return;
    if (name === 'src') this.#view.expectNewSubject();
    if (name === 'src' || name === 'polygonizer') void this.#load();
    else this.#configure();
  }

  // A new canvas each time: one whose context was released cannot have another.
  #build(): void {
    const root = this.shadowRoot ?? this.attachShadow({ mode: 'open' });
    // A <style> element would fail under a strict content security policy.
    const sheet = new CSSStyleSheet();
    sheet.replaceSync(STYLE);
    root.adoptedStyleSheets = [sheet];
    this.#canvas = document.createElement('canvas');
    this.#progress = document.createElement('progress');
    this.#canvas.part.add('canvas');
    this.#progress.part.add('progress-bar');
    this.#progress.hidden = true;
    root.replaceChildren(this.#canvas, this.#progress);
  }

  #configure(): void {
    const isInteractive = this.hasAttribute('camera-controls');
    const canvas = this.#canvas!;
    canvas.setAttribute('role', isInteractive ? 'application' : 'img');
    if (isInteractive) canvas.setAttribute('aria-roledescription', '3D viewer');
    else canvas.removeAttribute('aria-roledescription');
    canvas.setAttribute('aria-label', this.alt ?? '');
    canvas.tabIndex = isInteractive ? 0 : -1;
    this.#view!.configure({
      isInteractive,
      isRotating: this.hasAttribute('auto-rotate'),
      orbit: this.getAttribute('camera-orbit') ?? undefined,
      color: getComputedStyle(this).getPropertyValue('--surface-color').trim() || '#e9dcc3',
    });
  }

  async #load(): Promise<void> {
    this.#run.abort();
    this.#run = new AbortController();
    const { signal } = this.#run;
    const { src } = this;
    if (!src) return;
    this.#progress!.hidden = false;
    this.#progress!.value = 0;
    try {
      sharedDecoder ??= createDecoder();
      const decoder = await sharedDecoder.catch((reason) => {
        sharedDecoder = undefined; // the next element tries again
        throw reason;
      });
      const response = await fetch(new URL(src, document.baseURI), { signal });
      const polygonizer = (this.getAttribute('polygonizer') ?? 'cubes') as Polygonizer;
      for await (const surface of decoder.decode(response, { signal, polygonizer }))
        this.#show(surface);
      this.dispatchEvent(new CustomEvent('load', { detail: { url: src } }));
    } catch (sourceError) {
      if (!signal.aborted)
        this.dispatchEvent(
          new CustomEvent('error', { detail: { type: 'loadfailure', sourceError } }),
        );
    } finally {
      if (!signal.aborted) this.#progress!.hidden = true;
    }
  }

  #show(surface: Surface): void {
    this.#surface = surface;
    this.#view?.show(surface);
    const totalProgress = surface.bytes / surface.info.bytes;
    this.#progress!.value = totalProgress;
    this.dispatchEvent(
      new CustomEvent('progress', {
        detail: { totalProgress, level: surface.level, levels: surface.levels },
      }),
    );
    this.dispatchEvent(new CustomEvent('level', { detail: surface }));
  }

  #reflect(name: string, value: string | null): void {
    if (value === null) this.removeAttribute(name);
    else this.setAttribute(name, value);
  }
}

globalThis.customElements?.define('isostar-surface', IsostarSurfaceElement);

declare global {
  interface HTMLElementTagNameMap {
    'isostar-surface': IsostarSurfaceElement;
  }
}

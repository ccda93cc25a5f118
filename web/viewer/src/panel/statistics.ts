import { bytes, duration, integer, short } from './format.ts';

/** The figures of one side that are known so far. */
export interface Figures {
  bytes?: number;
  /** Of the surface that marching cubes makes; both sides' bits are divided by it. */
  sourceVertices?: number;
  error?: number;
  level?: string;
  vertices?: number;
  triangles?: number;
  first?: number;
  complete?: number;
  decode?: number;
  polygonize?: number;
}

type Row = readonly [
  key: string,
  label: string,
  unit: string,
  value: (figures: Figures) => string | undefined,
];

const ROWS: readonly Row[] = [
  ['bytes', 'Bytes shown', '', (f) => (f.bytes === undefined ? undefined : bytes(f.bytes))],
  [
    'bits',
    'Bits per vertex',
    '',
    (f) =>
      f.bytes === undefined || !f.sourceVertices
        ? undefined
        : short((8 * f.bytes) / f.sourceVertices),
  ],
  [
    'error',
    'RMS error',
    'grid steps',
    (f) => (f.error === undefined ? undefined : f.error.toFixed(3)),
  ],
  ['level', 'Level', '', (f) => f.level],
  ['vertices', 'Vertices', '', (f) => (f.vertices === undefined ? undefined : integer(f.vertices))],
  [
    'triangles',
    'Triangles',
    '',
    (f) => (f.triangles === undefined ? undefined : integer(f.triangles)),
  ],
  [
    'first',
    'First surface',
    'after',
    (f) => (f.first === undefined ? undefined : duration(f.first)),
  ],
  [
    'complete',
    'Complete',
    'after',
    (f) => (f.complete === undefined ? undefined : duration(f.complete)),
  ],
  ['decode', 'Decode', '', (f) => (f.decode === undefined ? undefined : duration(f.decode))],
  [
    'polygonize',
    'Polygonize',
    'or normals',
    (f) => (f.polygonize === undefined ? undefined : duration(f.polygonize)),
  ],
];

/** The table beside the view, and the two bars above it. */
export class Statistics {
  readonly #cells = new Map<string, HTMLElement>();
  readonly #headline: HTMLElement;

  constructor(table: HTMLTableElement, headline: HTMLElement) {
    this.#headline = headline;
    for (const [key, label, unit] of ROWS) {
      const row = table.tBodies[0]!.insertRow();
      const head = document.createElement('th');
      head.scope = 'row';
      head.append(label);
      if (unit)
        head.append(' ', Object.assign(document.createElement('small'), { textContent: unit }));
      row.append(head);
      for (const side of ['isostar', 'draco']) {
        const cell = row.insertCell();
        cell.dataset.column = side;
        cell.dataset.stat = `${side}-${key}`;
        this.#cells.set(cell.dataset.stat, cell);
      }
    }
  }

  show(side: 'isostar' | 'draco', figures: Figures): void {
    for (const [key, , , value] of ROWS)
      this.#cells.get(`${side}-${key}`)!.textContent = value(figures) ?? '–';
  }

  /** The sizes of both files, and when each side showed its first surface. */
  compare(
    sizes: { isostar: number; draco: number } | undefined,
    ourFirst?: number,
    theirFirst?: number,
  ): void {
    this.#headline.hidden = !sizes;
    if (!sizes) return;
    const { isostar, draco } = sizes;
    for (const [side, size] of Object.entries(sizes)) {
      this.#headline.querySelector(`[data-size=${side}]`)!.textContent = bytes(size);
      this.#headline.querySelector<HTMLElement>(`[data-bar=${side}]`)!.style.transform =
        `scaleX(${size / Math.max(isostar, draco)})`;
    }
    const ratio = this.#headline.querySelector('[data-role=ratio]')!;
    ratio.textContent =
      isostar < draco ? `${short(draco / isostar)}× smaller` : `${short(isostar / draco)}× larger`;
    if (ourFirst === undefined || theirFirst === undefined || ourFirst > 0.95 * theirFirst) return;
    ratio.append(
      Object.assign(document.createElement('small'), {
        textContent: `first surface ${short(theirFirst / ourFirst)}× sooner`,
      }),
    );
  }
}

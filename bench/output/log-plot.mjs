// Plots with two logarithmic axes, as SVG.

/** `<name key="value" …>content</name>`; undefined attributes are left out. */
export function element(name, attributes, content) {
  const given = Object.entries(attributes).filter(([, value]) => value !== undefined);
  const head = [name, ...given.map(([key, value]) => `${key}="${value}"`)].join(' ');
  return content === undefined ? `<${head}/>` : `<${head}>${content}</${name}>`;
}

export const escape = (text) => text.replace(/&/g, '&amp;').replace(/</g, '&lt;');
const pixels = (number) => number.toFixed(1);

/** The powers of ten between two numbers. */
function decades({ low, high }) {
  const ticks = [];
  for (let power = Math.ceil(Math.log10(low)); 10 ** power <= high; power++)
    ticks.push(10 ** power);
  return ticks;
}

/** A logarithmic scale from numbers to pixels, with a margin at both ends. */
function scale(numbers, from, to) {
  const low = Math.min(...numbers) / 1.15;
  const high = Math.max(...numbers) * 1.15;
  const toPixels = (number) => from + ((to - from) * Math.log(number / low)) / Math.log(high / low);
  return Object.assign(toPixels, { low, high });
}

function byteLabel(bytes) {
  if (bytes >= 1e6) return `${bytes / 1e6} MB`;
  return bytes >= 1e3 ? `${bytes / 1e3} kB` : `${bytes} B`;
}

/** Bytes from left to right, distances from bottom to top. */
export class LogPlot {
  #box;
  #x;
  #y;

  /** `box`: { left, right, top, bottom } in pixels; `bytes` and `distances`: what has to fit in. */
  constructor(box, bytes, distances) {
    this.#box = box;
    this.#x = scale(bytes, box.left, box.right);
    this.#y = scale(distances, box.bottom, box.top);
  }

  /** Frame, grid, labels; `titleOffset`: of the word "bytes", below the box. */
  axes(titleOffset) {
    const { left, right, top, bottom } = this.#box;
    const [width, height] = [right - left, bottom - top];
    const title = { x: (left + right) / 2, y: bottom + titleOffset, 'text-anchor': 'middle' };
    return [
      element('rect', { x: left, y: top, width, height, fill: 'none', stroke: '#c4c9d0' }),
      ...decades(this.#x).map((tick) => this.#bytesTick(tick)),
      ...decades(this.#y).map((tick) => this.#distanceTick(tick)),
      element('text', title, 'bytes'),
    ].join('\n');
  }

  /** A line through points { bytes, distance, isMarked }, with discs at those marked. */
  curve(points, { colour, width, dash }, radius) {
    const line = points.map(({ bytes, distance }) => this.#at(bytes, distance).join(',')).join(' ');
    const discs = points.filter(({ isMarked }) => isMarked);
    return [
      element('polyline', {
        points: line,
        fill: 'none',
        stroke: colour,
        'stroke-width': width,
        'stroke-linejoin': 'round',
        'stroke-dasharray': dash,
      }),
      ...discs.map(({ bytes, distance }) => {
        const [cx, cy] = this.#at(bytes, distance);
        return element('circle', { cx, cy, r: radius, fill: colour });
      }),
    ].join('');
  }

  #at(bytes, distance) {
    return [pixels(this.#x(bytes)), pixels(this.#y(distance))];
  }

  #bytesTick(tick) {
    const { top, bottom } = this.#box;
    const x = pixels(this.#x(tick));
    const line = { x1: x, x2: x, y1: top, y2: bottom, class: 'grid' };
    const label = { x, y: bottom + 17, 'text-anchor': 'middle' };
    return element('line', line) + element('text', label, byteLabel(tick));
  }

  #distanceTick(tick) {
    const { left, right } = this.#box;
    const y = this.#y(tick);
    const line = { x1: left, x2: right, y1: pixels(y), y2: pixels(y), class: 'grid' };
    const label = { x: left - 8, y: pixels(y + 4), 'text-anchor': 'end' };
    return element('line', line) + element('text', label, Number(tick.toPrecision(1)));
  }
}

export function legendEntry(x, y, { title, colour, width, dash }) {
  const style = { stroke: colour, 'stroke-width': width, 'stroke-dasharray': dash };
  const line = element('line', { x1: x, x2: x + 26, y1: y, y2: y, ...style });
  return line + element('text', { x: x + 32, y: y + 4 }, title);
}

/** A whole SVG file. */
export function svgFile(width, height, style, parts) {
  const attributes = {
    xmlns: 'http://www.w3.org/2000/svg',
    viewBox: `0 0 ${width} ${height}`,
    width,
    height,
    'font-family': 'system-ui, sans-serif',
    'font-size': 12,
    fill: '#30363d',
  };
  const lines = [
    element('style', {}, style),
    element('rect', { width, height, fill: '#fff' }),
    ...parts,
  ];
  return `${element('svg', attributes, `\n${lines.join('\n')}\n`)}\n`;
}

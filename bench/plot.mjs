// Distance over bytes, both logarithmic, as an SVG of two panels.

const PANEL = { width: 470, height: 400, left: 62, right: 14, top: 44, bottom: 46 };
const STYLES = {
  meshopt: { title: 'meshoptimizer + zstd', colour: '#8a8f98', dash: '2 3', width: 1.5 },
  draco7: { title: 'Draco 7', colour: '#f0a030', dash: '6 3', width: 1.5 },
  draco10: { title: 'Draco 10', colour: '#d1432b', width: 1.8 },
  simplified: { title: 'simplify × Draco', colour: '#2c8a4b', width: 1.8 },
  bounds: { title: 'isostar, by bound', colour: '#6ea8fe', dash: '5 3', width: 1.8 },
  isostar: { title: 'isostar, any prefix', colour: '#1656c9', width: 2.4 },
};
const HIGHEST = { rms: 3, max: 30 };

const isShown = (key) => (point) => point[key] > 0 && point[key] <= HIGHEST[key];
const escape = (words) => words.replace(/&/g, '&amp;').replace(/</g, '&lt;');
const decades = (low, high) => {
  const ticks = [];
  for (let power = Math.ceil(Math.log10(low)); 10 ** power <= high; power++) ticks.push(10 ** power);
  return ticks;
};
const byteLabel = (bytes) => (bytes >= 1e6 ? `${bytes / 1e6} MB` : bytes >= 1e3 ? `${bytes / 1e3} kB` : `${bytes} B`);

/** A logarithmic scale from numbers to pixels, with a little room at both ends. */
function scale(numbers, from, to) {
  const low = Math.min(...numbers) / 1.15, high = Math.max(...numbers) * 1.15;
  const place = (number) => from + ((to - from) * Math.log(number / low)) / Math.log(high / low);
  return Object.assign(place, { low, high });
}

function panel(series, key, offset, heading) {
  const shown = series.map((one) => ({ ...one, points: one.points.filter(isShown('rms')).filter(isShown(key)) }));
  const points = shown.flatMap((one) => one.points);
  const x = scale(series.flatMap((one) => one.points.filter(isShown('rms'))).map((point) => point.bytes), offset + PANEL.left, offset + PANEL.width - PANEL.right);
  const y = scale(points.map((point) => point[key]), PANEL.height - PANEL.bottom, PANEL.top);
  const [left, right, bottom, top] = [offset + PANEL.left, offset + PANEL.width - PANEL.right, PANEL.height - PANEL.bottom, PANEL.top];
  const at = (point) => `${x(point.bytes).toFixed(1)},${y(point[key]).toFixed(1)}`;
  return [
    `<text x="${left}" y="${top - 12}" class="heading">${heading}</text>`,
    `<rect x="${left}" y="${top}" width="${right - left}" height="${bottom - top}" fill="none" stroke="#c4c9d0"/>`,
    ...decades(x.low, x.high).map((tick) =>
      `<line x1="${x(tick)}" x2="${x(tick)}" y1="${top}" y2="${bottom}" class="grid"/><text x="${x(tick)}" y="${bottom + 17}" text-anchor="middle">${byteLabel(tick)}</text>`),
    ...decades(y.low, y.high).map((tick) =>
      `<line x1="${left}" x2="${right}" y1="${y(tick)}" y2="${y(tick)}" class="grid"/><text x="${left - 8}" y="${y(tick) + 4}" text-anchor="end">${Number(tick.toPrecision(1))}</text>`),
    `<text x="${(left + right) / 2}" y="${bottom + 37}" text-anchor="middle">bytes</text>`,
    ...shown.map(({ points: line, colour, width, dash, marks }) => [
      `<polyline points="${line.map(at).join(' ')}" fill="none" stroke="${colour}" stroke-width="${width}" stroke-linejoin="round"${dash ? ` stroke-dasharray="${dash}"` : ''}/>`,
      ...line.filter((point) => !marks || marks(point)).map((point) => `<circle cx="${x(point.bytes).toFixed(1)}" cy="${y(point[key]).toFixed(1)}" r="${marks ? 4 : 2}" fill="${colour}"/>`),
    ].join('')),
  ].join('\n');
}

function legend(series, row) {
  let x = PANEL.left;
  return series.map(({ title, colour, width, dash }) => {
    const entry = `<line x1="${x}" x2="${x + 26}" y1="${row}" y2="${row}" stroke="${colour}" stroke-width="${width}"${dash ? ` stroke-dasharray="${dash}"` : ''}/><text x="${x + 32}" y="${row + 4}">${title}</text>`;
    x += 48 + 6.3 * title.length;
    return entry;
  }).join('\n');
}

export function plot(name, curves) {
  const series = Object.entries(STYLES)
    .filter(([key]) => curves[key]?.length)
    .map(([key, style]) => ({ ...style, points: curves[key], marks: key === 'isostar' ? (point) => point.layerEnd : undefined }));
  const [width, height] = [2 * PANEL.width, PANEL.height + 34];
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${width} ${height}" width="${width}" height="${height}" font-family="system-ui, sans-serif" font-size="12" fill="#30363d">
<style>.grid { stroke: #e6e9ed } .heading { font-size: 14px; font-weight: 600 }</style>
<rect width="${width}" height="${height}" fill="#fff"/>
${panel(series, 'rms', 0, `${escape(name)}: RMS distance, grid steps`)}
${panel(series, 'max', PANEL.width, 'largest distance')}
${legend([...series].reverse(), PANEL.height + 14)}
</svg>
`;
}

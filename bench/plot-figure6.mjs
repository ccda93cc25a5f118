// One panel of figure 6: RMS distance over bytes, both logarithmic, as a small SVG.

export const CODERS = {
  prefixes: { title: 'uniform, prefixes', colour: '#1656c9', width: 2.2, progressive: true },
  uniform: { title: 'uniform, by bound', colour: '#6ea8fe', width: 1.8, dash: '5 3' },
  adaptive: { title: 'adaptive, by bound', colour: '#2c8a4b', width: 1.8 },
  singleRate: { title: 'single rate', colour: '#d1432b', width: 1.8 },
  octree: { title: 'octree', colour: '#8a5a00', width: 1.8, dash: '2 2', progressive: true },
};
const FRAME = { width: 560, height: 400, left: 62, right: 16, top: 40, bottom: 84 };
const HIGHEST = 3;  // grid steps; above there is little to see

const decades = (low, high) => {
  const ticks = [];
  for (let power = Math.ceil(Math.log10(low)); 10 ** power <= high; power++) ticks.push(10 ** power);
  return ticks;
};
const label = (bytes) => (bytes >= 1e6 ? `${bytes / 1e6} MB` : bytes >= 1e3 ? `${bytes / 1e3} kB` : `${bytes} B`);

function scale(numbers, from, to) {
  const low = Math.min(...numbers) / 1.15, high = Math.max(...numbers) * 1.15;
  return Object.assign((number) => from + ((to - from) * Math.log(number / low)) / Math.log(high / low), { low, high });
}

const path = (points, x, y) => points.map((point) => `${x(point.bytes).toFixed(1)},${y(point.rms).toFixed(1)}`).join(' ');

export function plotFigure6(name, curves) {
  const drawn = Object.entries(CODERS)
    .map(([key, style]) => ({ ...style, points: curves[key].filter(({ rms }) => rms > 0 && rms <= HIGHEST).sort((a, b) => a.bytes - b.bytes) }))
    .filter(({ points }) => points.length > 0);
  const points = drawn.flatMap((one) => one.points);
  const [left, right, top, bottom] = [FRAME.left, FRAME.width - FRAME.right, FRAME.top, FRAME.height - FRAME.bottom];
  const x = scale(points.map(({ bytes }) => bytes), left, right);
  const y = scale(points.map(({ rms }) => rms), bottom, top);
  const lines = drawn.map(({ points: line, colour, width, dash }) => [
    `<polyline points="${path(line, x, y)}" fill="none" stroke="${colour}" stroke-width="${width}" stroke-linejoin="round"${dash ? ` stroke-dasharray="${dash}"` : ''}/>`,
    ...line.filter((point) => point.layerEnd !== false).map((point) => `<circle cx="${x(point.bytes).toFixed(1)}" cy="${y(point.rms).toFixed(1)}" r="2.5" fill="${colour}"/>`),
  ].join(''));
  const legend = drawn.map(({ title, colour, width, dash }, place) => {
    const [at, row] = [left + (place % 3) * 165, bottom + 56 + 18 * Math.floor(place / 3)];
    return `<line x1="${at}" x2="${at + 26}" y1="${row}" y2="${row}" stroke="${colour}" stroke-width="${width}"${dash ? ` stroke-dasharray="${dash}"` : ''}/><text x="${at + 32}" y="${row + 4}">${title}</text>`;
  });
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${FRAME.width} ${FRAME.height}" width="${FRAME.width}" height="${FRAME.height}" font-family="system-ui, sans-serif" font-size="12" fill="#30363d">
<style>.grid { stroke: #e6e9ed }</style>
<rect width="${FRAME.width}" height="${FRAME.height}" fill="#fff"/>
<text x="${left}" y="${top - 14}" font-size="14" font-weight="600">${name}: RMS distance, grid steps</text>
<rect x="${left}" y="${top}" width="${right - left}" height="${bottom - top}" fill="none" stroke="#c4c9d0"/>
${decades(x.low, x.high).map((tick) => `<line x1="${x(tick).toFixed(1)}" x2="${x(tick).toFixed(1)}" y1="${top}" y2="${bottom}" class="grid"/><text x="${x(tick).toFixed(1)}" y="${bottom + 17}" text-anchor="middle">${label(tick)}</text>`).join('\n')}
${decades(y.low, y.high).map((tick) => `<line x1="${left}" x2="${right}" y1="${y(tick).toFixed(1)}" y2="${y(tick).toFixed(1)}" class="grid"/><text x="${left - 8}" y="${(y(tick) + 4).toFixed(1)}" text-anchor="end">${Number(tick.toPrecision(1))}</text>`).join('\n')}
<text x="${(left + right) / 2}" y="${bottom + 34}" text-anchor="middle">bytes</text>
${lines.join('\n')}
${legend.join('\n')}
</svg>
`;
}

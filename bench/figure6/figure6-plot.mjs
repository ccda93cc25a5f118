// One panel of figure 6: RMS distance over bytes, as a small SVG.
import { element, escape, legendEntry, LogPlot, svgFile } from '../output/log-plot.mjs';

export const CODERS = {
  prefixes: { title: 'uniform, prefixes', colour: '#1656c9', width: 2.2, progressive: true },
  uniform: { title: 'uniform, by bound', colour: '#6ea8fe', width: 1.8, dash: '5 3' },
  adaptive: { title: 'adaptive, by bound', colour: '#2c8a4b', width: 1.8 },
  singleRate: { title: 'single rate', colour: '#d1432b', width: 1.8 },
  octree: { title: 'octree', colour: '#8a5a00', width: 1.8, dash: '2 2', progressive: true },
};
const [WIDTH, HEIGHT] = [560, 400];
const BOX = { left: 62, right: WIDTH - 16, top: 40, bottom: HEIGHT - 84 };
const HIGHEST = 3; // grid steps; greater distances are not drawn
const COLUMNS = 3; // of the legend

const drawnPoints = (points) =>
  points
    .filter(({ rms }) => rms > 0 && rms <= HIGHEST)
    .sort((a, b) => a.bytes - b.bytes)
    .map(({ bytes, rms, layerEnd }) => ({ bytes, distance: rms, isMarked: layerEnd !== false }));

export function plotFigure6(name, curves) {
  const drawn = Object.entries(CODERS)
    .map(([key, style]) => ({ style, points: drawnPoints(curves[key]) }))
    .filter(({ points }) => points.length > 0);
  const points = drawn.flatMap((curve) => curve.points);
  const plot = new LogPlot(
    BOX,
    points.map(({ bytes }) => bytes),
    points.map(({ distance }) => distance),
  );
  const heading = { x: BOX.left, y: BOX.top - 14, 'font-size': 14, 'font-weight': 600 };
  return svgFile(WIDTH, HEIGHT, '.grid { stroke: #e6e9ed }', [
    element('text', heading, `${escape(name)}: RMS distance, grid steps`),
    plot.axes(34),
    ...drawn.map((curve) => plot.curve(curve.points, curve.style, 2.5)),
    ...drawn.map(({ style }, i) => {
      const [column, row] = [i % COLUMNS, Math.floor(i / COLUMNS)];
      return legendEntry(BOX.left + column * 165, BOX.bottom + 56 + 18 * row, style);
    }),
  ]);
}

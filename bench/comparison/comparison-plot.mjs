// Distance over bytes, as an SVG of two panels: RMS and largest distance.
import { element, escape, legendEntry, LogPlot, svgFile } from '../output/log-plot.mjs';

const PANEL = { width: 470, height: 400, left: 62, right: 14, top: 44, bottom: 46 };
const STYLES = {
  meshopt: { title: 'meshoptimizer + zstd', colour: '#8a8f98', dash: '2 3', width: 1.5 },
  draco7: { title: 'Draco 7', colour: '#f0a030', dash: '6 3', width: 1.5 },
  draco10: { title: 'Draco 10', colour: '#d1432b', width: 1.8 },
  simplified: { title: 'simplify × Draco', colour: '#2c8a4b', width: 1.8 },
  bounds: { title: 'isostar, by bound', colour: '#6ea8fe', dash: '5 3', width: 1.8 },
  isostar: { title: 'isostar, any prefix', colour: '#1656c9', width: 2.4 },
};
const HIGHEST = { rms: 3, max: 30 }; // grid steps; greater distances are not drawn
const CSS = '.grid { stroke: #e6e9ed } .heading { font-size: 14px; font-weight: 600 }';

const isDrawn = (key) => (point) => point[key] > 0 && point[key] <= HIGHEST[key];

/** Both panels have the same range of bytes. */
function panel(series, key, offset, heading) {
  const box = {
    left: offset + PANEL.left,
    right: offset + PANEL.width - PANEL.right,
    top: PANEL.top,
    bottom: PANEL.height - PANEL.bottom,
  };
  const withRms = series.map((one) => ({ ...one, points: one.points.filter(isDrawn('rms')) }));
  const drawn = withRms.map((one) => ({ ...one, points: one.points.filter(isDrawn(key)) }));
  const plot = new LogPlot(
    box,
    withRms.flatMap(({ points }) => points.map(({ bytes }) => bytes)),
    drawn.flatMap(({ points }) => points.map((point) => point[key])),
  );
  const curve = ({ points, style, hasLayers }) =>
    plot.curve(
      points.map((point) => ({
        bytes: point.bytes,
        distance: point[key],
        isMarked: !hasLayers || point.layerEnd,
      })),
      style,
      hasLayers ? 4 : 2,
    );
  return [
    element('text', { x: box.left, y: box.top - 12, class: 'heading' }, heading),
    plot.axes(37),
    ...drawn.map(curve),
  ].join('\n');
}

function legend(styles, row) {
  let x = PANEL.left;
  return styles.map((style) => {
    const entry = legendEntry(x, row, style);
    x += 48 + 6.3 * style.title.length;
    return entry;
  });
}

export function plot(name, curves) {
  const series = Object.entries(STYLES)
    .filter(([key]) => curves[key]?.length)
    .map(([key, style]) => ({ style, points: curves[key], hasLayers: key === 'isostar' }));
  return svgFile(2 * PANEL.width, PANEL.height + 34, CSS, [
    panel(series, 'rms', 0, `${escape(name)}: RMS distance, grid steps`),
    panel(series, 'max', PANEL.width, 'largest distance'),
    ...legend(series.map(({ style }) => style).reverse(), PANEL.height + 14),
  ]);
}

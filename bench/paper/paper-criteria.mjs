// The targets of adaptive streams, preserved topology, further isovalues, tetrahedral meshes and
// images: { what, target, measured, met }.
import { bytesAt, envelope } from '../measure/rate-curve.mjs';
import { fixed, kilobytes, significant } from '../output/markdown.mjs';

const ROUNDING = 1e-3; // grid steps: coordinates are floats
const FIRST_PICTURE = 30; // bytes

/** The smallest uniform stream at a distance: a prefix of the default one, or another bound's. */
const uniformAt = ({ prefixes, bounds }, rms) =>
  smallest(bytesAt(prefixes, rms), bytesAt(envelope([...bounds, prefixes.at(-1)]), rms));
const simplifiedAt = ({ draco, simplified }, rms) =>
  bytesAt(envelope([...draco, ...simplified]), rms);

function smallest(...sizes) {
  const known = sizes.filter((size) => size !== undefined);
  return known.length ? Math.min(...known) : undefined;
}

/** Bytes of an adaptive stream, and of others at the same RMS distance. */
export function adaptiveFigures(one) {
  const { bytes, rms, max } = one.adaptive;
  return {
    name: one.name,
    bytes,
    rms,
    max,
    sameBound: one.uniform,
    uniform: uniformAt(one, rms),
    simplified: simplifiedAt(one, rms),
  };
}

/**
 * Bytes and distances of a tetrahedral mesh's stream, in the mesh's unit; Draco encodes the
 * isosurface of the tetrahedra.
 */
export function tetrahedraFigures(one) {
  const { name, isovalue, worldBound } = one;
  const inSteps = Math.max(one.there.rms, one.back.rms);
  const world = ({ rms, max }) => ({ rms: rms * one.step, max: max * one.step });
  const [there, back] = [world(one.there), world(one.back)];
  return {
    name: `${name} ${isovalue}${worldBound ? ` --max-error ${worldBound} --units world` : ''}`,
    grid: one.size.join(' × '),
    bytes: one.bytes,
    bound: worldBound ?? one.bound * one.step,
    there,
    back,
    rms: inSteps * one.step,
    dracoBytes: bytesAt(envelope(one.draco), inSteps),
    simplifiedBytes: simplifiedAt(one, inSteps),
  };
}

export const furtherShare = ({ bytes, otherBytes, together }) => (together - bytes) / otherBytes;

/** Do all layers' surfaces have as many components and the same genus as the last one's? */
export function keepsTopology({ layers }) {
  const last = layers.at(-1);
  return (
    last.genus !== null &&
    layers.every(({ components, genus }) => components === last.components && genus === last.genus)
  );
}

function atMost(what, target, ratio, detail) {
  if (ratio === undefined || Number.isNaN(ratio))
    return {
      what,
      target: `≤ ${fixed(target, 2)}`,
      measured: 'the others do not reach it',
      met: undefined,
    };
  return {
    what,
    target: `≤ ${fixed(target, 2)}`,
    measured: `${fixed(ratio, 2)} (${detail})`,
    met: ratio <= target,
  };
}

function adaptiveCriteria(bound, one) {
  const { bytes, rms, max, uniform, simplified } = adaptiveFigures(one);
  const what = `${one.name} --adaptive --max-error ${bound}`;
  return [
    {
      what: `${what}: distance both ways`,
      target: `≤ ${bound}`,
      measured: significant(max),
      met: max <= bound + ROUNDING,
    },
    atMost(
      `${what}: bytes against uniform at equal RMS`,
      0.5,
      uniform && bytes / uniform,
      `${kilobytes(bytes)} and ${kilobytes(uniform)} kB at ${significant(rms)}`,
    ),
    atMost(
      `${what}: against simplify × Draco`,
      1,
      simplified && bytes / simplified,
      `${kilobytes(bytes)} and ${kilobytes(simplified)} kB at ${significant(rms)}`,
    ),
  ];
}

function topologyCriterion(one) {
  const { components, genus } = one.layers.at(-1);
  const like = one.layers.filter(
    (layer) => layer.components === components && layer.genus === genus,
  ).length;
  const price = fixed(100 * (one.bytes / one.uniform - 1), 1);
  return {
    what: `${one.name} --preserve-topology: components and genus of the last layer`,
    target: 'every layer',
    measured:
      `${like} of ${one.layers.length}: ${components}, ${genus ?? 'not manifold'};` +
      ` ${price} % more bytes`,
    met: keepsTopology(one),
  };
}

function tetrahedraCriteria(one) {
  const { name, bytes, bound, rms, there, back, dracoBytes } = tetrahedraFigures(one);
  const met = Math.max(there.max, back.max) <= bound + ROUNDING * one.step;
  return [
    {
      what: `${name}: distance both ways`,
      target: `≤ ${significant(bound)}`,
      measured: `${significant(there.max)} there, ${significant(back.max)} back`,
      met,
    },
    atMost(
      `${name}: bytes against Draco at equal RMS`,
      1 / 3,
      dracoBytes && bytes / dracoBytes,
      `${kilobytes(bytes)} and ${kilobytes(dracoBytes)} kB at ${significant(rms)}`,
    ),
  ];
}

function imageCriteria({ layers, lossless, bytes }) {
  const [first] = layers;
  const falling = layers.every(({ error }, i) => i === 0 || error < layers[i - 1].error);
  return [
    {
      what: 'image, first contour, bytes',
      target: `< ${FIRST_PICTURE}`,
      measured: String(first.offset),
      met: first.offset < FIRST_PICTURE,
    },
    {
      what: 'image, up to lossless',
      target: 'error falls with each layer',
      measured: `${layers.length} layers, ${bytes} bytes, ${lossless ? 'same' : 'other'} points`,
      met: lossless && falling,
    },
  ];
}

export function paperCriteria({ bound, adaptive, topology, further, tetrahedra, image }) {
  return [
    ...adaptive.flatMap((one) => adaptiveCriteria(bound, one)),
    ...topology.map(topologyCriterion),
    ...further.map((one) =>
      atMost(
        `${one.name} --near ${fixed(one.other, 2)}: its bytes on top, against its own file`,
        0.5,
        furtherShare(one),
        `${kilobytes(one.together - one.bytes)} of ${kilobytes(one.otherBytes)} kB`,
      ),
    ),
    ...tetrahedra.flatMap(tetrahedraCriteria),
    ...image.flatMap(imageCriteria),
  ];
}

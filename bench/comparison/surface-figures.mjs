// Figures of one surface, from its raw measurements: ratios, bits per vertex, distances at equal
// bytes.
import { bytesAt, envelope, errorAt } from '../measure/rate-curve.mjs';

export const ERRORS = [0.01, 0.02, 0.05, 0.1, 0.2]; // RMS, grid steps
const SHARES = [0.02, 0.05, 0.1]; // of the default stream's bytes
const ROUNDING = 1e-3; // grid steps: coordinates are floats

const draco = (raw, level) =>
  raw.draco.filter((point) => point.level === level).sort((a, b) => a.bytes - b.bytes);

/**
 * The curves of a plot. A prefix has the surface of its last complete layer, so isostar's curve
 * keeps every point.
 */
export function curves(raw) {
  const all = {
    isostar: raw.prefixes,
    draco7: draco(raw, 7),
    draco10: envelope(draco(raw, 10)),
    bounds: envelope([...raw.bounds, raw.default]),
  };
  if (!raw.simplified) return all;
  return {
    ...all,
    simplified: envelope([...draco(raw, 10), ...raw.simplified]),
    meshopt: envelope(raw.meshopt),
  };
}

export function figures(raw) {
  const drawn = curves(raw);
  const { bits } = raw.default;
  const first = raw.default.layers[0];
  return {
    vertices: raw.vertices,
    bytes: raw.default.bytes,
    connectivity: bits.connectivity / raw.vertices,
    geometry: bits.geometry / raw.vertices,
    rms: raw.default.rms,
    max: raw.default.max,
    keepsBound: raw.default.max <= raw.default.bound + ROUNDING,
    isLossless: raw.lossless.sameTriangles && raw.lossless.largestDifference <= ROUNDING,
    largestRise: Math.max(
      ...raw.prefixes.slice(1).map((point, i) => point.rms / (raw.prefixes[i].rms ?? Infinity)),
    ),
    firstSurface: first.offset / raw.default.bytes,
    dracoBytes: bytesAt(drawn.draco10, raw.default.rms),
    rate: equalError(drawn),
    ...(raw.simplified && { lowRates: lowRates(raw, drawn), ...prefixCounts(raw, drawn) }),
    ...(raw.times && timeRatios(raw)),
  };
}

/**
 * How many times smaller isostar's stream is at each error: one encoded for it or, if smaller, a
 * prefix of the default one.
 */
function equalError(drawn) {
  return ERRORS.map((rms) => {
    const prefix = bytesAt(drawn.isostar, rms);
    const bytes = Math.min(prefix ?? Infinity, bytesAt(drawn.bounds, rms) ?? Infinity);
    const times = (curve, ours = bytes) => {
      const theirs = curve && bytesAt(curve, rms);
      return theirs && Number.isFinite(ours) ? theirs / ours : undefined;
    };
    return {
      rms,
      bytes: Number.isFinite(bytes) ? Math.round(bytes) : undefined,
      draco10: times(drawn.draco10),
      draco10ByPrefix: times(drawn.draco10, prefix ?? Infinity),
      simplified: times(drawn.simplified),
    };
  });
}

/** Distances of both at small shares of the default stream's bytes. */
function lowRates(raw, drawn) {
  return SHARES.map((share) => {
    const bytes = Math.floor(share * raw.default.bytes);
    const ours = raw.prefixes.findLast((point) => point.bytes <= bytes);
    return { share, bytes, isostar: ours?.rms, simplified: errorAt(drawn.simplified, bytes) };
  });
}

/** The number of prefixes from the smallest share on, and of those farther than the envelope. */
function prefixCounts(raw, drawn) {
  const judged = raw.prefixes.filter(
    (point) => point.bytes >= Math.floor(SHARES[0] * raw.default.bytes),
  );
  const farther = judged.filter(
    (point) => (point.rms ?? Infinity) > (errorAt(drawn.simplified, point.bytes) ?? Infinity),
  );
  return { prefixes: judged.length, farther: farther.length };
}

function timeRatios({ times: { threads, encode, decode }, wasm, memory }) {
  return {
    threads,
    decode: decode.isostarPolygonized / decode.draco7,
    decodeWithNormals: decode.isostarWithNormals / decode.draco7,
    wasm: wasm.isostarPolygonized / wasm.draco7,
    wasmWithNormals: wasm.isostarWithNormals / wasm.draco7,
    decodeInThreads: decode.isostarPolygonizedInThreads / decode.draco7,
    decodeGain: decode.isostarPolygonized / decode.isostarPolygonizedInThreads,
    encode7: encode.isostar / (encode.marchingCubes + encode.draco7),
    encode7InThreads: encode.isostarInThreads / (encode.marchingCubes + encode.draco7),
    encodeGain: encode.isostar / encode.isostarInThreads,
    encode10: encode.isostar / (encode.marchingCubes + encode.draco10),
    memory: memory.isostar / memory.draco,
  };
}

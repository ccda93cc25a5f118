// Curves of points { bytes, rms }, sorted by bytes; the RMS of an empty surface is null. Between
// two points the interpolation is linear in the logarithms of both.

const between = (x, x0, x1, y0, y1) => {
  if (x1 === x0) return y1;
  return y0 * (y1 / y0) ** (Math.log(x / x0) / Math.log(x1 / x0));
};

/** The points that no other point beats in both coordinates, sorted by bytes. */
export function envelope(points) {
  let best = Infinity;
  const sorted = points
    .filter(({ rms }) => rms !== null)
    .sort((a, b) => a.bytes - b.bytes || a.rms - b.rms);
  return sorted.filter(({ rms }) => rms < best && ((best = rms), true));
}

/** Bytes at which the distance is reached; undefined outside the curve. */
export function bytesAt(curve, rms) {
  const found = curve.findIndex((point) => point.rms !== null && point.rms <= rms);
  if (found < 0) return undefined;
  if (found === 0) return curve[0].rms === rms ? curve[0].bytes : undefined;
  const [before, after] = [curve[found - 1], curve[found]];
  return before.rms === null
    ? after.bytes
    : between(rms, before.rms, after.rms, before.bytes, after.bytes);
}

/** The distance at a number of bytes; undefined if even the first point has more bytes. */
export function errorAt(curve, bytes) {
  const found = curve.findIndex((point) => point.bytes > bytes);
  if (found === 0 || curve.length === 0) return undefined;
  if (found < 0) return curve.at(-1).rms;
  const [before, after] = [curve[found - 1], curve[found]];
  return between(bytes, before.bytes, after.bytes, before.rms, after.rms);
}

export const geometricMean = (numbers) =>
  numbers.length === 0
    ? undefined
    : Math.exp(numbers.reduce((sum, x) => sum + Math.log(x), 0) / numbers.length);

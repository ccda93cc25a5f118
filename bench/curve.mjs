// Points { bytes, rms } by growing size: what a distance costs, what bytes buy. Between two points both go along powers of each other.
// An empty surface's distance is null.

const between = (x, x0, x1, y0, y1) => {
  if (x1 === x0) return y1;
  return y0 * (y1 / y0) ** (Math.log(x / x0) / Math.log(x1 / x0));
};

/** The points that no other one beats in both, by growing size. */
export function envelope(points) {
  let best = Infinity;
  const sorted = points.filter(({ rms }) => rms !== null).sort((a, b) => a.bytes - b.bytes || a.rms - b.rms);
  return sorted.filter(({ rms }) => rms < best && ((best = rms), true));
}

/** Bytes from which on the distance is reached; undefined where the curve does not go so far, or starts below it. */
export function bytesAt(curve, rms) {
  const found = curve.findIndex((point) => point.rms !== null && point.rms <= rms);
  if (found < 0) return undefined;
  if (found === 0) return curve[0].rms === rms ? curve[0].bytes : undefined;
  const [before, after] = [curve[found - 1], curve[found]];
  return before.rms === null ? after.bytes : between(rms, before.rms, after.rms, before.bytes, after.bytes);
}

/** The distance that so many bytes buy; undefined where even the smallest file has more. */
export function errorAt(curve, bytes) {
  const found = curve.findIndex((point) => point.bytes > bytes);
  if (found === 0 || curve.length === 0) return undefined;
  if (found < 0) return curve.at(-1).rms;
  const [before, after] = [curve[found - 1], curve[found]];
  return between(bytes, before.bytes, after.bytes, before.rms, after.rms);
}

export const geometricMean = (numbers) =>
  numbers.length === 0 ? undefined : Math.exp(numbers.reduce((sum, x) => sum + Math.log(x), 0) / numbers.length);

// How a change of the code changed sizes, which are exact: against the last run with the same
// surface.
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { geometricMean } from '../measure/rate-curve.mjs';
import { fixed } from '../output/markdown.mjs';

const TRACKED = {
  default: ({ raw }) => raw.default.bytes,
  connectivity: ({ raw }) => raw.default.bits.connectivity / 8,
  lossless: ({ raw }) => raw.lossless.bytes,
};

const percent = (ratio) => `${ratio < 1 ? '−' : '+'}${fixed(100 * Math.abs(ratio - 1), 2)} %`;
const mapValues = (object, change) =>
  Object.fromEntries(Object.entries(object).map(([key, value]) => [key, change(value)]));

/** Lines to print. The file then holds this run's sizes. */
export function sizeChanges(all, file) {
  const before = existsSync(file) ? JSON.parse(readFileSync(file, 'utf8')) : {};
  const now = Object.fromEntries(
    all.map((one) => [one.name, mapValues(TRACKED, (bytes) => bytes(one))]),
  );
  writeFileSync(file, JSON.stringify({ ...before, ...now }, null, 1));
  const lines = [];
  for (const size of Object.keys(TRACKED)) {
    const ratios = Object.keys(now)
      .filter((name) => before[name]?.[size])
      .map((name) => [name, now[name][size] / before[name][size]]);
    const changed = ratios.filter(([, ratio]) => ratio !== 1);
    if (changed.length === 0) continue;
    const mean = geometricMean(ratios.map(([, ratio]) => ratio));
    const each = changed.map(([name, ratio]) => `${name} ${percent(ratio)}`);
    lines.push(`${size}: ${percent(mean)} (${each.join(', ')})`);
  }
  return lines;
}

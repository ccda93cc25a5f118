// What a change of the code did to the sizes, which are exact: against the latest run that saw the same surface.
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { geometricMean } from './curve.mjs';
import { fixed } from './format.mjs';

const TRACKED = {
  'default': ({ raw }) => raw.default.bytes,
  'connectivity': ({ raw }) => raw.default.bits.connectivity / 8,
  'lossless': ({ raw }) => raw.lossless.bytes,
};

/** Lines for people; the file then holds this run's sizes. */
export function changes(all, file) {
  const before = existsSync(file) ? JSON.parse(readFileSync(file, 'utf8')) : {};
  const now = Object.fromEntries(all.map((one) => [one.name, Object.fromEntries(Object.entries(TRACKED).map(([what, bytes]) => [what, bytes(one)]))]));
  writeFileSync(file, JSON.stringify({ ...before, ...now }, null, 1));
  const percent = (ratio) => `${ratio < 1 ? '−' : '+'}${fixed(100 * Math.abs(ratio - 1), 2)} %`;
  const lines = [];
  for (const what of Object.keys(TRACKED)) {
    const ratios = Object.keys(now).filter((name) => before[name]?.[what]).map((name) => [name, now[name][what] / before[name][what]]);
    const moved = ratios.filter(([, ratio]) => ratio !== 1);
    if (moved.length === 0) continue;
    const mean = geometricMean(ratios.map(([, ratio]) => ratio));
    lines.push(`${what}: ${percent(mean)} (${moved.map(([name, ratio]) => `${name} ${percent(ratio)}`).join(', ')})`);
  }
  return lines;
}

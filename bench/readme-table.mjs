// `npm run bench:report`: writes the README's table from the last results.
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { figures } from './comparison/surface-figures.mjs';
import { summary } from './comparison/comparison-tables.mjs';

const BEGIN = '<!-- bench:begin -->';
const END = '<!-- bench:end -->';

const here = (path) => fileURLToPath(new URL(path, import.meta.url));
const [readme, results] = [here('../README.md'), here('out/results.json')];

/** The text with the part between the markers replaced. */
function rewritten(text, inside) {
  const [begin, end] = [text.indexOf(BEGIN), text.indexOf(END)];
  if (begin < 0 || end < begin)
    throw new Error(`README.md: the markers ${BEGIN} and ${END} are missing`);
  return `${text.slice(0, begin + BEGIN.length)}\n${inside}\n${text.slice(end)}`;
}

if (!existsSync(results)) {
  console.error('bench:report: bench/out/results.json is missing; run npm run bench');
  process.exit(1);
}
if (!existsSync(readme)) {
  console.warn('bench:report: README.md is missing');
} else {
  const { surfaces } = JSON.parse(readFileSync(results, 'utf8'));
  const all = Object.entries(surfaces).map(([name, raw]) => ({ name, ...figures(raw) }));
  writeFileSync(readme, rewritten(readFileSync(readme, 'utf8'), summary(all)));
  console.log(`README.md: ${all.length} surfaces`);
}

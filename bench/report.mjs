// `npm run bench:report`: the README's table from the last results.
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { figures } from './figures.mjs';
import { summary } from './tables.mjs';

const BEGIN = '<!-- bench:begin -->';
const END = '<!-- bench:end -->';

const here = (path) => fileURLToPath(new URL(path, import.meta.url));
const [readme, results] = [here('../README.md'), here('out/results.json')];

/** The text with everything between the markers replaced. */
function rewritten(text, inside) {
  const [begin, end] = [text.indexOf(BEGIN), text.indexOf(END)];
  if (begin < 0 || end < begin) throw new Error(`README.md: no ${BEGIN} … ${END}`);
  return `${text.slice(0, begin + BEGIN.length)}\n${inside}\n${text.slice(end)}`;
}

if (!existsSync(results)) {
  console.error('bench:report: no bench/out/results.json; run npm run bench');
  process.exit(1);
}
if (!existsSync(readme)) {
  console.warn('bench:report: there is no README.md');
} else {
  const { surfaces } = JSON.parse(readFileSync(results, 'utf8'));
  const all = Object.entries(surfaces).map(([name, raw]) => ({ name, ...figures(raw) }));
  writeFileSync(readme, rewritten(readFileSync(readme, 'utf8'), summary(all)));
  console.log(`README.md: ${all.length} surfaces`);
}

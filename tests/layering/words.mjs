// Words that docs/glossary.md refuses, and basenames that occur twice. Prints each; status 1 if any.
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { basename, dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const EVERYWHERE = /./;
const CODEC = /^(shared|docs\/codec|wasm)\//;

/**
 * The words by the files in which they are refused. Words of everyday English ("ask", "fresh
 * clone") are refused only as the names they were.
 */
const REFUSED = [
  [EVERYWHERE, /\b(?:un)?(?:tells?|told|telling)\b|[tT]old[A-Z]|\btell[A-Z]/],
  [EVERYWHERE, /\boctaves?\b|[a-z]Octave|Octaves?[A-Z]/i],
  [EVERYWHERE, /\bquant(?:um|a)\b/i],
  [EVERYWHERE, /\bkernels?\b/i],
  [EVERYWHERE, /\bclose[-_]by\b|CloseBy/i],
  [EVERYWHERE, /\bchances?\b|Chance[A-Z]/i],
  [EVERYWHERE, /\bpersuade/i],
  [EVERYWHERE, /\bstrangers?\b/i],
  [EVERYWHERE, /\bseldom\b/i],
  [EVERYWHERE, /\bas long again\b/i],
  [EVERYWHERE, /\b(?:does|did|do) not pay\b|\bpays\b/i],
  [EVERYWHERE, /\bBlind[A-Z]|\bTruth[A-Z]|[a-z]Truth\b/],
  [CODEC, /\btruths?\b/i],
  [CODEC, /\baims?\b/i],
  [CODEC, /\bask\b[.,)(]|& ask\b/],
  [CODEC, /\bfresh\b|Fresh/],
  [CODEC, /\bnear (?:isovalues?|surfaces?|signs|geometry)\b|Near(?:Signs|Geometry|Surface)/i],
  [CODEC, /\bplaceOf\b|\bplaces\(\)/],
];

/** Where the words themselves are the subject, or the past is. */
const EXEMPT = new Set([
  ...['docs/glossary.md', 'tests/layering/words.mjs', 'tests/layering/words.test.mjs', 'LICENSE'],
]);
const TEXT = /\.(h|cpp|cmake|txt|mjs|mts|ts|sh|md|html|css|json)$/;

/** Names that every folder may have. */
const COMMON = new Set([
  ...['CMakeLists.txt', 'README.md', 'package.json', 'tsconfig.json', 'index.ts', 'index.html'],
]);
const CODE = /\.(h|cpp|ts|mts|mjs|sh)$/;

const tracked = (root) =>
  execFileSync('git', ['ls-files', '--cached', '--others', '--exclude-standard'], {
    cwd: root,
    encoding: 'utf8',
  })
    .split('\n')
    .filter(Boolean);

export function refusedIn(path, text) {
  const patterns = REFUSED.filter(([where]) => where.test(path)).map(([, words]) => words);
  return text.split('\n').flatMap((line, i) => {
    const found = patterns.map((words) => line.match(words)?.[0]).find(Boolean);
    return found ? [`${path}:${i + 1} says "${found}"`] : [];
  });
}

export function refusedWords(root) {
  return tracked(root)
    .filter((path) => TEXT.test(path) && !EXEMPT.has(path) && path !== 'package-lock.json')
    .filter((path) => !path.startsWith('tests/golden/'))
    .flatMap((path) => {
      try {
        return refusedIn(path, readFileSync(join(root, path), 'utf8'));
      } catch (error) {
        if (error.code === 'ENOENT') return []; // removed, and not yet committed
        throw error;
      }
    });
}

export function twins(paths) {
  const byName = Map.groupBy
    ? Map.groupBy(paths, (path) => basename(path))
    : paths.reduce((map, path) => {
        const name = basename(path);
        return map.set(name, [...(map.get(name) ?? []), path]);
      }, new Map());
  return [...byName]
    .filter(([name, all]) => CODE.test(name) && !COMMON.has(name) && all.length > 1)
    .map(([, all]) => all.join(' and '));
}

export const repeatedNames = (root) => twins(tracked(root));

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const root = join(dirname(fileURLToPath(import.meta.url)), '../..');
  const found = [...refusedWords(root), ...repeatedNames(root)];
  for (const line of found) console.error(line);
  process.exitCode = found.length > 0 ? 1 : 0;
}

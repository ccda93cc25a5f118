// Which folder may include which: the architecture, held. `node tests/layering/layering.mjs` prints
// each include that breaks it (status 1 if any), `--picture` the picture in docs/architecture.md.
import { readFileSync, readdirSync, statSync } from 'node:fs';
import { dirname, join, relative } from 'node:path';
import { fileURLToPath } from 'node:url';

/**
 * The folders of shared/src, and what each may include. The decoder cannot see the encoder, the
 * surface no coder. `api` is the public header.
 */
export const ARROWS = {
  api: [],
  util: [],
  entropy: ['util'],
  grid: ['util'],
  container: ['grid', 'api'],
  bisection: ['grid'],
  scalars: ['grid', 'util'],
  surface: ['scalars', 'grid', 'util', 'api'],
  estimate: ['scalars', 'grid', 'util', 'api'],
  'coding/exchange': ['entropy', 'estimate', 'grid'],
  'coding/signs': ['coding/exchange', 'grid', 'util'],
  'coding/geometry': [
    ...['coding/exchange', 'container', 'entropy', 'estimate', 'scalars', 'grid', 'util'],
  ],
  'coding/isovalues': ['coding/geometry', 'coding/exchange', 'estimate', 'scalars', 'grid'],
  'coding/adaptive': [
    ...['coding/signs', 'coding/geometry', 'bisection', 'entropy', 'estimate', 'scalars', 'grid'],
    ...['util'],
  ],
  coding: [
    ...['coding/signs', 'coding/geometry', 'coding/isovalues', 'coding/adaptive', 'container'],
    ...['estimate', 'grid', 'util'],
  ],
  decoder: [
    ...['coding', 'coding/geometry', 'coding/isovalues', 'coding/adaptive', 'container', 'surface'],
    ...['estimate', 'grid', 'util', 'api'],
  ],
  'encoder/core': [
    ...['coding/exchange', 'coding/geometry', 'container', 'surface', 'estimate', 'scalars'],
    ...['grid', 'util', 'api'],
  ],
  'encoder/adaptive': ['encoder/core', 'coding/adaptive', 'scalars', 'api'],
  'encoder/topology': ['coding/adaptive', 'container', 'surface', 'bisection', 'grid'],
  encoder: ['encoder/core', 'encoder/adaptive', 'encoder/topology', 'coding', 'util', 'api'],
};

/** The C++ library as far as the codec needs it: no threads, files, streams, clocks. */
const STANDARD = new Set(
  (
    'algorithm array bit cmath concepts cstddef cstdint cstdlib cstring deque functional limits ' +
    'map memory numeric optional set span string tuple type_traits utility vector'
  ).split(' '),
);
/** Header-only libraries, and the one folder that may use each. */
const LIBRARIES = { glm: 'surface' };

/** Coders written for a comparison, in no stream, and the folders that they may build on. */
const COMPARISONS = {
  'native/bench/chunks/': ['coding', 'decoder', 'grid', 'scalars'],
  'native/bench/figure6/': ['container', 'entropy', 'grid', 'bisection', 'coding/adaptive'],
};

const folderOf = (path) => (path.startsWith('isostar/') ? 'api' : dirname(path));

function offenceInShared(path, { target, system }) {
  const from = path.startsWith('include/') ? 'api' : folderOf(path.replace(/^src\//, ''));
  if (!ARROWS[from]) return 'is in a folder that tests/layering/layering.mjs does not know';
  if (system) {
    if (STANDARD.has(target) || LIBRARIES[target.split('/')[0]] === from) return null;
  } else {
    const to = folderOf(target);
    if (to === from || ARROWS[from].includes(to)) return null;
  }
  return `may not include ${target}`;
}

/** Outside shared/ the codec is its public header, and no other folder reaches into it. */
function offenceOutside(path, { target }) {
  const parts = COMPARISONS[Object.keys(COMPARISONS).find((folder) => path.startsWith(folder))];
  const part = folderOf(target);
  const isInternal = ARROWS[part] && part !== 'api';
  if (isInternal && !parts?.includes(part)) return `may not include ${target}`;
  return /shared\/|src\//.test(target) ? `may not include ${target}` : null;
}

function* sourcesBelow(folder) {
  for (const name of readdirSync(folder).sort()) {
    if (name === 'node_modules' || name === 'dist') continue;
    const path = join(folder, name);
    if (statSync(path).isDirectory()) yield* sourcesBelow(path);
    else if (/\.(h|cpp)$/.test(name)) yield path;
  }
}

const includesOf = (path) =>
  [...readFileSync(path, 'utf8').matchAll(/^\s*#\s*include\s*([<"])([^>"]+)[>"]/gm)].map(
    ([, quote, target]) => ({ target, system: quote === '<' }),
  );

/** Files of shared/src that include each other in a circle, one line a circle. */
function circles(root) {
  const folder = join(root, 'shared/src');
  const paths = [...sourcesBelow(folder)].map((path) => relative(folder, path));
  const includes = new Map(
    paths.map((path) => [path, includesOf(join(folder, path)).map(({ target }) => target)]),
  );
  const found = [];
  const done = new Set();
  const visit = (path, way) => {
    if (way.includes(path)) found.push(`${[...way.slice(way.indexOf(path)), path].join(' → ')}`);
    else if (!done.has(path))
      for (const next of includes.get(path) ?? []) visit(next, [...way, path]);
    done.add(path);
  };
  for (const path of paths) visit(path, []);
  return found;
}

export function offences(root) {
  const found = circles(root);
  for (const folder of ['shared', 'native', 'wasm', 'web']) {
    for (const path of sourcesBelow(join(root, folder))) {
      for (const include of includesOf(path)) {
        const offence =
          folder === 'shared'
            ? offenceInShared(relative(join(root, 'shared'), path), include)
            : offenceOutside(relative(root, path), include);
        if (offence) found.push(`${relative(root, path)} ${offence}`);
      }
    }
  }
  return found;
}

/** Folders above those that they include; an arrow that others imply is left out. */
export function picture() {
  const reaches = (from, to) => ARROWS[from].some((next) => next === to || reaches(next, to));
  const direct = (from) =>
    ARROWS[from].filter((to) => !ARROWS[from].some((other) => other !== to && reaches(other, to)));
  const width = Math.max(...Object.keys(ARROWS).map((name) => name.length));
  return Object.keys(ARROWS)
    .reverse()
    .map((name) => `${name.padEnd(width)}  → ${direct(name).join(', ') || '(nothing)'}`)
    .join('\n');
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  if (process.argv.includes('--picture')) {
    console.log(picture());
  } else {
    const found = offences(join(dirname(fileURLToPath(import.meta.url)), '../..'));
    for (const offence of found) console.error(offence);
    process.exitCode = found.length > 0 ? 1 : 0;
  }
}

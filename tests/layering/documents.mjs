// Does all exist that the documents name? Prints each file, link or identifier that does not; status 1 if any.
import { existsSync, readFileSync, readdirSync, statSync } from 'node:fs';
import { basename, dirname, join, relative } from 'node:path';
import { fileURLToPath } from 'node:url';

const CODE = ['shared', 'native', 'wasm', 'web', 'tests', 'bench', 'scripts'];
const NOT_OURS = ['node_modules', 'dist', 'out', 'build'];

function* filesBelow(folder) {
  for (const name of readdirSync(folder).sort()) {
    if (NOT_OURS.includes(name)) continue;
    const path = join(folder, name);
    if (statSync(path).isDirectory()) yield* filesBelow(path);
    else yield path;
  }
}

const matches = (text, pattern) => [...text.matchAll(pattern)].map(([all, part]) => part ?? all);

/** The file names and identifiers in a document's code spans, and the stems of files in its pictures of arrows. */
export function namesIn(text) {
  const fenced = matches(text, /^```\n([^]*?)^```/gm)
    .filter((block) => block.includes('←'))
    .join('\n');
  const spans = matches(text.replace(/^```[^]*?^```/gm, ''), /`([^`\n]+)`/g).join('\n');
  const files = /[\w.-]+\.(?:h|cpp|mjs|ts|sh|md)\b/g;
  return {
    files: [...matches(spans, files), ...matches(fenced, files)],
    stems: matches(fenced, /\b[a-z]+(?:_[a-z0-9]+)+\b(?!\.)/g),
    identifiers: matches(
      spans.replace(files, ''),
      /\b(?:[A-Z][a-z]{3,}|[A-Za-z][a-z0-9]*(?:[A-Z][a-z0-9]+)+)\b/g,
    ),
    links: matches(text, /\]\((?!https?:)([^)#]+)/g),
  };
}

export function staleNames(root) {
  const sources = CODE.flatMap((folder) => [...filesBelow(join(root, folder))]);
  // What has changed may name what is gone.
  const documents = [
    ...readdirSync(root).map((name) => join(root, name)),
    ...filesBelow(join(root, 'docs')),
    ...sources,
  ].filter((path) => path.endsWith('.md') && basename(path) !== 'CHANGELOG.md');
  const names = new Set([...sources, ...documents, 'CHANGELOG.md'].map((path) => basename(path)));
  const stems = new Set([...names].map((name) => name.replace(/\.\w+$/, '')));
  const words = new Set(
    sources
      .filter((path) => /\.(h|cpp|m?js|ts|json|css|html|sh)$/.test(path))
      .flatMap((path) => readFileSync(path, 'utf8').match(/\w+/g) ?? []),
  );
  const found = [];
  for (const path of documents) {
    const named = namesIn(readFileSync(path, 'utf8'));
    const stale = [
      ...named.files.filter((name) => !names.has(name)),
      ...named.stems.filter((name) => !stems.has(name)),
      ...named.identifiers.filter((name) => !words.has(name)),
      ...named.links.filter((target) => !existsSync(join(dirname(path), target))),
    ];
    for (const name of new Set(stale))
      found.push(`${relative(root, path)} names ${name}, which is nowhere`);
  }
  return found;
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const found = staleNames(
    process.argv[2] ?? join(dirname(fileURLToPath(import.meta.url)), '../..'),
  );
  for (const name of found) console.error(name);
  process.exitCode = found.length > 0 ? 1 : 0;
}

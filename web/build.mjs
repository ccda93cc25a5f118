// Builds the publishable package into dist/: an ES module per entry, the chunks that they share,
// type declarations, the decoder's WebAssembly and licences.
import { build } from 'esbuild';
import { execFileSync } from 'node:child_process';
import { copyFileSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';

const here = (path) => fileURLToPath(new URL(path, import.meta.url));

const options = {
  absWorkingDir: here('.'),
  bundle: true,
  minify: true,
  lineLimit: 160, // an error message shows the line that failed
  metafile: true,
  format: 'esm',
  target: 'es2022',
  external: ['node:fs/promises', 'three', 'three/*'],
};

rmSync(here('dist'), { recursive: true, force: true });
const { metafile } = await build({
  ...options,
  entryPoints: ['index', 'worker', 'three', 'element'].map((entry) => `src/${entry}.ts`),
  outdir: 'dist',
  splitting: true,
});
// Bundlers look for names of files, so no string may be split between lines. They must not follow
// imports of a variable's file: for that there are comments, which esbuild drops.
let ignored = 0;
for (const file of Object.keys(metafile.outputs)) {
  const script = readFileSync(here(file), 'utf8').replaceAll('\\\n', '');
  const finished = script.replace(/\bimport\((?=[\w$.]+\))/g, (start) => {
    ignored++;
    return `${start}/* webpackIgnore: true */ /* @vite-ignore */ `;
  });
  writeFileSync(here(file), finished);
}
if (ignored !== 2) throw new Error(`${ignored} imports of a variable's file, not 2`);
// Shares nothing with the others: it is loaded by its address.
await build({
  ...options,
  entryPoints: ['../build/wasm/decoder-all.js'],
  outfile: 'dist/decoder-all.js',
});
const typescript = createRequire(import.meta.url).resolve('typescript/bin/tsc');
execFileSync(process.execPath, [typescript, '-p', here('.')], { stdio: 'inherit' });
for (const name of ['decoder', 'decoder-all'])
  copyFileSync(here(`../build/wasm/${name}.wasm`), here(`dist/${name}.wasm`));
copyFileSync(here('../LICENSE'), here('dist/LICENSE'));
copyFileSync(here('THIRD-PARTY.md'), here('dist/THIRD-PARTY.md'));
// No package is bundled; THIRD-PARTY.md would have to list it.
const bundled = Object.keys(metafile.inputs).filter((path) => path.includes('node_modules/'));
if (bundled.length > 0) throw new Error(`bundled without a licence: ${bundled.join(', ')}`);

/** The files that a page downloads for one: itself and all that it imports at once. */
function closure(file, files = new Set()) {
  if (files.has(file)) return files;
  files.add(file);
  for (const { path, kind, external } of metafile.outputs[file].imports)
    if (!external && kind === 'import-statement') closure(path, files);
  return files;
}
const gzipped = (path) => gzipSync(readFileSync(here(path)), { level: 9 }).length;
const sum = (files) => [...files].reduce((total, path) => total + gzipped(path), 0);
const kilobytes = (bytes) => `${(bytes / 1000).toFixed(1)} kB`;

const [page, worker] = ['src/remote/remote-decoder.ts', 'src/worker.ts'].map((source) =>
  Object.keys(metafile.outputs).find((path) => metafile.outputs[path].entryPoint === source),
);
const script = sum(closure(worker));
const pageScript = sum(closure(page, closure('dist/index.js', closure(worker)))) - script;
const wasm = gzipped('dist/decoder.wasm');
console.log(`web/dist: ${readdirSync(here('dist')).length} files and folders`);
console.log(
  `decoder after gzip: ${kilobytes(wasm)} WebAssembly + ${kilobytes(script)} script` +
    ` = ${kilobytes(wasm + script)}; the page's part of the script: ${kilobytes(pageScript)}`,
);
console.log(
  `for streams that it lacks: ${kilobytes(gzipped('dist/decoder-all.wasm'))} WebAssembly` +
    ` + ${kilobytes(gzipped('dist/decoder-all.js'))} script`,
);

// Builds the publishable package into dist/: an ES module per entry, the chunks that they share,
// type declarations, the decoder's WebAssembly and licences.
import { build } from 'esbuild';
import { execFileSync } from 'node:child_process';
import { copyFileSync, readdirSync, readFileSync, rmSync } from 'node:fs';
import { createRequire } from 'node:module';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';

const here = (path) => fileURLToPath(new URL(path, import.meta.url));

rmSync(here('dist'), { recursive: true, force: true });
const { metafile } = await build({
  absWorkingDir: here('.'),
  entryPoints: ['index', 'worker', 'three', 'element'].map((entry) => `src/${entry}.ts`),
  outdir: 'dist',
  bundle: true,
  splitting: true,
  minifySyntax: true,
  minifyIdentifiers: true, // but not white space: an error message shows the line that failed
  metafile: true,
  format: 'esm',
  target: 'es2022',
  alias: { 'isostar-wasm': here('../build/wasm/decoder.js') },
  external: ['node:fs/promises', 'three', 'three/*'],
});
const typescript = createRequire(import.meta.url).resolve('typescript/bin/tsc');
execFileSync(process.execPath, [typescript, '-p', here('.')], { stdio: 'inherit' });
copyFileSync(here('../build/wasm/decoder.wasm'), here('dist/decoder.wasm'));
copyFileSync(here('../LICENSE'), here('dist/LICENSE'));
copyFileSync(here('THIRD-PARTY.md'), here('dist/THIRD-PARTY.md'));
// No package is bundled; THIRD-PARTY.md would have to list it.
const bundled = Object.keys(metafile.inputs).filter((path) => path.includes('node_modules/'));
if (bundled.length > 0) throw new Error(`bundled without a licence: ${bundled.join(', ')}`);

/** What a page downloads for an entry: the entry itself and all that it imports. */
function closure(file, files = new Set()) {
  if (files.has(file)) return files;
  files.add(file);
  for (const { path, external } of metafile.outputs[file].imports)
    if (!external) closure(path, files);
  return files;
}
const gzipped = (path) => gzipSync(readFileSync(here(path)), { level: 9 }).length;
const kilobytes = (bytes) => `${(bytes / 1000).toFixed(1)} kB`;

const wasm = gzipped('dist/decoder.wasm');
const script = [...closure('dist/worker.js')].reduce((sum, path) => sum + gzipped(path), 0);
console.log(`web/dist: ${readdirSync(here('dist')).length} files and folders`);
console.log(
  `decoder after gzip: ${kilobytes(wasm)} WebAssembly + ${kilobytes(script)} script` +
    ` = ${kilobytes(wasm + script)}`,
);

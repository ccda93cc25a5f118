// What is shipped names the licences of all that it contains or loads. What the build takes from the
// registry is fixed.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, test } from 'node:test';
import { fileURLToPath } from 'node:url';

const root = (path) => fileURLToPath(new URL(`../../${path}`, import.meta.url));
const folder = mkdtempSync(join(tmpdir(), 'isostar-licences-'));
after(() => rmSync(folder, { recursive: true, force: true }));

const ninja = (...options) =>
  execFileSync('ninja', ['-C', root('build/wasm'), ...options], {
    encoding: 'utf8',
    maxBuffer: 1e8,
  });

/** The names in the first column of a document's tables. */
const listed = (path) =>
  new Set(
    [...readFileSync(root(path), 'utf8').matchAll(/^\| ([^|]+) \|/gm)].flatMap(([, names]) =>
      names.split(',').map((name) => name.trim().replaceAll('`', '')),
    ),
  );

const notIn = (names, all) => [...new Set(names)].filter((name) => !all.has(name));

/** The archives from which the linker takes code for a decoder. */
function linkedArchives(file) {
  const command = ninja('-t', 'commands', file)
    .trim()
    .split('\n')
    .at(-1)
    .replace(/^: && | && :$/g, '')
    .replaceAll('-O3', '-O1') // faster, and the same archives
    .replace(/-o \S+/, `-Wl,--trace -o ${join(folder, file)}`);
  const trace = execFileSync('sh', ['-c', `${command} 2>&1`], {
    cwd: root('build/wasm'),
    encoding: 'utf8',
    env: { ...process.env, NODE_PATH: '/usr/share/nodejs' },
  });
  return [...trace.matchAll(/(\w[\w+-]*)\.a\(/g)].map(([, name]) => name);
}

/** The projects whose headers the decoder's sources include. */
function includedProjects() {
  const projects = [
    [/\/host\/glm\//, 'glm'],
    [/\/include\/c\+\+\/v1\//, 'libc++'],
    [/\/sysroot\/include\/emscripten\//, 'emscripten'],
    [/\/sysroot\/include\//, 'libc'],
    [/\/lib\/clang\/[\d.]+\/include\//, 'clang'],
  ];
  const headers = [...ninja('-t', 'deps').matchAll(/^ {4}(.*)$/gm)].map(([, path]) => path);
  const ofOthers = headers.filter((path) => path.startsWith('/usr/') || path.includes('/host/'));
  return ofOthers.map((path) => projects.find(([where]) => where.test(path))?.[1] ?? path);
}

test('THIRD-PARTY.md lists all that the WebAssembly contains', () => {
  const known = listed('web/THIRD-PARTY.md');
  // Builds without exceptions have names of their own.
  const archives = ['decoder.wasm', 'decoder-all.js']
    .flatMap(linkedArchives)
    .map((name) => name.replace(/-noexcept$/, ''));
  assert.ok(archives.includes('libc'), 'the linker names its archives');
  assert.deepEqual(
    notIn(
      [...archives, ...includedProjects()],
      new Set([...known, 'libisostar', 'libisostar_default']),
    ),
    [],
  );
});

test('the package carries the licences', () => {
  const [{ files }] = JSON.parse(
    execFileSync('npm', ['pack', '--dry-run', '--json', '--offline'], {
      cwd: root('web'),
      encoding: 'utf8',
      stdio: ['ignore', 'pipe', 'ignore'],
    }),
  );
  const paths = files.map(({ path }) => path);
  assert.ok(paths.includes('dist/LICENSE') && paths.includes('dist/THIRD-PARTY.md'));
});

test('docs/licences.md lists the packages that the command loads', { skip: noDpkg() }, () => {
  const packages = readFileSync(root('build/packages.txt'), 'utf8')
    .split('packages that build/isostar loads\n')[1]
    .trim()
    .split('\n')
    .map((line) => line.split(' ')[0]);
  assert.ok(packages.includes('libc6'));
  assert.deepEqual(notIn(packages, listed('docs/licences.md')), []);
});

function noDpkg() {
  return existsSync('/usr/bin/dpkg-query') ? false : 'no dpkg: the packages are not known';
}

test('the package depends on nothing but its peer', () => {
  const manifest = JSON.parse(readFileSync(root('web/package.json'), 'utf8'));
  assert.equal(manifest.dependencies, undefined);
  assert.deepEqual(Object.keys(manifest.peerDependencies), ['three']);
});

test('the lock file has a checksum of every package', () => {
  const { packages } = JSON.parse(readFileSync(root('package-lock.json'), 'utf8'));
  const installed = Object.entries(packages).filter(
    ([path, { link }]) => path.startsWith('node_modules/') && !link,
  );
  assert.ok(installed.length > 0);
  for (const [path, { integrity }] of installed) assert.match(integrity, /^sha512-/, path);
});

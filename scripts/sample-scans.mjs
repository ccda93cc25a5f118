// The sample scans, from Debian packages, encoded by the command line in build/ and by Draco.
import { execFileSync } from 'node:child_process';
import { existsSync, mkdirSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';

const DRACO_BITS = 11;
const DRACO_LEVEL = 7;

const SKULL = {
  package: 'invesalius-examples',
  file: 'usr/share/doc/invesalius-examples/examples/Cranium.inv3',
  member: 'matrix.dat', // the project file is a gzipped tar
  // Rows run from the back of the head to its front, opposite to DICOM's.
  header: `NRRD0005
type: int16
dimension: 3
sizes: 256 256 108
space: left-posterior-superior
space directions: (0.957,0,0) (0,-0.957,0) (0,0,1.5)
space origin: (0,0,0)
endian: little
encoding: raw
`,
  credit: 'CT, 256×256×108 samples, 0.957×0.957×1.5 mm. From Debian’s invesalius-examples, GPL-2.',
};
const HEAD = {
  package: 'mricron-data',
  file: 'usr/share/mricron/templates/ch2.nii.gz',
  credit: 'MRI, 181×217×181 samples, 1 mm. From Debian’s mricron-data.',
};
export const SURFACES = [
  { id: 'skull-bone', title: 'Skull, bone (CT)', scan: SKULL, isovalue: 226.5, orbit: [-32, 10] },
  { id: 'skull-skin', title: 'Skull, skin (CT)', scan: SKULL, isovalue: -400.5, orbit: [-32, 10] },
  { id: 'head-skin', title: 'Head, skin (MRI)', scan: HEAD, isovalue: 30.5, orbit: [-32, 10] },
];

const run = (command, ...options) =>
  execFileSync(command, options, {
    stdio: ['ignore', 'pipe', 'inherit'],
    encoding: 'utf8',
    maxBuffer: 1e8,
  });
const isNewer = (file, than) =>
  existsSync(file) && statSync(file).mtimeMs >= statSync(than).mtimeMs;

/** The scan's volume file: the installed one, or that of the package, downloaded and unpacked. */
export function volumeOf({ package: name, file, member, header }, cache) {
  let path = join('/', file);
  if (!existsSync(path)) path = join(cache, name, file);
  if (!existsSync(path)) unpack(name, join(cache, name));
  if (!member) return path;
  const volume = join(cache, `${name}.nhdr`);
  writeFileSync(
    join(cache, member),
    execFileSync('tar', ['-xzOf', path, '--wildcards', `*/${member}`], { maxBuffer: 1e9 }),
  );
  writeFileSync(volume, `${header}data file: ${member}\n`);
  return volume;
}

function unpack(name, folder) {
  mkdirSync(folder, { recursive: true });
  const download = () =>
    execFileSync('apt-get', ['download', '-qq', name], { cwd: folder, stdio: 'ignore' });
  try {
    download();
  } catch {
    // A new machine has no package lists.
    execFileSync('apt-get', ['update', '-qq'], { stdio: 'inherit' });
    download();
  }
  run('sh', '-c', 'dpkg -x "$1"/*.deb "$1" && rm "$1"/*.deb', 'sh', folder);
}

/** Writes Draco's file of the marching cubes mesh and returns its RMS distance from that mesh. */
function encodeWithDraco(isostar, stream, folder, id) {
  const file = (name) => join(folder, `${id}-${name}`);
  const [mesh, draco, decoded] = [file('cubes.ply'), join(folder, `${id}.drc`), file('draco.ply')];
  run(isostar, 'decode', stream, mesh, '--polygonizer', 'cubes');
  run(
    'draco_encoder',
    '-i',
    mesh,
    '-o',
    draco,
    '-qp',
    String(DRACO_BITS),
    '-cl',
    String(DRACO_LEVEL),
    '--skip',
    'NORMAL',
  );
  run('draco_decoder', '-i', draco, '-o', decoded);
  const { symmetric } = JSON.parse(run(isostar, 'compare', decoded, stream, '--json'));
  rmSync(mesh);
  rmSync(decoded);
  return symmetric.rms;
}

function make(surface, isostar, folder, cache) {
  const { id, title, scan, isovalue, orbit } = surface;
  const stream = join(folder, `${id}.isostar`);
  const draco = join(folder, `${id}.drc`);
  const entry = join(cache, `${id}.json`);
  if (!isNewer(entry, isostar)) {
    console.log(`encoding ${title}`);
    const volume = volumeOf(scan, cache);
    const encode = (out, ...options) =>
      run(isostar, 'encode', volume, out, '--iso', String(isovalue), ...options);
    encode(stream);
    const lossless = join(cache, `${id}-lossless.isostar`);
    encode(lossless, '--lossless');
    const error = encodeWithDraco(isostar, lossless, folder, id);
    const [version] = run('dpkg-query', '-W', '-f', '${Version}', 'draco').split('+');
    const settings = `${version}, level ${DRACO_LEVEL}, ${DRACO_BITS} bits`;
    const size = (file) => statSync(file).size;
    writeFileSync(
      entry,
      JSON.stringify({
        id,
        title,
        orbit,
        note: `${scan.credit} Isovalue ${isovalue}.`,
        stream: `${id}.isostar`,
        bytes: size(stream),
        draco: { file: `${id}.drc`, bytes: size(draco), settings, error },
      }),
    );
  }
  return JSON.parse(readFileSync(entry, 'utf8'));
}

/**
 * Writes streams, Draco files and samples.json to `folder`. Files newer than the command line are
 * kept.
 */
export function makeSamples(isostar, folder, cache) {
  mkdirSync(folder, { recursive: true });
  mkdirSync(cache, { recursive: true });
  const samples = SURFACES.map((surface) => make(surface, isostar, folder, cache));
  writeFileSync(join(folder, 'samples.json'), JSON.stringify({ samples }, null, 2));
  return samples;
}

// Which file may include which: the arrows of docs/design.md, kept. Prints each arrow that is not in the table; status 1 if any.
import { readFileSync, readdirSync, statSync } from 'node:fs';
import { basename, dirname, join, relative } from 'node:path';
import { fileURLToPath } from 'node:url';

/** Parts of shared/; inside a part a file may include those before it. */
const PARTS = {
  api: ['isostar.h'],
  seldom: ['seldom.h'],
  errors: ['errors.cpp'],
  bytes: ['bytes.h'],
  lanes: ['lanes.h'],
  coder: ['range_coder.h', 'models.h'],
  hierarchy: ['lattice.h', 'bricks.h', 'window.h', 'octave.h', 'simplex.h', 'row_packs.h', 'neighbourhood.h', 'fresh_rows.h', 'shape_estimate.h', 'tube.h', 'vertex_front.h'],
  rbmt: ['diamond.h', 'tagged_simplex.h', 'rbmt.h', 'leaves.h', 'decomposition.h', 'linear_function.h', 'criteria.h', 'topology.h', 'adjacency.h', 'leaf_set.h'],
  scalars: ['reciprocal.h', 'pool.h', 'scalars.h', 'halo_window.h', 'scalar_window.h', 'fit_window.h', 'local_fit.h', 'intervals.h', 'far_ends.h', 'interpolation.h', 'prediction.h', 'displacements.h', 'displacement_window.h', 'hints.h', 'smoothing.h', 'completion.h'],
  aims: ['crossing_errors.h', 'aim.h'],
  exchange: ['exchange.h'],
  singleRate: ['seed_coder.h', 'mesh_exchange.h', 'gate_traversal.h'],
  traversal: [
    ...['base_coder.h', 'sign_coder.h', 'whole_cell_coder.h', 'exception_coder.h', 'refinement_coder.h', 'filling_coder.h'],
    ...['displacement_coder.h', 'octaves_coder.h', 'fit_coder.h', 'halving_coder.h'],
    ...['domain_coder.h', 'near_signs_coder.h', 'near_halving_coder.h', 'close_by.h', 'between.h'],
  ],
  header: ['header.h', 'header.cpp'],
  container: ['stream.h', 'stream.cpp'],
  layers: ['geometry_pass.h', 'layers.h'],
  layerBytes: ['layer_bytes.h'],
  adaptive: ['adaptive_mesh.h', 'adaptive_octave.h', 'adaptive_field.h'],
  polygonizer: [
    ...['surface.h', 'crossings.h', 'corner_signs.h', 'cell_table.h', 'cell_table.cpp', 'cell_cut.h', 'trim.h', 'trim.cpp', 'polygonizer.h', 'polygonizer.cpp'],
    ...['contour.h', 'contour.cpp', 'time_slice.h', 'time_slice.cpp'],
  ],
  field: ['field.h', 'field.cpp'],
  distance: ['vertex_cloud.h', 'source_distance.h', 'source_distance.cpp', 'displacement_plan.h', 'displacement_plan.cpp', 'source.h'],
  source: ['polygonize.cpp', 'sampled.cpp'],
  adaptiveEncoder: ['adaptive_plan.h', 'adaptive_plan.cpp', 'adaptive_distance.h', 'planned_field.h', 'adaptive_writer.h', 'encode_adaptive.h', 'encode_adaptive.cpp'],
  topologyEncoder: ['topology_plan.h', 'topology_plan.cpp', 'sign_turns.h', 'sign_turns.cpp', 'encode_topology.h', 'encode_topology.cpp'],
  encoder: ['layer_writer.h', 'encode.cpp'],
  reconstruction: ['reconstruction.h', 'adaptive_reconstruction.h', 'reconstruction_in.h', 'reconstruction.cpp', 'volumes_only.cpp'],
  decoder: ['decode.cpp'],
};

/** The parts that a part may include: the decoder cannot see the field, the polygonizer no coder. */
const ARROWS = {
  api: [],
  seldom: [],
  errors: ['api'],
  bytes: [],
  lanes: [],
  coder: ['lanes'],
  hierarchy: ['seldom'],
  rbmt: ['hierarchy'],
  scalars: ['seldom', 'hierarchy', 'lanes', 'api'],
  aims: ['coder'],
  exchange: ['aims', 'coder', 'hierarchy'],
  singleRate: ['coder', 'hierarchy', 'rbmt'],
  traversal: ['seldom', 'exchange', 'coder', 'hierarchy', 'scalars'],
  header: ['hierarchy', 'api'],
  container: ['bytes', 'header'],
  layers: ['seldom', 'adaptive', 'traversal', 'container', 'hierarchy', 'scalars'],
  layerBytes: ['exchange', 'layers', 'container'],
  polygonizer: ['seldom', 'hierarchy', 'scalars', 'api'],
  field: ['aims', 'hierarchy', 'header', 'scalars', 'lanes', 'api'],
  distance: ['field', 'hierarchy', 'scalars', 'polygonizer'],
  source: ['field', 'hierarchy', 'scalars', 'polygonizer', 'api'],
  adaptive: ['seldom', 'traversal', 'exchange', 'hierarchy', 'scalars', 'api'],
  adaptiveEncoder: ['adaptive', 'field', 'distance', 'layerBytes', 'polygonizer', 'hierarchy', 'scalars', 'api'],
  topologyEncoder: ['adaptive', 'header', 'polygonizer', 'rbmt', 'hierarchy'],
  encoder: ['field', 'distance', 'layerBytes', 'layers', 'adaptiveEncoder', 'topologyEncoder', 'scalars', 'api'],
  reconstruction: ['seldom', 'container', 'layers', 'adaptive', 'traversal', 'hierarchy', 'scalars', 'polygonizer', 'api'],
  decoder: ['seldom', 'reconstruction', 'api'],
};

/** The C++ library as far as the codec needs it: no threads, files, streams, clocks. */
const STANDARD = new Set(
  'algorithm array bit cmath concepts cstddef cstdint cstdlib cstring deque functional limits map memory numeric optional set span string tuple type_traits utility vector'.split(' '),
);
/** Header-only libraries, and the one file that may use each. */
const LIBRARIES = { glm: 'polygonizer.cpp', 'xxhash.h': 'stream.cpp' };

const partOf = (file) => Object.keys(PARTS).find((part) => PARTS[part].includes(file));

function mayInclude(file, target) {
  const [from, to] = [partOf(file), partOf(target)];
  if (from !== to) return ARROWS[from].includes(to);
  return PARTS[from].indexOf(target) < PARTS[from].indexOf(file);
}

function offenceInShared(file, { target, system }) {
  if (!partOf(file)) return 'is in no part of tests/layering/layering.mjs';
  if (system) {
    const library = target.split('/')[0];
    if (STANDARD.has(target) || LIBRARIES[library] === file) return null;
  } else if (partOf(basename(target)) && mayInclude(file, basename(target))) return null;
  return `may not include ${target}`;
}

/** The one folder outside that builds on the codec's parts: coders written for a comparison, of none of its streams. */
const COMPARISON = { folder: 'native/bench/figure6/', parts: ['bytes', 'coder', 'hierarchy', 'rbmt', 'singleRate'] };

/** Outside shared/ the codec is its public header, and isostar's other folders never reach into it. */
function offenceOutside(file, { target }) {
  const compares = file.startsWith(COMPARISON.folder);
  const internal = Object.keys(PARTS).filter((part) => !compares || !COMPARISON.parts.includes(part)).flatMap((part) => PARTS[part]).filter((name) => name !== 'isostar.h');
  if (target.includes('shared/') || target.includes('src/') || internal.includes(target)) return `may not include ${target}`;
  return null;
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
  [...readFileSync(path, 'utf8').matchAll(/^\s*#\s*include\s*([<"])([^>"]+)[>"]/gm)].map(([, quote, target]) => ({ target, system: quote === '<' }));

export function offences(root) {
  const found = [];
  for (const folder of ['shared', 'native', 'wasm', 'web']) {
    for (const path of sourcesBelow(join(root, folder))) {
      for (const include of includesOf(path)) {
        const offence = folder === 'shared' ? offenceInShared(basename(path), include) : offenceOutside(relative(root, path), include);
        if (offence) found.push(`${relative(root, path)} ${offence}`);
      }
    }
  }
  return found;
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const found = offences(process.argv[2] ?? join(dirname(fileURLToPath(import.meta.url)), '../..'));
  for (const offence of found) console.error(offence);
  process.exitCode = found.length > 0 ? 1 : 0;
}

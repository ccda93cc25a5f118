// Decodes the streams of FOLDER with the page's decoder and prints their surfaces in the lines of
// print_surfaces.cpp: `node print-surfaces.mjs FOLDER`. Images and sequences, which the page's
// decoder refuses, are left out.
import { readFileSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import { createDecoder } from 'isostar';

/** 32-bit FNV-1a over the bytes of arrays of four-byte numbers. */
function checksum(...arrays) {
  let sum = 2166136261;
  for (const { buffer, byteOffset, byteLength } of arrays)
    for (const byte of new Uint8Array(buffer, byteOffset, byteLength))
      sum = Math.imul(sum ^ byte, 16777619);
  return (sum >>> 0).toString(16);
}

async function surfaces(bytes, options) {
  const list = [];
  for await (const surface of decoder.decode(bytes, { refinements: 'all', ...options }))
    list.push(surface);
  return list;
}

/** The isovalues of a stream; undefined if the page's decoder does not read its kind. */
async function isovaluesOf(bytes) {
  try {
    return (await surfaces(bytes, { refinements: 'last' }))[0].info.isovalues;
  } catch (error) {
    if (error.code === 'UnsupportedVersion') return undefined;
    throw error;
  }
}

const folder = process.argv[2];
const decoder = await createDecoder();
for (const file of readdirSync(folder).filter((name) => name.endsWith('.isostar'))) {
  const bytes = new Uint8Array(readFileSync(join(folder, file)));
  const name = file.slice(0, -'.isostar'.length);
  for (const polygonizer of ['cubes', 'tetrahedra'])
    for (const [i, isovalue] of ((await isovaluesOf(bytes)) ?? []).entries())
      for (const surface of await surfaces(bytes, { polygonizer, isovalue })) {
        const { positions, normals, indices } = surface;
        const sum = checksum(positions, normals, indices);
        const where = `${name} ${surface.bytes} ${polygonizer} ${i} 0`;
        console.log(`mesh ${where} ${positions.length / 3} ${sum}`);
      }
}
decoder.dispose();

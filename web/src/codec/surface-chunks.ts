import type { Frame, StreamInfo, Surface, SurfaceChunk } from '../api/surface.js';

/** A surface without the property that is computed when it is asked for. */
export type WholeSurface = Omit<Surface, 'chunks'>;

/** Adds `chunks`, which is not copied when the surface is posted. */
export function withChunks(surface: WholeSurface, frame: Frame = 'world'): Surface {
  let chunks: readonly SurfaceChunk[] | undefined;
  return Object.defineProperty(surface, 'chunks', {
    get: () => (chunks ??= divided(surface, frame)),
    enumerable: false,
    configurable: true,
  }) as Surface;
}

/** Each triangle belongs to the chunk in which its first vertex lies. */
function divided(surface: WholeSurface, frame: Frame): SurfaceChunk[] {
  const { indices, info, level, levels } = surface;
  const side = (info.chunkSide || Infinity) * 2 ** (levels - 1 - level);
  const counts = info.size.map((samples) => Math.max(1, Math.ceil((samples - 1) / side)));
  const places = placesOf(surface, side, counts, samplesOf(info, frame));
  const lists: number[][] = [];
  for (let corner = 0; corner < indices.length; corner += 3)
    (lists[places[indices[corner]!]!] ??= []).push(corner);
  const number = new Uint32Array(places.length); // of a vertex in the last chunk that used it
  const lastUser = new Int32Array(places.length).fill(-1);
  return Object.entries(lists).map(([place, corners]) =>
    pieceOf(surface, corners, Number(place), number, lastUser),
  );
}

/** The number of the chunk in which each vertex lies. */
function placesOf(
  { positions }: WholeSurface,
  side: number,
  counts: number[],
  samples: Rows,
): Uint32Array {
  const places = new Uint32Array(positions.length / 3);
  if (counts.every((count) => count === 1)) return places;
  for (let v = 0; v < places.length; v++) {
    let place = 0;
    for (let axis = 2; axis >= 0; axis--) {
      const [x, y, z, start] = samples[axis]!;
      const sample =
        x * positions[3 * v]! + y * positions[3 * v + 1]! + z * positions[3 * v + 2]! + start;
      const last = counts[axis]! - 1;
      const at = Math.min(last, Math.max(0, Math.floor(sample / side)));
      place = place * counts[axis]! + at;
    }
    places[v] = place;
  }
  return places;
}

/** The vertices and triangles of some corners, three from each on. */
function pieceOf(
  { positions, normals, indices }: WholeSurface,
  corners: number[],
  place: number,
  number: Uint32Array,
  lastUser: Int32Array,
): SurfaceChunk {
  const own = new Uint32Array(corners.length * 3);
  const vertices: number[] = [];
  corners.forEach((corner, triangle) => {
    for (let i = 0; i < 3; i++) {
      const vertex = indices[corner + i]!;
      if (lastUser[vertex] !== place) {
        lastUser[vertex] = place;
        number[vertex] = vertices.push(vertex) - 1;
      }
      own[3 * triangle + i] = number[vertex]!;
    }
  });
  const picked = (values: Float32Array) => {
    const result = new Float32Array(values.length > 0 ? vertices.length * 3 : 0);
    for (let i = 0; i < result.length; i++)
      result[i] = values[3 * vertices[Math.floor(i / 3)]! + (i % 3)]!;
    return result;
  };
  const own3 = picked(positions);
  return { positions: own3, normals: picked(normals), indices: own, ...boxOf(own3) };
}

function boxOf(positions: Float32Array): Pick<SurfaceChunk, 'min' | 'max'> {
  const min: [number, number, number] = [Infinity, Infinity, Infinity];
  const max: [number, number, number] = [-Infinity, -Infinity, -Infinity];
  positions.forEach((value, i) => {
    min[i % 3] = Math.min(min[i % 3]!, value);
    max[i % 3] = Math.max(max[i % 3]!, value);
  });
  return { min, max };
}

/** On each axis, what x, y and z of a point are multiplied by, and what is added. */
type Rows = readonly (readonly [number, number, number, number])[];

/** From points in a frame to samples. */
function samplesOf({ origin, spacing, direction }: StreamInfo, frame: Frame): Rows {
  if (frame === 'grid')
    return [
      [1, 0, 0, 0],
      [0, 1, 0, 0],
      [0, 0, 1, 0],
    ];
  const at = (row: number, column: number) => direction[3 * (row % 3) + (column % 3)]!;
  // The cofactor of an element, without a sign: rows and columns go round.
  const cofactor = (row: number, column: number) =>
    at(row + 1, column + 1) * at(row + 2, column + 2) -
    at(row + 1, column + 2) * at(row + 2, column + 1);
  const determinant = [0, 1, 2].reduce(
    (sum, column) => sum + at(0, column) * cofactor(0, column),
    0,
  );
  return [0, 1, 2].map((axis) => {
    const of = (row: number) => cofactor(row, axis) / (determinant * spacing[axis]!);
    const start = -(of(0) * origin[0] + of(1) * origin[1] + of(2) * origin[2]);
    return [of(0), of(1), of(2), start];
  });
}

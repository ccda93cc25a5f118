import type { Surface } from '../api/surface.js';

export type Mesh = Pick<Surface, 'positions' | 'normals' | 'indices'>;

/** The part of a mesh that one share makes. Its indices are those of the whole mesh. */
export interface MeshPart {
  readonly positions: Float32Array;
  /** Empty if not requested. */
  readonly normals: Float32Array;
  readonly indices: Uint32Array;
  /**
   * Four numbers for each run of vertices and corners that follow each other in the whole mesh,
   * too: its place in the order of all runs, its first vertex in the whole mesh, how many vertices,
   * how many corners.
   */
  readonly runs: Uint32Array;
}

/** A run, and where in its part it begins. */
interface Run {
  readonly part: MeshPart;
  readonly order: number;
  readonly firstVertex: number;
  readonly vertices: readonly [number, number];
  readonly corners: readonly [number, number];
}

/** Joins the parts of all shares. */
export function joinMesh(parts: readonly MeshPart[]): Mesh {
  const total = (name: 'positions' | 'normals' | 'indices') =>
    parts.reduce((sum, part) => sum + part[name].length, 0);
  const positions = new Float32Array(total('positions'));
  const normals = new Float32Array(total('normals'));
  const indices = new Uint32Array(total('indices'));
  let corner = 0;
  for (const run of parts.flatMap(runsOf).sort((a, b) => a.order - b.order)) {
    const [begin, end] = run.vertices.map((vertex) => 3 * vertex);
    positions.set(run.part.positions.subarray(begin, end), 3 * run.firstVertex);
    if (normals.length > 0) normals.set(run.part.normals.subarray(begin, end), 3 * run.firstVertex);
    const corners = run.part.indices.subarray(...run.corners);
    indices.set(corners, corner);
    corner += corners.length;
  }
  return { positions, normals, indices };
}

function runsOf(part: MeshPart): Run[] {
  const result: Run[] = [];
  const { runs } = part;
  let [vertex, corner] = [0, 0];
  for (let i = 0; i < runs.length; i += 4) {
    const [endVertex, endCorner] = [vertex + runs[i + 2]!, corner + runs[i + 3]!];
    result.push({
      part,
      order: runs[i]!,
      firstVertex: runs[i + 1]!,
      vertices: [vertex, endVertex],
      corners: [corner, endCorner],
    });
    [vertex, corner] = [endVertex, endCorner];
  }
  return result;
}

/** A part in buffers of its own, which can be posted. */
export function copyOf({ positions, normals, indices, runs }: MeshPart) {
  return {
    positions: positions.slice() as Float32Array<ArrayBuffer>,
    normals: normals.slice() as Float32Array<ArrayBuffer>,
    indices: indices.slice() as Uint32Array<ArrayBuffer>,
    runs: runs.slice() as Uint32Array<ArrayBuffer>,
  };
}

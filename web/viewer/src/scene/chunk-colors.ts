import { Color } from 'three';
import type { Shape } from './pane.ts';

/** Pieces as one shape, coloured from the first (blue) to the last (red). */
export function coloured(pieces: readonly Shape[]): Shape & { readonly colors: Float32Array } {
  const total = (count: (piece: Shape) => number) =>
    pieces.reduce((sum, piece) => sum + count(piece), 0);
  const values = total(({ positions }) => positions.length);
  const positions = new Float32Array(values);
  const normals = new Float32Array(values);
  const colors = new Float32Array(values);
  const indices = new Uint32Array(total((piece) => piece.indices.length));
  let [value, corner] = [0, 0];
  pieces.forEach((piece, i) => {
    positions.set(piece.positions, value);
    normals.set(piece.normals, value);
    const hue = 0.62 * (1 - i / Math.max(1, pieces.length - 1));
    const color = new Color().setHSL(hue, 0.6, i % 2 === 0 ? 0.62 : 0.5).toArray();
    for (let k = 0; k < piece.positions.length; k++) colors[value + k] = color[k % 3]!;
    for (const vertex of piece.indices) indices[corner++] = value / 3 + vertex;
    value += piece.positions.length;
  });
  return { positions, normals, colors, indices };
}

import type { Frame, StreamInfo } from '../api/surface.js';

/**
 * The box of the whole grid, [minimum, maximum]. It is known from the header on, so that the camera
 * need not move as the surface grows.
 */
export function boundsOf(info: StreamInfo, frame: Frame = 'world'): [number[], number[]] {
  const minimum = [Infinity, Infinity, Infinity];
  const maximum = [-Infinity, -Infinity, -Infinity];
  for (let corner = 0; corner < 8; corner++) {
    const index = info.size.map((samples, axis) => ((corner >> axis) & 1) * (samples - 1));
    const point = frame === 'grid' ? index : toWorld(info, index);
    for (let axis = 0; axis < 3; axis++) {
      minimum[axis] = Math.min(minimum[axis]!, point[axis]!);
      maximum[axis] = Math.max(maximum[axis]!, point[axis]!);
    }
  }
  return [minimum, maximum];
}

function toWorld({ origin, spacing, direction }: StreamInfo, index: number[]): number[] {
  return origin.map((start, row) =>
    index.reduce((sum, i, axis) => sum + direction[3 * row + axis]! * spacing[axis]! * i, start),
  );
}

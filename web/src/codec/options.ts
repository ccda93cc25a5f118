import { IsostarError } from '../api/errors.js';
import type { DecodeOptions, Limits, SurfaceOptions } from '../api/surface.js';
import { checkLimits, withDefaults } from './limits.js';
import { checkRegion } from './region.js';

/** The options of decode(), sorted by who uses them. `surface` can be posted to a worker. */
export interface SortedOptions {
  readonly signal: AbortSignal | undefined;
  readonly isovalues: AsyncIterable<number> | undefined;
  readonly surface: SurfaceOptions;
}

export function sortOptions(options: DecodeOptions, defaults: Limits | undefined): SortedOptions {
  const { signal, isovalue, polygonizer, frame, normals, region, refinements } = options;
  checkLimits(options.limits);
  checkRegion(region);
  const limits = withDefaults(options.limits, defaults);
  const surface = { polygonizer, frame, normals, region, refinements, limits };
  if (isovalue === undefined) return { signal, isovalues: undefined, surface };
  if (typeof isovalue === 'number')
    return { signal, isovalues: undefined, surface: { ...surface, isovalue } };
  if (!isovalue || typeof isovalue[Symbol.asyncIterator] !== 'function')
    throw new IsostarError('BadArgument', 'isovalue must be a number or an AsyncIterable');
  return { signal, isovalues: isovalue, surface };
}

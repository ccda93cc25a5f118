import { IsostarError } from '../api/errors.js';
import type { Limits } from '../api/surface.js';

export function checkLimits(limits: Limits | undefined): void {
  for (const [name, value] of Object.entries(limits ?? {}))
    if (value !== undefined && !(typeof value === 'number' && value >= 0))
      throw new IsostarError('BadArgument', `limits.${name} must be a number from 0 on`);
}

/** `limits`, and those of `defaults` where it has none. */
export function withDefaults(limits: Limits | undefined, defaults: Limits | undefined): Limits {
  return {
    memory: limits?.memory ?? defaults?.memory,
    samples: limits?.samples ?? defaults?.samples,
    vertices: limits?.vertices ?? defaults?.vertices,
    decisions: limits?.decisions ?? defaults?.decisions,
  };
}

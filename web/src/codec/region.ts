import { IsostarError } from '../api/errors.js';
import type { Region } from '../api/surface.js';

export function checkRegion(region: Region | undefined): void {
  if (region === undefined) return;
  const { min, max } = region ?? {};
  if (!isPoint(min) || !isPoint(max) || min.some((least, axis) => least > max[axis]!))
    throw new IsostarError(
      'BadArgument',
      'region must be { min, max }, three finite numbers each, with min <= max',
    );
}

const isPoint = (value: unknown): value is Region['min'] =>
  Array.isArray(value) && value.length === 3 && value.every(Number.isFinite);

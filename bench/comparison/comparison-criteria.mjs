// The targets of the comparison: { what, target, measured, met }.
import { geometricMean } from '../measure/rate-curve.mjs';
import { fixed, times } from '../output/markdown.mjs';

const known = (all, value) =>
  all
    .map((one) => ({ name: one.name, value: value(one) }))
    .filter(({ value: v }) => v !== undefined && Number.isFinite(v));

function everyOne(what, all, holds) {
  const misses = all.filter((one) => !holds(one));
  const names = misses
    .slice(0, 3)
    .map(({ name }) => name)
    .join(', ');
  return {
    what,
    target: 'every surface',
    measured: `${all.length - misses.length} of ${all.length}${names && `, not ${names}`}`,
    met: misses.length === 0,
  };
}

/** A mean, and the worst surface; with `worst` the target holds for that one too. */
function judged(what, sign, target, all, value, { worst = false, digits = 2 } = {}) {
  const numbers = known(all, value);
  if (numbers.length === 0)
    return { what, target: `${sign} ${target}`, measured: 'not measured', met: undefined };
  const holds = (number) => (sign === '≤' ? number <= target : number >= target);
  const isWorse = (a, b) => (sign === '≤' ? a > b : a < b);
  const mean = geometricMean(numbers.map(({ value: v }) => v));
  const write = (number) => fixed(number, digits);
  const last = numbers.reduce((a, b) => (isWorse(b.value, a.value) ? b : a));
  return {
    what,
    target: `${sign} ${target}${worst ? ' each' : ', mean'}`,
    measured: `mean ${write(mean)}, worst ${write(last.value)} (${last.name})`,
    met: holds(worst ? last.value : mean),
  };
}
const atMost = (what, ...rest) => judged(what, '≤', ...rest);
const atLeast = (what, ...rest) => judged(what, '≥', ...rest);

/** Fewest vertices of surfaces that are divided into chunks. */
export const FEWEST_IN_CHUNKS = 200_000;

/** Times with several threads, of surfaces that are divided into chunks. */
export function threadCriteria(all) {
  const large = all.filter(({ vertices }) => vertices >= FEWEST_IN_CHUNKS);
  const worst = { worst: true };
  return [
    atMost(
      'decode and polygonize against Draco level 7',
      0.8,
      large,
      (one) => one.decodeInThreads,
      worst,
    ),
    atMost(
      'encode against marching cubes and Draco level 7',
      0.6,
      large,
      (one) => one.encode7InThreads,
      worst,
    ),
    atLeast(
      'decode and polygonize, against one thread',
      1.75,
      large,
      (one) => one.decodeGain,
      worst,
    ),
    atLeast('encode, against one thread', 1.75, large, (one) => one.encodeGain, worst),
  ];
}

/** Prefixes are decoded before this. Distances are sampled, so that they may rise a little. */
function falling(all) {
  const NOISE = 1.02;
  const highest = all.reduce((a, b) => (b.largestRise > a.largestRise ? b : a));
  const rising = all.filter((one) => one.largestRise > NOISE).length;
  const step = `largest step ${times(highest.largestRise)} (${highest.name})`;
  const measured = `${all.length - rising} of ${all.length}, ${step}`;
  return {
    what: 'every prefix decodes, and the error falls with bytes',
    target: 'every surface',
    measured,
    met: rising === 0,
  };
}

export function mainCriteria(all) {
  const at = (one, rms) => one.rate.find((point) => point.rms === rms);
  return [
    everyOne('lossless is the surface of marching cubes', all, (one) => one.isLossless),
    everyOne('the default stream keeps its bound', all, (one) => one.keepsBound),
    falling(all),
    atMost('connectivity, bits per vertex', 0.6, all, (one) => one.connectivity),
    atMost(
      'bytes at RMS 0.05 against Draco level 10',
      0.25,
      all,
      (one) => 1 / at(one, 0.05).draco10,
    ),
    atMost(
      'the same as a prefix of the default stream',
      0.25,
      all,
      (one) => 1 / at(one, 0.05).draco10ByPrefix,
    ),
    atMost('decode and polygonize against Draco level 7', 1.5, all, (one) => one.decode, {
      worst: true,
    }),
    atMost('the same in WebAssembly against draco3d', 1.5, all, (one) => one.wasm, { worst: true }),
    atMost('encode against marching cubes and Draco level 7', 1, all, (one) => one.encode7, {
      worst: true,
    }),
    atMost('peak memory of the decoder against Draco’s', 2, all, (one) => one.memory, {
      worst: true,
    }),
    atMost('first surface, share of the bytes', 0.02, all, (one) => one.firstSurface, {
      worst: true,
      digits: 4,
    }),
  ];
}

function smaller(what, target, all, key) {
  const ratios = known(
    all.flatMap((one) =>
      one.rate.map((point) => ({ name: `${one.name} at ${point.rms}`, ...point })),
    ),
    (point) => point[key],
  );
  const mean = geometricMean(ratios.map(({ value }) => value));
  return {
    what,
    target: `≥ ${target}`,
    measured: `${fixed(mean, 2)} over ${ratios.length} ratios`,
    met: mean >= target,
    ratios,
  };
}

export function rateCriteria(all) {
  const { ratios, ...simplified } = smaller(
    'times smaller than simplify × Draco, mean',
    2.5,
    all,
    'simplified',
  );
  const { ratios: _, ...draco } = smaller(
    'times smaller than Draco level 10, mean',
    4.5,
    all,
    'draco10',
  );
  const lowest = ratios.reduce((a, b) => (b.value < a.value ? b : a), { value: Infinity });
  const judged = all.reduce((sum, one) => sum + one.prefixes, 0);
  const farther = all.reduce((sum, one) => sum + one.farther, 0);
  return [
    simplified,
    {
      what: 'smallest ratio',
      target: '≥ 1.2',
      measured: `${fixed(lowest.value, 2)} (${lowest.name})`,
      met: lowest.value >= 1.2,
    },
    draco,
    atMost('connectivity, bits per vertex', 0.48, all, (one) => one.connectivity),
    {
      what: 'prefixes from 2 % on closer to the source than simplify × Draco',
      target: 'every one',
      measured: `${judged - farther} of ${judged}`,
      met: farther === 0,
    },
    atMost('decode and polygonize against Draco level 7', 1, all, (one) => one.decode, {
      worst: true,
    }),
    atMost('the same in WebAssembly against draco3d', 1, all, (one) => one.wasm, { worst: true }),
    atMost('encode against marching cubes and Draco level 10', 2, all, (one) => one.encode10, {
      worst: true,
    }),
  ];
}

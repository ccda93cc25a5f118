import assert from 'node:assert/strict';
import { test } from 'node:test';
import {
  adaptiveFigures,
  keepsTopology,
  furtherShare,
  paperCriteria,
} from '../../bench/paper/paper-criteria.mjs';
import { paperTables } from '../../bench/paper/paper-tables.mjs';

const points = (...pairs) => pairs.map(([bytes, rms]) => ({ bytes, rms }));
const layers = (...pairs) =>
  pairs.map(([components, genus], i) => ({ offset: 10 * (i + 1), components, genus }));

const adaptive = {
  name: 'egg',
  uniform: 900,
  adaptive: { bytes: 400, rms: 0.1, max: 0.19 },
  prefixes: points([100, 0.5], [1000, 0.1], [2000, 0.01]),
  bounds: points([800, 0.1], [1500, 0.02]),
  draco: points([5000, 0.1], [9000, 0.01]),
  simplified: points([300, 0.05], [6000, 0.02]),
};
const topology = { name: 'knot', bytes: 110, uniform: 100, layers: layers([2, 1], [2, 1]) };
const further = { name: 'head', other: 51, bytes: 1000, otherBytes: 900, together: 1090 };
const tetrahedra = {
  name: 'fin',
  isovalue: 1,
  size: [9, 5, 5],
  step: 2,
  bound: 0.05,
  bytes: 100,
  there: { rms: 0.02, max: 0.04 },
  back: { rms: 0.03, max: 0.06 },
  draco: points([200, 0.1], [400, 0.03]),
  simplified: points([90, 0.02]),
};
const image = {
  bytes: 60,
  lossless: true,
  layers: [
    { kind: 'base', level: 0, offset: 27, error: 5 },
    { kind: 'geometry', level: 0, offset: 60, error: 0 },
  ],
};
const all = {
  bound: 0.2,
  adaptive: [adaptive],
  topology: [topology],
  further: [further],
  tetrahedra: [tetrahedra],
  image: [image],
};
const verdicts = (measured) => paperCriteria(measured).map(({ met }) => met);

test('an adaptive stream is compared with the smallest others at its distance', () => {
  const { uniform, simplified } = adaptiveFigures(adaptive);
  assert.deepEqual(
    { uniform, simplified },
    { uniform: 800, simplified: undefined },
    'a curve that starts below the distance has no size there',
  );
  assert.equal(
    adaptiveFigures({ ...adaptive, simplified: points([200, 0.2], [600, 0.1]) }).simplified,
    600,
  );
});

test('each criterion says whether it is met', () => {
  assert.deepEqual(verdicts(all), [true, true, undefined, true, true, false, true, true, true]);
  assert.equal(
    verdicts({
      ...all,
      adaptive: [{ ...adaptive, adaptive: { bytes: 401, rms: 0.1, max: 0.3 } }],
    })[0],
    false,
  );
  assert.equal(
    verdicts({
      ...all,
      adaptive: [{ ...adaptive, adaptive: { bytes: 401, rms: 0.1, max: 0.1 } }],
    })[1],
    false,
  );
  assert.equal(verdicts({ ...all, image: [{ ...image, lossless: false }] }).at(-1), false);
});

test('a bound in world units replaces the default one', () => {
  const own = (worldBound) =>
    paperCriteria({ ...all, tetrahedra: [{ ...tetrahedra, worldBound }] }).find(
      ({ what }) => what.includes('distance both ways') && what.startsWith('fin'),
    );
  assert.equal(own(undefined).target, '≤ 0.10');
  assert.equal(own(0.12).met, true);
  assert.equal(own(0.11).met, false);
});

test('topology has to agree on every layer, and needs manifolds', () => {
  assert.ok(keepsTopology(topology));
  assert.ok(!keepsTopology({ layers: layers([2, 0], [2, 1]) }));
  assert.ok(!keepsTopology({ layers: layers([3, 1], [2, 1]) }));
  assert.ok(!keepsTopology({ layers: layers([2, null], [2, null]) }));
});

test('a further isovalue costs the bytes that it adds', () =>
  assert.equal(furtherShare(further), 0.1));

test('a kind without measurements has no row', () => {
  const none = {
    bound: 0.2,
    adaptive: [],
    topology: [],
    further: [],
    tetrahedra: [],
    image: [image],
  };
  assert.equal(paperCriteria(none).length, 2);
  assert.match(paperTables(none), /^\| image \|/);
  assert.match(paperTables(all), /egg \| 900 \| 400 /);
});

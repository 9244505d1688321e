// Sketches of surfaces: fewer triangles over the same vertices.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { coarseIndex } from '../../apps/editor/page/viewer/coarse_index.js';

/** A plate [0, 1]² of n x n squares at a height, facing up or down. */
function plate(n, height, up, part) {
  const positions = [], normals = [], index = [];
  for (let j = 0; j <= n; ++j)
    for (let i = 0; i <= n; ++i) {
      positions.push(i / n, j / n, height);
      normals.push(0, 0, up ? 1 : -1);
    }
  for (let j = 0; j < n; ++j)
    for (let i = 0; i < n; ++i) {
      const a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
      index.push(...(up ? [a, b, d, a, d, c] : [a, d, b, a, c, d]));
    }
  return { positions, normals, index, partOf: Array((n + 1) * (n + 1)).fill(part) };
}

/** One surface of several. */
function together(...plates) {
  const all = { positions: [], normals: [], index: [], partOf: [] };
  for (const { positions, normals, index, partOf } of plates) {
    const first = all.partOf.length;
    all.positions.push(...positions);
    all.normals.push(...normals);
    all.index.push(...index.map((v) => v + first));
    all.partOf.push(...partOf);
  }
  return { positions: new Float32Array(all.positions), normals: new Float32Array(all.normals), index: new Uint32Array(all.index), partOf: new Uint32Array(all.partOf) };
}

function area({ positions }, index) {
  let sum = 0;
  for (let t = 0; t < index.length; t += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => [...positions.slice(3 * index[t + k], 3 * index[t + k] + 2)]);
    sum += ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2;
  }
  return sum;
}

test('a plate keeps its area but for less than a cell along its border, with two triangles per cell', () => {
  const fine = together(plate(100, 0, true, 0)), cells = 10, cell = 1 / cells;
  const coarse = coarseIndex(fine, cell);
  assert.ok(coarse.length / 3 <= 2 * cells ** 2 && coarse.length / 3 >= 2 * (cells - 1) ** 2, `${coarse.length / 3} triangles`);
  const kept = area(fine, coarse);
  assert.ok(kept <= 1 + 1e-6 && kept >= (1 - cell) ** 2 - 1e-6, `area ${kept}`);
});

test('walls back to back and parts side by side stay apart', () => {
  const thin = together(plate(40, 0, false, 0), plate(40, 1e-3, true, 0), plate(40, 1e-3, true, 1));
  const coarse = coarseIndex(thin, 0.2), side = 41 * 41;
  const counts = [0, 0, 0];
  for (let t = 0; t < coarse.length; t += 3) {
    const of = [0, 1, 2].map((k) => Math.floor(coarse[t + k] / side));
    assert.deepEqual(of, Array(3).fill(of[0]), 'a triangle is of one wall');
    ++counts[of[0]];
  }
  assert.ok(counts.every((count) => count === counts[0] && count > 0), String(counts));
});

test('cells smaller than the triangles change nothing', () => {
  const fine = together(plate(10, 0.3, true, 0));
  assert.deepEqual(coarseIndex(fine, 0.01), fine.index);
});

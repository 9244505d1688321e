// Fewer triangles over the same vertices, for pictures that are seen for a moment.

/**
 * Which way a normal mostly points: walls that lie back to back are not to become one.
 * @param {ArrayLike<number>} normals @param {number} v  offset of the normal
 */
function sideOf(normals, v) {
  let axis = 0;
  for (let k = 1; k < 3; ++k) if (Math.abs(normals[v + k]) > Math.abs(normals[v + axis])) axis = k;
  return 2 * axis + (normals[v + axis] < 0 ? 1 : 0);
}

/**
 * Leaves out triangles: all vertices of a part in one cell of a grid that face the same way become one of them
 * [Rossignac and Borrel 1993]. The vertices may move afterwards.
 * @param {{positions: Float32Array, normals: Float32Array, index: Uint32Array, partOf: Uint32Array}} surface
 * @param {number} cell  length of the sides of a cell
 */
export function coarseIndex({ positions, normals, index, partOf }, cell) {
  /** @type {Map<string, number>} */
  const known = new Map();
  const stands = new Uint32Array(partOf.length);
  for (let v = 0; v < stands.length; ++v) {
    const [i, j, k] = [0, 1, 2].map((axis) => Math.floor(positions[3 * v + axis] / cell));
    const key = `${i},${j},${k},${sideOf(normals, 3 * v)},${partOf[v]}`;
    const first = known.get(key) ?? v;
    known.set(key, first);
    stands[v] = first;
  }
  const kept = [];
  for (let t = 0; t < index.length; t += 3) {
    const a = stands[index[t]], b = stands[index[t + 1]], c = stands[index[t + 2]];
    if (a !== b && b !== c && c !== a) kept.push(a, b, c);
  }
  return Uint32Array.from(kept);
}

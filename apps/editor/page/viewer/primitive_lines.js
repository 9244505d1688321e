// Wireframes of primitives.
import * as THREE from 'three';

/** @typedef {{kind: 'cuboid' | 'cylinder', points: number[][], radii?: number[], closed?: boolean}} Primitive */

/** Lines between the points of primitives. @param {Primitive[]} primitives @returns {number[]} */
export function primitiveLines(primitives) {
  /** @type {number[]} */
  const lines = [];
  for (const primitive of primitives) {
    const p = primitive.points;
    if (primitive.kind === 'cuboid') {
      for (let a = 0; a < 8; ++a)
        for (const bit of [1, 2, 4]) if (!(a & bit)) lines.push(...p[a], ...p[a | bit]);
      continue;
    }
    const count = p.length, axis = new THREE.Vector3(), u = new THREE.Vector3(), v = new THREE.Vector3();
    for (let k = 0; k < count; ++k) {
      const next = primitive.closed ? (k + 1) % count : Math.min(k + 1, count - 1);
      if (next !== k) lines.push(...p[k], ...p[next]);
      const before = primitive.closed ? (k + count - 1) % count : Math.max(k - 1, 0);
      axis.set(p[next][0] - p[before][0], p[next][1] - p[before][1], p[next][2] - p[before][2]).normalize();
      u.set(Math.abs(axis.x) < 0.9 ? 1 : 0, Math.abs(axis.x) < 0.9 ? 0 : 1, 0).cross(axis).normalize();
      v.crossVectors(axis, u);
      const radius = primitive.radii?.[k] ?? 0, sides = 20;
      for (let s = 0; s < sides; ++s)
        for (const angle of [(2 * Math.PI * s) / sides, (2 * Math.PI * (s + 1)) / sides])
          for (let i = 0; i < 3; ++i)
            lines.push(p[k][i] + radius * (Math.cos(angle) * u.getComponent(i) + Math.sin(angle) * v.getComponent(i)));
    }
  }
  return lines;
}

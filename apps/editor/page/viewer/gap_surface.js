// The upper envelope of a design, in the colours of how near the copy above comes to it.
import * as THREE from 'three';

/**
 * Samples of both envelopes, row by row.
 * @typedef {object} Envelopes
 * @property {number} columns
 * @property {Float32Array} place  of the first sample at height 0, then steps to the next column, to the next row, and of height
 * @property {Float32Array} upper  heights; not numbers where there is no surface
 * @property {Float32Array} lower
 * @property {number} f_max  exact distance of copies that touch
 */

/** Samples that are further apart in height than so many steps aside are on different surfaces. */
const steepest = 6;

/**
 * Colour of a distance from the copy above. Short distances differ most.
 * @param {number} share  of the largest distance
 * @param {import('./palettes.js').Palette} palette
 */
export function gapColour(share, palette) {
  return new THREE.Color(palette.contact).lerp(new THREE.Color(palette.apart), Math.sqrt(share));
}

/** How far the copy above stays from each sample. Walls along the direction slide past it. @param {Envelopes} envelopes */
export function distances({ upper, lower, f_max: touching }) {
  return Float32Array.from(upper, (height, k) => Math.max(0, touching - (height - lower[k])));
}

/** @param {Envelopes} envelopes */
export function largestDistance(envelopes) {
  return distances(envelopes).reduce((most, one) => (one > most ? one : most), 0);
}

/**
 * @param {Envelopes} envelopes
 * @param {import('./palettes.js').Palette} palette
 */
export function gapGeometry(envelopes, palette) {
  const { columns, place, upper } = envelopes, [first, right, up, high] = [0, 3, 6, 9].map((at) => new THREE.Vector3().fromArray(place, at));
  const apart = distances(envelopes), most = largestDistance(envelopes) || 1;
  const positions = new Float32Array(3 * upper.length), colours = new Float32Array(3 * upper.length);
  const point = new THREE.Vector3(), index = [];
  const limit = steepest * Math.max(right.length(), up.length());
  for (let k = 0; k < upper.length; ++k) {
    if (Number.isNaN(upper[k])) continue;
    const i = k % columns, j = Math.floor(k / columns);
    point.copy(first).addScaledVector(right, i).addScaledVector(up, j).addScaledVector(high, upper[k]).toArray(positions, 3 * k);
    gapColour(apart[k] / most, palette).toArray(colours, 3 * k);
    const corners = [k, k + 1, k + columns + 1, k + columns], heights = corners.map((corner) => upper[corner]);
    if (i + 1 < columns && k + columns < upper.length && Math.max(...heights) - Math.min(...heights) <= limit)
      index.push(k, k + 1, k + columns + 1, k, k + columns + 1, k + columns);
  }
  return new THREE.BufferGeometry().setIndex(index)
    .setAttribute('position', new THREE.BufferAttribute(positions, 3)).setAttribute('color', new THREE.BufferAttribute(colours, 3));
}

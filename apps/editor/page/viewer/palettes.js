// Colours of the figures, one per meaning, for a light and a dark ground.
import { Color } from 'three';

export const palettes = {
  light: { ground: 0xf3f4f5, rest: 0xf2c649, changed: 0x7fba63, ghost: 0xaab3be, ghostEdge: 0x30343a, edge: 0x30343a, choice: 0x2f64ab, contact: 0xd6191f,
    before: 0xb98a10, apart: 0xe4e8ee, joint: 0x8a3fb0, plane: 0x2f64ab },
  dark: { ground: 0x1b1d20, rest: 0xe3b73c, changed: 0x74ad59, ghost: 0x8d98a4, ghostEdge: 0xc3cbd4, edge: 0x0d0e10, choice: 0x8ab4ec, contact: 0xff4d52,
    before: 0xf0c348, apart: 0x2c333b, joint: 0xcf8af0, plane: 0x8ab4ec },
};

/** @typedef {typeof palettes.light} Palette */

/** Colours that tell parts apart: Okabe and Ito 2008, lightened. */
export const partColours = [0xe8b04a, 0x7cc3ea, 0x4fb89a, 0xf0e06b, 0x5f97c9, 0xe08a5c, 0xd49bbd, 0xb0b6bd].map((hex) => new Color(hex));

/** Colour of the strokes of a name. @param {number} k */
export function strokeColour(k) {
  return '#' + partColours[(k + 2) % partColours.length].clone().lerp(new Color(0x000000), 0.25).getHexString();
}

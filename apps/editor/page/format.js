// Numbers as people read them.

/** @param {number} value */
export const stackability = (value) => (Number.isFinite(value) ? value.toFixed(2).replace(/^-0\.00$/, '0.00').replace('-', '−') : '–');

/** @param {number} value @param {number} digits */
export const signed = (value, digits = 2) => {
  const text = Math.abs(value).toFixed(digits);
  return Number(text) === 0 ? text : (value > 0 ? '+' : '−') + text;
};

/** @param {number} value  fraction */
export const percent = (value) => (100 * value).toFixed(Math.abs(value) < 0.1 ? 1 : 0) + ' %';

/** @param {number} value @param {string | null} unit */
export function length(value, unit) {
  const text = value === 0 ? '0' : Number(value.toPrecision(3)).toString();
  return unit ? `${text} ${unit}` : text;
}

/** A number for the program: all digits. @param {number} value */
export const exact = (value) => (Math.abs(value) < 1e-300 ? '0' : String(value));

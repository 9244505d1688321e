// S along the axis of a drag, and the limits at its ends.
import { element } from './dom.js';
import { stackability } from './format.js';

const width = 236, height = 64;

/** @param {any} range  @param {number | null} share  where the drag is */
export function showRange(range, share) {
  const card = element('range');
  card.hidden = !range?.edit || !range.samples.length;
  if (card.hidden) return;
  const values = range.samples.map((/** @type {number[]} */ sample) => sample[1]);
  const low = Math.min(...values), high = Math.max(low + 0.02, ...values);
  const x = (/** @type {number} */ amount) => 4 + ((amount + 1) / 2) * (width - 8);
  const y = (/** @type {number} */ s) => height - 8 - ((s - low) / (high - low)) * (height - 18);
  const path = range.samples.map((/** @type {number[]} */ sample, /** @type {number} */ k) => `${k ? 'L' : 'M'}${x(sample[0]).toFixed(1)} ${y(sample[1]).toFixed(1)}`).join('');
  const ends = [[range.low, range.below], [range.high, range.above]].map(([amount, words]) =>
    `<line class="${words ? 'limit' : 'end'}" x1="${x(amount)}" x2="${x(amount)}" y1="4" y2="${height - 4}"/>`).join('');
  const now = share === null ? '' : `<line class="now" x1="${x(share)}" x2="${x(share)}" y1="2" y2="${height - 2}"/>`;
  const picture = card.querySelector('svg');
  if (picture) {
    picture.setAttribute('viewBox', `0 0 ${width} ${height}`);
    picture.innerHTML = `<line class="zero" x1="${x(0)}" x2="${x(0)}" y1="4" y2="${height - 4}"/>${ends}<path d="${path}"/>${now}`;
  }
  const most = Math.max(...values);
  element('range-best').textContent = stackability(low) === stackability(most) ? `S stays ${stackability(low)}` : `S ${stackability(low)} to ${stackability(most)}`;
  const words = [range.below, range.above].filter((one) => one);
  element('range-limits').textContent = words.length ? 'Held by ' + [...new Set(words)].join('; ').replaceAll('limit: ', '') : 'No limit within reach';
}

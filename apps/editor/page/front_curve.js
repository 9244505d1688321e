// The designs of a front: the change of each over its S. The list beside it says the same in words.
import * as format from './format.js';

const width = 300, height = 130, left = 34, bottom = 20, top = 8, right = 8, reach = 12;

export class FrontCurve {
  /** @param {{preview: (number: number) => void, leave: () => void, take: (number: number) => void}} actions */
  constructor(actions) {
    this.element = document.createElement('div');
    this.element.className = 'curve';
    this.element.hidden = true;
    this.element.setAttribute('aria-hidden', 'true');
    /** Designs in the picture. @type {{number: number, x: number, y: number}[]} */
    this.points = [];
    this.element.addEventListener('mousemove', (event) => {
      const point = this.#nearest(event);
      this.#mark(point?.number);
      if (point) actions.preview(point.number);
      else actions.leave();
    });
    this.element.addEventListener('mouseleave', () => { this.#mark(undefined); actions.leave(); });
    this.element.addEventListener('click', (event) => {
      const point = this.#nearest(event);
      if (point) actions.take(point.number);
    });
  }

  /** @param {any} message */
  set({ front, list, at_rest: rest }) {
    this.element.hidden = !front || !list.length;
    if (this.element.hidden) return;
    const most = Math.max(...list.map((/** @type {any} */ one) => one.stackability)), largest = Math.max(1e-9, ...list.map((/** @type {any} */ one) => one.change));
    const x = (/** @type {number} */ s) => left + ((s - rest) / (most - rest)) * (width - left - right);
    const y = (/** @type {number} */ change) => height - bottom - (change / largest) * (height - bottom - top);
    this.points = list.map((/** @type {any} */ one) => ({ number: one.number, x: x(one.stackability), y: y(one.change) }));
    const path = [{ x: x(rest), y: y(0) }, ...this.points].map((one, k) => `${k ? 'L' : 'M'}${one.x.toFixed(1)} ${one.y.toFixed(1)}`).join('');
    const dots = this.points.map((one) => `<circle data-number="${one.number}" cx="${one.x.toFixed(1)}" cy="${one.y.toFixed(1)}" r="4.5"/>`).join('');
    const words = [[left, height - 5, 'start', `S ${format.stackability(rest)}`], [width - right, height - 5, 'end', `S ${format.stackability(most)}`],
      [left - 4, top + 9, 'end', format.percent(largest)], [left - 4, height - bottom, 'end', '0 %']].map(([at, line, anchor, text]) =>
      `<text x="${at}" y="${line}" text-anchor="${anchor}">${text}</text>`).join('');
    this.element.innerHTML = `<svg viewBox="0 0 ${width} ${height}"><path class="axes" d="M${left} ${top}V${height - bottom}H${width - right}"/><path d="${path}"/>${dots}${words}</svg>`;
  }

  /** @param {MouseEvent} event */
  #nearest(event) {
    const box = this.element.firstElementChild?.getBoundingClientRect();
    if (!box) return undefined;
    const x = ((event.clientX - box.left) / box.width) * width, y = ((event.clientY - box.top) / box.height) * height;
    const away = (/** @type {{x: number, y: number}} */ one) => Math.hypot(one.x - x, one.y - y);
    return this.points.filter((one) => away(one) <= reach).sort((a, b) => away(a) - away(b))[0];
  }

  /** @param {number | undefined} number */
  #mark(number) {
    this.element.style.cursor = number === undefined ? '' : 'pointer';
    for (const dot of this.element.querySelectorAll('circle')) dot.classList.toggle('chosen', dot.dataset.number === String(number));
  }
}

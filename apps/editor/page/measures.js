// The numbers that are always in view.
import { create, element } from './dom.js';
import * as format from './format.js';

export class Measures {
  /** @param {(command: object) => void} send */
  constructor(send) {
    this.model = /** @type {any} */ (null);
    this.design = /** @type {any} */ (null);
    this.wishes = /** @type {any} */ (null);
    this.typing = /** @type {HTMLInputElement | null} */ (null); // what comes from the program does not overwrite it
    const target = /** @type {HTMLInputElement} */ (element('target'));
    target.addEventListener('change', () => {
      const value = Number(target.value);
      if (target.value !== '' && value < 1) send({ do: 'target', value });
      else if (this.wishes) target.value = this.wishes.target.toFixed(2);
    });
    const within = /** @type {HTMLInputElement} */ (element('within')), copies = element('copies');
    for (const field of [target, within]) {
      field.addEventListener('input', () => { this.typing = field; });
      for (const end of ['change', 'blur']) field.addEventListener(end, () => { this.typing = null; });
    }
    const sendWithin = () => send({ do: 'within', copies: this.copies, length: Number(within.value) });
    within.addEventListener('change', () => {
      if (within.value !== '') sendWithin();
      else if (this.wishes?.within) send({ do: 'target', value: this.wishes.target });
    });
    copies.addEventListener('input', () => this.#update());
    copies.addEventListener('change', () => { if (this.wishes?.within && this.wishes.within.copies !== this.copies) sendWithin(); });
  }

  /** How many copies the height of a stack is told of. */
  get copies() {
    const { value, min, max } = /** @type {HTMLInputElement} */ (element('copies'));
    return Math.round(Math.min(Number(max), Math.max(Number(min), Number(value) || 0)));
  }

  /** @param {any} model */
  setModel(model) { this.model = model; }

  /** @param {any} wishes */
  setWishes(wishes) {
    this.wishes = wishes;
    const show = (/** @type {string} */ name, /** @type {string} */ value) => {
      const field = /** @type {HTMLInputElement} */ (element(name));
      if (field !== this.typing) field.value = value;
    };
    const { within } = wishes, copies = /** @type {HTMLInputElement} */ (element('copies'));
    show('target', String(Math.round(100 * wishes.target) / 100));
    show('within', within ? String(within.length) : '');
    if (within) copies.value = String(within.copies);
    this.#update();
  }

  /** @param {any} design */
  setDesign(design) {
    const began = design.dragging && !this.design?.dragging;
    this.design = design;
    if (began) this.setReview({ ready: false });
    this.#update();
  }

  /** @param {any} review */
  setReview(review) {
    const list = element('words');
    if (!review.ready) {
      if (this.design?.dragging) list.replaceChildren(create('li', 'none', 'Let go to keep, Escape to give up'));
      return;
    }
    const nothing = (this.design?.change ?? 0) < 1e-9;
    list.replaceChildren(...(nothing ? ['As given: nothing is changed yet'] : review.words).map((/** @type {string} */ words) => create('li', nothing ? 'none' : '', words)));
  }

  /** Shows S of a design that is only looked at. @param {number | null} value @param {number | null} f */
  preview(value, f) {
    this.#update(value, f);
  }

  /** @param {number | null} [value] @param {number | null} [f] */
  #update(value = null, f = null) {
    const { design, wishes, model } = this;
    if (!design || !wishes || !model) return;
    const s = value ?? design.measured.stackability, step = f ?? design.measured.f_max;
    const gain = value === null ? s - design.rest.stackability : s - design.measured.stackability;
    element('s').textContent = format.stackability(s);
    const delta = element('s-change');
    delta.textContent = Math.abs(gain) < 0.005 ? '' : format.signed(gain);
    delta.title = value === null ? 'since rest' : 'against the current design';
    delta.classList.toggle('down', gain < 0);
    const share = (/** @type {number} */ x) => `${100 * Math.max(0, Math.min(1, x))}%`;
    const bar = element('bar');
    /** @type {HTMLElement} */ (bar.children[0]).style.width = share(s);
    /** @type {HTMLElement} */ (bar.children[1]).style.left = share(design.rest.stackability);
    /** @type {HTMLElement} */ (bar.children[2]).style.left = share(wishes.target);
    bar.setAttribute('aria-label', `S ${format.stackability(s)}, at rest ${format.stackability(design.rest.stackability)}, target ${format.stackability(wishes.target)}`);
    element('rest-legend').textContent = `At rest ${format.stackability(design.rest.stackability)}`;
    element('f').textContent = format.length(step, model.unit);
    element('h').textContent = format.length(design.measured.height, model.unit);
    element('stack').classList.toggle('beyond', Boolean(wishes.within) && value === null && !design.reaches);
    element('stack').textContent = format.length(design.measured.height + (this.copies - 1) * step, model.unit);
    element('change').textContent = format.percent(design.change);
    element('energy').textContent = format.signed(design.energy.value, 3);
    element('direction').textContent = design.direction_words;
  }
}

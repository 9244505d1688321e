// The limits of quality: how near each one is, and how to allow more.
import { create, element } from './dom.js';

/** @param {string} name */
const plain = (name) => name.replace(/^quality: /, '').replace(/[-_]/g, ' ');

export class Quality {
  /** @param {(command: object) => void} send */
  constructor(send) {
    this.send = send;
    this.panel = element('panel-quality');
    this.model = /** @type {any} */ (null);
    this.wishes = /** @type {any} */ (null);
    this.checks = /** @type {any[]} */ ([]);
    this.list = create('ul', 'limits');
    this.panel.append(create('p', 'note', 'What a person looks at, measured on the mesh against rest. No edit goes beyond a limit; allow more where it does not matter.'), this.list);
  }

  /** @param {any} model */
  setModel(model) { this.model = model; }

  /** @param {any} wishes */
  setWishes(wishes) {
    this.wishes = wishes;
    this.#show();
  }

  /** All checks, or those that follow a drag. @param {any[]} checks */
  setChecks(checks) {
    const known = new Map(this.checks.map((check) => [check.name, check]));
    for (const check of checks) known.set(check.name, check);
    this.checks = [...known.values()];
    this.#show();
    this.#nearest();
  }

  /** The limit that is nearest, always in view. */
  #nearest() {
    const line = element('nearest');
    const nearest = this.checks.filter((check) => check.share !== undefined).reduce((best, check) => (check.share > (best?.share ?? 0) ? check : best), null);
    const share = nearest?.share ?? 0;
    line.textContent = share < 0.01 ? 'none' : `${plain(nearest.name)} ${Math.round(100 * Math.min(share, 9.99))} %`;
    line.className = share > 1 ? 'bad' : share > 0.75 ? 'near' : '';
  }

  #show() {
    if (this.panel.contains(document.activeElement) && document.activeElement instanceof HTMLInputElement) return;
    if (!this.model || !this.wishes) return;
    const byName = new Map(this.checks.map((check) => [check.name, check]));
    const rows = this.model.measures.map((/** @type {any} */ measure) => {
      const check = byName.get('quality: ' + measure.name), limit = this.wishes.limits[measure.name];
      return { measure, check, limit, share: limit === null ? 0 : check?.share ?? 0 };
    });
    rows.sort((/** @type {any} */ a, /** @type {any} */ b) => b.share - a.share);
    this.list.replaceChildren(...rows.map((/** @type {any} */ row) => this.#row(row)));
  }

  /** @param {{measure: any, check: any, limit: number | null, share: number}} row */
  #row({ measure, check, limit, share }) {
    const line = create('li'), top = create('div', 'top'), bar = create('div', 'meter'), fill = create('i');
    line.className = limit === null ? 'free' : share > 1 ? 'bad' : share > 0.75 ? 'near' : '';
    top.append(create('b', '', plain(measure.name)));
    const form = create('span', 'limit'), input = create('input'), free = create('input'), label = create('label', 'check');
    input.type = 'number';
    input.step = 'any';
    input.min = '0';
    if (measure.lower) input.max = '1';
    input.disabled = limit === null;
    input.value = limit === null ? '' : String(Number(limit.toPrecision(4)));
    input.setAttribute('aria-label', `Limit of ${plain(measure.name)}, ${measure.unit}`);
    input.addEventListener('change', () => {
      const value = Number(input.value);
      if (input.value !== '' && value >= 0) this.send({ do: 'limit', measure: measure.name, value });
      input.blur();
    });
    free.type = 'checkbox';
    free.checked = limit === null;
    free.addEventListener('change', () => {
      this.send({ do: 'limit', measure: measure.name, value: free.checked ? null : measure.limit });
      free.blur();
    });
    label.append(free, ' any');
    label.title = `No limit for ${plain(measure.name)}`;
    free.setAttribute('aria-label', label.title);
    form.append(measure.lower ? 'at least ' : 'at most ', input, label);
    top.append(form);
    fill.style.width = `${Math.min(100, 100 * share)}%`;
    bar.append(fill);
    line.append(top, bar, create('small', '', check ? check.words : measure.unit));
    return line;
  }
}

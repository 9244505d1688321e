// Painting parts on the object: strokes of two names say what is cut from what.
import { MOUSE } from 'three';
import { create, element } from './dom.js';
import { strokeColour } from './viewer/palettes.js';

export class Strokes {
  /**
   * @param {import('./viewer/viewer.js').Viewer} viewer
   * @param {import('./picker.js').Picker} picker
   * @param {(command: object) => void} send
   */
  constructor(viewer, picker, send) {
    this.viewer = viewer;
    this.picker = picker;
    this.send = send;
    this.active = false;
    /** @type {Map<string, Set<number>>} */
    this.strokes = new Map();
    this.names = /** @type {string[]} */ ([]);
    const box = element('strokes');
    this.toggle = create('button', '', 'Paint parts');
    this.toggle.title = 'Paint parts (K)';
    this.toggle.setAttribute('aria-pressed', 'false');
    this.toggle.addEventListener('click', () => this.set(!this.active));
    this.form = create('div', 'paint');
    this.form.hidden = true;
    this.name = create('input');
    this.name.setAttribute('list', 'part-names');
    this.name.setAttribute('aria-label', 'Part that the strokes belong to');
    this.name.placeholder = 'name of the part';
    this.known = create('datalist');
    this.known.id = 'part-names';
    this.cut = create('button', 'primary', 'Cut');
    this.cut.addEventListener('click', () => this.#cut());
    const clear = create('button', '', 'Clear');
    clear.addEventListener('click', () => this.clear());
    this.legend = create('ul', 'legend');
    const row = create('div', 'row');
    row.append(this.name, this.known, this.cut, clear);
    this.form.append(create('p', 'note', 'Draw a stroke on what becomes a part of its own, then another name on what stays. The right button turns the view.'), row, this.legend);
    box.append(this.toggle, this.form);
    const { canvas } = viewer;
    canvas.addEventListener('pointerdown', (event) => this.#down(event), { capture: true });
    canvas.addEventListener('pointermove', (event) => this.#paint(event));
    canvas.addEventListener('pointerup', () => (this.drawing = false));
    this.drawing = false;
    /** @type {{x: number, y: number} | null} */
    this.last = null;
  }

  /** @param {string[]} names  of the parts there are */
  setNames(names) {
    this.names = names;
    this.known.replaceChildren(...names.map((name) => new Option(name)));
    this.clear();
  }

  /** @param {boolean} active */
  set(active) {
    this.active = active;
    this.toggle.setAttribute('aria-pressed', String(active));
    this.form.hidden = !active;
    this.viewer.controls.mouseButtons = active ? { LEFT: null, MIDDLE: MOUSE.DOLLY, RIGHT: MOUSE.ROTATE } : { LEFT: MOUSE.ROTATE, MIDDLE: MOUSE.DOLLY, RIGHT: MOUSE.PAN };
    this.viewer.canvas.style.cursor = active ? 'crosshair' : '';
    if (active && !this.name.value) this.name.value = this.#fresh();
    if (!active) this.clear();
  }

  /** A name that no part has. */
  #fresh() {
    let number = 1;
    while (this.names.includes('new_' + number)) ++number;
    return 'new_' + number;
  }

  clear() {
    this.strokes.clear();
    this.#show();
  }

  /** @param {PointerEvent} event */
  #down(event) {
    if (!this.active || event.button !== 0) return;
    event.stopImmediatePropagation();
    this.viewer.canvas.setPointerCapture(event.pointerId);
    this.drawing = true;
    this.last = null;
    this.#paint(event);
  }

  /** @param {PointerEvent} event */
  #paint(event) {
    if (!this.active || !this.drawing || !this.name.value) return;
    const to = { x: event.clientX, y: event.clientY }, from = this.last ?? to;
    const steps = Math.max(1, Math.ceil(Math.hypot(to.x - from.x, to.y - from.y) / 3));
    for (let k = 1; k <= steps; ++k) {
      const hit = this.picker.pick(from.x + ((to.x - from.x) * k) / steps, from.y + ((to.y - from.y) * k) / steps);
      if (!hit) continue;
      for (const [name, triangles] of this.strokes) if (name !== this.name.value) triangles.delete(hit.triangle);
      if (!this.strokes.has(this.name.value)) this.strokes.set(this.name.value, new Set());
      this.strokes.get(this.name.value)?.add(hit.triangle);
    }
    this.last = to;
    this.#show();
  }

  #show() {
    for (const [name, triangles] of this.strokes) if (!triangles.size) this.strokes.delete(name);
    this.viewer.main.setStrokes([...this.strokes.values()]);
    this.legend.replaceChildren(...[...this.strokes.keys()].map((name, k) => {
      const line = create('li', '', name), colour = create('i');
      colour.style.background = strokeColour(k);
      line.prepend(colour);
      return line;
    }));
    this.cut.disabled = this.strokes.size === 0;
  }

  #cut() {
    this.send({ do: 'segment', strokes: [...this.strokes].map(([part, triangles]) => ({ part, triangles: [...triangles] })) });
  }
}

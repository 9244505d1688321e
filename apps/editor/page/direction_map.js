// The map of directions: S along each of them on the half sphere seen from above, and a mark to drag over it.
import { create, element } from './dom.js';
import * as format from './format.js';

const size = 216, middle = size / 2, rim = middle - 10;
/** A mark that is dropped nearer to the best direction than this snaps to it, in radians. */
const snap = (6 * Math.PI) / 180;
/** Of keys, in radians. */
const keyStep = (3 * Math.PI) / 180;

/** From pale to deep: S from 0 to the largest one. @type {[number, number, number][]} */
const ramp = [[241, 244, 248], [190, 214, 236], [120, 170, 216], [58, 117, 182], [22, 62, 122]];

/** @param {number} s  share of the largest S */
function colourOf(s) {
  const at = Math.max(0, Math.min(1, s)) * (ramp.length - 1), k = Math.min(Math.floor(at), ramp.length - 2), t = at - k;
  return `rgb(${ramp[k].map((a, i) => Math.round(a + t * (ramp[k + 1][i] - a))).join(' ')})`;
}

/** A direction with z >= 0. @param {number[]} d */
function upward([x, y, z]) {
  const length = Math.hypot(x, y, z) || 1, sign = z < 0 ? -1 : 1;
  return [(sign * x) / length, (sign * y) / length, (sign * z) / length];
}

/** Place of a direction on the disc: the angle from z is the distance from the middle. @param {number[]} d */
function placeOf(d) {
  const [x, y, z] = upward(d), angle = Math.acos(Math.min(1, z)), far = Math.hypot(x, y) || 1;
  const r = (angle / (Math.PI / 2)) * rim;
  return { x: middle + (r * x) / far, y: middle - (r * y) / far };
}

/** @param {number} px @param {number} py */
function directionAt(px, py) {
  const x = (px - middle) / rim, y = (middle - py) / rim, r = Math.min(1, Math.hypot(x, y)), far = Math.hypot(x, y) || 1;
  const angle = (r * Math.PI) / 2;
  return [(Math.sin(angle) * x) / far, (Math.sin(angle) * y) / far, Math.cos(angle)];
}

/** @param {number[]} a @param {number[]} b */
const angleBetween = (a, b) => Math.acos(Math.min(1, Math.abs(a[0] * b[0] + a[1] * b[1] + a[2] * b[2])));

export class DirectionMap {
  /**
   * @param {{wanted: () => void, look: (direction: number[], overHeight: number) => void, leave: () => void,
   *   take: (direction: number[]) => void}} actions
   */
  constructor(actions) {
    this.actions = actions;
    this.card = element('direction-map');
    /** The map, if it is known. @type {{samples: number[][], best: {direction: number[], stackability: number, words: string}} | null} */
    this.map = null;
    this.current = [0, 0, 1];
    /** Where the mark is while it is dragged. @type {number[] | null} */
    this.dragged = null;
    this.canvas = create('canvas');
    this.canvas.width = this.canvas.height = 2 * size;
    this.canvas.tabIndex = 0;
    this.canvas.setAttribute('role', 'application');
    this.canvas.setAttribute('aria-label', 'Map of directions, seen from above. Drag the mark, or move it by arrow keys and press Enter.');
    this.value = create('p');
    this.value.setAttribute('role', 'status');
    this.best = create('button', 'primary');
    this.best.addEventListener('click', () => this.map && this.actions.take(this.map.best.direction));
    const top = create('div', 'top'), close = create('button', '', 'Close');
    close.addEventListener('click', () => this.show(false));
    top.append(create('b', '', 'Direction'), close);
    this.card.append(top, this.canvas, this.value, this.best);
    this.canvas.addEventListener('pointerdown', (event) => this.#drag(event));
    this.canvas.addEventListener('pointermove', (event) => this.canvas.hasPointerCapture(event.pointerId) && this.#drag(event));
    this.canvas.addEventListener('pointerup', () => this.#drop());
    this.canvas.addEventListener('pointercancel', () => this.#giveUp());
    this.canvas.addEventListener('keydown', (event) => this.#key(event));
  }

  get open() { return !this.card.hidden; }

  /** @param {boolean} open */
  show(open) {
    this.card.hidden = !open;
    if (!open) return this.#giveUp();
    if (!this.map) this.actions.wanted();
    this.#draw();
    this.canvas.focus();
  }

  /** Paints the map again, after the page has other colours. */
  paint() { this.#draw(); }

  /** Another design: its map is another one. @param {number[]} direction */
  setDirection(direction) {
    this.current = upward(direction);
    this.#draw();
  }

  /** @param {any} message */
  set(message) {
    this.map = message.ready ? message : null;
    if (!this.map && this.open) this.actions.wanted();
    this.#draw();
  }

  /** The sample nearest to a direction. @param {number[]} direction @returns {number[] | null} */
  #sampleAt(direction) {
    if (!this.map) return null;
    return this.map.samples.reduce((best, sample) => (angleBetween(sample, direction) < angleBetween(best, direction) ? sample : best));
  }

  /** @param {PointerEvent} event */
  #drag(event) {
    this.canvas.setPointerCapture(event.pointerId);
    const box = this.canvas.getBoundingClientRect();
    this.#look(directionAt(((event.clientX - box.left) * size) / box.width, ((event.clientY - box.top) * size) / box.height));
  }

  /** @param {number[]} direction */
  #look(direction) {
    const snapped = this.map && angleBetween(direction, this.map.best.direction) < snap ? upward(this.map.best.direction) : direction;
    this.dragged = snapped;
    const sample = this.#sampleAt(snapped);
    if (sample) this.actions.look(snapped, 1 - sample[3]);
    this.#draw();
  }

  #drop() {
    const direction = this.dragged;
    if (!direction) return;
    this.dragged = null;
    const exact = this.map && angleBetween(direction, this.map.best.direction) < 1e-9 ? this.map.best.direction : direction;
    this.actions.leave();
    this.actions.take(exact);
  }

  #giveUp() {
    if (!this.dragged) return;
    this.dragged = null;
    this.actions.leave();
    this.#draw();
  }

  /** @param {KeyboardEvent} event */
  #key(event) {
    const steps = /** @type {Record<string, [number, number]>} */ ({ ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] })[event.key];
    if (steps) {
      const { x, y } = placeOf(this.dragged ?? this.current), pixels = (keyStep / (Math.PI / 2)) * rim;
      this.#look(directionAt(x + steps[0] * pixels, y + steps[1] * pixels));
    } else if (event.key === 'Enter') this.#drop();
    else if (event.key === 'Escape') { if (this.dragged) this.#giveUp(); else this.show(false); }
    else return;
    event.preventDefault();
    event.stopPropagation();
  }

  #draw() {
    if (!this.open) return;
    const pen = this.canvas.getContext('2d'), style = getComputedStyle(document.documentElement);
    if (!pen) return;
    pen.setTransform(2, 0, 0, 2, 0, 0);
    pen.clearRect(0, 0, size, size);
    pen.save();
    pen.beginPath();
    pen.arc(middle, middle, rim, 0, 2 * Math.PI);
    pen.clip();
    const most = Math.max(this.map?.best.stackability ?? 0, 0.05);
    for (const [x, y, z, s] of this.map?.samples ?? []) {
      const at = placeOf([x, y, z]);
      pen.fillStyle = colourOf(s / most);
      pen.fillRect(at.x - 4.2, at.y - 4.2, 8.4, 8.4);
    }
    pen.restore();
    pen.strokeStyle = style.getPropertyValue('--line');
    pen.beginPath();
    pen.arc(middle, middle, rim, 0, 2 * Math.PI);
    pen.stroke();
    if (this.map) this.#mark(pen, this.map.best.direction, style.getPropertyValue('--good-fill'), 5);
    this.#mark(pen, this.dragged ?? this.current, style.getPropertyValue('--bad'), 7);
    this.#say();
  }

  /** @param {CanvasRenderingContext2D} pen @param {number[]} direction @param {string} colour @param {number} radius */
  #mark(pen, direction, colour, radius) {
    const { x, y } = placeOf(direction);
    pen.beginPath();
    pen.arc(x, y, radius, 0, 2 * Math.PI);
    pen.fillStyle = colour;
    pen.fill();
    pen.lineWidth = 2;
    pen.strokeStyle = '#fff';
    pen.stroke();
    pen.lineWidth = 1;
  }

  #say() {
    const sample = this.#sampleAt(this.dragged ?? this.current);
    this.value.textContent = sample ? `S about ${format.stackability(sample[3])} here, seen from above` : 'Measuring all directions …';
    this.best.hidden = !this.map;
    if (this.map) this.best.textContent = `Best: S ${format.stackability(this.map.best.stackability)}, ${this.map.best.words}`;
    this.best.disabled = !this.map || angleBetween(this.map.best.direction, this.current) < 1e-6;
  }
}

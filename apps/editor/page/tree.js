// Every design visited, as a tree that grows to the right.
import { create, element, walkWithArrows } from './dom.js';
import * as format from './format.js';

const width = 140, height = 56;

export class Tree {
  /**
   * @param {import('./viewer/viewer.js').Viewer} viewer
   * @param {{go: (node: number) => void, picture: (node: number) => void, leave: () => void,
   *   preview: (node: {vertices: Float32Array, f_max: number, stackability: number, direction: number[]}) => void}} actions
   */
  constructor(viewer, actions) {
    this.viewer = viewer;
    this.actions = actions;
    this.list = element('tree');
    /** @type {Map<number, Float32Array>} */
    this.vertices = new Map();
    /** f_max of nodes. @type {Map<number, number>} */
    this.steps = new Map();
    /** @type {Map<number, HTMLButtonElement>} */
    this.nodes = new Map();
    this.message = /** @type {any} */ (null);
    this.lines = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
    this.lines.setAttribute('aria-hidden', 'true');
    walkWithArrows(this.list);
  }

  /** @param {number} node @param {Float32Array} vertices */
  setVertices(node, vertices) {
    this.vertices.set(node, vertices);
    this.#paint(node);
  }

  /** Forgets all designs: those that come are of another structure. */
  clear() {
    this.nodes.clear();
    this.vertices.clear();
    this.steps.clear();
  }

  /** Comes before the vertices of the node. @param {number} node @param {number} f_max */
  setStep(node, f_max) { this.steps.set(node, f_max); }

  /** @param {any} message */
  set(message) {
    this.message = message;
    if (message.nodes.length < this.nodes.size) this.clear();
    const places = layout(message.nodes);
    const path = new Set();
    for (let node = message.current; node >= 0; node = message.nodes[node].parent) path.add(node);
    message.nodes.forEach((/** @type {any} */ node, /** @type {number} */ k) => {
      const button = this.#node(k, node);
      button.style.left = `${12 + width * places[k].column}px`;
      button.style.top = `${8 + height * places[k].row}px`;
      if (k === message.current) button.setAttribute('aria-current', 'true');
      else button.removeAttribute('aria-current');
      button.setAttribute('aria-level', String(places[k].column + 1));
      button.tabIndex = k === message.current ? 0 : -1;
    });
    this.#connect(message.nodes, places, path);
    const rows = 1 + Math.max(...places.map((place) => place.row));
    this.list.style.height = `${10 + height * Math.min(rows, 2)}px`;
    this.#place();
    this.nodes.get(message.current)?.scrollIntoView({ block: 'nearest', inline: 'nearest' });
  }

  /** Puts nodes into the list. Those that are there stay where they are: one of them may have the focus. */
  #place() {
    const buttons = new Set(/** @type {Iterable<Element>} */ (this.nodes.values())), had = this.list.contains(document.activeElement);
    for (const child of [...this.list.children]) if (child !== this.lines && !buttons.has(child)) child.remove();
    for (const part of [this.lines, ...buttons]) if (part.parentElement !== this.list) this.list.append(part);
    if (had && !this.list.contains(document.activeElement)) this.nodes.get(this.message.current)?.focus();
  }

  /** @param {number} k @param {any} node */
  #node(k, node) {
    const known = this.nodes.get(k);
    if (known) return known;
    const button = create('button', 'node');
    button.setAttribute('role', 'treeitem');
    const name = k === 0 ? 'At rest' : node.name;
    button.setAttribute('aria-label', `S ${format.stackability(node.stackability)}, ${name}`);
    button.title = name;
    const picture = create('canvas');
    picture.width = 108;
    picture.height = 84;
    const words = create('span');
    words.append(create('b', '', format.stackability(node.stackability)), create('small', '', name));
    button.append(picture, words);
    button.addEventListener('click', () => this.actions.go(k));
    const look = () => {
      const vertices = this.vertices.get(k);
      if (vertices && k !== this.message.current) this.actions.preview({ vertices, f_max: this.stepOf(k), stackability: node.stackability, direction: node.direction });
    };
    for (const begin of ['mouseenter', 'focus']) button.addEventListener(begin, look);
    for (const end of ['mouseleave', 'blur']) button.addEventListener(end, () => this.actions.leave());
    this.nodes.set(k, button);
    this.actions.picture(k);
    return button;
  }

  /** f_max of a node of which the vertices are known. @param {number} k */
  stepOf(k) { return this.steps.get(k) ?? 0; }

  /** @param {number} k */
  #paint(k) {
    const vertices = this.vertices.get(k), picture = this.nodes.get(k)?.querySelector('canvas');
    if (vertices && picture) this.viewer.thumbnail(picture, vertices, { step: this.stepOf(k), direction: this.message.nodes[k].direction, against: this.viewer.main.surface?.mesh.vertices ?? null });
  }

  /** Paints all pictures again. */
  paint() {
    for (const node of this.nodes.keys()) this.#paint(node);
  }

  /** @param {{parent: number}[]} nodes @param {{column: number, row: number}[]} places @param {Set<number>} path */
  #connect(nodes, places, path) {
    const lines = nodes.map((node, k) => {
      if (node.parent < 0) return '';
      const from = places[node.parent], to = places[k];
      const x0 = 12 + width * from.column + 112, y0 = 8 + height * from.row + 24, x1 = 12 + width * to.column, y1 = 8 + height * to.row + 24;
      const middle = (x0 + x1) / 2;
      return `<path class="${path.has(k) ? 'path' : ''}" d="M${x0} ${y0}C${middle} ${y0} ${middle} ${y1} ${x1} ${y1}"/>`;
    });
    this.lines.innerHTML = lines.join('');
    this.lines.setAttribute('width', String(24 + width * (1 + Math.max(...places.map((p) => p.column)))));
    this.lines.setAttribute('height', String(16 + height * (1 + Math.max(...places.map((p) => p.row)))));
  }
}

/**
 * Columns by depth; the first child stays in the row of its parent, further ones start rows of their own.
 * @param {{parent: number}[]} nodes
 */
export function layout(nodes) {
  /** @type {number[][]} */
  const children = nodes.map(() => []);
  nodes.forEach((node, k) => { if (node.parent >= 0) children[node.parent].push(k); });
  const places = nodes.map(() => ({ column: 0, row: 0 }));
  let rows = 0;
  const place = (/** @type {number} */ k, /** @type {number} */ column, /** @type {number} */ row) => {
    places[k] = { column, row };
    children[k].forEach((child, n) => place(child, column + 1, n === 0 ? row : ++rows));
  };
  if (nodes.length) place(0, 0, 0);
  return places;
}

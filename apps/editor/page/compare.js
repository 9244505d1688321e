// Two designs side by side under one camera, and single edits taken from one into the other.
import { create, element } from './dom.js';
import * as format from './format.js';

export class Compare {
  /**
   * @param {import('./viewer/viewer.js').Viewer} viewer
   * @param {import('./tree.js').Tree} tree
   * @param {(command: object) => void} send
   */
  constructor(viewer, tree, send) {
    this.viewer = viewer;
    this.tree = tree;
    this.send = send;
    this.box = element('compare');
    this.choice = create('select');
    this.choice.setAttribute('aria-label', 'Design on the right');
    this.choice.addEventListener('change', () => this.#choose(Number(this.choice.value)));
    this.close = create('button', '', 'Close');
    this.close.addEventListener('click', () => this.show(false));
    this.edits = create('ul', 'edits');
    this.left = create('p', 'pane-label');
    const right = create('div', 'pane-right'), row = create('div', 'row');
    row.append(this.choice, this.close);
    right.append(row, this.edits);
    this.box.append(this.left, right);
    this.node = 0;
    /** Called when it opens or closes. @type {(open: boolean) => void} */
    this.changed = () => {};
  }

  get open() { return !this.box.hidden; }

  /** @param {boolean} open  @param {number} [node]  on the right */
  show(open, node) {
    if (open === this.open) return;
    this.box.hidden = !open;
    if (open) {
      const { message } = this.tree;
      this.viewer.addStage();
      this.#choose(node ?? Math.max(0, message.nodes[message.current].parent));
    } else {
      this.viewer.removeStage();
    }
    this.viewer.fit();
    this.changed(open);
  }

  /** The tree or the current design changed. */
  follow() {
    if (!this.open) return;
    if (this.viewer.stages.length < 2) this.viewer.addStage();
    this.#choose(Math.min(this.node, this.tree.message.nodes.length - 1));
  }

  /** @param {number} node */
  #choose(node) {
    const { nodes, current } = this.tree.message;
    this.node = node;
    this.choice.replaceChildren(...nodes.map((/** @type {any} */ one, /** @type {number} */ k) =>
      new Option(`${k === 0 ? 'At rest' : one.name}, S ${format.stackability(one.stackability)}`, String(k), false, k === node)));
    this.left.textContent = `Current, S ${format.stackability(nodes[current].stackability)}`;
    const stage = this.viewer.stages[1], vertices = this.tree.vertices.get(node);
    stage.setDirection(nodes[node].direction);
    stage.setChanged(node !== 0);
    stage.setLayers({ ghosts: this.viewer.main.layers.ghosts });
    stage.setCopies(this.viewer.main.copiesAbove, this.viewer.main.copiesBelow);
    if (vertices) stage.show(vertices, this.tree.stepOf(node));
    this.#listEdits(node);
  }

  /** Edits on the way to a node, each to be made on the current design too. @param {number} node */
  #listEdits(node) {
    const { nodes, current } = this.tree.message, lines = /** @type {HTMLElement[]} */ ([]);
    for (let at = node; at > 0; at = nodes[at].parent)
      nodes[at].edits.forEach((/** @type {string} */ edit, /** @type {number} */ k) => {
        const line = create('li'), take = create('button', '', 'Take');
        take.title = 'Make this edit on the current design too';
        take.disabled = node === current;
        take.addEventListener('click', () => this.send({ do: 'take-edit', node: at, edit: k }));
        const words = nodes[at].edits.length === 1 ? nodes[at].name : edit;
        take.setAttribute('aria-label', `Take: ${words}`);
        line.append(create('span', '', words), take);
        line.title = edit;
        lines.unshift(line);
      });
    this.edits.replaceChildren(...lines);
  }
}

// The panel of parts: pick one, choose what of it is dragged and how, or type the amount.
import { create, element, walkWithArrows } from './dom.js';
import { PickedHandle, toolsOf } from './handles.js';

const elementWords = { part: 'Whole part', face: 'Face', corner: 'Corner', end: 'End' };
const toolWords = { move: 'Move', rotate: 'Turn', scale: 'Scale' };

export class Parts {
  /**
   * @param {import('./handles.js').Gizmo} gizmo
   * @param {(command: object) => void} send
   * @param {() => void} changed  the choice changed
   */
  constructor(gizmo, send, changed) {
    this.gizmo = gizmo;
    this.send = send;
    this.changed = changed;
    this.panel = element('panel-parts');
    this.bar = element('handle-bar');
    this.model = /** @type {any} */ (null);
    this.primitives = /** @type {any[]} */ ([]);
    this.kept = /** @type {number[]} */ ([]);
    this.part = -1;
    this.element = /** @type {import('./handles.js').Element} */ ('part');
    this.tool = /** @type {import('./handles.js').Tool} */ ('move');
    this.near = /** @type {any} */ (null);
    this.list = create('ul', 'parts');
    this.form = create('div');
    this.how = create('b');
    this.axis = create('select');
    this.amount = create('input');
    this.amounts = this.#makeAmounts();
    this.keepBox = create('input');
    this.keepBox.type = 'checkbox';
    this.panel.append(create('p', 'note', 'Click a part in the view, or here, and drag its handles. Whatever is joined or symmetric to it follows.'), this.form, this.list);
    walkWithArrows(this.list);
  }

  /** @param {any} model */
  setModel(model) {
    this.model = model;
    this.list.replaceChildren(...model.parts.map((/** @type {any} */ part, /** @type {number} */ row) => {
      const line = create('li'), button = create('button', '', part.name);
      button.append(create('small', '', part.kind === 'cuboid' ? 'box' : 'cylinder'));
      button.addEventListener('click', () => this.pick(row, null));
      line.append(button);
      return line;
    }));
  }

  /** @param {any[]} primitives */
  setPrimitives(primitives) {
    this.primitives = primitives;
    const { handle } = this.gizmo;
    if (handle) {
      handle.update(primitives[handle.part]);
      this.gizmo.rebuild();
    }
  }

  /** @param {number[]} kept */
  setKept(kept) {
    this.kept = kept;
    this.#mark();
  }

  /** @param {number} part  -1: none  @param {any} near  the point that was clicked */
  pick(part, near) {
    if (part !== this.part) this.amount.value = '';
    this.part = part;
    const primitive = this.primitives[part];
    if (near) this.near = near;
    else if (primitive) this.near = new PickedHandle(part, '', primitive, 'part', this.gizmo.viewer.main.centre.clone()).centre;
    if (primitive && !PickedHandle.elementsOf(primitive).includes(this.element)) this.element = 'part';
    if (!toolsOf[this.element].includes(this.tool)) this.tool = 'move';
    this.#show();
  }

  /** @param {import('./handles.js').Tool} tool */
  choose(tool) {
    if (this.part < 0 || !toolsOf[this.element].includes(tool)) return;
    this.tool = tool;
    this.#show();
  }

  /** Marks the part that is picked, and those that are kept. */
  #mark() {
    [...this.list.querySelectorAll('button')].forEach((button, row) => {
      button.setAttribute('aria-pressed', String(row === this.part));
      button.classList.toggle('kept', this.kept.includes(row));
    });
    this.keepBox.checked = this.kept.includes(this.part);
  }

  #show() {
    const primitive = this.primitives[this.part];
    this.#mark();
    if (!primitive) {
      this.gizmo.set(null, this.tool);
      this.bar.replaceChildren();
      this.form.replaceChildren();
      return this.changed();
    }
    const part = this.model.parts[this.part], focused = document.activeElement instanceof HTMLElement ? document.activeElement.dataset.choice : undefined;
    this.gizmo.set(new PickedHandle(this.part, part.text, primitive, this.element, this.near), this.tool);
    this.bar.replaceChildren(create('b', '', part.name),
      this.#chips('What is dragged', PickedHandle.elementsOf(primitive), elementWords, this.element, (one) => {
        this.element = one;
        if (!toolsOf[one].includes(this.tool)) this.tool = 'move';
      }),
      this.#chips('How', toolsOf[this.element], toolWords, this.tool, (one) => (this.tool = one)));
    this.#showAmounts();
    this.form.replaceChildren(this.amounts, this.#keep(), this.#kind(), this.#joints(), this.#symmetries(), this.#more());
    // The chips are made anew.
    for (const chip of document.querySelectorAll('[data-choice]')) if (chip instanceof HTMLElement && chip.dataset.choice === focused) chip.focus();
    this.changed();
  }

  /**
   * @template {string} Name
   * @param {string} label
   * @param {Name[]} names
   * @param {Record<Name, string>} words
   * @param {Name} current
   * @param {(name: Name) => void} choose
   */
  #chips(label, names, words, current, choose) {
    const group = create('span', 'segments');
    group.setAttribute('role', 'group');
    group.setAttribute('aria-label', label);
    for (const name of names) {
      const button = create('button', '', words[name]);
      button.setAttribute('aria-pressed', String(name === current));
      button.dataset.choice = `${label}: ${name}`;
      button.addEventListener('click', () => { choose(name); this.#show(); });
      group.append(button);
    }
    return group;
  }

  /** A form with what a drag does, for exact amounts and for those who use no mouse. It stays: somebody may be typing. */
  #makeAmounts() {
    const form = create('form', 'amounts');
    this.axis.setAttribute('aria-label', 'Direction');
    this.amount.type = 'number';
    this.amount.step = 'any';
    this.amount.required = true;
    form.append(this.how, this.axis, this.amount, create('button', 'primary', 'Apply'));
    form.addEventListener('submit', (event) => {
      event.preventDefault();
      const { handle, tool } = this.gizmo, value = Number(this.amount.value) * (tool === 'rotate' ? Math.PI / 180 : 1);
      if (!handle || !Number.isFinite(value) || (tool === 'scale' && value <= 0)) return;
      // The axes turn with the part.
      this.send({ do: 'drag', edit: handle.edit(tool, handle.axesOf(tool)[Number(this.axis.value)], value) });
      this.send({ do: 'end-drag', keep: true });
    });
    return form;
  }

  /** Offers the amounts of the handle that is picked. What was typed stays where it means the same. */
  #showAmounts() {
    const { tool } = this, chosen = this.axis.value, axes = this.gizmo.handle?.axesOf(tool) ?? [];
    const unit = tool === 'move' ? this.model.unit ?? 'units' : tool === 'rotate' ? 'degrees' : 'times';
    this.axis.replaceChildren(...axes.map((one, k) => new Option(one.name, String(k))));
    if (Number(chosen) < axes.length) this.axis.value = chosen;
    if (this.how.textContent !== toolWords[tool]) this.amount.value = '';
    this.how.textContent = toolWords[tool];
    this.amount.placeholder = unit;
    this.amount.setAttribute('aria-label', `Amount, ${unit}`);
  }

  /** What the part is for the program: a box, or circles along a curve. */
  #kind() {
    const row = create('div', 'row kind');
    row.append(create('span', 'note', 'Moves as a'),
      this.#chips('Kind of the part', ['cuboid', 'cylinder'], { cuboid: 'Box', cylinder: 'Cylinder' }, this.model.parts[this.part].kind,
        (kind) => this.send({ do: 'kind', part: this.part, kind })));
    return row;
  }

  /**
   * Other parts with a tag each, which takes relations to them apart.
   * @param {string} words @param {{relation: number, parts: number[]}[]} relations @param {string} title
   */
  #tags(words, relations, title) {
    const box = create('div', 'joints'), own = relations.filter((one) => one.parts.includes(this.part) && one.parts.length === 2);
    if (!own.length) return box;
    box.append(create('span', 'note', words));
    for (const other of new Set(own.map((one) => one.parts.find((part) => part !== this.part)))) {
      const name = this.model.parts[/** @type {number} */ (other)].name, button = create('button', 'tag', name + ' ×');
      button.title = title;
      button.setAttribute('aria-label', `${title}: ${name}`);
      button.addEventListener('click', () =>
        this.send({ do: 'remove-relations', relations: own.filter((one) => one.parts.includes(/** @type {number} */ (other))).map((one) => one.relation) }));
      box.append(button);
    }
    return box;
  }

  /**
   * A choice among parts that it has no such relation to yet.
   * @param {string} words @param {string} label @param {{parts: number[]}[]} relations @param {(parts: number[]) => object} command
   * @returns {HTMLElement[]}
   */
  #others(words, label, relations, command) {
    const { part } = this, related = new Set(relations.filter(({ parts }) => parts.includes(part)).flatMap(({ parts }) => parts)).add(part);
    const others = this.model.parts.map((/** @type {any} */ one, /** @type {number} */ row) => ({ name: one.name, row })).filter((/** @type {any} */ one) => !related.has(one.row));
    if (!others.length) return [];
    const choice = create('select');
    choice.setAttribute('aria-label', label);
    choice.append(new Option(words, ''), ...others.map((/** @type {any} */ one) => new Option(one.name, String(one.row))));
    choice.addEventListener('change', () => choice.value && this.send(command([part, Number(choice.value)])));
    return [choice];
  }

  /** What it is joined to, to be taken apart; and others, to be joined. */
  #joints() {
    const { joints } = this.model, box = this.#tags('Joined to ', joints, 'Take this joint apart');
    box.append(...this.#others('Join to …', 'Join to another part', joints, (parts) => ({ do: 'join', parts })));
    return box;
  }

  /** Parts that follow it, to be let go; and others, to follow. */
  #symmetries() {
    const { pairs } = this.model, box = this.#tags('Symmetric to ', pairs, 'Let it change on its own');
    box.append(...this.#others('Symmetric to …', 'Make symmetric to another part', pairs, (parts) => ({ do: 'make-symmetric', parts })));
    return box;
  }

  #more() {
    const row = create('div', 'row kind'), remove = create('button', '', 'Leave this part out');
    remove.addEventListener('click', () => this.send({ do: 'remove-parts', parts: [this.part] }));
    remove.disabled = this.model.parts.length < 2;
    row.append(remove);
    return row;
  }

  #keep() {
    const label = create('label', 'check'), { keepBox: box, part } = this;
    box.onchange = () =>
      this.send({ do: 'keep', parts: box.checked ? [...this.kept, part].sort((a, b) => a - b) : this.kept.filter((row) => row !== part) });
    label.append(box, ' Keep this part as it is');
    return label;
  }
}

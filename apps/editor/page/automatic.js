// The automatic search: a target or a front, designs as they are found, and what is in the way.
import { create, element, walkWithArrows } from './dom.js';
import { FrontCurve } from './front_curve.js';
import { diagnosisLines } from './offers.js';
import * as format from './format.js';

export class Automatic {
  /**
   * @param {import('./viewer/viewer.js').Viewer} viewer
   * @param {{send: (command: object) => void, leave: () => void, preview: (offer: any) => void}} actions
   */
  constructor(viewer, actions) {
    this.viewer = viewer;
    this.actions = actions;
    this.panel = element('panel-automatic');
    this.message = /** @type {any} */ ({ list: [], offers: [], running: false, diagnosis: null });
    /** By the numbers of the designs. @type {Map<number, Float32Array>} */
    this.vertices = new Map();
    /** Cards by what they show: those that stay are not painted again. @type {Map<string, {card: HTMLButtonElement, picture: HTMLCanvasElement, offer: any}>} */
    this.cards = new Map();
    this.wishes = /** @type {any} */ (null);
    this.button = create('button', 'primary', 'Find designs');
    this.button.id = 'find';
    this.button.addEventListener('click', () => actions.send({ do: this.message.running ? 'stop' : 'find' }));
    this.whole = create('button', '', 'Explore');
    this.whole.id = 'find-front';
    this.whole.title = 'Designs of least change, from S at rest to the largest S that the limits allow';
    this.whole.addEventListener('click', () => actions.send({ do: 'find', front: true }));
    this.curve = new FrontCurve({ preview: (number) => this.#startPreview(number), leave: actions.leave, take: (number) => this.#take(number) });
    this.bar = create('progress');
    this.bar.max = 1;
    this.bar.setAttribute('aria-label', 'Progress of the search');
    this.note = create('p', 'note');
    this.note.setAttribute('role', 'status');
    this.list = create('div', 'gallery');
    this.list.setAttribute('role', 'group');
    this.list.setAttribute('aria-label', 'Designs found, least change first');
    this.reasons = create('div');
    const row = create('div', 'row find');
    row.append(this.button, this.whole, this.bar);
    this.panel.append(row, this.note, this.curve.element, this.list, this.reasons);
    walkWithArrows(this.list);
    this.#show();
  }

  /** @param {any} wishes */
  setWishes(wishes) {
    this.wishes = wishes;
    this.#show();
  }

  /** @param {number} number @param {Float32Array} vertices */
  setVertices(number, vertices) { this.vertices.set(number, vertices); }

  /** @param {any} message */
  set(message) {
    this.message = message;
    this.#show();
  }

  /** @param {number} fraction */
  progress(fraction) { this.bar.value = fraction; }

  #show() {
    const { message } = this;
    this.button.textContent = message.running ? 'Stop' : 'Find designs';
    this.button.classList.toggle('primary', !message.running);
    this.bar.hidden = !message.running;
    this.whole.hidden = message.running;
    const wanted = (/** @type {any} */ { within, target }) => (within ? `${within.copies} copies within ${within.length}` : `S ${format.stackability(target)}`);
    const count = message.list.length;
    this.note.textContent = message.front ? this.#frontNote() : count ? `${count === 1 ? 'One design reaches' : count + ' designs reach'} ${wanted(message)}, least change first.${message.running ? ' Looking for better ones …' : ''}`
      : message.running ? `Looking for designs of ${wanted(message)} …`
        : message.diagnosis ? `No design of ${wanted(message)} within the limits; the best one has S ${format.stackability(message.diagnosis.reached)}.`
          : this.wishes ? `Looks for the least change that reaches ${wanted(this.wishes)}, with all limits kept.` : '';
    this.curve.set(message);
    this.#list();
    this.#diagnose();
  }

  #frontNote() {
    const { list, running, at_rest: rest } = this.message, s = (/** @type {any} */ design) => format.stackability(design.stackability);
    const soFar = list.length > 1 ? `${list.length} designs, S ${s(list[0])} to ${s(list[list.length - 1])}, each of the least change found for its S.`
      : list.length ? `One design, S ${s(list[0])}.` : '';
    return running ? soFar + ' Looking for more …' : soFar || `No design within the limits stacks better than S ${format.stackability(rest)}.`;
  }

  /** @param {number} number */
  #take(number) {
    this.actions.leave();
    this.actions.send({ do: 'take', number });
  }

  /** @param {number} number */
  #startPreview(number) {
    const vertices = this.vertices.get(number), design = this.message.list.find((/** @type {any} */ one) => one.number === number);
    if (vertices && design) this.actions.preview({ ...design, vertices });
  }

  /** Puts the cards in order. Designs come while somebody looks at those that are there. */
  #list() {
    const focused = [...this.cards.values()].find(({ card }) => card === document.activeElement)?.card, cards = new Map();
    for (const design of this.message.list) {
      const key = JSON.stringify(design);
      cards.set(key, this.cards.get(key) ?? this.#card({ ...design, vertices: this.vertices.get(design.number) }));
    }
    this.cards = cards;
    this.list.replaceChildren(...[...this.cards.values()].map(({ card }) => card));
    if (focused?.isConnected) focused.focus();
  }

  /** @param {any} offer  a design with its vertices */
  #card(offer) {
    const card = create('button', 'card'), picture = create('canvas', 'picture'), facts = create('span', 'facts'), gain = create('span', 'gain');
    picture.width = 160;
    picture.height = 120;
    picture.setAttribute('aria-hidden', 'true');
    gain.append(`S ${format.stackability(offer.stackability)}`, create('span', 'cost', format.percent(offer.change)));
    facts.append(gain, ...offer.words.slice(0, 3).map((/** @type {string} */ words) => create('span', 'what', words)));
    card.append(picture, facts);
    card.setAttribute('aria-label', `S ${format.stackability(offer.stackability)}, change ${format.percent(offer.change)}, ${offer.words.join(', ')}`);
    card.onclick = () => this.#take(offer.number);
    card.onmousemove = card.onfocus = () => offer.vertices && this.actions.preview(offer);
    card.onmouseleave = card.onblur = () => this.actions.leave();
    this.#paint(picture, offer);
    return { card, picture, offer };
  }

  /** @param {HTMLCanvasElement} picture @param {any} offer */
  #paint(picture, { vertices, f_max: step, direction }) {
    if (vertices) this.viewer.thumbnail(picture, vertices, { step, direction, against: this.viewer.main.surface?.mesh.vertices ?? null });
  }

  /** Paints all pictures again, after the view has other colours. */
  paint() {
    for (const { picture, offer } of this.cards.values()) this.#paint(picture, offer);
  }

  #diagnose() {
    const { diagnosis, list, offers } = this.message;
    this.reasons.replaceChildren(...(list.length ? [] : diagnosisLines(diagnosis, offers, (number) => this.actions.send({ do: 'accept', number }))));
  }
}

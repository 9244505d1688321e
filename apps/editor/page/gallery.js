// Suggestions as small pictures, best first.
import { create, element, walkWithArrows } from './dom.js';
import { diagnosisLines } from './offers.js';
import * as format from './format.js';

/** @typedef {{words: string, edit: string, gain: number, stackability: number, f_max: number, change: number, reaches: boolean, vertices: Float32Array}} Offer */

export class Gallery {
  /**
   * @param {import('./viewer/viewer.js').Viewer} viewer
   * @param {{preview: (offer: Offer) => void, leave: () => void, apply: (number: number) => void, accept: (number: number) => void}} actions
   */
  constructor(viewer, actions) {
    this.viewer = viewer;
    this.actions = actions;
    this.list = element('gallery');
    this.note = element('suggestions-note');
    /** Vertices by the stamp of their list. @type {Map<number, Float32Array[]>} */
    this.vertices = new Map();
    /** @type {Offer[]} */
    this.offers = [];
    /** Cards by the edit that they show: those that stay are not painted again. @type {Map<string, HTMLButtonElement>} */
    this.cards = new Map();
    this.done = false;
    /** Whether an offer raises S. */
    this.gains = false;
    this.fraction = 0;
    walkWithArrows(this.list);
  }

  /** @param {number} number @param {number} stamp @param {Float32Array} vertices */
  setVertices(number, stamp, vertices) {
    if (!this.vertices.has(stamp)) this.vertices.set(stamp, []);
    const list = this.vertices.get(stamp);
    if (list) list[number] = vertices;
  }

  /** @param {any} message */
  set(message) {
    const vertices = this.vertices.get(message.stamp) ?? [];
    this.vertices.clear();
    const focused = document.activeElement instanceof HTMLButtonElement ? document.activeElement.dataset.edit : undefined;
    this.offers = message.list.map((/** @type {any} */ offer, /** @type {number} */ k) => ({ ...offer, vertices: vertices[k] }));
    const cards = new Map();
    this.offers.forEach((offer, number) => {
      const card = this.cards.get(offer.edit) ?? this.#card(offer);
      card.onclick = () => this.actions.apply(number);
      // Moving the mouse, not lying under it: cards change places under a mouse that rests.
      card.onmousemove = card.onfocus = () => this.actions.preview(offer);
      card.onmouseleave = card.onblur = () => this.actions.leave();
      cards.set(offer.edit, card);
    });
    this.cards = cards;
    this.done = message.complete;
    this.gains = this.offers.some((offer) => offer.gain >= 0.005);
    const reasons = create('div', 'whole');
    reasons.append(...diagnosisLines(message.diagnosis, message.offers, this.actions.accept), ...this.#reasons(message.refused));
    this.list.replaceChildren(...cards.values(), reasons);
    if (focused) cards.get(focused)?.focus();
    this.#say();
  }

  /** @param {Offer} offer */
  #card(offer) {
    const card = create('button', 'card');
    card.dataset.edit = offer.edit;
    const picture = create('canvas', 'picture');
    picture.width = 160;
    picture.height = 120;
    picture.setAttribute('aria-hidden', 'true');
    const facts = create('span', 'facts'), gain = create('span', 'gain'), flat = Math.abs(offer.gain) < 0.005;
    gain.classList.toggle('flat', flat);
    const cost = create('span', 'cost', format.percent(offer.change));
    cost.title = 'change of the shape since rest';
    gain.append(flat ? 'Prepares' : `S ${format.signed(offer.gain)}`, cost);
    if (flat) card.title = 'S stays for now: one of several contacts that block at the same height is moved out of the way.';
    facts.append(gain, create('span', 'what', offer.words));
    if (offer.reaches) facts.append(create('span', 'reaches', 'reaches the target'));
    card.append(picture, facts);
    card.setAttribute('aria-label', `${flat ? 'prepares' : 'S ' + format.signed(offer.gain)}, ${offer.words}, change ${format.percent(offer.change)}${offer.reaches ? ', reaches the target' : ''}`);
    this.#paint(card, offer);
    return card;
  }

  /** @param {HTMLButtonElement} card @param {Offer} offer */
  #paint(card, offer) {
    const picture = card.querySelector('canvas');
    if (picture && offer.vertices) this.viewer.thumbnail(picture, offer.vertices, { step: offer.f_max, against: this.viewer.design });
  }

  /** @param {string[]} refused */
  #reasons(refused) {
    if (!refused.length) return [];
    const reasons = create('details', 'reasons');
    reasons.append(create('summary', '', 'What else was tried, and why not'));
    const list = create('ul');
    list.append(...refused.slice(0, 8).map((words) => create('li', '', words)));
    reasons.append(list);
    return [reasons];
  }

  /** @param {number} fraction */
  progress(fraction) {
    this.fraction = fraction;
    this.#say();
  }

  #say() {
    const count = this.offers.length;
    this.note.textContent = !this.done
      ? `Looking for edits that help … ${Math.round(100 * this.fraction)} %`
      : count && !this.gains ? 'No single edit raises S from here; these prepare one.'
        : count ? `${count === 1 ? 'One edit helps' : count + ' edits help'}, best first. Hover to see, click to apply.`
          : 'No single edit helps from here. Try the automatic search, or allow more under Quality.';
  }

  /** Paints all pictures again, after the view has other colours. */
  paint() {
    for (const offer of this.offers) {
      const card = this.cards.get(offer.edit);
      if (card) this.#paint(card, offer);
    }
  }
}

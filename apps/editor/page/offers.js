// What blocks, and what would help: offers of a diagnosis.
import { create } from './dom.js';
import * as format from './format.js';

/** @typedef {{words: string, stackability: number}} RemedyOffer */

/**
 * @param {{blockers: string[]} | null | undefined} diagnosis
 * @param {RemedyOffer[]} offers
 * @param {(number: number) => void} accept
 * @returns {HTMLElement[]}
 */
export function diagnosisLines(diagnosis, offers, accept) {
  if (!diagnosis) return [];
  const lines = [];
  if (diagnosis.blockers.length) {
    const list = create('ul', 'words');
    list.append(...diagnosis.blockers.map((words) => create('li', 'bad', words)));
    lines.push(create('h3', '', 'What blocks'), list);
  }
  if (!offers.length) return lines;
  const help = create('div', 'offers');
  help.append(create('h3', '', 'What would help'));
  offers.forEach((offer, number) => {
    const button = create('button', 'offer', offer.words);
    button.append(create('b', '', `S ${format.stackability(offer.stackability)}`));
    button.addEventListener('click', () => accept(number));
    help.append(button);
  });
  return [...lines, help];
}

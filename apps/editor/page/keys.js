// Keys of the whole page.
import { create } from './dom.js';

/** Does this element take letters? @param {EventTarget | null} target */
const takesText = (target) => target instanceof HTMLInputElement || target instanceof HTMLTextAreaElement || target instanceof HTMLSelectElement;

/** Does it undo what was typed into it? @param {EventTarget | null} target */
const editsText = (target) => target instanceof HTMLTextAreaElement || (target instanceof HTMLInputElement && !['checkbox', 'radio', 'range', 'file'].includes(target.type));

/**
 * @param {object} keys
 * @param {Record<string, () => void>} keys.plain
 * @param {Record<string, () => void>} keys.control
 * @param {Record<string, () => void>} keys.controlShift
 * @param {HTMLElement} keys.list  where they are listed
 * @param {string[][]} keys.words  key and meaning
 */
export function bindKeys(keys) {
  document.addEventListener('keydown', (event) => {
    const control = event.ctrlKey || event.metaKey;
    if (event.altKey || (control ? editsText : takesText)(event.target) || document.querySelector('dialog[open]')) return;
    const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    const action = control ? (event.shiftKey ? keys.controlShift : keys.control)[key] : keys.plain[key];
    if (!action) return;
    event.preventDefault();
    action();
  });
  for (const [key, words] of keys.words) {
    const term = create('dt');
    for (const one of key.split(' ')) term.append(create('kbd', '', one), ' ');
    keys.list.append(term, create('dd', '', words));
  }
}

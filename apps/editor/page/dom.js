// Small helpers for elements.

/** @param {string} id @returns {HTMLElement} */
export function element(id) {
  const found = document.getElementById(id);
  if (!found) throw new Error('no element ' + id);
  return found;
}

/**
 * @template {keyof HTMLElementTagNameMap} Name
 * @param {Name} name
 * @param {string} [className]
 * @param {string} [text]
 * @returns {HTMLElementTagNameMap[Name]}
 */
export function create(name, className, text) {
  const made = document.createElement(name);
  if (className) made.className = className;
  if (text !== undefined) made.textContent = text;
  return made;
}

/** Lets arrow keys walk over the children of a list. @param {HTMLElement} list */
export function walkWithArrows(list) {
  list.addEventListener('keydown', (event) => {
    const children = /** @type {HTMLElement[]} */ ([...list.querySelectorAll('button')]);
    const at = children.indexOf(/** @type {HTMLElement} */ (document.activeElement));
    const step = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1, Home: -at, End: children.length - 1 - at }[event.key];
    if (at < 0 || step === undefined) return;
    event.preventDefault();
    children[Math.max(0, Math.min(children.length - 1, at + step))].focus();
  });
}

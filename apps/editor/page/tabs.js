// Tabs after the pattern of WAI-ARIA.
import { element } from './dom.js';

/** Shows a panel. @param {string} name */
export const openTab = (name) => element('tab-' + name).click();

/** @param {HTMLElement} list */
export function bindTabs(list) {
  const tabs = /** @type {HTMLElement[]} */ ([...list.querySelectorAll('[role="tab"]')]);
  const choose = (/** @type {HTMLElement} */ chosen) => {
    for (const tab of tabs) {
      const is = tab === chosen;
      tab.setAttribute('aria-selected', String(is));
      tab.tabIndex = is ? 0 : -1;
      element(tab.getAttribute('aria-controls') ?? '').hidden = !is;
    }
  };
  tabs.forEach((tab, k) => {
    tab.addEventListener('click', () => choose(tab));
    tab.addEventListener('keydown', (event) => {
      const step = { ArrowRight: 1, ArrowLeft: tabs.length - 1 }[event.key];
      if (!step) return;
      event.preventDefault();
      // Those that a study hides are left out.
      const next = [...tabs.keys()].map((n) => tabs[(k + step * (n + 1)) % tabs.length]).find((one) => one.checkVisibility());
      if (!next) return;
      choose(next);
      next.focus();
    });
  });
}

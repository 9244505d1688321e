// A mesh file that is dropped onto the page, or chosen, is opened.
import { element } from './dom.js';

/** @param {{busy: (words: string) => void, failed: (words: string) => void}} actions */
export function bindDrop(actions) {
  const open = async (/** @type {File} */ file) => {
    actions.busy(`Reading ${file.name} …`);
    try {
      const reply = await fetch('open?name=' + encodeURIComponent(file.name), { method: 'POST', body: file });
      if (!reply.ok) actions.failed(await reply.text());
    } catch (error) {
      actions.failed(`${file.name} cannot be sent: ${error}`);
    }
    actions.busy('');
  };
  document.addEventListener('dragover', (event) => {
    event.preventDefault();
    document.body.classList.add('dropping');
  });
  document.addEventListener('dragleave', (event) => event.relatedTarget === null && document.body.classList.remove('dropping'));
  document.addEventListener('drop', (event) => {
    event.preventDefault();
    document.body.classList.remove('dropping');
    const file = event.dataTransfer?.files[0];
    if (file) void open(file);
  });
  const input = /** @type {HTMLInputElement} */ (element('open-file'));
  element('open').addEventListener('click', () => input.click());
  input.addEventListener('change', () => {
    const file = input.files?.[0];
    input.value = '';
    if (file) void open(file);
  });
}

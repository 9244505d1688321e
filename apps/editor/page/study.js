// Tasks of a study: consent, a task at a time, three questions after each.
import { create, element } from './dom.js';
import { openTab } from './tabs.js';
import * as format from './format.js';

const conditionWords = {
  manual: 'Drag the handles of parts.',
  suggestive: 'Drag the handles of parts, or take suggestions.',
  automatic: 'Let the program find designs, and take the one you like best.',
};

export class Study {
  /** @param {(command: object) => void} send */
  constructor(send) {
    this.send = send;
    /** The task that is shown, counted from 1. */
    this.turn = 0;
    this.bar = element('study');
    this.dialog = /** @type {HTMLDialogElement} */ (element('study-dialog'));
    this.dialog.addEventListener('cancel', (event) => event.preventDefault());
    this.failure = create('p', 'bad');
    this.failure.setAttribute('role', 'alert');
  }

  /** Whether there is no study, which leaves everything to a person. */
  get free() { return !document.body.dataset.study; }

  /** Whether parts may be edited by hand. */
  get byHand() { return !['automatic', 'pause'].includes(document.body.dataset.study ?? ''); }

  /** Says in the dialog what failed: it covers all else. @param {string} words */
  fail(words) { this.failure.textContent = words; }

  /** @param {any} message */
  set(message) {
    document.body.dataset.study = message.phase === 'task' ? message.condition : 'pause';
    for (const id of ['direction', 'target', 'within']) /** @type {HTMLButtonElement | HTMLInputElement} */ (element(id)).disabled = true;
    this.bar.hidden = message.phase !== 'task';
    if (this.dialog.open) this.dialog.close();
    if (message.phase === 'task') this.#task(message);
    else this.#ask(message);
  }

  /** @param {any} message */
  #task(message) {
    if (this.turn !== message.turn) openTab({ manual: 'parts', suggestive: 'suggestions', automatic: 'automatic' }[/** @type {'manual'} */ (message.condition)]);
    this.turn = message.turn;
    const done = create('button', 'primary', 'Done'), stop = create('button', '', 'Give up');
    done.addEventListener('click', () => this.send({ do: 'study', step: 'done' }));
    stop.addEventListener('click', () => this.send({ do: 'study', step: 'give up' }));
    this.bar.replaceChildren(create('b', '', `Task ${message.turn} of ${message.turns}`),
      create('span', '', `Make it stack with S ${format.stackability(message.target)} or more. ${conditionWords[/** @type {'manual'} */ (message.condition)]}`), done, stop);
  }

  /** @param {any} message */
  #ask(message) {
    const form = create('form');
    form.method = 'dialog';
    const title = create('h2', '', { consent: 'Before you begin', questions: 'About this task', done: 'Thank you' }[/** @type {'done'} */ (message.phase)]);
    title.id = 'study-title';
    const go = create('button', 'primary', message.phase === 'consent' ? 'I agree, begin' : 'Go on');
    if (message.phase === 'consent') form.append(create('p', '', message.consent), go);
    if (message.phase === 'questions') form.append(...message.questions.map(this.#question), go);
    if (message.phase === 'done') form.append(create('p', '', 'That was the last task. You can close this page.'));
    form.addEventListener('submit', (event) => {
      event.preventDefault();
      const answers = new FormData(form);
      this.send(message.phase === 'consent' ? { do: 'study', step: 'agree' }
        : { do: 'study', step: 'answers', answers: [0, 1, 2].map((k) => Number(answers.get('question-' + k))) });
    });
    this.fail('');
    this.dialog.replaceChildren(title, form, this.failure);
    this.dialog.showModal();
  }

  /** @param {string} words @param {number} k */
  #question(words, k) {
    const field = create('fieldset', 'scale');
    field.append(create('legend', '', words), create('span', 'note', 'not at all'));
    for (let value = 1; value <= 5; ++value) {
      const label = create('label'), input = create('input');
      input.type = 'radio';
      input.name = 'question-' + k;
      input.value = String(value);
      input.required = true;
      label.append(input, String(value));
      field.append(label);
    }
    field.append(create('span', 'note', 'very much'));
    return field;
  }
}

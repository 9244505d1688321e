// A study in a real browser: consent, tasks in three conditions, questions, and the CSV.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';
import { after, before, test } from 'node:test';
import { Editor, Folder, keepPicture, openBrowser, openPage, seconds, suggestionsOf } from './editor.mjs';

let browser, folder;
before(async () => {
  browser = await openBrowser();
  folder = new Folder('cup.obj');
  fs.writeFileSync(path.join(folder.path, 'plan.json'), JSON.stringify({ format: 'stackabilize study', version: 1, consent: 'Do you agree?',
    tasks: ['one', 'two', 'three'].map((name) => ({ name, model: 'cup.obj', target: 0.8 })) }));
});
after(async () => {
  await browser?.close();
  folder?.remove();
});

const results = () => path.join(folder.path, 'results.csv');
const rowsOf = (text) => text.trim().split('\n').slice(1).map((line) => {
  const names = text.split('\n')[0].split(','), fields = line.match(/("([^"]|"")*"|[^,]*)(,|$)/g).map((field) => field.replace(/,$/, ''));
  return Object.fromEntries(names.map((name, k) => [name, fields[k]]));
});

async function answer(page, values) {
  await page.waitForSelector('#study-dialog[open] fieldset');
  for (let k = 0; k < 3; ++k) await page.check(`input[name=question-${k}][value="${values[k]}"]`);
  await page.click('#study-dialog button.primary');
}

/** Clicks the middle of the object, and says whether that picked a part. */
async function clicked(page) {
  await page.waitForFunction(() => window.editor.state.design && window.editor.viewer.framesDrawn > 1);
  const at = await page.evaluate(() => window.editor.viewer.screenOf(window.editor.viewer.main.centre));
  await page.mouse.click(at.x, at.y);
  return page.evaluate(() => Boolean(window.editor.gizmo.handle));
}

test('a participant does three tasks, each in its condition', { timeout: seconds(300) }, async () => {
  const plan = { model: path.join(folder.path, 'plan.json') };
  const editor = await Editor.start(plan, ['--study', results()]);
  const page = await openPage(browser, editor);
  assert.match(await page.textContent('#study-dialog'), /Do you agree/);
  await keepPicture(page, 'study_consent');
  await page.click('#study-dialog button.primary');
  await page.waitForSelector('#study:not([hidden])');

  // Manual: handles, no suggestions.
  assert.equal(await page.getAttribute('body', 'data-study'), 'manual');
  assert.equal(await page.isVisible('#tab-suggestions'), false);
  await keepPicture(page, 'study_manual');
  assert.equal(await page.isDisabled('#direction'), true);
  assert.equal(await page.isDisabled('#target'), true);
  await page.focus('#tab-parts');
  await page.keyboard.press('ArrowRight');
  assert.equal(await page.evaluate(() => document.activeElement.id), 'tab-parts', 'no panel but this one');
  await page.locator('body').press('k');
  assert.equal(await page.evaluate(() => window.editor.strokes.active), false);
  assert.equal(await clicked(page), true);
  await page.keyboard.press('Escape');
  await page.evaluate(() => window.editor.send({ do: 'find' }));
  await page.waitForFunction(() => /manual/.test(document.getElementById('hint').textContent));
  await page.evaluate(() => {
    window.editor.send({ do: 'drag', edit: window.editor.state.model.parts[0].text + ' scale 1.02 along 1 0 0' });
    window.editor.send({ do: 'end-drag', keep: true });
  });
  await page.waitForFunction(() => window.editor.state.tree.nodes.length === 2);
  await page.click('#study button:has-text("Give up")');
  await page.waitForSelector('#study-dialog[open] fieldset');
  await keepPicture(page, 'study_questions');
  await answer(page, [1, 2, 3]);

  // Suggestive: one suggestion is taken and undone.
  await page.waitForFunction(() => document.body.dataset.study === 'suggestive');
  const [first] = await suggestionsOf(page);
  await page.locator('.card').first().click();
  await page.waitForFunction(() => window.editor.state.tree.current === 1);
  await page.keyboard.press('Control+z');
  await page.waitForFunction(() => window.editor.state.tree.current === 0);
  await page.keyboard.press('Control+Shift+z');
  await page.waitForFunction(() => window.editor.state.tree.current === 1);
  await page.click('#study button:has-text("Done")');
  await answer(page, [4, 5, 5]);

  await page.waitForFunction(() => document.body.dataset.study === 'automatic');
  assert.equal(await clicked(page), false, 'there are no handles');
  assert.equal(await page.isVisible('#panel-automatic'), true);
  await keepPicture(page, 'study_automatic');
  await page.click('#study button:has-text("Give up")');
  await answer(page, [3, 3, 3]);
  await page.waitForFunction(() => /Thank you/.test(document.getElementById('study-dialog').textContent));
  assert.deepEqual(page.failures, []);
  await page.close();
  assert.equal(await editor.ended, 0);

  const rows = rowsOf(fs.readFileSync(results(), 'utf8'));
  assert.deepEqual(rows.map((row) => `${row.task} ${row.condition} ${row.event}`), [
    'one manual begin', 'one manual edit', 'one manual give up',
    'two suggestive begin', 'two suggestive edit', 'two suggestive go', 'two suggestive go', 'two suggestive done',
    'three automatic begin', 'three automatic give up']);
  assert.ok(rows.every((row) => row.participant === '1' && row.target === '0.8'));
  assert.match(rows[1].edit, /scale 1\.02/);
  assert.ok(Math.abs(Number(rows[7].stackability) - first.stackability) < 1e-9);
  assert.equal(rows[5].stackability, rows[3].stackability);
  assert.deepEqual([rows[2].answer_1, rows[2].answer_2, rows[2].answer_3], ['1', '2', '3']);
  assert.deepEqual([rows[1].answer_1, rows[7].answer_1], ['', '4']);
});

test('the next participant has the next number, and other conditions first', { timeout: seconds(300) }, async () => {
  const editor = await Editor.start({ model: path.join(folder.path, 'plan.json') }, ['--study', results()]);
  const page = await openPage(browser, editor);
  await page.click('#study-dialog button.primary');
  await page.waitForFunction(() => document.body.dataset.study === 'suggestive');
  await assert.rejects(Editor.start({ model: path.join(folder.path, 'plan.json') }, ['--study', results()]), /another program edits/, 'it would lead the same participant');
  await editor.kill();
  await page.close();
  const rows = rowsOf(fs.readFileSync(results(), 'utf8'));
  assert.deepEqual([rows.at(-1).participant, rows.at(-1).event], ['2', 'begin'], 'a killed program loses nothing that was written');
});

test('a task that cannot be written down does not begin, and can be begun again', { timeout: seconds(300) }, async () => {
  const file = path.join(folder.path, 'later.csv');
  const editor = await Editor.start({ model: path.join(folder.path, 'plan.json') }, ['--study', file]);
  try {
    const page = await openPage(browser, editor);
    fs.mkdirSync(file); // is there, and no file
    await page.click('#study-dialog button.primary');
    await page.waitForFunction(() => /cannot be written/.test(document.getElementById('study-dialog').textContent));
    await keepPicture(page, 'study_failed');
    fs.rmdirSync(file);
    await page.click('#study-dialog button.primary');
    await page.waitForFunction(() => document.body.dataset.study === 'manual');
    assert.match(fs.readFileSync(file, 'utf8'), /begin/);
    await page.close();
  } finally {
    await editor.kill();
  }
});

test('plans and results that are none are refused before a page opens', { timeout: seconds(120) }, async () => {
  const plan = path.join(folder.path, 'bad.json');
  fs.writeFileSync(plan, '{"format": "stackabilize study", "version": 1, "tasks": [{"name": "x", "model": "nothing.obj", "target": 0.5}]}');
  await assert.rejects(Editor.start({ model: plan }, ['--study', results()]), /nothing\.obj/);
  fs.writeFileSync(plan, '{"format": "stackabilize study", "version": 1, "tasks": []}');
  await assert.rejects(Editor.start({ model: plan }, ['--study', results()]), /at least one task/);
  await assert.rejects(Editor.start({ model: path.join(folder.path, 'plan.json') }, ['--study', folder.model]), /line 1/);
});

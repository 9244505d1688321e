// Every shipped model, from opening it to an exported design with nothing to object to, by mouse alone.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import { after, before, test } from 'node:test';
import { Editor, Folder, keepPicture, models, openBrowser, openPage, program, seconds, stackability, suggestionsOf } from './editor.mjs';

let browser;
before(async () => { browser = await openBrowser(); });
after(() => browser?.close());

/** What a command of the program says, which must end with status 0. */
const resultOf = (...words) => JSON.parse(execFileSync(program, [...words, '--json', '-']).toString());

/** Clicks in the middle of what the locator finds. */
async function clickOn(page, locator) {
  await locator.scrollIntoViewIfNeeded();
  const box = await locator.boundingBox();
  await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
}

// Builds with sanitizers take minutes for each model: there every fifth one.
const every = Number(process.env.SLOWDOWN ?? 1) > 1 ? 5 : 1;
for (const model of fs.readdirSync(models).filter((name) => name.endsWith('.obj')).sort().filter((_, k) => k % every === 0))
  test(`${model}: the best suggestions make a design that stacks better, and that is acceptable`, { timeout: seconds(300) }, async () => {
    const folder = new Folder(model);
    const editor = await Editor.start(folder);
    try {
      const page = await openPage(browser, editor);
      // One suggestion is enough, or two where the first one only prepares.
      const atRest = await stackability(page), edits = 2;
      for (let k = 1; k <= edits && (await stackability(page)) <= atRest && (await suggestionsOf(page)).length > 0; ++k) {
        await clickOn(page, page.locator('.card').first());
        await page.waitForFunction((node) => window.editor.state.tree.current === node, k);
      }
      const shown = await stackability(page);
      assert.ok(shown > atRest, `S ${atRest} became ${shown}`);
      await keepPicture(page, `model_${model.replace(/\W.*/, '')}`);
      await clickOn(page, page.locator('#export summary'));
      const [download] = await Promise.all([page.waitForEvent('download'), clickOn(page, page.locator('#export-list a').first())]);
      const design = `${await download.path()}.obj`;
      fs.copyFileSync(await download.path(), design);
      try {
        assert.equal(resultOf('measure', design).stackability, shown);
        assert.equal(resultOf('compare', folder.model, design).acceptable, true);
      } finally {
        fs.rmSync(design);
      }
      assert.deepEqual(page.failures, []);
      await page.close();
    } finally {
      await editor.kill();
      folder.remove();
    }
  });

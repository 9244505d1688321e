// The page that `improve` writes, opened from its folder without a server: the 3-D view in it.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { pathToFileURL } from 'node:url';
import { after, before, test } from 'node:test';
import { Folder, keepPicture, openBrowser, program, seconds } from './editor.mjs';

let browser, folder, out;
before(async () => {
  browser = await openBrowser();
  folder = new Folder('table.obj');
  out = path.join(folder.path, 'out');
  execFileSync(program, ['improve', folder.model, '--target', '0.4', '--direction', '0', '0', '1', '--solutions', '1', '--effort', '0.3', '-o', out, '--quiet']);
});
after(async () => {
  await browser?.close();
  folder?.remove();
});

test('the view shows the object as given beside its solutions, under one camera', { timeout: seconds(120) }, async () => {
  const page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
  const failures = [], asked = [];
  page.on('pageerror', (error) => failures.push(String(error)));
  page.on('console', (message) => ['error', 'warning'].includes(message.type()) && !/GPU stall|GL Driver/.test(message.text()) && failures.push(message.text()));
  page.on('request', (request) => asked.push(request.url()));
  await page.goto(pathToFileURL(path.join(out, 'index.html')).href);
  await page.waitForFunction(() => window.reportView?.framesDrawn > 1);
  const labels = await page.locator('.view .labels span').allTextContents();
  assert.match(labels[0], /^As given, S /);
  assert.match(labels[1], /^Solution 1, S /);
  const facts = await page.evaluate(async () => {
    const view = window.reportView, bitmap = await createImageBitmap(await view.picture());
    const canvas = new OffscreenCanvas(bitmap.width, bitmap.height), pen = canvas.getContext('2d', { willReadFrequently: true });
    pen.drawImage(bitmap, 0, 0);
    const width = Math.floor(bitmap.width / view.stages.length);
    // Colours of each pane: that of the object as given is yellow, those of solutions are green.
    const panes = view.stages.map((_, k) => {
      const { data } = pen.getImageData(k * width, 0, width, bitmap.height);
      let yellow = 0, green = 0;
      for (let p = 0; p < data.length; p += 4) {
        if (Math.max(data[p], data[p + 1]) - data[p + 2] < 40) continue;
        if (data[p] > data[p + 1]) ++yellow;
        else ++green;
      }
      return { yellow, green };
    });
    return { panes, lost: view.renderer.getContext().isContextLost() };
  });
  assert.equal(facts.lost, false);
  assert.equal(facts.panes.length, labels.length);
  assert.ok(facts.panes[0].yellow > 1000 && facts.panes[0].green < facts.panes[0].yellow / 10, JSON.stringify(facts.panes));
  for (const pane of facts.panes.slice(1)) assert.ok(pane.green > 1000 && pane.yellow < pane.green / 10, JSON.stringify(facts.panes));
  const eye = () => page.evaluate(() => window.reportView.camera.position.toArray());
  const before = await eye();
  await page.focus('.view canvas');
  await page.keyboard.press('ArrowRight');
  assert.notDeepEqual(await eye(), before);
  await keepPicture(page, 'report');
  assert.deepEqual(failures, []);
  assert.deepEqual(asked.filter((url) => !url.startsWith('file:') && !url.startsWith('blob:') && !url.startsWith('data:')), [], 'nothing comes from a network');
  await page.close();
});

test('the page stays small', () => {
  const bytes = fs.statSync(path.join(out, 'index.html')).size;
  assert.ok(bytes < 700_000, `${bytes} bytes`);
});

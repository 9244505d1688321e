// The editor in a real browser: what a person sees and does.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { after, before, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { canvasFacts, Editor, Folder, keepPicture, models, openBrowser, openPage, program, seconds, stackability, suggestionsOf } from './editor.mjs';

let browser;
before(async () => { browser = await openBrowser(); });
after(() => browser?.close());

/** A test with a model, an editor and a page of its own. */
function editing(name, model, work) {
  test(name, { timeout: seconds(300) }, async () => {
    const folder = new Folder(model);
    const editor = await Editor.start(folder);
    try {
      const page = await openPage(browser, editor);
      await work(page, editor, folder);
      assert.deepEqual(page.failures, []);
      if (!page.isClosed()) {
        const facts = await canvasFacts(page);
        assert.equal(facts.lost, false, 'the WebGL context lives');
        assert.ok(facts.colours > 50 && facts.flat < 0.97, `the canvas is not flat: ${JSON.stringify(facts)}`);
        await keepPicture(page, name.replace(/[^a-z]+/gi, '_'));
        await page.close();
      }
    } finally {
      await editor.kill();
      folder.remove();
    }
  });
}

editing('a table opens with its measures and with suggestions, best first', 'table.obj', async (page) => {
  assert.match(await page.textContent('#s'), /^0\.0/);
  const list = await suggestionsOf(page);
  assert.ok(list.length > 3);
  assert.ok(list[0].gain > 0.1, 'the first suggestion of four legs on a top raises S');
  assert.equal(await page.locator('.card').count(), list.length);
});

editing('hovering previews, clicking applies, undo goes back', 'table.obj', async (page) => {
  const [first] = await suggestionsOf(page);
  const before = await stackability(page);
  await page.locator('.card').first().hover();
  await page.waitForFunction((s) => document.getElementById('s').textContent === s, first.stackability.toFixed(2));
  assert.equal(await stackability(page), before, 'a preview is no edit');
  const outlined = () => page.evaluate(() => window.editor.viewer.main.objects.before.visible);
  assert.equal(await outlined(), true, 'the current design is outlined beside a preview');
  await page.mouse.move(400, 400);
  await page.waitForFunction((s) => Number(document.getElementById('s').textContent) === s, Number(before.toFixed(2)));
  assert.equal(await outlined(), false);
  await page.locator('.card').first().click();
  await page.waitForFunction(() => window.editor.state.tree.current === 1);
  assert.ok(Math.abs((await stackability(page)) - first.stackability) < 1e-9);
  await suggestionsOf(page);
  await page.keyboard.press('Control+z');
  await page.waitForFunction(() => window.editor.state.tree.current === 0);
  assert.equal(await stackability(page), before);
  await page.keyboard.press('Control+Shift+z');
  await page.waitForFunction(() => window.editor.state.tree.current === 1);
});

editing('rolling back to the root and taking another edit makes a branch', 'small_cup.obj', async (page) => {
  await suggestionsOf(page);
  await page.locator('.card').first().click();
  await page.waitForFunction(() => window.editor.state.tree.current === 1);
  await suggestionsOf(page);
  await page.locator('.node').first().click();
  await page.waitForFunction(() => window.editor.state.tree.current === 0);
  await suggestionsOf(page);
  await page.locator('.card').nth(1).focus();
  await page.keyboard.press('Enter');
  await page.waitForFunction(() => window.editor.state.tree.nodes.length === 3);
  const parents = await page.evaluate(() => window.editor.state.tree.nodes.map((node) => node.parent));
  assert.deepEqual(parents, [-1, 0, 0]);
});

editing('what is exported is what is shown', 'small_cup.obj', async (page) => {
  await suggestionsOf(page);
  await page.locator('.card').first().click();
  await page.waitForFunction(() => window.editor.state.tree.current === 1);
  await page.click('#export summary');
  const [download] = await Promise.all([page.waitForEvent('download'), page.click('#export-list a >> nth=0')]);
  assert.equal(download.suggestedFilename(), 'small_cup.obj');
  const text = fs.readFileSync(await download.path(), 'utf8');
  const vertices = text.split('\n').filter((line) => line.startsWith('v ')).flatMap((line) => line.split(' ').slice(1, 4).map(Number));
  await page.waitForTimeout(0);
  const shown = await page.evaluate(() => Array.from(window.editor.viewer.design));
  assert.equal(vertices.length, shown.length);
  vertices.forEach((value, k) => assert.ok(Math.abs(value - shown[k]) <= 1e-6 * Math.abs(value) + 1e-12));
});

editing('every kind of export holds the design', 'small_cup.obj', async (page) => {
  await suggestionsOf(page);
  await page.locator('.card').first().click();
  await page.waitForFunction(() => window.editor.state.tree.current === 1);
  const shown = await stackability(page), folder = fs.mkdtempSync(path.join(os.tmpdir(), 'exports-'));
  const saved = async (link) => {
    await page.click('#export summary');
    const [download] = await Promise.all([page.waitForEvent('download'), link.click()]);
    const file = path.join(folder, download.suggestedFilename());
    await download.saveAs(file);
    if (await page.locator('#export').getAttribute('open') !== null) await page.click('#export summary');
    return file;
  };
  try {
    const links = page.locator('#export-list a'), names = [];
    for (let k = 0; k < await links.count(); ++k) {
      const file = await saved(links.nth(k));
      names.push(path.basename(file));
      if (/\.(obj|3mf|glb|stl)$/.test(file)) {
        const said = Number(execFileSync(program, ['measure', file, '--quiet'], { encoding: 'utf8' }));
        // GLB and STL hold single precision.
        assert.ok(Math.abs(said - shown) < (/\.(glb|stl)$/.test(file) ? 1e-5 : 1e-9), `${file}: S ${said}, not ${shown}`);
      } else if (file.endsWith('.json')) {
        const { history } = JSON.parse(fs.readFileSync(file, 'utf8'));
        assert.ok(Math.abs(history.nodes[history.current].stackability - shown) < 1e-9);
      }
    }
    assert.deepEqual(names, ['obj', '3mf', 'glb', 'stl', 'stackabilize.json', 'html'].map((ending) => 'small_cup.' + ending));
    const picture = fs.readFileSync(await saved(page.locator('#export-list button')));
    assert.equal(picture.subarray(0, 8).toString('latin1'), '\x89PNG\r\n\x1a\n');
    assert.ok(picture.readUInt32BE(16) > 400 && picture.readUInt32BE(20) > 300, 'as large as the view');
  } finally {
    fs.rmSync(folder, { recursive: true });
  }
});

editing('a report of the design is one page that needs neither editor nor network', 'small_cup.obj', async (page) => {
  await suggestionsOf(page);
  await page.locator('.card').first().click();
  await page.waitForFunction(() => window.editor.state.tree.current === 1);
  await page.fill('#copies', '7');
  await page.click('#export summary');
  const [download] = await Promise.all([page.waitForEvent('download'), page.click('#export-list a:has-text("Report")')]);
  assert.equal(download.suggestedFilename(), 'small_cup.html');
  const file = (await download.path()) + '.html', asked = [], failures = [];
  fs.copyFileSync(await download.path(), file);
  const shown = await page.evaluate(() => window.editor.state.design);
  assert.equal(await page.evaluate((text) => new DOMParser().parseFromString(text, 'application/xml').querySelector('parsererror')?.textContent, fs.readFileSync(file, 'utf8')), undefined, 'well-formed');
  const report = await browser.newPage({ viewport: { width: 1280, height: 800 } });
  report.on('request', (request) => asked.push(request.url()));
  report.on('pageerror', (error) => failures.push(String(error)));
  await report.goto(pathToFileURL(file).href);
  await report.waitForFunction(() => window.reportView?.framesDrawn > 1);
  assert.deepEqual(await report.locator('.view .labels span').allTextContents(),
    [shown.rest, shown.measured].map(({ stackability }, k) => `${['As given', 'Edited'][k]}, S ${Number(stackability.toPrecision(5))}`));
  const heights = await report.locator('tr:has-text("7 copies") td').allTextContents();
  [shown.rest, shown.measured].forEach(({ height, f_max }, k) => assert.ok(Math.abs(parseFloat(heights[k]) / (height + 6 * f_max) - 1) < 1e-4, heights[k]));
  assert.ok((await report.locator('h3:has-text("What changes") + ul li').count()) > 0);
  assert.equal(await report.locator('h3:has-text("Edits") + ol li').count(), 1);
  await keepPicture(report, 'session-report');
  assert.deepEqual(failures, []);
  assert.deepEqual(asked.filter((url) => !/^(file|blob|data):/.test(url)), []);
  await report.close();
  fs.rmSync(file);
});

test('an editor that was killed comes back as it was', { timeout: seconds(300) }, async () => {
  const folder = new Folder('small_cup.obj');
  let editor = await Editor.start(folder);
  try {
    let page = await openPage(browser, editor);
    await suggestionsOf(page);
    await page.locator('.card').first().click();
    await page.waitForFunction(() => window.editor.state.tree.current === 1);
    await page.fill('#target', '0.87');
    // Wishes that come from the program in the meantime do not overwrite what is being typed.
    await page.evaluate(() => window.editor.connection.send({ do: 'target', value: 0.8 }));
    await page.waitForFunction(() => window.editor.state.wishes.target === 0.8);
    assert.equal(await page.inputValue('#target'), '0.87');
    await page.press('#target', 'Enter');
    await page.waitForFunction(() => window.editor.state.wishes.target === 0.87);
    const [s, vertices] = await page.evaluate(() => [window.editor.state.design.measured.stackability, Array.from(window.editor.viewer.design)]);
    await editor.kill('SIGKILL');
    await page.waitForSelector('#veil:not([hidden])');
    await page.close();
    editor = await Editor.start(folder);
    page = await openPage(browser, editor);
    assert.equal(await stackability(page), s);
    assert.deepEqual(await page.evaluate(() => Array.from(window.editor.viewer.design)), vertices);
    assert.equal(await page.inputValue('#target'), '0.87');
    assert.equal(await page.isEnabled('#undo'), true);
    await page.close();
  } finally {
    await editor.kill();
    folder.remove();
  }
});

test('a session of another shape is refused', { timeout: seconds(300) }, async () => {
  const folder = new Folder('small_cup.obj');
  try {
    const editor = await Editor.start(folder);
    const page = await openPage(browser, editor);
    await suggestionsOf(page);
    await page.locator('.card').first().click();
    await page.waitForFunction(() => window.editor.state.tree.current === 1);
    await editor.kill();
    await page.close();
    fs.appendFileSync(folder.model, 'v 9 9 9\n');
    await assert.rejects(Editor.start(folder), /--fresh begins anew/);
    await (await Editor.start(folder, ['--fresh'])).kill();
  } finally {
    folder.remove();
  }
});

editing('one page edits, the other looks on until it takes over', 'small_cup.obj', async (page, editor) => {
  const other = await openPage(browser, editor);
  await suggestionsOf(other);
  assert.match(await other.textContent('#role'), /looks on/);
  await other.locator('.card').first().click();
  await other.waitForFunction(() => /looks on/.test(document.getElementById('hint').textContent));
  assert.equal(await page.evaluate(() => window.editor.state.tree.nodes.length), 1);
  await page.locator('.card').first().click();
  await other.waitForFunction(() => window.editor.state.tree.current === 1);
  assert.equal(await page.isVisible('#write'), false);
  await keepPicture(other, 'looks_on');
  await other.click('#write');
  await other.waitForFunction(() => window.editor.state.writes);
  await page.waitForSelector('#write:not([hidden])');
  await other.click('#undo');
  await page.waitForFunction(() => window.editor.state.tree.current === 0);
  assert.deepEqual(other.failures, []);
  await other.close();
});

test('two programs do not save one session, and one that was killed makes way', { timeout: seconds(300) }, async () => {
  const folder = new Folder('small_cup.obj');
  const first = await Editor.start(folder);
  try {
    await assert.rejects(Editor.start(folder), /another program edits .*small_cup\.obj\.session\.json/);
    await (await Editor.start(folder, ['--session', path.join(folder.path, 'other.json')])).kill('SIGTERM');
    await first.kill();
    await (await Editor.start(folder)).kill('SIGTERM');
    assert.deepEqual(Object.keys(folder.contents()), ['small_cup.obj']);
  } finally {
    await first.kill();
    folder.remove();
  }
});

test('a session that goes on says which options it cannot obey', { timeout: seconds(300) }, async () => {
  const folder = new Folder('small_cup.obj');
  let editor = await Editor.start(folder, ['--direction', '0', '0', '2', '--unit', 'm']);
  try {
    assert.equal(editor.errors.includes('goes on'), false, 'a new session obeys');
    const page = await openPage(browser, editor);
    await page.fill('#target', '0.87');
    await page.press('#target', 'Enter');
    await page.waitForFunction(() => window.editor.state.wishes.target === 0.87);
    await editor.kill();
    await page.close();
    await assert.rejects(Editor.start(folder, ['--direction', '1', '0', '0']), /goes on stacked along z, not as --direction says: --fresh begins anew/);
    editor = await Editor.start(folder, ['--direction', '0', '0', '2', '--unit', 'm']);
    assert.match(editor.errors, /goes on with the shape and the structure that it holds, without --unit; --fresh begins anew/);
  } finally {
    await editor.kill();
    folder.remove();
  }
});

test('a page that lost the program says what is saved, and tries again when it is told to', { timeout: seconds(300) }, async () => {
  const folder = new Folder('small_cup.obj');
  const editor = await Editor.start(folder, ['--keep-open']);
  try {
    const page = await openPage(browser, editor);
    const lose = () => page.evaluate(() => {
      window.editor.connection.tries = 100;
      window.editor.connection.socket.close();
    });
    await lose();
    await page.waitForSelector('#again:not([hidden])');
    assert.match(await page.textContent('#veil-text'), /What you did is saved/);
    await keepPicture(page, 'lost');
    await page.click('#again');
    await page.waitForSelector('#veil', { state: 'hidden' });

    // Nothing is said to be saved where the file cannot be written.
    fs.mkdirSync(folder.session);
    await page.fill('#target', '0.87');
    await page.press('#target', 'Enter');
    await page.waitForFunction(() => window.editor.state.tree.saved === false);
    await lose();
    await page.waitForSelector('#again:not([hidden])');
    assert.doesNotMatch(await page.textContent('#veil-text'), /saved/);
    await page.close();
  } finally {
    await editor.kill();
    folder.remove();
  }
});

/** Middle of the handle of an axis in the window, a little away from the centre. */
async function gripOf(page, name) {
  await frameDrawn(page); // which gives the handles their size
  return page.evaluate((name) => {
    const { gizmo, viewer } = window.editor, axis = gizmo.handle.axesOf(gizmo.tool).find((one) => one.name === name);
    const length = gizmo.group.scale.x, centre = gizmo.group.position.clone(), at = centre.clone().addScaledVector(axis.direction, 0.8 * length);
    const grip = viewer.screenOf(at), origin = viewer.screenOf(centre);
    return { x: grip.x, y: grip.y, dx: grip.x - origin.x, dy: grip.y - origin.y };
  }, name);
}

/** Picks a part by its name in the panel. */
async function pick(page, name) {
  await page.click('#tab-parts');
  await page.locator('.parts button', { hasText: name }).first().click();
  await page.waitForFunction(() => window.editor.gizmo.handle);
}

/** Waits for a frame that is drawn from now on: frames that are asked for together are drawn as one. */
async function frameDrawn(page) {
  const before = await page.evaluate(() => {
    window.editor.viewer.draw();
    return window.editor.viewer.framesDrawn;
  });
  await page.waitForFunction((count) => window.editor.viewer.framesDrawn > count, before);
}

editing('where drawing is slow, what moves is sketched and what rests is drawn in full', 'armchair.obj', async (page) => {
  const seen = () => page.evaluate(() => {
    const { viewer } = window.editor, { body, ghosts, sketch } = viewer.main.objects;
    return { body: body.visible, ghosts: ghosts.children.map(({ children }) => children.map((one) => one.visible)), sketch: sketch.visible, width: viewer.canvas.width };
  });
  await page.waitForFunction(() => !window.editor.viewer.sketched);
  const whole = await seen();
  assert.ok(whole.ghosts.length > 0);
  for (const ghost of whole.ghosts) assert.deepEqual(ghost, [true, true, true, false]);
  const [moving, picked] = await page.evaluate(async () => {
    const { viewer } = window.editor, frame = () => new Promise(requestAnimationFrame);
    viewer.slow = true;
    viewer.turn(0.4, 0);
    await frame();
    await frame();
    const { body, sketch } = viewer.main.objects;
    const box = viewer.canvas.getBoundingClientRect(), hit = window.editor.picker.pick(box.left + box.width / 2, box.top + box.height / 2);
    return [{ body: body.visible, sketch: sketch.visible, width: viewer.canvas.width, sketched: viewer.sketched }, hit?.part];
  });
  assert.deepEqual({ ...moving, width: moving.width < whole.width / 2 }, { body: false, sketch: true, width: true, sketched: true });
  assert.ok(picked >= 0, 'a part is picked in a sketch');
  await page.waitForFunction(() => !window.editor.viewer.sketched);
  assert.deepEqual(await seen(), whole);
});

editing('the gap is shown in colours, again for each design, until it is not wanted', 'table.obj', async (page) => {
  await page.click('text=Gap');
  await page.waitForFunction(() => window.editor.viewer.main.envelopes);
  const seen = () => page.evaluate(() => {
    const { main } = window.editor.viewer, { gap } = main.objects, { upper, lower } = main.envelopes;
    const { position, color } = gap.geometry.attributes;
    let most = -1, red = -1;
    for (let k = 0; k < upper.length; ++k) if (upper[k] - lower[k] > (most < 0 ? -1 : upper[most] - lower[most])) most = k;
    for (let k = 0; k < upper.length; ++k) if (!Number.isNaN(upper[k]) && (red < 0 || color.getX(k) - color.getY(k) > color.getX(red) - color.getY(red))) red = k;
    const gaps = [most, red].map((k) => upper[k] - lower[k]), box = main.surface.geometry;
    box.computeBoundingBox();
    return { gaps, f_max: window.editor.state.design.measured.f_max, triangles: gap.geometry.index.count / 3, visible: gap.visible,
      inside: Array.from({ length: upper.length }, (_, k) => k).every((k) => Number.isNaN(upper[k]) || box.boundingBox.clone().expandByScalar(1e-5).containsPoint(main.centre.clone().fromBufferAttribute(position, k))) };
  });
  const first = await seen();
  assert.ok(first.visible && first.inside && first.triangles > 1000, JSON.stringify(first));
  assert.ok(Math.abs(first.gaps[0] - first.f_max) < 1e-3 && first.gaps[0] === first.gaps[1], 'where copies touch it is red: ' + JSON.stringify(first));
  const legend = page.locator('#gap-legend');
  assert.match(await legend.textContent(), /touches.* apart/);
  await keepPicture(page, 'gap');
  const [{ stackability: promised }] = await suggestionsOf(page);
  await page.locator('.card').first().click();
  await page.waitForFunction((s) => Math.abs(window.editor.state.design.measured.stackability - s) < 1e-9 && window.editor.viewer.main.envelopes, promised);
  const second = await seen();
  assert.ok(Math.abs(second.gaps[0] - second.f_max) < 0.01 * second.f_max && second.f_max < first.f_max, JSON.stringify(second));
  await page.keyboard.press('h');
  await page.waitForFunction(() => !window.editor.viewer.main.objects.gap.visible);
  assert.equal(await legend.isVisible(), false);
});

editing('so many copies within a length are wanted in place of a target', 'table.obj', async (page) => {
  const wishes = () => page.evaluate(() => window.editor.state.wishes);
  const stack = page.locator('#stack'), { target } = await wishes();
  await page.fill('#copies', '5');
  await page.fill('#within', '3');
  await page.press('#within', 'Enter');
  await page.waitForFunction(() => window.editor.state.wishes.within);
  assert.deepEqual((await wishes()).within, { copies: 5, length: 3 });
  assert.match(await stack.getAttribute('class'), /beyond/, 'the stack is 3.7 high');
  assert.equal(await page.evaluate(() => window.editor.state.design.reaches), false);
  await page.fill('#copies', '4');
  await page.press('#copies', 'Enter');
  await page.waitForFunction(() => window.editor.state.design.reaches);
  assert.doesNotMatch((await stack.getAttribute('class')) ?? '', /beyond/, 'that of four is 2.96');
  await page.fill('#within', '0.5');
  await page.press('#within', 'Enter');
  await page.waitForFunction(() => /no room for 4 copies/.test(document.getElementById('hint').textContent));
  assert.equal(await page.inputValue('#within'), '3', 'what was refused is not shown');
  await page.click('#tab-automatic');
  assert.match(await page.textContent('#panel-automatic'), /4 copies within 3/);
  await page.fill('#within', '');
  await page.press('#within', 'Enter');
  await page.waitForFunction(() => !window.editor.state.wishes.within);
  await page.fill('#target', String(target));
  await page.press('#target', 'Enter');
  await page.waitForFunction((target) => window.editor.state.wishes.target === target, target);
});

editing('a part is picked in the view', 'table.obj', async (page) => {
  await suggestionsOf(page);
  const at = await page.evaluate(() => {
    const { viewer, state } = window.editor, top = state.model.parts.findIndex((part) => /top/.test(part.name));
    const points = state.design.primitives[top].points, highest = Math.max(...points.map((p) => p[2]));
    const corners = points.filter((p) => p[2] > highest - 0.001), middle = [0, 1].map((k) => corners.reduce((sum, p) => sum + p[k], 0) / corners.length);
    const place = viewer.screenOf(viewer.main.centre.clone().set(middle[0], middle[1], highest));
    return { ...place, top };
  });
  await page.mouse.click(at.x, at.y);
  await page.waitForFunction((top) => window.editor.gizmo.handle?.part === top, at.top);
  assert.equal(await page.getAttribute('#tab-parts', 'aria-selected'), 'true');
  await page.keyboard.press('Escape');
  await page.waitForFunction(() => !window.editor.gizmo.handle);
});

editing('a handle is dragged until a limit holds it; the limit is named; it is one edit', 'table.obj', async (page) => {
  await suggestionsOf(page);
  await pick(page, 'leg');
  await frameDrawn(page);
  const name = await page.evaluate(() => window.editor.gizmo.handle.axesOf('move')[1].name);
  const grip = await gripOf(page, name);
  await page.mouse.move(grip.x, grip.y);
  await page.mouse.down();
  await page.waitForFunction(() => window.editor.gizmo.active);
  await page.waitForFunction(() => window.editor.state.range);
  const range = await page.evaluate(() => window.editor.state.range);
  assert.ok(range.above || range.below, 'a leg cannot be moved anywhere');
  for (let k = 1; k <= 12; ++k) await page.mouse.move(grip.x + (grip.dx * k) / 3, grip.y + (grip.dy * k) / 3);
  await page.waitForFunction(() => document.getElementById('hint').classList.contains('bad') && document.getElementById('hint').textContent);
  await page.waitForFunction(() => window.editor.state.design.dragging);
  assert.ok(await page.isVisible('#range'));
  const checks = await page.evaluate(() => window.editor.state.design.checks);
  for (const check of checks) assert.ok(check.passed || check.name === 'target', check.words);
  await keepPicture(page, 'dragging');
  await page.mouse.up();
  await page.waitForFunction(() => window.editor.state.tree.nodes.length === 2 && !window.editor.state.design.dragging);
  assert.equal(await page.evaluate(() => window.editor.state.tree.nodes[1].edits.length), 1);
  await page.keyboard.press('Control+z');
  await page.waitForFunction(() => window.editor.state.tree.current === 0);
});

editing('a drag that is given up leaves the design as it was', 'table.obj', async (page) => {
  await suggestionsOf(page);
  await pick(page, 'leg');
  const name = await page.evaluate(() => window.editor.gizmo.handle.axesOf('move')[1].name);
  const grip = await gripOf(page, name);
  await page.mouse.move(grip.x, grip.y);
  await page.mouse.down();
  await page.mouse.move(grip.x + 0.2 * grip.dx, grip.y + 0.2 * grip.dy);
  await page.waitForFunction(() => window.editor.state.design.dragging);
  await page.keyboard.press('Escape');
  await page.waitForFunction(() => !window.editor.state.design.dragging && window.editor.state.design.change < 1e-12);
  await page.mouse.up();
  assert.equal(await page.evaluate(() => window.editor.state.tree.nodes.length), 1);
});

editing('an amount is typed instead of dragged', 'table.obj', async (page) => {
  await pick(page, 'leg');
  await page.click('.segments button:has-text("Scale")');
  await page.selectOption('.amounts select', { label: 'across, first' });
  await page.fill('.amounts input', '0.95');
  await page.click('.amounts button');
  await page.waitForFunction(() => window.editor.state.tree.nodes.length === 2);
  assert.match(await page.evaluate(() => window.editor.state.tree.nodes[1].edits[0]), /scale 0\.95/);
});

editing('an amount goes along the axis that its part has now', 'table.obj', async (page) => {
  await pick(page, 'leg');
  const axisOf = (name) => page.evaluate((name) => window.editor.gizmo.handle.axesOf('move').find((axis) => axis.name === name).direction.toArray(), name);
  const before = await axisOf('across, second');
  await page.click('.segments button:has-text("Turn")');
  await page.selectOption('.amounts select', { label: 'across, first' });
  await page.fill('.amounts input', '4');
  await page.click('.amounts button');
  await page.waitForFunction(() => window.editor.state.tree.nodes.length === 2);
  await page.click('.segments button:has-text("Move")');
  await page.selectOption('.amounts select', { label: 'across, second' });
  await page.fill('.amounts input', '0.01');
  // Undo turns the axes back while the form stays.
  await page.click('#undo');
  await page.waitForFunction(() => window.editor.state.tree.current === 0 && !window.editor.state.design.dragging);
  await page.click('#redo');
  await page.waitForFunction(() => window.editor.state.tree.current === 1);
  const now = await axisOf('across, second');
  assert.ok(now.reduce((sum, x, k) => sum + x * before[k], 0) < 1 - 1e-8, 'the leg has turned, as far as its limits allow');
  await page.click('#undo');
  await page.waitForFunction(() => window.editor.state.tree.current === 0);
  assert.equal(await page.inputValue('.amounts input'), '0.01', 'what was typed stays');
  await page.click('.amounts button');
  await page.waitForFunction(() => window.editor.state.tree.nodes.length === 3);
  const moved = (await page.evaluate(() => window.editor.state.tree.nodes[2].edits[0])).match(/move (\S+) (\S+) (\S+)/).slice(1).map(Number);
  const length = Math.hypot(...moved);
  assert.ok(length > 0 && moved.reduce((sum, x, k) => sum + (x * before[k]) / length, 0) > 1 - 1e-12, `${moved} is along ${before}`);
});

editing('a target is set, designs are found, and one is taken on', 'small_cup.obj', async (page) => {
  await page.fill('#target', '0.8');
  await page.press('#target', 'Enter');
  await page.click('#tab-automatic');
  await page.click('#find');
  await page.waitForFunction(() => window.editor.state.found.list.length > 0);
  if (await page.evaluate(() => window.editor.state.found.running)) await page.click('#find');
  await page.waitForFunction(() => !window.editor.state.found.running);
  // Designs change places in the list while the search runs.
  const [design] = await page.evaluate(() => window.editor.state.found.list);
  assert.ok(design.stackability >= 0.8);
  await keepPicture(page, 'found');
  await page.locator('#panel-automatic .card').first().click();
  await page.waitForFunction(() => window.editor.state.tree.nodes.length === 2);
  assert.ok(Math.abs((await stackability(page)) - design.stackability) < 1e-6);
});

editing('the trade of S against change is explored, and a point of it is taken', 'small_cup.obj', async (page) => {
  await page.click('#tab-automatic');
  await page.click('#find-front');
  await page.waitForFunction(() => window.editor.state.found.front && window.editor.state.found.list.length > 0);
  assert.equal(await page.isVisible('#find-front'), false);
  await page.click('#find');
  await page.waitForFunction(() => !window.editor.state.found.running);
  const { list, at_rest: rest } = await page.evaluate(() => window.editor.state.found);
  for (let k = 0; k < list.length; ++k) assert.ok(list[k].stackability > (k ? list[k - 1].stackability : rest));
  const chosen = list[list.length - 1], dot = page.locator(`.curve circle[data-number="${chosen.number}"]`);
  assert.equal(await page.locator('.curve circle').count(), list.length);
  await dot.hover();
  await page.waitForFunction((s) => document.getElementById('s').textContent === s.toFixed(2), chosen.stackability);
  assert.match(await dot.getAttribute('class'), /chosen/);
  await keepPicture(page, 'front');
  await dot.click();
  await page.waitForFunction(() => window.editor.state.tree.nodes.length === 2);
  assert.ok(Math.abs((await stackability(page)) - chosen.stackability) < 1e-6);
});

editing('a limit is relaxed under Quality', 'small_cup.obj', async (page) => {
  await page.click('#tab-quality');
  const box = page.getByLabel('No limit for bending');
  await box.check();
  await page.waitForFunction(() => window.editor.state.wishes.limits.bending === null);
  await page.getByLabel('No limit for bending').uncheck();
  await page.waitForFunction(() => window.editor.state.wishes.limits.bending !== null);
  assert.match(await page.textContent('#nearest'), /none|%/);
});

editing('pictures of designs follow the theme', 'small_cup.obj', async (page) => {
  await page.fill('#target', '0.8');
  await page.press('#target', 'Enter');
  await page.click('#tab-automatic');
  await page.click('#find');
  await page.waitForFunction(() => window.editor.state.found.list.length > 0 && !window.editor.state.found.running);
  const corner = () => page.evaluate(() => Array.from(document.querySelector('#panel-automatic .card canvas').getContext('2d').getImageData(1, 1, 1, 1).data.slice(0, 3)));
  const light = await corner();
  await page.click('#theme');
  const dark = await corner();
  assert.ok(Math.max(...dark) < 64 && Math.min(...light) > 192, `${light} becomes ${dark}`);
});

editing('a design with another direction is looked at along that direction', 'small_cup.obj', async (page) => {
  await page.evaluate(() => window.editor.send({ do: 'direction', direction: [0, 3, 4] }));
  await page.waitForFunction(() => window.editor.state.tree.current === 1);
  const rest = await page.evaluate(() => window.editor.state.design.rest), measured = await page.evaluate(() => window.editor.state.design.measured);
  const seen = () => page.evaluate(() => [...window.editor.viewer.main.direction.toArray(), window.editor.viewer.main.step]);
  const settled = (step) => page.waitForFunction((step) => Math.abs(window.editor.viewer.main.step - step) < 1e-12, step);
  await settled(measured.f_max);
  await page.click('#cameras button:has-text("Compare")');
  await page.selectOption('#compare select', '0');
  await page.waitForFunction(() => window.editor.viewer.stages[1].step > 0);
  const upright = await page.evaluate(() => window.editor.viewer.stages[1].step);
  assert.notEqual(upright, rest.f_max, 'at rest along z, not along the new direction');
  await page.keyboard.press('x');
  await page.locator('.node').first().hover();
  await settled(upright);
  assert.deepEqual((await seen()).slice(0, 3), [0, 0, 1]);
  await page.mouse.move(400, 400);
  await settled(measured.f_max);
  assert.deepEqual((await seen()).slice(0, 3).map((x) => Math.round(1e9 * x) / 1e9), [0, 0.6, 0.8]);
  await page.evaluate(() => window.editor.send({ do: 'roll-back', node: 0 }));
  await page.waitForFunction(() => window.editor.state.tree.current === 0);
  assert.ok(Math.abs((await page.evaluate(() => window.editor.state.design.measured.f_max)) - upright) < 1e-9, 'its own step was shown');
});

editing('the graphics card keeps nothing that is not shown', 'table.obj', async (page) => {
  await pick(page, 'leg');
  await page.waitForFunction(() => window.editor.state.review.ready);
  for (const key of ['j', 'y', 'b']) await page.keyboard.press(key);
  const name = await page.evaluate(() => window.editor.gizmo.handle.axesOf('move')[1].name);
  const round = async () => {
    const grip = await gripOf(page, name);
    await page.mouse.move(grip.x, grip.y);
    await page.mouse.down();
    await page.waitForFunction(() => window.editor.state.range);
    for (const share of [0.1, 0.2, 0.1]) {
      await page.mouse.move(grip.x + share * grip.dx, grip.y + share * grip.dy);
      await frameDrawn(page);
    }
    await page.waitForFunction(() => window.editor.state.design.dragging);
    await page.keyboard.press('Escape');
    await page.waitForFunction(() => !window.editor.state.design.dragging);
    await page.mouse.up();
    await page.evaluate(() => {
      const { viewer, state } = window.editor;
      viewer.main.setStrokes([new Set([0, 1]), new Set([2, 3])]);
      viewer.main.setRelations(state.model.joints.flatMap((joint) => joint.points), state.model.symmetries);
    });
    await frameDrawn(page);
    await page.keyboard.press('x');
    await frameDrawn(page);
    await page.keyboard.press('x');
    await page.evaluate(() => window.editor.viewer.main.setStrokes([]));
    await page.mouse.move(400, 700);
    await frameDrawn(page);
    return page.evaluate(() => window.editor.viewer.renderer.info.memory.geometries);
  };
  const before = await round();
  assert.ok(before > 5);
  assert.deepEqual([await round(), await round()], [before, before]);
});

/** What axe-core finds serious or critical. */
const violations = (page) =>
  page.evaluate(async () => {
    const found = await window.axe.run(document, { runOnly: ['wcag2a', 'wcag2aa', 'wcag21aa', 'best-practice'] });
    return found.violations.filter((one) => ['serious', 'critical'].includes(one.impact)).map((one) => `${one.id}: ${one.nodes.map((node) => node.html).join(' | ').slice(0, 300)}`);
  });

editing('axe-core finds nothing serious, in any panel, light and dark', 'table.obj', async (page) => {
  await suggestionsOf(page);
  await page.evaluate(fs.readFileSync(new URL('node_modules/axe-core/axe.min.js', import.meta.url), 'utf8'));
  for (const theme of ['light', 'dark']) {
    for (const tab of ['suggestions', 'automatic', 'quality', 'parts']) {
      await page.click('#tab-' + tab);
      if (tab === 'parts') await page.locator('.parts button').first().click();
      assert.deepEqual(await violations(page), [], `${theme}, ${tab}`);
      await keepPicture(page, `panel_${theme}_${tab}`);
    }
    await page.keyboard.press('Escape');
    await page.keyboard.press('d');
  }
});

editing('everything of a step is done with keys alone', 'small_cup.obj', async (page) => {
  await suggestionsOf(page);
  await page.focus('#tab-suggestions');
  await page.keyboard.press('Tab');
  assert.ok(await page.evaluate(() => document.activeElement.classList.contains('card')));
  const first = await page.evaluate(() => document.activeElement.dataset.edit);
  await page.keyboard.press('ArrowRight');
  assert.notEqual(await page.evaluate(() => document.activeElement.dataset.edit), first);
  await page.keyboard.press('ArrowLeft');
  await page.keyboard.press('Enter');
  await page.waitForFunction(() => window.editor.state.tree.current === 1);
  await page.focus('.node[aria-current]');
  await page.keyboard.press('ArrowLeft');
  await page.keyboard.press('Enter');
  await page.waitForFunction(() => window.editor.state.tree.current === 0);
  const before = await page.evaluate(() => window.editor.viewer.camera.position.toArray());
  await page.focus('#view');
  await page.keyboard.press('ArrowLeft');
  assert.notDeepEqual(await page.evaluate(() => window.editor.viewer.camera.position.toArray()), before);
  const distance = () => page.evaluate(() => window.editor.viewer.camera.position.distanceTo(window.editor.viewer.controls.target));
  const far = await distance();
  await page.keyboard.press('+');
  assert.ok((await distance()) < far);
  await page.keyboard.press('-');
  assert.ok(Math.abs((await distance()) / far - 1) < 1e-9);
});

editing('what has the focus keeps it, and what is typed stays', 'small_cup.obj', async (page) => {
  const focused = () => page.evaluate(() => document.activeElement.getAttribute('aria-label') ?? document.activeElement.textContent);
  await page.evaluate(() => {
    window.editor.send({ do: 'drag', edit: 'body scale 1.02 along 1 0 0' });
    window.editor.send({ do: 'end-drag', keep: true });
  });
  await page.waitForFunction(() => window.editor.state.tree.current === 1);

  // A design of the tree shows what is behind it, and stays in focus when it becomes the current one.
  await page.waitForFunction(() => document.querySelectorAll('.node').length === 2);
  await page.focus('.node[aria-current]');
  await page.keyboard.press('ArrowLeft');
  await page.waitForFunction(() => {
    const { viewer } = window.editor;
    return viewer.main.surface.vertices[0] < viewer.design[0] - 1e-6;
  });
  const node = await focused();
  await page.keyboard.press('Enter');
  await page.waitForFunction(() => window.editor.state.tree.current === 0);
  assert.equal(await focused(), node);

  // Chips, and messages that come while somebody types.
  await pick(page, 'body');
  await page.focus('.segments button:has-text("Scale")');
  await page.keyboard.press('Enter');
  assert.equal(await focused(), 'Scale');
  await page.fill('.amounts input', '0.95');
  await page.evaluate(() => window.editor.send({ do: 'keep', parts: [0] }));
  await page.waitForFunction(() => window.editor.state.wishes.kept.length === 1);
  assert.match(await focused(), /Amount/);
  assert.equal(await page.inputValue('.amounts input'), '0.95');

  // In a text field undo is that of the text.
  await page.keyboard.press('End');
  await page.keyboard.type('7');
  await page.keyboard.press('Control+z');
  assert.notEqual(await page.inputValue('.amounts input'), '0.957');
  await page.evaluate(() => window.editor.send({ do: 'keep', parts: [] }));
  await page.waitForFunction(() => window.editor.state.wishes.kept.length === 0);
  assert.equal(await page.evaluate(() => window.editor.state.tree.current), 0, 'no design was left');
  await page.keyboard.press('Escape');
});

editing('strokes cut a part in two; undo joins it again', 'mug_with_handle.obj', async (page) => {
  await suggestionsOf(page);
  const count = await page.evaluate(() => window.editor.state.model.parts.length);
  await page.keyboard.press('k');
  const box = await page.locator('#view').boundingBox();
  const middle = await page.evaluate(() => window.editor.viewer.screenOf(window.editor.viewer.main.centre));
  const stroke = async (dy) => {
    await page.mouse.move(middle.x - 30, middle.y + dy);
    await page.mouse.down();
    await page.mouse.move(middle.x + 30, middle.y + dy, { steps: 4 });
    await page.mouse.up();
  };
  assert.ok(box);
  const own = await page.evaluate(({ x, y }) => window.editor.state.model.parts[window.editor.picker.pick(x, y).part].name, { x: middle.x, y: middle.y + 40 });
  await page.fill('.paint input', 'lower');
  await stroke(40);
  await page.fill('.paint input', own);
  await stroke(-20);
  await keepPicture(page, 'strokes');
  await page.click('.paint button.primary');
  await page.waitForFunction((n) => window.editor.state.model.parts.length === n, count + 1);
  assert.ok(await page.evaluate(() => window.editor.state.model.parts.some((part) => part.name === 'lower')));
  await page.waitForFunction(() => window.editor.state.tree?.can_undo);
  await page.keyboard.press('Escape');
  await page.keyboard.press('Control+z');
  await page.waitForFunction((n) => window.editor.state.model.parts.length === n, count);
});

editing('two designs are compared under one camera, and an edit is taken from one into the other', 'table.obj', async (page) => {
  await suggestionsOf(page);
  await page.locator('.card').first().click();
  await page.waitForFunction(() => window.editor.state.tree.current === 1);
  const wanted = await page.evaluate(() => Array.from(window.editor.viewer.design));
  await page.keyboard.press('Control+z');
  await page.waitForFunction(() => window.editor.state.tree.current === 0);
  await page.click('#cameras button:has-text("Compare")');
  await page.selectOption('#compare select', '1');
  await page.waitForFunction(() => window.editor.viewer.stages.length === 2 && window.editor.viewer.stages[1].changed);
  assert.deepEqual(await page.evaluate(() => Array.from(window.editor.viewer.stages[1].surface.vertices)), wanted);
  await page.evaluate(() => window.editor.viewer.turn(0.2, 0.1));
  await keepPicture(page, 'compare');
  await page.click('#compare button:has-text("Take")');
  await page.waitForFunction(() => window.editor.state.tree.nodes.length === 3);
  assert.deepEqual(await page.evaluate(() => Array.from(window.editor.viewer.design)), wanted);
  await page.keyboard.press('x');
  await page.waitForFunction(() => window.editor.viewer.stages.length === 1);
});

editing('a direction is dragged over the map, and snaps to the best one', 'chair.obj', async (page) => {
  await page.click('#direction');
  await page.waitForFunction(() => window.editor.directions.map);
  const map = await page.evaluate(() => window.editor.directions.map);
  assert.ok(map.samples.length > 500);
  for (const sample of map.samples) assert.ok(map.best.stackability >= sample[3] - 1e-9);
  await keepPicture(page, 'direction_map');
  // From the mark, which is at z in the middle, to a place near the best direction.
  const box = await page.locator('#direction-map canvas').boundingBox();
  const [x, y, z] = map.best.direction.map((c) => (map.best.direction[2] < 0 ? -c : c)), angle = Math.acos(z / Math.hypot(x, y, z)), far = Math.hypot(x, y) || 1;
  const r = (angle / (Math.PI / 2)) * (box.width / 2) * (98 / 108), at = { x: box.x + box.width / 2 + (r * x) / far + 2, y: box.y + box.height / 2 - (r * y) / far };
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await page.mouse.down();
  await page.mouse.move(at.x, at.y, { steps: 5 });
  await page.mouse.up();
  await page.waitForFunction(() => window.editor.state.tree.nodes.length === 2);
  assert.ok(Math.abs((await stackability(page)) - map.best.stackability) < 1e-9, 'the best direction exactly');
  await page.keyboard.press('Control+z');
  await page.waitForFunction(() => window.editor.state.tree.current === 0);
});

editing('a mesh file that is dropped is opened, and written beside the first one', 'small_cup.obj', async (page, editor, folder) => {
  const bytes = fs.readFileSync(path.join(models, 'table.obj'), 'utf8');
  const drop = (name, text) => page.evaluate(({ name, text }) => {
    const files = new DataTransfer();
    files.items.add(new File([text], name));
    document.dispatchEvent(new DragEvent('drop', { dataTransfer: files, bubbles: true, cancelable: true }));
  }, { name, text });
  await drop('my table.obj', bytes);
  await page.waitForFunction(() => window.editor.state.model.name === 'my table.obj' && window.editor.state.design);
  assert.equal(await page.evaluate(() => window.editor.state.model.parts.length), 12);
  assert.equal(fs.readFileSync(path.join(folder.path, 'my table.obj'), 'utf8'), bytes);
  assert.ok(fs.existsSync(path.join(folder.path, 'my table.obj.session.json')));
  for (const [name, text, words] of [['bad.obj', 'v 1 2\n', /bad\.obj/], ['small_cup.obj', bytes, /another file/], ['x.exe', bytes, /x\.exe/], ['empty.obj', '', /empty\.obj/]]) {
    await drop(name, text);
    await page.waitForFunction((source) => new RegExp(source).test(document.getElementById('hint').textContent), words.source);
    assert.equal(await page.evaluate(() => window.editor.state.model.name), 'my table.obj');
  }
  page.failures.length = 0; // the refused files, which a browser reports too
});

test('without a model the page asks for a mesh file', { timeout: seconds(300) }, async () => {
  const folder = new Folder('small_cup.obj');
  const editor = await Editor.start({ model: null }, [], folder.path);
  try {
    const page = await browser.newPage(), failures = [];
    page.on('pageerror', (error) => failures.push(String(error)));
    await page.goto(editor.address);
    await page.waitForFunction(() => window.editor?.state.empty);
    assert.match(await page.textContent('#veil-text'), /Drop a mesh file/);
    for (const id of ['#undo', '#export', '#tabs', '#target']) assert.equal(await page.isVisible(id), false, id);
    await keepPicture(page, 'no_model');
    await page.setInputFiles('#open-file', { name: 'none.obj', mimeType: '', buffer: Buffer.from('v 0 0 0\n') });
    await page.waitForFunction(() => /no faces/.test(document.getElementById('hint').textContent));
    assert.equal(await page.isVisible('#veil'), true, 'it still asks');
    await page.evaluate(() => window.editor.send({ do: 'undo' }));
    await page.waitForFunction(() => /open a mesh file first/.test(document.getElementById('hint').textContent));
    const file = { name: 'dropped.obj', mimeType: '', buffer: fs.readFileSync(folder.model) };
    await page.setInputFiles('#open-file', file);
    await page.waitForFunction(() => window.editor.state.design && window.editor.viewer.framesDrawn > 0);
    assert.equal(await page.isVisible('#veil'), false);
    assert.equal(await page.isVisible('#export'), true);
    assert.equal(await page.textContent('#title'), 'dropped.obj');
    assert.deepEqual(fs.readFileSync(path.join(folder.path, 'dropped.obj')), file.buffer);
    assert.deepEqual(failures, []);
    await page.close();
    assert.equal(await editor.ended, 0);
    await assert.rejects(Editor.start({ model: null }, ['--target', '0.5'], folder.path), /--target needs MODEL/);
  } finally {
    await editor.kill();
    folder.remove();
  }
});

editing('a part is left out, two parts are joined, and undo brings both back', 'table.obj', async (page) => {
  const parts = await page.evaluate(() => window.editor.state.model.parts.map((part) => part.name));
  await pick(page, 'middle_bar');
  await page.click('button:has-text("Leave this part out")');
  await page.waitForFunction((n) => window.editor.state.model.parts.length === n, parts.length - 1);
  await page.keyboard.press('Control+z');
  await page.waitForFunction((n) => window.editor.state.model.parts.length === n, parts.length);
  await pick(page, 'middle_bar');
  const joints = await page.evaluate(() => window.editor.state.model.joints.length);
  await page.locator('.joints .tag').first().click();
  await page.waitForFunction((n) => window.editor.state.model.joints.length < n, joints);
  await pick(page, 'middle_bar');
  const other = await page.evaluate(() => {
    const { model } = window.editor.state, bar = model.parts.findIndex((part) => part.name === 'middle_bar');
    const joined = new Set(model.joints.filter((joint) => joint.parts.includes(bar)).flatMap((joint) => joint.parts));
    return model.parts.findIndex((part, row) => /side_bar/.test(part.name) && !joined.has(row));
  });
  await page.selectOption('select[aria-label="Join to another part"]', String(other));
  await page.waitForFunction((n) => window.editor.state.model.joints.length === n, joints);
});

editing('two parts that were let go from each other are made symmetric again', 'table.obj', async (page) => {
  const pairs = () => page.evaluate(() => window.editor.state.model.pairs.filter(({ parts }) => parts.length === 2).length);
  const before = await pairs();
  const [one, other] = await page.evaluate(() => {
    const { model } = window.editor.state;
    return model.pairs.find(({ parts }) => parts.length === 2).parts.map((row) => model.parts[row].name);
  });
  await pick(page, one);
  await page.click(`button[aria-label="Let it change on its own: ${other}"]`);
  await page.waitForFunction((n) => window.editor.state.model.pairs.filter(({ parts }) => parts.length === 2).length < n, before);
  await pick(page, one);
  await page.selectOption('select[aria-label="Make symmetric to another part"]', { label: other });
  await page.waitForFunction((n) => window.editor.state.model.pairs.filter(({ parts }) => parts.length === 2).length === n, before);
});

test('the program ends when the last page leaves', { timeout: seconds(300) }, async () => {
  const folder = new Folder('small_cup.obj');
  const editor = await Editor.start(folder);
  const page = await openPage(browser, editor);
  await page.close();
  assert.equal(await editor.ended, 0);
  folder.remove();
});

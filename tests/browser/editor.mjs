// Starts `stackabilize edit` on a copy of a model, and pages of a real browser that look at it.
import { spawn } from 'node:child_process';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { chromium } from 'playwright-core';

export const program = process.env.STACKABILIZE ?? '';
export const models = process.env.STACKABILIZATION_MODELS ?? '';
const executablePath = process.env.CHROMIUM ?? '/usr/bin/chromium';
/** Pictures of every test are left there, to be looked at. */
const pictures = process.env.BROWSER_PICTURES ?? '';

/** @param {number} count @returns {number} milliseconds; more where the program is one that sanitizers slow down */
export const seconds = (count) => 1000 * count * Number(process.env.SLOWDOWN ?? 1);
/** A first answer of the program may take long on a machine that does other things too. */
const patience = seconds(120);

/** @returns {string} OBJ file of a tapered cup of few triangles, for what does not depend on the shape */
function fewTriangles(sides = 16, rings = 4) {
  const wall = 0.003, height = 0.099, out = (z) => 0.03 + (0.0125 * z) / height;
  const steps = [...Array(rings + 1).keys()].map((k) => k / rings);
  const profile = [...steps.map((t) => [out(t * height), t * height]),
    ...steps.reverse().map((t) => wall + t * (height - wall)).map((z) => [out(z) - wall, z])];
  const vertices = profile.flatMap(([r, z]) => [...Array(sides).keys()].map((k) => {
    const angle = (2 * Math.PI * k) / sides;
    return [r * Math.cos(angle), r * Math.sin(angle), z];
  }));
  const bottom = vertices.push([0, 0, 0]), floor = vertices.push([0, 0, wall]), faces = [];
  for (let k = 0; k < sides; ++k) {
    const next = (k + 1) % sides, last = (profile.length - 1) * sides;
    for (let row = 0; row < last; row += sides) {
      const [a, b, c, d] = [row + k, row + next, row + sides + next, row + sides + k].map((v) => v + 1);
      faces.push([a, b, c], [a, c, d]);
    }
    faces.push([bottom, next + 1, k + 1], [floor, last + k + 1, last + next + 1]);
  }
  return ['g body', ...vertices.map((v) => 'v ' + v.join(' ')), ...faces.map((f) => 'f ' + f.join(' ')), ''].join('\n');
}

/** A folder of its own, with a copy of a model; "small_cup.obj" is a cup of few triangles. */
export class Folder {
  /** @param {string} model */
  constructor(model) {
    this.path = fs.mkdtempSync(path.join(os.tmpdir(), 'stackabilize-'));
    this.model = path.join(this.path, model);
    if (model === 'small_cup.obj') fs.writeFileSync(this.model, fewTriangles());
    else fs.copyFileSync(path.join(models, model), this.model);
  }
  get session() { return this.model + '.session.json'; }
  /** @returns {Record<string, string>} all files, by their names */
  contents() {
    return Object.fromEntries(fs.readdirSync(this.path).sort().map((name) => [name, fs.readFileSync(path.join(this.path, name), 'latin1')]));
  }
  remove() { fs.rmSync(this.path, { recursive: true, force: true }); }
}

/** A running editor. */
export class Editor {
  /** @param {{model: string | null}} folder @param {string[]} [more] @param {string} [cwd]  where it runs */
  static async start(folder, more = [], cwd = undefined) {
    const editor = new Editor();
    editor.process = spawn(program, ['edit', ...(folder.model ? [folder.model] : []), '--no-browser', ...more], { cwd, stdio: ['ignore', 'pipe', 'pipe'] });
    editor.ended = new Promise((resolve) => editor.process.on('exit', (status, signal) => resolve(signal ?? status)));
    editor.errors = '';
    editor.process.stderr.on('data', (data) => (editor.errors += data));
    editor.address = await new Promise((resolve, reject) => {
      editor.process.stdout.once('data', (data) => resolve(String(data).trim()));
      editor.process.once('exit', () => reject(new Error(editor.errors)));
    });
    return editor;
  }
  /** @param {NodeJS.Signals} [signal] */
  async kill(signal = 'SIGKILL') {
    this.process.kill(signal);
    return this.ended;
  }
}

export const openBrowser = () =>
  chromium.launch({ executablePath, args: ['--use-angle=swiftshader', '--enable-unsafe-swiftshader'] });

/** A page of the editor that has shown the object, with what went wrong in it. */
export async function openPage(browser, editor, size = { width: 1280, height: 800 }) {
  const page = await browser.newPage({ viewport: size });
  page.setDefaultTimeout(patience);
  page.failures = [];
  page.on('pageerror', (error) => page.failures.push(String(error)));
  page.on('console', (message) => message.type() === 'error' && page.failures.push(message.text()));
  await page.goto(editor.address);
  await page.waitForFunction(() => window.editor?.state.design && window.editor.viewer.framesDrawn > 0);
  return page;
}

/** Waits until all suggestions for the current design are there. */
export const suggestionsOf = async (page) => {
  await page.waitForFunction(() => window.editor.state.suggestions.complete);
  return page.evaluate(() => window.editor.state.suggestions.list);
};

export const stackability = (page) => page.evaluate(() => window.editor.state.design.measured.stackability);

/** What the canvas shows: share of the most frequent colour, number of colours; and whether WebGL lives. */
export const canvasFacts = (page) =>
  page.evaluate(async () => {
    const { viewer } = window.editor;
    const bitmap = await createImageBitmap(await viewer.picture());
    const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
    const context = canvas.getContext('2d');
    context.drawImage(bitmap, 0, 0);
    const { data } = context.getImageData(0, 0, canvas.width, canvas.height);
    const counts = new Map();
    for (let k = 0; k < data.length; k += 4) {
      const colour = (data[k] << 16) | (data[k + 1] << 8) | data[k + 2];
      counts.set(colour, (counts.get(colour) ?? 0) + 1);
    }
    return { lost: viewer.renderer.getContext().isContextLost(), colours: counts.size, flat: Math.max(...counts.values()) / (data.length / 4) };
  });

/** @param {string} name */
export async function keepPicture(page, name) {
  if (!pictures) return;
  fs.mkdirSync(pictures, { recursive: true });
  await page.waitForFunction(() => !(window.editor ?? window.reportView)?.viewer?.sketched);
  await page.screenshot({ path: path.join(pictures, name + '.png') });
}

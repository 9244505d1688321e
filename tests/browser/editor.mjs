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

/** A folder of its own, with a copy of a model. */
export class Folder {
  /** @param {string} model */
  constructor(model) {
    this.path = fs.mkdtempSync(path.join(os.tmpdir(), 'stackabilize-'));
    this.model = path.join(this.path, model);
    fs.copyFileSync(path.join(models, model), this.model);
  }
  get session() { return this.model + '.session.json'; }
  remove() { fs.rmSync(this.path, { recursive: true, force: true }); }
}

/** A running editor. */
export class Editor {
  /** @param {Folder} folder @param {string[]} [more] */
  static async start(folder, more = []) {
    const editor = new Editor();
    editor.process = spawn(program, ['edit', folder.model, '--no-browser', ...more], { stdio: ['ignore', 'pipe', 'pipe'] });
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
  await page.screenshot({ path: path.join(pictures, name + '.png') });
}

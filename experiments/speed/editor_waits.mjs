#!/usr/bin/env node
// How long does a person wait for the program behind the editor?
//
// Starts `stackabilize edit` on a copy of each model and prints one row per model: seconds from its start to the first
// design, from there to the first suggestion and to all of them, and the median and largest milliseconds of a step of a
// drag, from the command to the message that follows the new vertices. Steps move one part after the other by up to a
// thousandth of the diagonal. Needs Node.js alone.
//
// usage: editor_waits.mjs PROGRAM MODEL...
import { spawn } from 'node:child_process';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { WebSocket } from '../../tests/browser/websocket.mjs';

const stepsOfDrag = 60;
const columns = ['model', 'triangles', 'open_s', 'first_suggestion_s', 'all_suggestions_s', 'drag_ms', 'largest_drag_ms'];

const since = (/** @type {number} */ begin) => performance.now() - begin;
const rounded = (/** @type {number} */ value) => Number(value.toPrecision(3));

/** A part that is moved a little, as a command says it. @param {any} model @param {number} step */
function editOf(model, step) {
  const part = model.parts[step % model.parts.length], by = (model.diagonal * (1 + (step % 7))) / 7000;
  return `${part.text} move ${step % 2 ? `${by} 0 0` : `0 ${by} 0`}`;
}

/** @param {string} program @param {string} file */
async function waits(program, file) {
  const begin = performance.now();
  const editor = spawn(program, ['edit', file, '--no-browser'], { stdio: ['ignore', 'pipe', 'inherit'] });
  try {
    const address = await new Promise((resolve, reject) => {
      editor.stdout.once('data', (data) => resolve(new URL(String(data).trim())));
      editor.once('exit', () => reject(new Error(`${program} ended`)));
    });
    const page = await WebSocket.open(address), next = (/** @type {(message: any) => boolean} */ wanted) => page.next(wanted);
    const model = await next(({ type }) => type === 'model');
    await next(({ type }) => type === 'design');
    const open = since(begin), opened = performance.now();
    await next((message) => message.type === 'suggestions' && (message.list.length > 0 || message.complete));
    const first = since(opened);
    await next((message) => message.type === 'suggestions' && message.complete);
    const all = since(opened), drags = [];
    for (let step = 0; step < stepsOfDrag; ++step) {
      const asked = performance.now();
      page.send(JSON.stringify({ do: 'drag', edit: editOf(model, step) }));
      await next((message) => message.type === 'design' && message.dragging);
      drags.push(since(asked));
    }
    page.close();
    drags.sort((a, b) => a - b);
    return [open / 1000, first / 1000, all / 1000, drags[Math.floor(drags.length / 2)], drags[drags.length - 1]].map(rounded);
  } finally {
    editor.kill();
  }
}

const [program, ...models] = process.argv.slice(2);
if (!program || models.length === 0) {
  console.error('usage: editor_waits.mjs PROGRAM MODEL...');
  process.exit(2);
}
const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'stackabilize-'));
try {
  console.log(columns.join(','));
  for (const model of models) {
    const copy = path.join(folder, path.basename(model));
    fs.copyFileSync(model, copy);
    const triangles = fs.readFileSync(copy, 'latin1').split('\n').filter((line) => line.startsWith('f ')).length;
    console.log([path.basename(model), triangles, ...(await waits(path.resolve(program), copy))].join(','));
  }
} finally {
  fs.rmSync(folder, { recursive: true });
}

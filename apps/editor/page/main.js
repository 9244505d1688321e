// The page: what the program tells goes into the view and the panels; what a person does becomes commands.
import { Connection, envelopesOf, frameKind, meshOf, verticesOf } from './connection.js';
import { length } from './format.js';
import { gapColour, largestDistance } from './viewer/gap_surface.js';
import { Viewer } from './viewer/viewer.js';
import { Picker } from './picker.js';
import { Measures } from './measures.js';
import { Gallery } from './gallery.js';
import { Tree } from './tree.js';
import { element } from './dom.js';
import { bindKeys } from './keys.js';
import { bindTabs, openTab } from './tabs.js';
import { Automatic } from './automatic.js';
import { Gizmo, PickedHandle } from './handles.js';
import { Parts } from './parts.js';
import { Quality } from './quality.js';
import { Strokes } from './strokes.js';
import { showRange } from './range_card.js';
import { DirectionMap } from './direction_map.js';
import { Compare } from './compare.js';
import { bindDrop } from './drop.js';
import { Study } from './study.js';

const canvas = /** @type {HTMLCanvasElement} */ (element('view'));
const viewer = new Viewer(canvas), picker = new Picker(viewer);

/** What the program has told. @type {Record<string, any>} */
const state = { model: null, design: null, review: null, tree: null, wishes: null, suggestions: { list: [] }, found: { list: [] }, writes: false, empty: false };
const askForFile = 'Drop a mesh file onto this page, or choose one with Open.';
/** @type {Float32Array | null} */
let shown = null;
/** What is shown instead while the mouse is over it. @type {Float32Array | null} */
let preview = null;

const connection = new Connection({ message: receive, frame: receiveFrame, open: opened, gaveUp });
element('again').addEventListener('click', () => connection.retry());
const send = (/** @type {object} */ command) => connection.send(command);

/** @param {{vertices: Float32Array, f_max: number, stackability: number, direction?: number[]}} design  along the current direction where it has none */
function startPreview({ vertices, f_max: step, stackability, direction }) {
  if (preview === vertices) return;
  preview = vertices;
  viewer.main.setBefore(shown);
  viewer.main.setDirection(direction ?? state.design.direction);
  viewer.main.show(vertices, step, true);
  measures.preview(stackability, step);
}

function endPreview() {
  if (!preview || !shown) return;
  preview = null;
  viewer.main.setBefore(null);
  if (state.design) viewer.main.setDirection(state.design.direction);
  viewer.main.show(shown, state.design?.measured.f_max ?? 0, true);
  measures.preview(null, null);
}

const measures = new Measures(send);
const gallery = new Gallery(viewer, {
  preview: startPreview,
  leave: endPreview,
  apply: (number) => { endPreview(); send({ do: 'apply', number }); },
  accept: (number) => { endPreview(); send({ do: 'accept-advice', number }); },
});
const tree = new Tree(viewer, {
  go: (node) => { endPreview(); send({ do: 'roll-back', node }); },
  picture: (node) => send({ do: 'picture', node }),
  preview: startPreview,
  leave: endPreview,
});

const automatic = new Automatic(viewer, {
  send,
  leave: endPreview,
  preview: startPreview,
});
const quality = new Quality(send);
const compare = new Compare(viewer, tree, send);
const study = new Study(send);
bindDrop({
  busy: (words) => { element('veil').hidden = !words && !state.empty; element('veil-text').textContent = words || askForFile; },
  failed: (words) => hint(words, true),
});

/** Extent of vertices along a direction. @param {Float32Array} vertices @param {number[]} d */
function extentAlong(vertices, d) {
  let low = Infinity, high = -Infinity;
  for (let v = 0; v < vertices.length; v += 3) {
    const at = vertices[v] * d[0] + vertices[v + 1] * d[1] + vertices[v + 2] * d[2];
    low = Math.min(low, at);
    high = Math.max(high, at);
  }
  return high - low;
}

const directions = new DirectionMap({
  wanted: () => send({ do: 'map' }),
  look: (direction, overHeight) => {
    if (!shown) return;
    viewer.main.setDirection(direction);
    viewer.main.show(shown, overHeight * extentAlong(shown, direction));
  },
  leave: () => showDesign(),
  take: (direction) => send({ do: 'direction', direction }),
});
element('direction').addEventListener('click', () => directions.show(!directions.open));

const gizmo = new Gizmo(viewer, {
  begin: (edit) => { endPreview(); send({ do: 'range', edit }); },
  drag: (edit) => send({ do: 'drag', edit }),
  end: (keep) => { send({ do: 'end-drag', keep }); showRange(null, null); },
});
const parts = new Parts(gizmo, send, () => viewer.main.select(parts.part < 0 ? [] : [parts.part]));

const strokes = new Strokes(viewer, picker, send);

/** Where a drag is on its axis, as ranges have it. */
function dragShare() {
  const { active } = gizmo;
  return active ? PickedHandle.share(gizmo.tool, active.amount, viewer.diagonal) : null;
}

// A click that turns nothing picks.
let pressed = { x: 0, y: 0 };
canvas.addEventListener('pointerdown', (event) => (pressed = { x: event.clientX, y: event.clientY }));
canvas.addEventListener('click', (event) => {
  const dragged = gizmo.dragged;
  gizmo.dragged = false;
  if (dragged || gizmo.active || strokes.active || !study.byHand || Math.hypot(event.clientX - pressed.x, event.clientY - pressed.y) > 4) return;
  const hit = picker.pick(event.clientX, event.clientY);
  parts.pick(hit ? hit.part : -1, hit?.point ?? null);
  if (hit) openTab('parts');
});

/** Says that the program is away. @param {string} words  what comes of it */
function sayAway(words) {
  const saved = state.tree?.saved ? ' What you did is saved.' : '';
  element('veil-text').textContent = `The program has ended, or cannot be reached.${saved} ${words}`;
}

/** @param {boolean} open */
function opened(open) {
  element('veil').hidden = open;
  element('again').hidden = true;
  if (!open) sayAway('Trying to reach it …');
}

function gaveUp() {
  element('again').hidden = false;
  sayAway('');
}

element('write').addEventListener('click', () => {
  send({ do: 'write' });
  canvas.focus();
});

/** A sentence under the object. @param {string} text @param {boolean} [bad] */
function hint(text, bad = false) {
  const line = element('hint');
  line.textContent = text;
  line.classList.toggle('bad', bad);
  clearTimeout(hintEnd);
  if (text) hintEnd = setTimeout(() => (line.textContent = ''), 6000);
}
let hintEnd = 0;

function showDesign() {
  if (!shown || !state.design || preview) return;
  const { design } = state;
  viewer.main.setDirection(design.direction);
  viewer.main.setChanged(design.change > 1e-9);
  // Few copies where they stand far apart, more where they nest.
  viewer.main.setCopies(Math.max(1, Math.min(4, Math.round(1 / Math.max(1 - design.measured.stackability, 0.01)))), 1);
  viewer.main.show(shown, design.measured.f_max, seen && !design.dragging);
  seen = true;
}
let seen = false;

/** @param {any} message */
function receive(message) {
  switch (message.type) {
    case 'empty':
      state.empty = true;
      document.body.classList.add('empty');
      element('veil').hidden = false;
      element('veil-text').textContent = askForFile;
      break;
    case 'model':
      if (state.empty) element('veil').hidden = true;
      state.empty = false;
      document.body.classList.remove('empty');
      state.model = message;
      element('title').textContent = message.name;
      document.title = message.name + ' – Stackabilization';
      measures.setModel(message);
      viewer.diagonal = message.diagonal;
      parts.pick(-1, null);
      parts.setModel(message);
      strokes.setNames(message.parts.map((/** @type {any} */ part) => part.name));
      strokes.set(false);
      state.design = null;
      compare.show(false);
      directions.set({ ready: false });
      shown = null;
      seen = false;
      tree.clear();
      quality.setModel(message);
      exportList(message.stem);
      if (message.resumed) hint('Going on from where you left off.');
      break;
    case 'role':
      state.writes = message.writes;
      element('role-words').textContent = message.writes ? '' : 'Another page is editing; this one looks on.';
      element('write').hidden = message.writes;
      document.body.classList.toggle('reader', !message.writes);
      break;
    case 'design': {
      const first = !state.design;
      state.design = message;
      showDesign();
      showEnvelopes(null);
      wantEnvelopes();
      if (message.primitives) {
        viewer.main.setPrimitives(message.primitives);
        parts.setPrimitives(message.primitives);
      }
      gizmo.follow(message.dragged ?? '');
      if (gizmo.active && state.range) showRange(state.range, dragShare());
      quality.setChecks(message.checks);
      measures.setDesign(message);
      directions.setDirection(message.direction);
      if (first) { viewer.main.setRelations(state.model.joints.flatMap((/** @type {any} */ j) => j.points), state.model.symmetries); viewer.fit(); }
      break;
    }
    case 'review':
      state.review = message;
      measures.setReview(message);
      if (message.ready) quality.setChecks(message.checks);
      if (!message.ready) viewer.main.setContacts(new Float32Array(), []);
      else viewer.main.setContacts(contactCorners, message.contacts.filter((/** @type {any} */ c) => c.type === 'dot').map((/** @type {any} */ c) => c.centre));
      break;
    case 'tree':
      state.tree = message;
      tree.set(message);
      compare.follow();
      /** @type {HTMLButtonElement} */ (element('undo')).disabled = !message.can_undo;
      /** @type {HTMLButtonElement} */ (element('redo')).disabled = !message.can_redo;
      break;
    case 'node':
      tree.setStep(message.node, message.f_max);
      break;
    case 'wishes':
      state.wishes = message;
      measures.setWishes(message);
      quality.setWishes(message);
      automatic.setWishes(message);
      parts.setKept(message.kept);
      break;
    case 'suggestions':
      state.suggestions = message;
      gallery.set(message);
      break;
    case 'progress':
      (message.work === 'suggestions' ? gallery : automatic).progress(message.fraction);
      break;
    case 'map':
      directions.set(message);
      break;
    case 'study':
      study.set(message);
      break;
    case 'found':
      state.found = message;
      automatic.set(message);
      break;
    case 'range':
      state.range = message.edit ? message : null;
      if (!gizmo.active) break;
      gizmo.setRange(state.range);
      showRange(state.range, dragShare());
      break;
    case 'refusal':
      hint(message.words, true);
      break;
    case 'error':
      if (state.wishes) measures.setWishes(state.wishes);
      hint(message.words, true);
      study.fail(message.words);
      break;
  }
}

let contactCorners = new Float32Array();

/** @param {import('./connection.js').Frame} frame */
function receiveFrame(frame) {
  switch (frame.kind) {
    case frameKind.mesh:
      viewer.setMesh(meshOf(frame));
      break;
    case frameKind.shown:
      shown = viewer.design = verticesOf(frame);
      break;
    case frameKind.suggestion:
      gallery.setVertices(frame.number, frame.stamp, verticesOf(frame));
      break;
    case frameKind.node:
      tree.setVertices(frame.number, verticesOf(frame));
      compare.follow();
      break;
    case frameKind.found:
      automatic.setVertices(frame.number, verticesOf(frame));
      break;
    case frameKind.envelopes:
      showEnvelopes({ ...envelopesOf(frame), f_max: state.design.measured.f_max });
      break;
    case frameKind.contacts:
      contactCorners = new Float32Array(frame.buffer, 16, 9 * frame.count);
      break;
  }
}

/** @param {string} stem */
function exportList(stem) {
  const list = element('export-list');
  list.replaceChildren();
  for (const [ending, words] of [['obj', 'Mesh with parts'], ['3mf', 'Mesh for printing'], ['glb', 'Mesh for viewers'], ['stl', 'Triangles only'], ['stackabilize.json', 'Project with all designs'], ['html', 'Report with a 3-D view']]) {
    const link = document.createElement('a');
    link.href = 'export/' + ending;
    link.download = stem + '.' + ending;
    link.textContent = `${words} (.${ending})`;
    link.addEventListener('click', () => element('export').removeAttribute('open'));
    list.append(link);
    if (ending === 'html')
      link.addEventListener('click', () => (link.href = `export/html?copies=${measures.copies}`));
  }
  const picture = document.createElement('button');
  picture.textContent = 'Picture of the view (.png)';
  picture.addEventListener('click', async () => {
    const blob = await viewer.picture();
    if (!blob) return;
    const link = document.createElement('a');
    link.href = URL.createObjectURL(blob);
    link.download = stem + '.png';
    link.click();
    URL.revokeObjectURL(link.href);
    element('export').removeAttribute('open');
  });
  list.append(picture);
}

/** Shows how near the copy above comes, or nothing of it. @param {import('./viewer/gap_surface.js').Envelopes | null} envelopes */
function showEnvelopes(envelopes) {
  viewer.main.setEnvelopes(envelopes);
  const shown = viewer.main.layers.gap && envelopes !== null;
  element('gap-legend').hidden = !shown;
  if (!shown) return;
  element('gap-most').textContent = length(largestDistance(envelopes), state.model.unit) + ' apart';
  const colours = [0, 0.1, 0.3, 0.6, 1].map((share) => `#${gapColour(share, viewer.palette).getHexString()} ${100 * share}%`);
  /** @type {HTMLElement} */ (element('gap-legend').querySelector('i')).style.background = `linear-gradient(to right, ${colours.join(', ')})`;
}

/** Asks for the envelopes of the design where they are wanted and not here. */
function wantEnvelopes() {
  const { envelopes, layers: { gap } } = viewer.main;
  if (gap && !envelopes && state.writes && !state.design?.dragging) send({ do: 'envelopes' });
  else showEnvelopes(envelopes);
}

/** What can be shown, with its key. */
const layers = /** @type {const} */ ([
  ['ghosts', 'Copies', 'g'], ['contacts', 'Contacts', 'c'], ['before', 'At rest', 'r'], ['parts', 'Parts', 'p'],
  ['primitives', 'Primitives', 'b'], ['joints', 'Joints', 'j'], ['symmetry', 'Symmetry', 'y'], ['gap', 'Gap', 'h'],
]);
/** @type {Record<string, () => void>} */
const toggles = {};
for (const [layer, words, key] of layers) {
  const button = document.createElement('button');
  button.textContent = words;
  button.title = `${words} (${key.toUpperCase()})`;
  const mark = () => button.setAttribute('aria-pressed', String(viewer.main.layers[layer]));
  toggles[key] = () => {
    viewer.main.setLayers({ [layer]: !viewer.main.layers[layer] });
    if (layer === 'before') viewer.main.setBefore(null);
    if (layer === 'gap') wantEnvelopes();
    mark();
  };
  button.addEventListener('click', toggles[key]);
  mark();
  element('layers').append(button);
}

/** @type {[string, string, number[]][]} */
const cameras = [['Fit', 'f', [1.6, -2.4, 1.15]], ['Front', '1', [0, -1, 0.001]], ['Side', '2', [1, 0, 0.001]], ['Top', '3', [0, -0.001, 1]]];
for (const [words, key, from] of cameras) {
  const button = document.createElement('button');
  button.textContent = words;
  button.title = `${words} (${key.toUpperCase()})`;
  toggles[key] = () => viewer.fit(from);
  button.addEventListener('click', toggles[key]);
  element('cameras').append(button);
}

const undo = () => send({ do: 'undo' }), redo = () => send({ do: 'redo' });
element('undo').addEventListener('click', undo);
element('redo').addEventListener('click', redo);

const comparing = document.createElement('button');
comparing.textContent = 'Compare';
comparing.title = 'Compare two designs side by side (X)';
comparing.setAttribute('aria-pressed', 'false');
toggles.x = () => compare.show(!compare.open);
toggles.v = () => { if (study.free) directions.show(!directions.open); };
comparing.addEventListener('click', toggles.x);
compare.changed = (/** @type {boolean} */ open) => comparing.setAttribute('aria-pressed', String(open));
element('cameras').append(comparing);

let dark = matchMedia('(prefers-color-scheme: dark)').matches;
function setTheme() {
  document.documentElement.dataset.theme = dark ? 'dark' : 'light';
  element('theme').textContent = dark ? 'Light' : 'Dark';
  viewer.setTheme(dark);
  gallery.paint();
  automatic.paint();
  tree.paint();
  directions.paint();
  showEnvelopes(viewer.main.envelopes);
}
const toggleTheme = () => { dark = !dark; setTheme(); };
element('theme').addEventListener('click', toggleTheme);
setTheme();

const keysDialog = /** @type {HTMLDialogElement} */ (element('keys'));
element('help').addEventListener('click', () => keysDialog.showModal());
bindTabs(element('tabs'));
bindKeys({
  plain: { ...toggles, d: toggleTheme, '?': () => keysDialog.showModal(),
    k: () => { if (study.free) { openTab('parts'); strokes.set(!strokes.active); } },
    m: () => parts.choose('move'), t: () => parts.choose('rotate'), s: () => parts.choose('scale'),
    Escape: () => { endPreview(); if (strokes.active) strokes.set(false); else if (!gizmo.cancel()) parts.pick(-1, null); } },
  control: { z: undo, y: redo },
  controlShift: { z: redo },
  list: element('keys-list'),
  words: [...layers.map(([, words, key]) => [key, 'Show or hide: ' + words]), ...cameras.map(([words, key]) => [key, 'View: ' + words]),
    ['x', 'Compare two designs'], ['v', 'Choose a direction'], ['Ctrl Z', 'Undo'], ['Ctrl Shift Z', 'Redo'], ['k', 'Paint parts'], ['m', 'Handle: move'], ['t', 'Handle: turn'], ['s', 'Handle: scale'], ['Escape', 'Give up a drag, or let go of the part'], ['d', 'Light or dark'], ['Arrows', 'In the view: turn; in a list: move'], ['+ -', 'In the view: nearer, farther'], ['Enter', 'Apply or go there'], ['?', 'This list']],
});
// For tests: what the page holds and shows.
Object.assign(window, { editor: { viewer, connection, picker, directions, compare, state, send, gizmo, parts, strokes } });

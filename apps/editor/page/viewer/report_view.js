// The 3-D view in the pages of `improve` and of the editor: the object as given beside designs, under one camera.
import * as THREE from 'three';
import { Viewer } from './viewer.js';

/** @typedef {{title: string, stackability: string, step: number, direction: number[], vertices: Float32Array}} ShownDesign */

/** More panes than that are too small. */
const maxPanes = 4;

/**
 * Reads what the program wrote (apps/report/page_view.cpp).
 * @param {ArrayBuffer} buffer
 * @returns {{designs: ShownDesign[], mesh: import('./mesh_surface.js').MeshData}}
 */
export function designsOf(buffer) {
  const length = new DataView(buffer).getUint32(0, true);
  const head = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length)));
  let at = 4 + length;
  const take = (/** @type {number} */ words) => (at += 4 * words) - 4 * words;
  const designs = head.designs.map((/** @type {any} */ design) => ({ ...design, vertices: new Float32Array(buffer, take(3 * head.vertices), 3 * head.vertices) }));
  const triangles = new Uint32Array(buffer, take(3 * head.triangles), 3 * head.triangles);
  const parts = new Uint32Array(buffer, take(head.triangles), head.triangles);
  return { designs, mesh: { vertices: designs[0].vertices, triangles, parts } };
}

/** A ball around designs with their copies. @param {ShownDesign[]} designs @param {number} copies */
function ballAround(designs, copies) {
  const box = new THREE.Box3(), point = new THREE.Vector3();
  for (const { vertices, direction, step } of designs) {
    const along = new THREE.Vector3().fromArray(direction).normalize().multiplyScalar(copies * step);
    for (let v = 0; v < vertices.length; v += 3) box.expandByPoint(point.fromArray(vertices, v)).expandByPoint(point.add(along));
  }
  return box.getBoundingSphere(new THREE.Sphere());
}

/** @param {string} name @param {Record<string, any>} [members] @returns {any} */
const create = (name, members = {}) => Object.assign(document.createElement(name), members);

/** @param {HTMLElement} box  that the view fills  @param {ArrayBuffer} buffer */
export function showDesigns(box, buffer) {
  const { designs, mesh } = designsOf(buffer), [given, ...solutions] = designs;
  const panes = create('div', { className: 'panes' }), labels = create('div', { className: 'labels' }), tools = create('div', { className: 'tools' });
  const canvas = create('canvas', { tabIndex: 0 });
  canvas.setAttribute('aria-label', 'The object as given and its solutions, each with copies above it. Drag to turn, arrow keys turn it, + and - zoom.');
  panes.append(canvas, labels);
  box.append(panes, tools);
  const viewer = new Viewer(canvas);
  viewer.setMesh(mesh);
  const copies = create('input', { type: 'range', min: '0', max: '8', value: '2' });
  let beside = solutions.slice(0, maxPanes - 1), view = /** @type {number[] | undefined} */ (undefined);

  const place = () => {
    const count = Number(copies.value);
    const shown = [given, ...beside];
    while (viewer.stages.length < shown.length) viewer.addStage();
    labels.replaceChildren(...shown.map((design) => create('span', { textContent: `${design.title}, S ${design.stackability}` })));
    shown.forEach((design, k) => {
      const stage = viewer.stages[k];
      stage.setDirection(design.direction);
      stage.setChanged(k > 0);
      stage.setCopies(count, 0);
      stage.show(design.vertices, design.step);
    });
  };
  const fit = () => {
    const ball = ballAround([given, ...beside], Number(copies.value));
    viewer.look(ball.center, 1.02 * ball.radius, view);
  };
  copies.addEventListener('input', () => { place(); fit(); });
  const label = create('label', { textContent: 'Copies on top ' });
  label.append(copies);
  tools.append(label);
  if (solutions.length > maxPanes - 1) {
    const choice = create('select');
    solutions.forEach((design, k) => choice.append(new Option(`${design.title}, S ${design.stackability}`, String(k))));
    choice.addEventListener('change', () => { beside = [solutions[Number(choice.value)]]; place(); });
    beside = [solutions[0]];
    const chosen = create('label', { textContent: 'Beside it ' });
    chosen.append(choice);
    tools.append(chosen);
  }
  for (const [words, from] of /** @type {[string, number[] | undefined][]} */ ([['Fit', undefined], ['Front', [0, -1, 0.001]], ['Side', [1, 0, 0.001]], ['Top', [0, -0.001, 1]]])) {
    const button = create('button', { textContent: words });
    button.addEventListener('click', () => { view = from; fit(); });
    tools.append(button);
  }
  tools.append(create('span', { textContent: 'Drag to turn, scroll to zoom once clicked; one camera for all.' }));
  // A page that is scrolled must not zoom what lies under the mouse.
  viewer.controls.enableZoom = false;
  canvas.addEventListener('pointerdown', () => (viewer.controls.enableZoom = true));
  canvas.addEventListener('pointerleave', () => (viewer.controls.enableZoom = false));
  place();
  viewer.resize();
  fit();
  // For tests: what the page shows.
  Object.assign(window, { reportView: viewer });
}

// Handles of a part that is picked: arrows, rings and cubes, with the freedoms that edits of the program have.
import * as THREE from 'three';
import { exact } from './format.js';
import { empty, release } from './viewer/release.js';

/** @typedef {import('./viewer/primitive_lines.js').Primitive} Primitive */
/** @typedef {'part' | 'face' | 'corner' | 'end'} Element */
/** @typedef {'move' | 'rotate' | 'scale'} Tool */

/**
 * A direction in which a handle is dragged.
 * @typedef {object} Axis
 * @property {string} name  for people
 * @property {THREE.Vector3 | null} direction  null: scaling in all directions
 */

/** What can be done with an element of a primitive. @type {Record<Element, Tool[]>} */
export const toolsOf = { part: ['move', 'rotate', 'scale'], face: ['move', 'rotate', 'scale'], corner: ['move'], end: ['move', 'rotate', 'scale'] };

/** Largest drags, in diagonals, radians and factors. */
const largest = { move: 0.35, rotate: Math.PI / 3, scale: 2 };

/** @param {number[]} p */
const vector = (p) => new THREE.Vector3(p[0], p[1], p[2]);

/** Corners of the faces of a cuboid. @param {number} face */
function cornersOf(face) {
  const bit = 1 << (face >> 1), side = face & 1;
  return [0, 1, 2, 3, 4, 5, 6, 7].filter((corner) => ((corner & bit) !== 0) === (side === 1));
}

/** @param {number[][]} points */
const mean = (points) => points.reduce((sum, p) => sum.add(vector(p)), new THREE.Vector3()).divideScalar(points.length);

/** A handle that was picked: an element of a part. */
export class PickedHandle {
  /**
   * @param {number} part
   * @param {string} text  name of the part as edits have it
   * @param {Primitive} primitive
   * @param {Element} element
   * @param {THREE.Vector3} near  the point that was picked
   */
  constructor(part, text, primitive, element, near) {
    this.part = part;
    this.text = text;
    this.element = element;
    /** Number of the face, the corner or the cross-section; it stays while the part moves. @type {number} */
    this.index = PickedHandle.#nearest(primitive, element, near);
    /** @type {THREE.Vector3} */
    this.centre = new THREE.Vector3();
    /** @type {Axis[]} */
    this.axes = [];
    this.update(primitive);
  }

  /** Elements that a primitive has. @param {Primitive} primitive @returns {Element[]} */
  static elementsOf(primitive) {
    if (primitive.kind === 'cuboid') return ['part', 'face', 'corner'];
    return primitive.closed ? ['part'] : ['part', 'end'];
  }

  /** Centres of the faces of a cuboid. @param {Primitive} primitive */
  static #faces(primitive) {
    return [0, 1, 2, 3, 4, 5].map((face) => mean(cornersOf(face).map((corner) => primitive.points[corner])));
  }

  /** @param {Primitive} primitive @param {Element} element @param {THREE.Vector3} near @returns {number} */
  static #nearest(primitive, element, near) {
    const p = primitive.points;
    if (element === 'part') return -1;
    if (element === 'end') return vector(p[0]).distanceTo(near) < vector(p[p.length - 1]).distanceTo(near) ? 0 : p.length - 1;
    if (element === 'corner') return p.reduce((best, point, k) => (vector(point).distanceTo(near) < vector(p[best]).distanceTo(near) ? k : best), 0);
    // The face on whose side the point lies, measured in half widths of the part.
    const faces = PickedHandle.#faces(primitive), middle = mean(p);
    const sides = faces.map((face) => {
      const out = face.clone().sub(middle);
      return near.clone().sub(middle).dot(out) / (out.lengthSq() || 1);
    });
    return sides.indexOf(Math.max(...sides));
  }

  /** Follows an edit. @param {Primitive} primitive */
  update(primitive) {
    const p = primitive.points;
    this.centre = mean(p);
    if (primitive.kind === 'cuboid') {
      const faces = PickedHandle.#faces(primitive);
      const axes = [0, 1, 2].map((a) => faces[2 * a + 1].clone().sub(faces[2 * a]).normalize());
      if (this.element === 'face') {
        const normal = this.index >> 1;
        this.centre = faces[this.index];
        this.axes = [{ name: 'out of the face', direction: axes[normal].clone().multiplyScalar(this.index & 1 ? 1 : -1) },
          ...[0, 1, 2].filter((a) => a !== normal).map((a, k) => ({ name: k ? 'across, second' : 'across, first', direction: axes[a] }))];
        return;
      }
      if (this.element === 'corner') this.centre = vector(p[this.index]);
      this.axes = axes.map((direction, k) => ({ name: ['first side', 'second side', 'third side'][k], direction }));
      return;
    }
    const last = p.length - 1;
    let along = vector(p[last]).sub(vector(p[0]));
    if (primitive.closed || along.length() < 1e-9) along = new THREE.Vector3(0, 0, 1);
    if (this.element === 'end') {
      this.centre = vector(p[this.index]);
      along = this.index === 0 ? vector(p[0]).sub(vector(p[1])) : vector(p[last]).sub(vector(p[last - 1]));
    }
    along.normalize();
    // The two directions across: those of the file where the part stands, else one of them level.
    const across = Math.abs(along.z) < 0.9 ? new THREE.Vector3(0, 0, 1).cross(along) : new THREE.Vector3(1, 0, 0).addScaledVector(along, -along.x);
    across.normalize();
    this.axes = [{ name: 'along', direction: along }, { name: 'across, first', direction: across },
      { name: 'across, second', direction: new THREE.Vector3().crossVectors(along, across).normalize() }];
  }

  /** Axes of a tool. @param {Tool} tool @returns {Axis[]} */
  axesOf(tool) {
    const { axes } = this;
    if (tool === 'scale') return this.element === 'part' ? [...axes, { name: 'all sizes', direction: null }] : [{ name: this.element === 'end' ? 'width' : 'size of the face', direction: null }];
    return axes;
  }

  /** The handle as edits have it. */
  get words() {
    if (this.element === 'part') return this.text;
    return `${this.text}/${this.element === 'end' ? 'section' : this.element}=${this.index}`;
  }

  /**
   * The edit of a drag.
   * @param {Tool} tool
   * @param {Axis} axis
   * @param {number} amount  length, angle in radians, or factor
   */
  edit(tool, axis, amount) {
    const linearly = this.element === 'end' && tool !== 'rotate' ? ' linearly' : '';
    const direction = axis.direction ? axis.direction.toArray() : [];
    if (tool === 'move') return `${this.words} move ${direction.map((x) => exact(x * amount)).join(' ')}${linearly}`;
    if (tool === 'rotate') return `${this.words} rotate ${exact((amount * 180) / Math.PI)} about ${direction.map(exact).join(' ')}`;
    return `${this.words} scale ${exact(amount)}${axis.direction ? ' along ' + direction.map(exact).join(' ') : ''}${linearly}`;
  }

  /** The amount of an edit that the program made of a drag. @param {string} text @param {Tool} tool @param {Axis} axis */
  amountOf(text, tool, axis) {
    const numbers = (text.slice(this.words.length).match(/-?\d[\d.e+-]*/g) ?? []).map(Number);
    if (tool === 'move') return axis.direction ? axis.direction.dot(new THREE.Vector3(numbers[0], numbers[1], numbers[2])) : 0;
    return tool === 'rotate' ? (numbers[0] * Math.PI) / 180 : numbers[0];
  }

  /** The largest amount of a drag. @param {Tool} tool @param {number} diagonal */
  static largestAmount(tool, diagonal) {
    return tool === 'move' ? largest.move * diagonal : largest[tool];
  }

  /** Share of the largest drag, as ranges have it. @param {Tool} tool @param {number} amount @param {number} diagonal */
  static share(tool, amount, diagonal) {
    return tool === 'scale' ? Math.log(amount) / Math.log(largest.scale) : amount / PickedHandle.largestAmount(tool, diagonal);
  }

  /** @param {Tool} tool @param {number} share @param {number} diagonal */
  static amountOfShare(tool, share, diagonal) {
    return tool === 'scale' ? largest.scale ** share : share * PickedHandle.largestAmount(tool, diagonal);
  }
}

/** Draws the handles, and turns the mouse into drags. */
export class Gizmo {
  /**
   * @param {import('./viewer/viewer.js').Viewer} viewer
   * @param {{begin: (edit: string) => void, drag: (edit: string) => void, end: (keep: boolean) => void}} actions
   */
  constructor(viewer, actions) {
    this.viewer = viewer;
    this.actions = actions;
    this.group = new THREE.Group();
    this.handle = /** @type {PickedHandle | null} */ (null);
    this.tool = /** @type {Tool} */ ('move');
    this.active = /** @type {{axis: Axis, start: number, amount: number, wanted: number} | null} */ (null);
    this.hovered = /** @type {Axis | null} */ (null);
    /** Whether the next click ends a drag. */
    this.dragged = false;
    this.range = /** @type {any} */ (null);
    viewer.main.scene.add(this.group);
    viewer.onDraw = () => this.#size();
    const { canvas } = viewer;
    canvas.addEventListener('pointermove', (event) => this.#move(event));
    canvas.addEventListener('pointerdown', (event) => this.#down(event), { capture: true });
    canvas.addEventListener('pointerup', (event) => this.#up(event, true));
    canvas.addEventListener('pointercancel', (event) => this.#up(event, false));
  }

  /** @param {PickedHandle | null} handle @param {Tool} tool */
  set(handle, tool) {
    this.handle = handle;
    this.tool = tool;
    this.range = null;
    this.hovered = null;
    this.rebuild();
  }

  /** @param {any} range */
  setRange(range) {
    this.range = range;
    this.rebuild();
  }

  /** Builds what is drawn. */
  rebuild() {
    empty(this.group);
    const { handle, tool, viewer } = this;
    viewer.draw();
    if (!handle?.centre) return;
    const { palette } = viewer, axisColour = palette.choice;
    const material = (/** @type {number} */ colour, opacity = 1) => new THREE.MeshBasicMaterial({ color: colour, depthTest: false, transparent: true, opacity });
    const dragged = this.active ? this.active.amount : null;
    this.group.position.copy(handle.centre);
    if (this.active && tool === 'move' && this.active.axis.direction) this.group.position.addScaledVector(this.active.axis.direction, dragged ?? 0);
    for (const axis of handle.axesOf(tool)) {
      const isActive = this.active?.axis.name === axis.name, hot = isActive || this.hovered?.name === axis.name;
      if (this.active && !isActive) continue;
      const colour = material(hot ? palette.contact : axisColour), grip = material(0xffffff, 0);
      const own = new THREE.Group();
      own.userData.axis = axis;
      if (tool === 'rotate' && axis.direction) {
        const ring = new THREE.Mesh(new THREE.TorusGeometry(1, 0.018, 8, 64), colour);
        const wide = new THREE.Mesh(new THREE.TorusGeometry(1, 0.09, 6, 32), grip);
        own.quaternion.setFromUnitVectors(new THREE.Vector3(0, 0, 1), axis.direction);
        own.add(ring, wide);
      } else if (axis.direction) {
        // Both ways, so that one of them is always within reach.
        for (const way of [1, -1]) {
          const arm = new THREE.Group();
          const shaft = new THREE.Mesh(new THREE.CylinderGeometry(0.02, 0.02, 0.85, 8), colour);
          shaft.position.y = 0.425;
          const tip = new THREE.Mesh(tool === 'move' ? new THREE.ConeGeometry(0.075, 0.22, 16) : new THREE.BoxGeometry(0.14, 0.14, 0.14), colour);
          tip.position.y = 0.95;
          const wide = new THREE.Mesh(new THREE.CylinderGeometry(0.12, 0.12, 1.1, 6), grip);
          wide.position.y = 0.55;
          arm.add(shaft, tip, wide);
          arm.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), axis.direction.clone().multiplyScalar(way));
          own.add(arm);
        }
      } else {
        own.add(new THREE.Mesh(new THREE.SphereGeometry(0.13, 16, 12), colour), new THREE.Mesh(new THREE.SphereGeometry(0.2, 8, 6), grip));
      }
      own.traverse((object) => (object.renderOrder = 10));
      this.group.add(own);
    }
    this.#drawRange();
  }

  /** The part of the axis on which all limits hold, and its ends. */
  #drawRange() {
    const { handle, active, range, tool, viewer } = this;
    if (this.bar) {
      viewer.main.scene.remove(this.bar);
      release(this.bar);
      this.bar = undefined;
    }
    const direction = active?.axis.direction;
    if (!handle?.centre || !direction || !range || tool === 'rotate') return;
    const { centre } = handle;
    const half = tool === 'move' ? PickedHandle.largestAmount('move', viewer.diagonal) : 1.2 * this.#length();
    const at = (/** @type {number} */ share) => centre.clone().addScaledVector(direction, share * half);
    const line = (/** @type {THREE.Vector3} */ a, /** @type {THREE.Vector3} */ b, /** @type {number} */ colour) =>
      new THREE.Line(new THREE.BufferGeometry().setFromPoints([a, b]), new THREE.LineBasicMaterial({ color: colour, depthTest: false, transparent: true }));
    const bar = new THREE.Group();
    bar.add(line(at(range.low), at(range.high), viewer.palette.changed));
    for (const [share, words] of /** @type {[number, string | null][]} */ ([[range.low, range.below], [range.high, range.above]])) {
      const end = new THREE.Mesh(new THREE.SphereGeometry(0.012 * viewer.diagonal, 12, 8),
        new THREE.MeshBasicMaterial({ color: words ? viewer.palette.contact : viewer.palette.changed, depthTest: false, transparent: true }));
      end.position.copy(at(share));
      bar.add(end);
    }
    bar.traverse((object) => (object.renderOrder = 9));
    this.bar = bar;
    viewer.main.scene.add(bar);
  }

  /** Length of an arm: about 80 pixels. */
  #length() {
    const distance = this.viewer.camera.position.distanceTo(this.group.position);
    return (distance * Math.tan((this.viewer.camera.fov * Math.PI) / 360) * 2 * 82) / this.viewer.canvas.clientHeight;
  }

  #size() {
    if (this.group.children.length) this.group.scale.setScalar(this.#length());
  }

  /** @param {PointerEvent} event @returns {Axis | null} */
  #axisAt(event) {
    if (!this.group.children.length || !this.viewer.isMain(event.clientX)) return null;
    this.group.updateMatrixWorld(true);
    const hit = this.viewer.rayAt(event.clientX, event.clientY).intersectObjects(this.group.children, true)[0];
    let object = /** @type {THREE.Object3D | null} */ (hit?.object ?? null);
    while (object && !object.userData.axis) object = object.parent;
    return object?.userData.axis ?? null;
  }

  /** Where the mouse is on an axis: length along it, angle about it, or distance in the window. @param {PointerEvent} event @param {Axis} axis */
  #place(event, axis) {
    const { handle, tool, viewer } = this;
    const centre = handle?.centre ?? new THREE.Vector3();
    if (!axis.direction) {
      const at = viewer.screenOf(centre);
      return Math.max(Math.hypot(event.clientX - at.x, event.clientY - at.y), 12);
    }
    const ray = viewer.rayAt(event.clientX, event.clientY).ray;
    if (tool === 'rotate') {
      const hit = ray.intersectPlane(new THREE.Plane().setFromNormalAndCoplanarPoint(axis.direction, centre), new THREE.Vector3());
      if (!hit) return 0;
      const u = new THREE.Vector3(1, 0, 0).cross(axis.direction);
      if (u.length() < 0.3) u.set(0, 1, 0).cross(axis.direction);
      u.normalize();
      const from = hit.sub(centre);
      return Math.atan2(from.dot(new THREE.Vector3().crossVectors(axis.direction, u)), from.dot(u));
    }
    // The point of the axis nearest to the ray.
    const w = centre.clone().sub(ray.origin), b = axis.direction.dot(ray.direction), d = axis.direction.dot(w), e = ray.direction.dot(w);
    const across = 1 - b * b;
    return across < 1e-4 ? 0 : (b * e - d) / across;
  }

  /** @param {PointerEvent} event */
  #down(event) {
    if (event.button !== 0) return;
    const axis = this.#axisAt(event);
    if (!axis || !this.handle) return;
    event.stopImmediatePropagation();
    event.preventDefault();
    this.viewer.canvas.setPointerCapture(event.pointerId);
    this.viewer.controls.enabled = false;
    const neutral = this.tool === 'scale' ? 1 : 0;
    this.active = { axis, start: this.#place(event, axis), amount: neutral, wanted: neutral };
    this.range = null;
    this.rebuild();
    this.actions.begin(this.handle.edit(this.tool, axis, PickedHandle.largestAmount(this.tool, this.viewer.diagonal)));
  }

  /** @param {PointerEvent} event */
  #move(event) {
    const { active, handle, tool, viewer } = this;
    if (!active || !handle) {
      const axis = event.buttons ? null : this.#axisAt(event);
      if (axis?.name !== this.hovered?.name) {
        this.hovered = axis;
        viewer.canvas.style.cursor = axis ? 'grab' : '';
        this.rebuild();
      }
      return;
    }
    const place = this.#place(event, active.axis), { diagonal } = viewer;
    let wanted;
    if (tool === 'scale') {
      const sign = active.axis.direction ? Math.max(this.#length() * 0.3, Math.abs(active.start)) : active.start;
      wanted = active.axis.direction ? 1 + ((place - active.start) * Math.sign(active.start || 1)) / sign : place / active.start;
      wanted = Math.min(largest.scale, Math.max(1 / largest.scale, wanted));
    } else {
      wanted = place - active.start;
      if (tool === 'rotate') wanted = Math.atan2(Math.sin(wanted), Math.cos(wanted));
      const most = PickedHandle.largestAmount(tool, diagonal);
      wanted = Math.max(-most, Math.min(most, wanted));
    }
    if (wanted === active.wanted) return;
    active.wanted = wanted;
    this.actions.drag(handle.edit(tool, active.axis, wanted));
  }

  /** @param {PointerEvent} event @param {boolean} keep */
  #up(event, keep) {
    if (!this.active) return;
    this.viewer.canvas.releasePointerCapture(event.pointerId);
    this.#finish(keep);
  }

  /** @param {boolean} keep */
  #finish(keep) {
    this.viewer.controls.enabled = true;
    const neutral = this.tool === 'scale' ? 1 : 0, moved = this.active?.wanted !== neutral;
    this.active = null;
    this.dragged = true;
    this.actions.end(keep && moved);
    this.rebuild();
  }

  /** Gives a drag up. */
  cancel() {
    if (!this.active) return false;
    this.#finish(false);
    return true;
  }

  /** Follows what the program made of the drag. @param {string} text */
  follow(text) {
    if (!this.active || !this.handle || !text) return;
    this.active.amount = this.handle.amountOf(text, this.tool, this.active.axis);
    this.rebuild();
  }
}

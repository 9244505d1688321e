// The 3-D view: one or more designs side by side, seen by one camera.
import * as THREE from 'three';
import { OrbitControls } from 'three/controls';
import { palettes } from './palettes.js';
import { Stage } from './stage.js';
import { ThumbnailPainter } from './thumbnails.js';

/** A frame that takes so many milliseconds is slow. */
const slowMilliseconds = 80;
/** Milliseconds that slow frames in a row take before it is no accident. */
const patience = 400;
/** Of the pixels of the window, along each side, that a sketch has. */
const sketchScale = 1 / 3;
/** Milliseconds after which what was sketched is drawn in full, unless it changes again. */
const restMilliseconds = 250;

/** Where the eye is at first, seen from the object. */
const firstView = [1.6, -2.4, 1.15];

/**
 * How a design is drawn small.
 * @typedef {object} SmallLook
 * @property {number} step  distance of the copy above it
 * @property {number[]} [direction]  in which that is; that of the view where it is left out
 * @property {Float32Array | null} against  parts that differ from this design are green
 */

/** Keys that turn the eye: sideways and upwards, in radians. @type {Record<string, [number, number]>} */
const turnKeys = { ArrowLeft: [-0.15, 0], ArrowRight: [0.15, 0], ArrowUp: [0, 0.1], ArrowDown: [0, -0.1] };
/** Keys that bring the eye nearer or farther; "=" is "+" without Shift on many keyboards. @type {Record<string, number>} */
const zoomKeys = { '+': 1 / 1.2, '=': 1 / 1.2, '-': 1.2 };

export class Viewer {
  /** @param {HTMLCanvasElement} canvas */
  constructor(canvas) {
    this.canvas = canvas;
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true, alpha: false });
    this.renderer.autoClear = false;
    this.camera = new THREE.PerspectiveCamera(32, 1, 0.1, 100);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.addEventListener('change', () => this.draw());
    this.controls.zoomToCursor = true;
    this.palette = palettes.light;
    /** From left to right. @type {Stage[]} */
    this.stages = [new Stage(() => this.draw())];
    /** Of the box of the object at rest. */
    this.diagonal = 1;
    /** The current design, which pictures are compared with. @type {Float32Array | null} */
    this.design = null;
    this.waits = false;
    this.framesDrawn = 0;
    /** Whether pictures that change are only sketched: without a graphics card they would follow slowly. */
    this.slow = false;
    /** Whether what is seen is a sketch. */
    this.sketched = false;
    /** Milliseconds that the last frames took, if they were slow. */
    this.slowly = 0;
    /** Whether a frame is timed now. */
    this.timed = false;
    /** Whether nothing was drawn of the mesh yet. */
    this.first = true;
    this.rest = /** @type {ReturnType<typeof setTimeout> | undefined} */ (undefined);
    this.painter = /** @type {ThumbnailPainter | null} */ (null);
    new ResizeObserver(() => this.resize()).observe(canvas);
    canvas.addEventListener('webglcontextrestored', () => this.draw());
    canvas.addEventListener('keydown', (event) => this.#key(event));
  }

  /** The design that is edited: the one on the left. */
  get main() { return this.stages[0]; }

  /** @param {import('./mesh_surface.js').MeshData} data */
  setMesh(data) {
    while (this.stages.length > 1) this.removeStage();
    this.main.setMesh(data);
    this.main.setPalette(this.palette);
    this.slow = false;
    this.slowly = 0;
    this.first = true;
    this.fit();
  }

  /** Adds a stage on the right for another design of the same mesh. */
  addStage() {
    const stage = new Stage(() => this.draw());
    if (this.main.surface) stage.setMesh(this.main.surface.mesh);
    stage.setPalette(this.palette);
    this.stages.push(stage);
    this.resize();
    return stage;
  }

  /** Removes the stage on the right; the first one stays. */
  removeStage() {
    if (this.stages.length > 1) this.stages.pop()?.release();
    this.resize();
  }

  /** @param {boolean} dark */
  setTheme(dark) {
    this.palette = dark ? palettes.dark : palettes.light;
    for (const stage of this.stages) stage.setPalette(this.palette);
  }

  /** Part of the window that the first stage has. */
  #pane() {
    const box = this.canvas.getBoundingClientRect();
    return { left: box.left, top: box.top, width: box.width / this.stages.length, height: box.height };
  }

  /** @param {number} x @param {number} y  of the window */
  rayAt(x, y) {
    const box = this.#pane(), ray = new THREE.Raycaster();
    ray.setFromCamera(new THREE.Vector2((2 * (x - box.left)) / box.width - 1, 1 - (2 * (y - box.top)) / box.height), this.camera);
    return ray;
  }

  /** Says whether a place of the window shows the first stage. @param {number} x */
  isMain(x) {
    const box = this.#pane();
    return x <= box.left + box.width;
  }

  /** Where a point of the first stage is in the window. @param {THREE.Vector3} point */
  screenOf(point) {
    const box = this.#pane(), at = point.clone().project(this.camera);
    return { x: box.left + ((at.x + 1) / 2) * box.width, y: box.top + ((1 - at.y) / 2) * box.height };
  }

  /** Looks at everything. @param {number[]} [from]  direction from the object to the eye */
  fit(from = firstView) {
    const { centre: middle, radius: own, direction, layers, copiesAbove, copiesBelow, step } = this.main;
    const high = layers.ghosts ? copiesAbove * step : 0, low = layers.ghosts ? copiesBelow * step : 0;
    const centre = middle.clone().addScaledVector(direction, Math.min((high - low) / 2, 0.25 * own));
    // The object fills the view; of copies far away only a part is seen.
    const radius = 1.12 * own + Math.min((high + low) / 2, 0.4 * own);
    this.look(centre, radius, from);
  }

  /** Looks at a ball. @param {THREE.Vector3} centre @param {number} radius @param {number[]} [from] */
  look(centre, radius, from = firstView) {
    const narrow = Math.min(1, this.camera.aspect);
    const distance = radius / Math.sin((this.camera.fov * Math.PI) / 360) / narrow;
    this.controls.target.copy(centre);
    this.camera.position.copy(centre).addScaledVector(new THREE.Vector3().fromArray(from).normalize(), distance);
    this.camera.near = distance / 200;
    this.camera.far = distance * 20;
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.draw();
  }

  /** @param {KeyboardEvent} event */
  #key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (turnKeys[event.key]) this.turn(...turnKeys[event.key]);
    else if (zoomKeys[event.key]) this.zoom(zoomKeys[event.key]);
    else return;
    event.preventDefault();
  }

  /** Brings the eye nearer or farther. @param {number} factor  of its distance */
  zoom(factor) {
    const { position } = this.camera, { target } = this.controls;
    position.sub(target).multiplyScalar(factor).add(target);
    this.controls.update();
    this.draw();
  }

  /** Turns the eye. @param {number} sideways @param {number} upwards  radians */
  turn(sideways, upwards) {
    const offset = this.camera.position.clone().sub(this.controls.target), polar = new THREE.Spherical();
    const toY = new THREE.Quaternion().setFromUnitVectors(this.camera.up, new THREE.Vector3(0, 1, 0));
    polar.setFromVector3(offset.applyQuaternion(toY));
    polar.theta += sideways;
    polar.phi -= upwards;
    polar.makeSafe();
    this.camera.position.copy(this.controls.target).add(offset.setFromSpherical(polar).applyQuaternion(toY.invert()));
    this.controls.update();
    this.draw();
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (!width || !height) return;
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / this.stages.length / height;
    this.camera.updateProjectionMatrix();
    // With several panes the place of the mouse in the window is not its place in the picture.
    this.controls.zoomToCursor = this.stages.length === 1;
    this.draw();
  }

  /** Draws with the next frame of the window. */
  draw() {
    if (this.waits) return;
    this.waits = true;
    requestAnimationFrame(() => {
      this.waits = false;
      this.#render(this.slow);
    });
  }

  /** @param {boolean} [sketched]  whether it is drawn coarsely now, and in full a little later */
  #render(sketched = false) {
    if (!this.main.surface) return;
    clearTimeout(this.rest);
    this.sketched = sketched;
    const ratio = Math.min(devicePixelRatio, 2) * (sketched ? sketchScale : 1);
    if (this.renderer.getPixelRatio() !== ratio) this.renderer.setPixelRatio(ratio);
    for (const stage of this.stages) stage.sketch(sketched);
    this.#paint();
    const frame = this.framesDrawn;
    if (sketched) {
      if (!this.#whenDrawn((waits) => this.#finish(waits, frame))) this.#finish(false, frame);
    } else if (!this.slow && !this.timed && !this.first) {  // the first frame of a mesh takes long everywhere
      this.timed = this.#whenDrawn((waits, milliseconds) => this.#time(waits, milliseconds));
    }
    this.first = false;
  }

  /**
   * Says again and again how long the last frame takes until it is drawn. False where the graphics card does not tell.
   * @param {(waits: boolean, milliseconds: number) => boolean} heard  whether to go on while it waits
   */
  #whenDrawn(heard) {
    const gl = /** @type {WebGL2RenderingContext} */ (this.renderer.getContext()), begin = performance.now();
    const drawn = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    if (!drawn) return false;
    gl.flush();
    const look = () => {
      const waits = !gl.isContextLost() && gl.getSyncParameter(drawn, gl.SYNC_STATUS) === gl.UNSIGNALED;
      if (heard(waits, performance.now() - begin) && waits) setTimeout(look, 5);
      else gl.deleteSync(drawn);
    };
    setTimeout(look, 5);
    return true;
  }

  /** Finds out whether frames are slow. @param {boolean} waits @param {number} milliseconds */
  #time(waits, milliseconds) {
    this.slow ||= this.slowly + milliseconds > patience;
    if (waits && !this.slow) return true;
    this.timed = false;
    this.slowly = milliseconds > slowMilliseconds ? this.slowly + milliseconds : 0;
    return false;
  }

  /** Draws in full what was sketched, unless it changes again. @param {boolean} waits @param {number} frame */
  #finish(waits, frame) {
    if (frame !== this.framesDrawn) return false;
    if (!waits) this.rest = setTimeout(() => this.#render(), restMilliseconds);
    return waits;
  }

  #paint() {
    const { camera, renderer } = this, size = renderer.getSize(new THREE.Vector2()), width = size.x / this.stages.length;
    this.onDraw?.();
    renderer.setScissorTest(true);
    this.stages.forEach((stage, k) => {
      const left = Math.round(k * width), right = Math.round((k + 1) * width);
      stage.light.position.copy(camera.position).add(new THREE.Vector3(0, 0, 2 * stage.radius)).addScaledVector(new THREE.Vector3(1, 0, 0).applyQuaternion(camera.quaternion), -2 * stage.radius);
      stage.light.target.position.copy(this.controls.target);
      renderer.setViewport(left, 0, right - left, size.y);
      renderer.setScissor(left, 0, right - left, size.y);
      renderer.clear();
      renderer.render(stage.scene, camera);
    });
    ++this.framesDrawn;
  }

  /** Called before each frame. @type {(() => void) | undefined} */
  onDraw = undefined;

  /** The window as a picture. @returns {Promise<Blob | null>} */
  picture() {
    this.#render();
    return new Promise((resolve) => this.canvas.toBlob(resolve));
  }

  /**
   * Draws a design small, as it is seen now, with one copy above it.
   * @param {HTMLCanvasElement} canvas
   * @param {Float32Array} vertices
   * @param {SmallLook} look
   */
  thumbnail(canvas, vertices, look) {
    if (!this.main.surface) return;
    this.painter ??= new ThumbnailPainter(this);
    this.painter.paint(canvas, vertices, look);
  }
}

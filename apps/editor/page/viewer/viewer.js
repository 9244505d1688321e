// The 3-D view: an object, copies above and below it, and what is known of them.
import * as THREE from 'three';
import { OrbitControls } from 'three/controls';
import { MeshBVH, acceleratedRaycast } from 'three-mesh-bvh';
import { MeshSurface } from './mesh_surface.js';

/** Colours of the figures, for a light and a dark ground. */
const palettes = {
  light: { ground: 0xf3f4f5, rest: 0xf2c649, changed: 0x7fba63, ghost: 0xaab3be, ghostEdge: 0x30343a, edge: 0x30343a, choice: 0x2f64ab, contact: 0xd6191f,
    before: 0xb98a10, joint: 0x8a3fb0, plane: 0x2f64ab },
  dark: { ground: 0x1b1d20, rest: 0xe3b73c, changed: 0x74ad59, ghost: 0x8d98a4, ghostEdge: 0xc3cbd4, edge: 0x0d0e10, choice: 0x8ab4ec, contact: 0xff4d52,
    before: 0xf0c348, joint: 0xcf8af0, plane: 0x8ab4ec },
};

/** Colours that tell parts apart: Okabe and Ito 2008, lightened. */
const partColours = [0xe8b04a, 0x7cc3ea, 0x4fb89a, 0xf0e06b, 0x5f97c9, 0xe08a5c, 0xd49bbd, 0xb0b6bd].map((hex) => new THREE.Color(hex));

/** @typedef {{kind: 'cuboid' | 'cylinder', points: number[][], radii?: number[], closed?: boolean}} Primitive */

/** For members that are added to objects of three.js. @param {any} object */
const asAny = (object) => object;

/** Lines between the points of primitives. @param {Primitive[]} primitives @returns {number[]} */
function primitiveLines(primitives) {
  /** @type {number[]} */
  const lines = [];
  for (const primitive of primitives) {
    const p = primitive.points;
    if (primitive.kind === 'cuboid') {
      for (let a = 0; a < 8; ++a)
        for (const bit of [1, 2, 4]) if (!(a & bit)) lines.push(...p[a], ...p[a | bit]);
      continue;
    }
    const count = p.length, axis = new THREE.Vector3(), u = new THREE.Vector3(), v = new THREE.Vector3();
    for (let k = 0; k < count; ++k) {
      const next = primitive.closed ? (k + 1) % count : Math.min(k + 1, count - 1);
      if (next !== k) lines.push(...p[k], ...p[next]);
      const before = primitive.closed ? (k + count - 1) % count : Math.max(k - 1, 0);
      axis.set(p[next][0] - p[before][0], p[next][1] - p[before][1], p[next][2] - p[before][2]).normalize();
      u.set(Math.abs(axis.x) < 0.9 ? 1 : 0, Math.abs(axis.x) < 0.9 ? 0 : 1, 0).cross(axis).normalize();
      v.crossVectors(axis, u);
      const radius = primitive.radii?.[k] ?? 0, sides = 20;
      for (let s = 0; s < sides; ++s)
        for (const angle of [(2 * Math.PI * s) / sides, (2 * Math.PI * (s + 1)) / sides])
          for (let i = 0; i < 3; ++i)
            lines.push(p[k][i] + radius * (Math.cos(angle) * u.getComponent(i) + Math.sin(angle) * v.getComponent(i)));
    }
  }
  return lines;
}

/** What is drawn of a mesh. @param {MeshSurface} surface */
function makeStage(surface) {
  const root = new THREE.Group();
  const material = new THREE.MeshLambertMaterial({ vertexColors: true, side: THREE.DoubleSide,
    polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 });
  const edgeMaterial = new THREE.LineBasicMaterial({ transparent: true, opacity: 0.55 });
  const body = new THREE.Mesh(surface.geometry, material);
  const bodyEdges = new THREE.LineSegments(surface.edgeGeometry, edgeMaterial);
  root.add(body, bodyEdges);
  // Ghosts: first their depth, then one layer of colour, so that their insides are not seen.
  const ghostDepth = new THREE.MeshBasicMaterial({ colorWrite: false, side: THREE.DoubleSide,
    polygonOffset: true, polygonOffsetFactor: 2, polygonOffsetUnits: 2 });
  const ghostMaterial = new THREE.MeshLambertMaterial({ transparent: true, opacity: 0.38, side: THREE.DoubleSide, depthWrite: false });
  const ghostEdgeMaterial = new THREE.LineBasicMaterial({ transparent: true, opacity: 0.28 });
  const ghosts = new THREE.Group();
  root.add(ghosts);
  const contactMaterial = new THREE.MeshBasicMaterial({ side: THREE.DoubleSide, depthTest: false, transparent: true, opacity: 0.85 });
  const contacts = new THREE.Mesh(new THREE.BufferGeometry(), contactMaterial);
  const contactDots = new THREE.Points(new THREE.BufferGeometry(), new THREE.PointsMaterial({ size: 7, sizeAttenuation: false, depthTest: false, transparent: true, opacity: 0.9 }));
  contacts.renderOrder = contactDots.renderOrder = 6;
  const before = new THREE.LineSegments(surface.edgeGeometry.clone(), new THREE.LineBasicMaterial({ transparent: true, opacity: 0.9 }));
  const primitives = new THREE.LineSegments(new THREE.BufferGeometry(), new THREE.LineBasicMaterial());
  const joints = new THREE.Points(new THREE.BufferGeometry(), new THREE.PointsMaterial({ size: 9, sizeAttenuation: false, depthTest: false }));
  const strokes = new THREE.Group();
  const symmetry = new THREE.Group();
  const handles = new THREE.Group();
  root.add(contacts, contactDots, before, primitives, joints, strokes, symmetry, handles);
  const bvh = new MeshBVH(surface.geometry, { indirect: true });
  asAny(surface.geometry).boundsTree = bvh;
  body.raycast = acceleratedRaycast;
  return { root, bvh, before, body, bodyEdges, contactDots, contactMaterial, contacts, edgeMaterial, ghostDepth, ghostEdgeMaterial, ghostMaterial, ghosts, handles, joints, material, primitives, strokes, symmetry };
}

export class Viewer {
  /** @param {HTMLCanvasElement} canvas */
  constructor(canvas) {
    this.canvas = canvas;
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true, alpha: false });
    this.scene = new THREE.Scene();
    this.camera = new THREE.PerspectiveCamera(32, 1, 0.1, 100);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.addEventListener('change', () => this.draw());
    this.controls.zoomToCursor = true;
    this.light = new THREE.DirectionalLight(0xffffff, 2.1);
    this.scene.add(new THREE.HemisphereLight(0xffffff, 0x8d8f95, 1.5), this.light, this.light.target);
    this.palette = palettes.light;
    this.direction = new THREE.Vector3(0, 0, 1);
    this.step = 0;
    this.radius = 1;
    /** Of the box of the object at rest. */
    this.diagonal = 1;
    this.centre = new THREE.Vector3();
    /** What is shown. @type {Record<string, boolean>} */
    this.layers = { ghosts: true, contacts: true, before: false, parts: false, primitives: false, joints: false, symmetry: false };
    this.copiesAbove = 2;
    this.copiesBelow = 1;
    this.selected = /** @type {Set<number>} */ (new Set());
    this.changed = false;
    /** The current design, which pictures are compared with. @type {Float32Array | null} */
    this.design = null;
    this.waits = false;
    this.framesDrawn = 0;
    this.surface = /** @type {MeshSurface | null} */ (null);
    this.stage = /** @type {ReturnType<typeof makeStage> | null} */ (null);
    this.motion = 0;
    this.painter = /** @type {ThumbnailPainter | null} */ (null);
    new ResizeObserver(() => this.resize()).observe(canvas);
    canvas.addEventListener('webglcontextrestored', () => this.draw());
  }

  /** @param {import('./mesh_surface.js').MeshData} data */
  setMesh(data) {
    if (this.stage) this.scene.remove(this.stage.root);
    this.surface?.dispose();
    const surface = (this.surface = new MeshSurface(data));
    const sphere = new THREE.Sphere().setFromPoints(
      Array.from({ length: data.vertices.length / 3 }, (_, v) => new THREE.Vector3().fromArray(data.vertices, 3 * v)));
    this.radius = sphere.radius;
    this.centre.copy(sphere.center);
    this.stage = makeStage(surface);
    this.scene.add(this.stage.root);
    this.stale = false;
    this.setTheme(this.palette === palettes.dark);
    this.fit();
  }

  /** @param {boolean} dark */
  setTheme(dark) {
    this.palette = dark ? palettes.dark : palettes.light;
    this.scene.background = new THREE.Color(this.palette.ground);
    this.recolour();
  }

  recolour() {
    const { palette, stage } = this;
    if (!this.surface || !stage) return;
    const base = new THREE.Color(this.changed ? palette.changed : palette.rest), chosen = new THREE.Color(palette.choice);
    this.surface.paint((part) => {
      const own = this.layers.parts ? partColours[part % partColours.length] : base;
      return this.selected.has(part) ? own.clone().lerp(chosen, 0.6) : own;
    });
    stage.edgeMaterial.color.setHex(palette.edge);
    stage.ghostMaterial.color.setHex(palette.ghost);
    stage.ghostEdgeMaterial.color.setHex(palette.ghostEdge);
    stage.contactMaterial.color.setHex(palette.contact);
    stage.contactDots.material.color.setHex(palette.contact);
    stage.before.material.color.setHex(palette.before);
    stage.primitives.material.color.setHex(palette.choice);
    stage.joints.material.color.setHex(palette.joint);
    this.draw();
  }

  /** @param {Record<string, boolean>} layers */
  setLayers(layers) {
    Object.assign(this.layers, layers);
    this.#place();
    this.recolour();
  }

  /**
   * Shows a design: its vertices, and copies at multiples of `step` along `direction`.
   * @param {Float32Array} vertices
   * @param {number} step
   * @param {boolean} smooth  whether it moves there instead of jumping
   */
  show(vertices, step, smooth = false) {
    if (!this.surface) return;
    cancelAnimationFrame(this.motion);
    const still = matchMedia('(prefers-reduced-motion: reduce)').matches;
    if (!smooth || still) return this.#set(vertices, step);
    const from = this.surface.vertices, fromStep = this.step, begin = performance.now(), milliseconds = 220;
    const between = new Float32Array(vertices.length);
    const move = () => {
      const t = Math.min((performance.now() - begin) / milliseconds, 1), s = t * t * (3 - 2 * t);
      if (t >= 1) return this.#set(vertices, step);
      for (let k = 0; k < between.length; ++k) between[k] = from[k] + s * (vertices[k] - from[k]);
      this.#set(between.slice(), fromStep + s * (step - fromStep));
      this.motion = requestAnimationFrame(move);
    };
    move();
  }

  /** @param {Float32Array} vertices @param {number} step */
  #set(vertices, step) {
    this.surface?.set(vertices);
    this.step = step;
    this.stale = true;
    this.#place();
    this.draw();
  }

  /** Puts copies and layers where they belong. */
  #place() {
    const { layers, stage } = this;
    if (!this.surface || !stage) return;
    const wanted = layers.ghosts ? [...Array(this.copiesBelow).keys()].map((k) => -k - 1).concat([...Array(this.copiesAbove).keys()].map((k) => k + 1)) : [];
    while (stage.ghosts.children.length > wanted.length) stage.ghosts.remove(stage.ghosts.children[stage.ghosts.children.length - 1]);
    while (stage.ghosts.children.length < wanted.length) {
      const ghost = new THREE.Group();
      const depth = new THREE.Mesh(this.surface.geometry, stage.ghostDepth), colour = new THREE.Mesh(this.surface.geometry, stage.ghostMaterial);
      const edges = new THREE.LineSegments(this.surface.edgeGeometry, stage.ghostEdgeMaterial);
      depth.renderOrder = 2;
      colour.renderOrder = 3;
      edges.renderOrder = 4;
      ghost.add(depth, colour, edges);
      stage.ghosts.add(ghost);
    }
    wanted.forEach((copy, k) => stage.ghosts.children[k].position.copy(this.direction).multiplyScalar(copy * this.step));
    stage.contacts.visible = stage.contactDots.visible = layers.contacts && layers.ghosts;
    stage.before.visible = layers.before;
    stage.primitives.visible = layers.primitives;
    stage.joints.visible = layers.joints;
    stage.symmetry.visible = layers.symmetry;
  }

  /** @param {number[]} direction */
  setDirection(direction) {
    this.direction.fromArray(direction).normalize();
    this.#place();
    this.draw();
  }

  /** @param {Float32Array} corners  of triangles  @param {number[][]} centres  of regions */
  setContacts(corners, centres) {
    const { stage } = this;
    if (!stage) return;
    stage.contacts.geometry.dispose();
    stage.contacts.geometry = new THREE.BufferGeometry().setAttribute('position', new THREE.BufferAttribute(corners, 3));
    stage.contactDots.geometry.dispose();
    stage.contactDots.geometry = new THREE.BufferGeometry().setAttribute('position', new THREE.Float32BufferAttribute(centres.flat(), 3));
    this.draw();
  }

  /** Outlines another design in the layer `before`. @param {Float32Array | null} vertices */
  setBefore(vertices) {
    const { stage } = this;
    if (!this.surface || !stage) return;
    const { edges } = this.surface, position = stage.before.geometry.attributes.position;
    const from = vertices ?? this.surface.mesh.vertices;
    for (let e = 0; e < edges.length; ++e)
      position.setXYZ(e, from[3 * edges[e]], from[3 * edges[e] + 1], from[3 * edges[e] + 2]);
    position.needsUpdate = true;
    stage.before.geometry.boundingSphere = null;
    stage.before.visible = vertices !== null || this.layers.before;
    this.draw();
  }

  /** @param {Primitive[]} primitives */
  setPrimitives(primitives) {
    const { stage } = this;
    if (!stage) return;
    stage.primitives.geometry.dispose();
    stage.primitives.geometry = new THREE.BufferGeometry().setAttribute('position', new THREE.Float32BufferAttribute(primitiveLines(primitives), 3));
    this.draw();
  }

  /** @param {number[][]} points @param {{kind: string, point: number[], axis: number[]}[]} symmetries */
  setRelations(points, symmetries) {
    const { stage } = this;
    if (!stage) return;
    stage.joints.geometry.dispose();
    stage.joints.geometry = new THREE.BufferGeometry().setAttribute('position', new THREE.Float32BufferAttribute(points.flat(), 3));
    stage.symmetry.clear();
    for (const symmetry of symmetries) {
      const axis = new THREE.Vector3().fromArray(symmetry.axis), point = new THREE.Vector3().fromArray(symmetry.point);
      const centre = this.centre.clone();
      if (symmetry.kind === 'reflection') {
        centre.addScaledVector(axis, point.clone().sub(centre).dot(axis));
        const size = 2.2 * this.radius;
        const plane = new THREE.Mesh(new THREE.PlaneGeometry(size, size),
          new THREE.MeshBasicMaterial({ color: this.palette.plane, transparent: true, opacity: 0.12, side: THREE.DoubleSide, depthWrite: false }));
        plane.renderOrder = 5;
        plane.position.copy(centre);
        plane.quaternion.setFromUnitVectors(new THREE.Vector3(0, 0, 1), axis);
        stage.symmetry.add(plane);
      } else {
        const along = axis.clone().multiplyScalar(1.3 * this.radius);
        centre.copy(point).addScaledVector(axis, this.centre.clone().sub(point).dot(axis));
        stage.symmetry.add(new THREE.Line(new THREE.BufferGeometry().setFromPoints([centre.clone().sub(along), centre.clone().add(along)]),
          new THREE.LineBasicMaterial({ color: this.palette.plane })));
      }
    }
    this.draw();
  }

  /** Colour of the strokes of a name. @param {number} k */
  strokeColour(k) {
    return '#' + partColours[(k + 2) % partColours.length].clone().lerp(new THREE.Color(0x000000), 0.25).getHexString();
  }

  /** Paints triangles over the object. @param {Set<number>[]} strokes */
  setStrokes(strokes) {
    const { stage, surface } = this;
    if (!stage || !surface) return;
    stage.strokes.clear();
    strokes.forEach((triangles, k) => {
      const corners = [];
      for (const triangle of triangles)
        for (let corner = 0; corner < 3; ++corner)
          for (let i = 0; i < 3; ++i) corners.push(surface.vertices[3 * surface.mesh.triangles[3 * triangle + corner] + i]);
      const painted = new THREE.Mesh(new THREE.BufferGeometry().setAttribute('position', new THREE.Float32BufferAttribute(corners, 3)),
        new THREE.MeshBasicMaterial({ color: this.strokeColour(k), side: THREE.DoubleSide, polygonOffset: true, polygonOffsetFactor: -2, polygonOffsetUnits: -2 }));
      painted.renderOrder = 1;
      stage.strokes.add(painted);
    });
    this.draw();
  }

  /** @param {Iterable<number>} parts */
  select(parts) {
    this.selected = new Set(parts);
    this.recolour();
  }

  /** @param {boolean} changed  whether the object is not the one at rest any more */
  setChanged(changed) {
    if (changed === this.changed) return;
    this.changed = changed;
    this.recolour();
  }

  /** The point and the triangle under a place of the window. @param {number} x @param {number} y */
  pick(x, y) {
    const { stage } = this;
    if (!this.surface || !stage) return null;
    if (this.stale) stage.bvh.refit();
    this.stale = false;
    const ray = this.rayAt(x, y);
    asAny(ray).firstHitOnly = true;
    const hit = ray.intersectObject(stage.body, false)[0];
    if (!hit || hit.faceIndex == null) return null;
    const triangle = hit.faceIndex;
    return { point: hit.point, part: this.surface.partOf[this.surface.index[3 * triangle]], triangle };
  }

  /** @param {number} x @param {number} y  of the window */
  rayAt(x, y) {
    const box = this.canvas.getBoundingClientRect();
    const ray = new THREE.Raycaster();
    ray.setFromCamera(new THREE.Vector2((2 * (x - box.left)) / box.width - 1, 1 - (2 * (y - box.top)) / box.height), this.camera);
    return ray;
  }

  /** Where a point is in the window. @param {THREE.Vector3} point */
  screenOf(point) {
    const box = this.canvas.getBoundingClientRect(), at = point.clone().project(this.camera);
    return { x: box.left + ((at.x + 1) / 2) * box.width, y: box.top + ((1 - at.y) / 2) * box.height };
  }

  /** Looks at everything. @param {number[]} [from]  direction from the object to the eye */
  fit(from = [1.6, -2.4, 1.15]) {
    const high = this.layers.ghosts ? this.copiesAbove * this.step : 0, low = this.layers.ghosts ? this.copiesBelow * this.step : 0;
    const centre = this.centre.clone().addScaledVector(this.direction, Math.min((high - low) / 2, 0.25 * this.radius));
    // The object fills the view; of copies far away only a part is seen.
    const radius = 1.12 * this.radius + Math.min((high + low) / 2, 0.4 * this.radius);
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
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  /** Draws with the next frame of the window. */
  draw() {
    if (this.waits) return;
    this.waits = true;
    requestAnimationFrame(() => {
      this.waits = false;
      this.#render();
    });
  }

  #render() {
    if (!this.surface) return;
    this.light.position.copy(this.camera.position).add(new THREE.Vector3(0, 0, 2 * this.radius)).addScaledVector(new THREE.Vector3(1, 0, 0).applyQuaternion(this.camera.quaternion), -2 * this.radius);
    this.light.target.position.copy(this.controls.target);
    this.onDraw?.();
    this.renderer.render(this.scene, this.camera);
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
   * @param {{step: number, against: Float32Array | null}} look  parts that differ from `against` are green
   */
  thumbnail(canvas, vertices, look) {
    if (!this.surface) return;
    this.painter ??= new ThumbnailPainter(this);
    this.painter.paint(canvas, vertices, look);
  }
}

/**
 * Parts of which a vertex moved by more than `least`.
 * @param {import('./mesh_surface.js').MeshData} mesh
 * @param {Float32Array} before
 * @param {Float32Array} after
 * @param {number} least
 */
function partsThatMoved(mesh, before, after, least) {
  const moved = new Set();
  for (let corner = 0; corner < mesh.triangles.length; ++corner) {
    const v = 3 * mesh.triangles[corner];
    if (Math.hypot(after[v] - before[v], after[v + 1] - before[v + 1], after[v + 2] - before[v + 2]) > least)
      moved.add(mesh.parts[Math.floor(corner / 3)]);
  }
  return moved;
}

/** Draws small pictures, with a renderer of their own: reading back from that of the view would wait for it. */
class ThumbnailPainter {
  /** @param {Viewer} viewer */
  constructor(viewer) {
    this.viewer = viewer;
    this.renderer = new THREE.WebGLRenderer({ antialias: false });
    this.renderer.setPixelRatio(1);
    this.scene = new THREE.Scene();
    this.camera = new THREE.PerspectiveCamera(26, 4 / 3, 0.1, 100);
    this.camera.up.set(0, 0, 1);
    this.light = new THREE.DirectionalLight(0xffffff, 2.1);
    this.scene.add(new THREE.HemisphereLight(0xffffff, 0x8d8f95, 1.5), this.light);
    this.surface = /** @type {MeshSurface | null} */ (null);
    this.group = new THREE.Group();
    this.ghost = new THREE.Mesh(undefined, new THREE.MeshLambertMaterial());
    this.edges = new THREE.LineSegments(undefined, new THREE.LineBasicMaterial());
  }

  #prepare() {
    const { surface } = this.viewer;
    if (!surface || this.surface?.mesh === surface.mesh) return;
    this.surface?.dispose();
    this.scene.remove(this.group);
    this.surface = new MeshSurface(surface.mesh);
    const body = new THREE.Mesh(this.surface.geometry, new THREE.MeshLambertMaterial({ vertexColors: true, side: THREE.DoubleSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 }));
    this.edges = new THREE.LineSegments(this.surface.edgeGeometry, new THREE.LineBasicMaterial({ transparent: true, opacity: 0.45 }));
    this.ghost = new THREE.Mesh(this.surface.geometry, new THREE.MeshLambertMaterial({ side: THREE.DoubleSide, transparent: true, opacity: 0.45 }));
    this.group = new THREE.Group().add(body, this.edges, this.ghost);
    this.scene.add(this.group);
  }

  /**
   * @param {HTMLCanvasElement} canvas
   * @param {Float32Array} vertices
   * @param {{step: number, against: Float32Array | null}} look
   */
  paint(canvas, vertices, look) {
    this.#prepare();
    if (!this.surface) return;
    const { viewer } = this, { palette } = viewer;
    const moved = look.against ? partsThatMoved(this.surface.mesh, look.against, vertices, 0.004 * viewer.radius) : new Set();
    const still = new THREE.Color(palette.rest), changed = new THREE.Color(palette.changed);
    this.surface.paint((part) => (moved.has(part) ? changed : still));
    this.surface.set(vertices);
    this.ghost.material.color.setHex(palette.ghost);
    this.edges.material.color.setHex(palette.edge);
    this.ghost.position.copy(viewer.direction).multiplyScalar(look.step);
    const width = canvas.width, height = canvas.height, scale = 2;
    this.camera.aspect = width / height;
    const radius = viewer.radius + look.step / 2, centre = viewer.centre.clone().addScaledVector(viewer.direction, look.step / 2);
    const distance = (0.98 * radius) / Math.sin((this.camera.fov * Math.PI) / 360);
    const eye = viewer.camera.position.clone().sub(viewer.controls.target).normalize();
    this.camera.position.copy(centre).addScaledVector(eye, distance);
    this.camera.near = distance / 100;
    this.camera.far = distance * 10;
    this.camera.lookAt(centre);
    this.camera.updateProjectionMatrix();
    this.light.position.copy(this.camera.position).add(new THREE.Vector3(0, 0, 2 * viewer.radius));
    this.scene.background = new THREE.Color(palette.ground);
    this.renderer.setSize(scale * width, scale * height, false);
    this.renderer.render(this.scene, this.camera);
    const context = canvas.getContext('2d');
    if (!context) return;
    context.imageSmoothingQuality = 'high';
    context.drawImage(this.renderer.domElement, 0, 0, width, height);
  }
}

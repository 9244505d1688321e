// One design on the stage: the object, copies above and below it, and layers of what is known of it.
import * as THREE from 'three';
import { gapGeometry } from './gap_surface.js';
import { MeshSurface } from './mesh_surface.js';
import { palettes, partColours, strokeColour } from './palettes.js';
import { primitiveLines } from './primitive_lines.js';
import { empty, release } from './release.js';

/** Everything that is drawn of a mesh. @param {MeshSurface} surface */
function makeObjects(surface) {
  const root = new THREE.Group();
  const material = new THREE.MeshLambertMaterial({ vertexColors: true, side: THREE.DoubleSide,
    polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 });
  const edgeMaterial = new THREE.LineBasicMaterial({ transparent: true, opacity: 0.55 });
  const body = new THREE.Mesh(surface.geometry, material);
  const bodyEdges = new THREE.LineSegments(surface.edgeGeometry, edgeMaterial);
  const sketch = new THREE.Mesh(surface.coarse, material);
  sketch.frustumCulled = sketch.visible = false;  // it shares vertices that move
  root.add(body, bodyEdges, sketch);
  // Ghosts: first their depth, then one layer of colour, so that their insides are not seen.
  const ghostDepth = new THREE.MeshBasicMaterial({ colorWrite: false, side: THREE.DoubleSide,
    polygonOffset: true, polygonOffsetFactor: 2, polygonOffsetUnits: 2 });
  const ghostMaterial = new THREE.MeshLambertMaterial({ transparent: true, opacity: 0.38, side: THREE.DoubleSide, depthWrite: false });
  const ghostEdgeMaterial = new THREE.LineBasicMaterial({ transparent: true, opacity: 0.28 });
  const ghosts = new THREE.Group();
  const contactMaterial = new THREE.MeshBasicMaterial({ side: THREE.DoubleSide, depthTest: false, transparent: true, opacity: 0.85 });
  const contacts = new THREE.Mesh(new THREE.BufferGeometry(), contactMaterial);
  const contactDots = new THREE.Points(new THREE.BufferGeometry(), new THREE.PointsMaterial({ size: 7, sizeAttenuation: false, depthTest: false, transparent: true, opacity: 0.9 }));
  contacts.renderOrder = contactDots.renderOrder = 6;
  const before = new THREE.LineSegments(surface.edgeGeometry.clone(), new THREE.LineBasicMaterial({ transparent: true, opacity: 0.9 }));
  const gap = new THREE.Mesh(new THREE.BufferGeometry(), new THREE.MeshBasicMaterial({ vertexColors: true, side: THREE.DoubleSide, polygonOffset: true, polygonOffsetFactor: -2, polygonOffsetUnits: -4 }));
  gap.renderOrder = 1;
  const primitives = new THREE.LineSegments(new THREE.BufferGeometry(), new THREE.LineBasicMaterial());
  const joints = new THREE.Points(new THREE.BufferGeometry(), new THREE.PointsMaterial({ size: 9, sizeAttenuation: false, depthTest: false }));
  const strokes = new THREE.Group(), symmetry = new THREE.Group();
  root.add(gap, ghosts, contacts, contactDots, before, primitives, joints, strokes, symmetry);
  return { root, before, body, contactDots, contactMaterial, contacts, edgeMaterial, gap, ghostDepth, ghostEdgeMaterial, ghostMaterial, ghosts, joints, primitives, sketch, strokes, symmetry };
}

/** @param {number[]} numbers */
const pointsOf = (numbers) => new THREE.BufferGeometry().setAttribute('position', new THREE.Float32BufferAttribute(numbers, 3));

export class Stage {
  /** @param {() => void} draw  called when what is seen has changed */
  constructor(draw) {
    this.draw = draw;
    this.scene = new THREE.Scene();
    this.light = new THREE.DirectionalLight(0xffffff, 2.1);
    this.scene.add(new THREE.HemisphereLight(0xffffff, 0x8d8f95, 1.5), this.light, this.light.target);
    this.palette = palettes.light;
    this.direction = new THREE.Vector3(0, 0, 1);
    /** Distance of copies along the direction. */
    this.step = 0;
    /** Of the smallest ball around the object at rest, roughly. */
    this.radius = 1;
    this.centre = new THREE.Vector3();
    this.copiesAbove = 2;
    this.copiesBelow = 1;
    /** What is shown. @type {Record<string, boolean>} */
    this.layers = { ghosts: true, contacts: true, before: false, parts: false, primitives: false, joints: false, symmetry: false, gap: false };
    this.envelopes = /** @type {import('./gap_surface.js').Envelopes | null} */ (null);
    /** Whether another design than the one at rest is outlined. */
    this.outlines = false;
    this.selected = /** @type {Set<number>} */ (new Set());
    this.changed = false;
    this.surface = /** @type {MeshSurface | null} */ (null);
    this.objects = /** @type {ReturnType<typeof makeObjects> | null} */ (null);
    this.motion = 0;
    /** Counts the designs that were shown. */
    this.version = 0;
  }

  /** @param {import('./mesh_surface.js').MeshData} data */
  setMesh(data) {
    this.release();
    this.surface = new MeshSurface(data);
    const sphere = new THREE.Sphere().setFromPoints(
      Array.from({ length: data.vertices.length / 3 }, (_, v) => new THREE.Vector3().fromArray(data.vertices, 3 * v)));
    this.radius = sphere.radius;
    this.centre.copy(sphere.center);
    this.objects = makeObjects(this.surface);
    this.scene.add(this.objects.root);
    this.recolour();
  }

  /** Lets go of all that is drawn of a mesh. */
  release() {
    cancelAnimationFrame(this.motion);
    if (!this.objects) return;
    this.scene.remove(this.objects.root);
    release(this.objects.root);
    this.objects = this.surface = this.envelopes = null;
  }

  /** @param {import('./palettes.js').Palette} palette */
  setPalette(palette) {
    this.palette = palette;
    this.scene.background = new THREE.Color(palette.ground);
    this.recolour();
  }

  recolour() {
    const { palette, objects } = this;
    if (!this.surface || !objects) return;
    const base = new THREE.Color(this.changed ? palette.changed : palette.rest), chosen = new THREE.Color(palette.choice);
    this.surface.paint((part) => {
      const own = this.layers.parts ? partColours[part % partColours.length] : base;
      return this.selected.has(part) ? own.clone().lerp(chosen, 0.6) : own;
    });
    objects.edgeMaterial.color.setHex(palette.edge);
    objects.ghostMaterial.color.setHex(palette.ghost);
    objects.ghostEdgeMaterial.color.setHex(palette.ghostEdge);
    objects.contactMaterial.color.setHex(palette.contact);
    objects.contactDots.material.color.setHex(palette.contact);
    objects.before.material.color.setHex(palette.before);
    objects.primitives.material.color.setHex(palette.choice);
    objects.joints.material.color.setHex(palette.joint);
    this.#paintGap();
    this.draw();
  }

  /** @param {Record<string, boolean>} layers */
  setLayers(layers) {
    Object.assign(this.layers, layers);
    this.#place();
    this.recolour();
  }

  /** @param {number} above @param {number} below */
  setCopies(above, below) {
    this.copiesAbove = above;
    this.copiesBelow = below;
    this.#place();
    this.draw();
  }

  /**
   * Shows a design: its vertices, and copies at multiples of `step` along the direction.
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
    ++this.version;
    this.#place();
    this.draw();
  }

  /** Puts copies and layers where they belong. */
  #place() {
    const { layers, objects } = this;
    if (!objects) return;
    const wanted = layers.ghosts ? [...Array(this.copiesBelow).keys()].map((k) => -k - 1).concat([...Array(this.copiesAbove).keys()].map((k) => k + 1)) : [];
    while (objects.ghosts.children.length > wanted.length) objects.ghosts.remove(objects.ghosts.children[objects.ghosts.children.length - 1]);
    while (objects.ghosts.children.length < wanted.length) objects.ghosts.add(this.#ghost(objects));
    wanted.forEach((copy, k) => objects.ghosts.children[k].position.copy(this.direction).multiplyScalar(copy * this.step));
    objects.contacts.visible = objects.contactDots.visible = layers.contacts && layers.ghosts;
    objects.before.visible = layers.before || this.outlines;
    objects.primitives.visible = layers.primitives;
    objects.joints.visible = layers.joints;
    objects.symmetry.visible = layers.symmetry;
    objects.gap.visible = layers.gap;
  }

  /** @param {ReturnType<typeof makeObjects>} objects */
  #ghost(objects) {
    const depth = new THREE.Mesh(objects.body.geometry, objects.ghostDepth), colour = new THREE.Mesh(objects.body.geometry, objects.ghostMaterial);
    const edges = new THREE.LineSegments(this.surface?.edgeGeometry, objects.ghostEdgeMaterial);
    const sketch = new THREE.Mesh(objects.sketch.geometry, objects.ghostMaterial);
    sketch.frustumCulled = sketch.visible = false;
    depth.renderOrder = 2;
    colour.renderOrder = sketch.renderOrder = 3;
    edges.renderOrder = 4;
    return new THREE.Group().add(depth, colour, edges, sketch);
  }

  /** @param {boolean} sketched  whether surfaces are drawn coarsely for now */
  sketch(sketched) {
    const { objects } = this;
    if (!objects) return;
    objects.body.visible = !sketched;
    objects.sketch.visible = sketched;
    for (const { children: [depth, colour, , sketch] } of objects.ghosts.children) {
      depth.visible = colour.visible = !sketched;
      sketch.visible = sketched;
    }
  }

  /** @param {ArrayLike<number>} direction */
  setDirection(direction) {
    this.direction.fromArray(Array.from(direction)).normalize();
    this.#place();
    this.draw();
  }

  /** @param {boolean} changed  whether the object is not the one at rest any more */
  setChanged(changed) {
    if (changed === this.changed) return;
    this.changed = changed;
    this.recolour();
  }

  /** @param {Iterable<number>} parts */
  select(parts) {
    this.selected = new Set(parts);
    this.recolour();
  }

  /** @param {Float32Array} corners  of triangles  @param {number[][]} centres  of regions */
  setContacts(corners, centres) {
    const { objects } = this;
    if (!objects) return;
    objects.contacts.geometry.dispose();
    objects.contacts.geometry = new THREE.BufferGeometry().setAttribute('position', new THREE.BufferAttribute(corners, 3));
    objects.contactDots.geometry.dispose();
    objects.contactDots.geometry = pointsOf(centres.flat());
    this.draw();
  }

  /** @param {import('./gap_surface.js').Envelopes | null} envelopes  of what is shown, seen along the direction */
  setEnvelopes(envelopes) {
    if (this.envelopes === envelopes) return;
    this.envelopes = envelopes;
    this.#paintGap();
    this.draw();
  }

  #paintGap() {
    const { envelopes, objects, palette } = this;
    if (!objects) return;
    objects.gap.geometry.dispose();
    objects.gap.geometry = envelopes ? gapGeometry(envelopes, palette) : new THREE.BufferGeometry();
  }

  /** Outlines another design in the layer `before`; null: the one at rest. @param {Float32Array | null} vertices */
  setBefore(vertices) {
    const { objects } = this;
    if (!this.surface || !objects) return;
    const { edges } = this.surface, position = objects.before.geometry.attributes.position;
    const from = vertices ?? this.surface.mesh.vertices;
    for (let e = 0; e < edges.length; ++e)
      position.setXYZ(e, from[3 * edges[e]], from[3 * edges[e] + 1], from[3 * edges[e] + 2]);
    position.needsUpdate = true;
    objects.before.geometry.boundingSphere = null;
    this.outlines = vertices !== null;
    objects.before.visible = this.outlines || this.layers.before;
    this.draw();
  }

  /** @param {import('./primitive_lines.js').Primitive[]} primitives */
  setPrimitives(primitives) {
    const { objects } = this;
    if (!objects) return;
    objects.primitives.geometry.dispose();
    objects.primitives.geometry = pointsOf(primitiveLines(primitives));
    this.draw();
  }

  /** @param {number[][]} points @param {{kind: string, point: number[], axis: number[]}[]} symmetries */
  setRelations(points, symmetries) {
    const { objects } = this;
    if (!objects) return;
    objects.joints.geometry.dispose();
    objects.joints.geometry = pointsOf(points.flat());
    empty(objects.symmetry);
    for (const symmetry of symmetries) objects.symmetry.add(symmetry.kind === 'reflection' ? this.#plane(symmetry) : this.#axis(symmetry));
    this.draw();
  }

  /** @param {{point: number[], axis: number[]}} symmetry */
  #plane({ point, axis }) {
    const normal = new THREE.Vector3().fromArray(axis), size = 2.2 * this.radius;
    const plane = new THREE.Mesh(new THREE.PlaneGeometry(size, size),
      new THREE.MeshBasicMaterial({ color: this.palette.plane, transparent: true, opacity: 0.12, side: THREE.DoubleSide, depthWrite: false }));
    plane.renderOrder = 5;
    plane.position.copy(this.centre).addScaledVector(normal, new THREE.Vector3().fromArray(point).sub(this.centre).dot(normal));
    plane.quaternion.setFromUnitVectors(new THREE.Vector3(0, 0, 1), normal);
    return plane;
  }

  /** @param {{point: number[], axis: number[]}} symmetry */
  #axis({ point, axis }) {
    const direction = new THREE.Vector3().fromArray(axis), along = direction.clone().multiplyScalar(1.3 * this.radius);
    const on = new THREE.Vector3().fromArray(point), centre = on.clone().addScaledVector(direction, this.centre.clone().sub(on).dot(direction));
    return new THREE.Line(new THREE.BufferGeometry().setFromPoints([centre.clone().sub(along), centre.clone().add(along)]),
      new THREE.LineBasicMaterial({ color: this.palette.plane }));
  }

  /** Paints triangles over the object. @param {Set<number>[]} strokes */
  setStrokes(strokes) {
    const { objects, surface } = this;
    if (!objects || !surface) return;
    empty(objects.strokes);
    strokes.forEach((triangles, k) => {
      const corners = [];
      for (const triangle of triangles)
        for (let corner = 0; corner < 3; ++corner)
          for (let i = 0; i < 3; ++i) corners.push(surface.vertices[3 * surface.mesh.triangles[3 * triangle + corner] + i]);
      const painted = new THREE.Mesh(pointsOf(corners),
        new THREE.MeshBasicMaterial({ color: strokeColour(k), side: THREE.DoubleSide, polygonOffset: true, polygonOffsetFactor: -2, polygonOffsetUnits: -2 }));
      painted.renderOrder = 1;
      objects.strokes.add(painted);
    });
    this.draw();
  }
}

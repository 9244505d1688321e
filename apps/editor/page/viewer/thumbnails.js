// Small pictures of designs, with a renderer of their own: reading back from that of the view would wait for it.
import * as THREE from 'three';
import { MeshSurface } from './mesh_surface.js';
import { release } from './release.js';

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

/** Draws small pictures of designs as they are seen in a viewer. */
export class ThumbnailPainter {
  /** @param {import('./viewer.js').Viewer} viewer */
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
    const { surface } = this.viewer.main;
    if (!surface || this.surface?.mesh === surface.mesh) return;
    this.scene.remove(this.group);
    release(this.group);
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
   * @param {import('./viewer.js').SmallLook} look
   */
  paint(canvas, vertices, look) {
    this.#prepare();
    if (!this.surface) return;
    const { viewer } = this, { palette } = viewer;
    const moved = look.against ? partsThatMoved(this.surface.mesh, look.against, vertices, 0.004 * viewer.main.radius) : new Set();
    const still = new THREE.Color(palette.rest), changed = new THREE.Color(palette.changed);
    this.surface.paint((part) => (moved.has(part) ? changed : still));
    this.surface.set(vertices);
    this.ghost.material.color.setHex(palette.ghost);
    this.edges.material.color.setHex(palette.edge);
    const direction = look.direction ? new THREE.Vector3().fromArray(look.direction).normalize() : viewer.main.direction;
    this.ghost.position.copy(direction).multiplyScalar(look.step);
    const width = canvas.width, height = canvas.height, scale = 2;
    this.camera.aspect = width / height;
    const radius = viewer.main.radius + look.step / 2, centre = viewer.main.centre.clone().addScaledVector(direction, look.step / 2);
    const distance = (0.98 * radius) / Math.sin((this.camera.fov * Math.PI) / 360);
    const eye = viewer.camera.position.clone().sub(viewer.controls.target).normalize();
    this.camera.position.copy(centre).addScaledVector(eye, distance);
    this.camera.near = distance / 100;
    this.camera.far = distance * 10;
    this.camera.lookAt(centre);
    this.camera.updateProjectionMatrix();
    this.light.position.copy(this.camera.position).add(new THREE.Vector3(0, 0, 2 * viewer.main.radius));
    this.scene.background = new THREE.Color(palette.ground);
    this.renderer.setSize(scale * width, scale * height, false);
    this.renderer.render(this.scene, this.camera);
    const context = canvas.getContext('2d');
    if (!context) return;
    context.imageSmoothingQuality = 'high';
    context.drawImage(this.renderer.domElement, 0, 0, width, height);
  }
}

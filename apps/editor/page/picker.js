// Which triangle of the object is under the mouse.
import { Mesh } from 'three';
import { MeshBVH, acceleratedRaycast } from 'three-mesh-bvh';

/** For members that are added to objects of three.js. @param {any} object */
const asAny = (object) => object;

export class Picker {
  /** @param {import('./viewer/viewer.js').Viewer} viewer */
  constructor(viewer) {
    this.viewer = viewer;
    this.body = /** @type {Mesh | null} */ (null);
    this.tree = /** @type {MeshBVH | null} */ (null);
    this.version = -1;
  }

  /** The point and the triangle under a place of the window. @param {number} x @param {number} y */
  pick(x, y) {
    const { main } = this.viewer;
    if (!main.surface || !main.objects || !this.viewer.isMain(x)) return null;
    this.#follow(main.objects.body, main.version);
    const ray = this.viewer.rayAt(x, y);
    asAny(ray).firstHitOnly = true;
    const hit = ray.intersectObject(main.objects.body, false)[0];
    if (!hit || hit.faceIndex == null) return null;
    const triangle = hit.faceIndex;
    return { point: hit.point, part: main.surface.partOf[main.surface.index[3 * triangle]], triangle };
  }

  /** Keeps the tree of boxes with the mesh. @param {Mesh} body @param {number} version */
  #follow(body, version) {
    if (this.body !== body || !this.tree) {
      this.tree = new MeshBVH(body.geometry, { indirect: true });
      asAny(body.geometry).boundsTree = this.tree;
      body.raycast = acceleratedRaycast;
      this.body = body;
    } else if (this.version !== version) {
      this.tree.refit();
    }
    this.version = version;
  }
}

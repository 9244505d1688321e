// What the page uses of three-mesh-bvh.
import type { BufferGeometry, Mesh } from 'three';

export class MeshBVH {
  constructor(geometry: BufferGeometry, options?: { indirect?: boolean });
  refit(): void;
}
export const acceleratedRaycast: Mesh['raycast'];

// What the graphics card holds of objects stays there until it is told to let go.

/** Lets go of objects and all that is in them. @param {import('three').Object3D} root */
export function release(root) {
  root.traverse((object) => {
    const { geometry, material } = /** @type {Partial<import('three').Mesh>} */ (object);
    geometry?.dispose();
    for (const one of [material ?? []].flat()) one.dispose();
  });
}

/** Takes out all that is in a group. @param {import('three').Group} group */
export function empty(group) {
  group.children.forEach(release);
  group.clear();
}

// A triangle mesh whose vertices move while its triangles stay: what three.js draws of it.
import * as THREE from 'three';
import { coarseIndex } from './coarse_index.js';

const creaseCosine = Math.cos((32 * Math.PI) / 180);

/** Triangles of a coarse surface, about. */
const coarseTriangles = 2500;

/**
 * @typedef {object} MeshData
 * @property {Float32Array} vertices  three numbers per vertex, at rest
 * @property {Uint32Array} triangles  three vertices per triangle
 * @property {Uint32Array} parts  one per triangle
 */

/**
 * Numbers vertices so that those at one place have one number: meshes often repeat them.
 * @param {Float32Array} vertices
 */
function weld(vertices) {
  const words = new Uint32Array(vertices.buffer, vertices.byteOffset, vertices.length);
  /** @type {Map<string, number>} */
  const known = new Map();
  const result = new Uint32Array(vertices.length / 3);
  for (let v = 0; v < result.length; ++v) {
    const key = words[3 * v] + ',' + words[3 * v + 1] + ',' + words[3 * v + 2];
    let id = known.get(key);
    if (id === undefined) known.set(key, (id = known.size));
    result[v] = id;
  }
  return result;
}

/**
 * @param {ArrayLike<number>} p
 * @param {Uint32Array} triangles
 * @param {Float32Array} normals  out: three numbers per triangle, their length is twice the area
 */
function faceNormals(p, triangles, normals) {
  for (let t = 0; t < triangles.length; t += 3) {
    const a = 3 * triangles[t], b = 3 * triangles[t + 1], c = 3 * triangles[t + 2];
    const ux = p[b] - p[a], uy = p[b + 1] - p[a + 1], uz = p[b + 2] - p[a + 2];
    const vx = p[c] - p[a], vy = p[c + 1] - p[a + 1], vz = p[c + 2] - p[a + 2];
    normals[t] = uy * vz - uz * vy;
    normals[t + 1] = uz * vx - ux * vz;
    normals[t + 2] = ux * vy - uy * vx;
  }
}

/** The drawn surface. Where it is smooth at rest it is shaded smoothly, and creases are lines. */
export class MeshSurface {
  /** @param {MeshData} mesh */
  constructor(mesh) {
    this.mesh = mesh;
    this.faces = new Float32Array(mesh.triangles.length);
    faceNormals(mesh.vertices, mesh.triangles, this.faces);
    const welded = weld(mesh.vertices);
    const { index, source, partOf } = this.#cluster(welded);
    /** Drawn vertices of the corners. */
    this.index = index;
    /** Vertex of the mesh that a drawn vertex is. */
    this.source = source;
    /** Part of a drawn vertex. */
    this.partOf = partOf;
    this.geometry = new THREE.BufferGeometry();
    this.geometry.setIndex(new THREE.BufferAttribute(this.index, 1));
    this.positions = new Float32Array(3 * this.source.length);
    this.normals = new Float32Array(3 * this.source.length);
    this.colours = new Float32Array(3 * this.source.length).fill(1);
    this.geometry.setAttribute('position', new THREE.BufferAttribute(this.positions, 3));
    this.geometry.setAttribute('normal', new THREE.BufferAttribute(this.normals, 3));
    this.geometry.setAttribute('color', new THREE.BufferAttribute(this.colours, 3));
    this.edges = this.#creases(welded);
    this.edgeGeometry = new THREE.BufferGeometry();
    this.edgePositions = new Float32Array(3 * this.edges.length);
    this.edgeGeometry.setAttribute('position', new THREE.BufferAttribute(this.edgePositions, 3));
    /** @type {Float32Array} */
    this.vertices = mesh.vertices;
    this.set(mesh.vertices);
    /** The surface with fewer triangles, if it has many. */
    this.coarse = this.#coarse();
  }

  #coarse() {
    if (this.index.length <= 3 * coarseTriangles) return this.geometry;
    let area = 0;
    for (let face = 0; face < this.faces.length; face += 3)
      area += Math.hypot(this.faces[face], this.faces[face + 1], this.faces[face + 2]) / 2;
    const coarse = new THREE.BufferGeometry();
    for (const [name, attribute] of Object.entries(this.geometry.attributes)) coarse.setAttribute(name, attribute);
    // Two triangles per cell that the surface crosses.
    return coarse.setIndex(new THREE.BufferAttribute(coarseIndex(this, Math.sqrt((2 * area) / coarseTriangles) || 1), 1));
  }

  /**
   * Gives every corner of a triangle the drawn vertex of its neighbours that are about parallel.
   * @param {Uint32Array} welded
   */
  #cluster(welded) {
    const { triangles, parts } = this.mesh;
    /** @type {{face: number, vertex: number}[][]} */
    const clustersAt = [];
    const source = [], partOf = [];
    const index = new Uint32Array(triangles.length);
    for (let corner = 0; corner < triangles.length; ++corner) {
      const face = 3 * Math.floor(corner / 3), place = welded[triangles[corner]];
      const clusters = (clustersAt[place] ??= []);
      let found = -1;
      for (const { face: other, vertex } of clusters) {
        if (partOf[vertex] !== parts[face / 3]) continue;
        const dot = this.#dot(face, other);
        if (dot >= creaseCosine) { found = vertex; break; }
      }
      if (found < 0) {
        found = source.length;
        source.push(triangles[corner]);
        partOf.push(parts[face / 3]);
      }
      if (clusters.length < 24) clusters.push({ face, vertex: found });
      index[corner] = found;
    }
    return { index, source: Uint32Array.from(source), partOf: Uint32Array.from(partOf) };
  }

  /** @param {number} a @param {number} b  offsets of two faces */
  #dot(a, b) {
    const n = this.faces;
    const length = Math.hypot(n[a], n[a + 1], n[a + 2]) * Math.hypot(n[b], n[b + 1], n[b + 2]);
    return length > 0 ? (n[a] * n[b] + n[a + 1] * n[b + 1] + n[a + 2] * n[b + 2]) / length : 1;
  }

  /** @param {Uint32Array} welded @returns {Uint32Array} pairs of vertices */
  #creases(welded) {
    const { triangles } = this.mesh;
    /** @type {Map<number, {face: number, from: number, to: number, crease: boolean}>} */
    const sides = new Map();
    const count = welded.length;
    for (let corner = 0; corner < triangles.length; ++corner) {
      const face = 3 * Math.floor(corner / 3), next = face + ((corner - face + 1) % 3);
      const a = welded[triangles[corner]], b = welded[triangles[next]];
      if (a === b) continue;
      const key = Math.min(a, b) * count + Math.max(a, b);
      const known = sides.get(key);
      if (known) known.crease = this.#dot(face, known.face) < creaseCosine;
      else sides.set(key, { face, from: triangles[corner], to: triangles[next], crease: true });
    }
    const edges = [];
    for (const side of sides.values()) if (side.crease) edges.push(side.from, side.to);
    return Uint32Array.from(edges);
  }

  /** Moves the vertices. @param {Float32Array} vertices */
  set(vertices) {
    this.vertices = vertices;
    const { source, positions, normals, edges, edgePositions } = this;
    for (let v = 0; v < source.length; ++v) {
      const from = 3 * source[v];
      positions[3 * v] = vertices[from];
      positions[3 * v + 1] = vertices[from + 1];
      positions[3 * v + 2] = vertices[from + 2];
    }
    faceNormals(vertices, this.mesh.triangles, this.faces);
    normals.fill(0);
    for (let corner = 0; corner < this.index.length; ++corner) {
      const face = 3 * Math.floor(corner / 3), to = 3 * this.index[corner];
      normals[to] += this.faces[face];
      normals[to + 1] += this.faces[face + 1];
      normals[to + 2] += this.faces[face + 2];
    }
    for (let v = 0; v < normals.length; v += 3) {
      const length = Math.hypot(normals[v], normals[v + 1], normals[v + 2]) || 1;
      normals[v] /= length;
      normals[v + 1] /= length;
      normals[v + 2] /= length;
    }
    for (let e = 0; e < edges.length; ++e)
      for (let k = 0; k < 3; ++k) edgePositions[3 * e + k] = vertices[3 * edges[e] + k];
    this.geometry.attributes.position.needsUpdate = true;
    this.geometry.attributes.normal.needsUpdate = true;
    this.edgeGeometry.attributes.position.needsUpdate = true;
    this.geometry.boundingSphere = null;
    this.geometry.boundingBox = null;
    this.edgeGeometry.boundingSphere = null;
  }

  /** Colours the parts. @param {(part: number) => THREE.Color} colourOf */
  paint(colourOf) {
    /** @type {Map<number, THREE.Color>} */
    const known = new Map();
    for (let v = 0; v < this.partOf.length; ++v) {
      let colour = known.get(this.partOf[v]);
      if (!colour) known.set(this.partOf[v], (colour = colourOf(this.partOf[v])));
      colour.toArray(this.colours, 3 * v);
    }
    this.geometry.attributes.color.needsUpdate = true;
  }
}

// Measures the 3-D view that the editor and the pages of `improve` have: frames while an object turns, the time of
// one frame, and what a step of a drag costs the page.
import { Viewer } from '/apps/editor/page/viewer/viewer.js';

const query = new URLSearchParams(location.search);
/** Seconds in which a view without a graphics card finds out that it has to sketch. */
const warmUp = 3;
const seconds = Number(query.get('seconds')), parts = 8;

/** A wavy ring of about `count` triangles. @param {number} count @param {number} phase */
function ring(count, phase = 0) {
  const around = Math.round(Math.sqrt(count)), across = Math.round(count / 2 / around);
  const vertices = new Float32Array(3 * around * across), triangles = new Uint32Array(6 * around * across), of = new Uint32Array(2 * around * across);
  for (let i = 0, t = 0; i < around; ++i)
    for (let j = 0; j < across; ++j) {
      const u = (2 * Math.PI * i) / around, v = (2 * Math.PI * j) / across, r = 0.35 + 0.02 * Math.sin(9 * u + phase);
      vertices.set([(1 + r * Math.cos(v)) * Math.cos(u), (1 + r * Math.cos(v)) * Math.sin(u), r * Math.sin(v)], 3 * (i * across + j));
      const next = (i + 1) % around, beside = (j + 1) % across, part = Math.floor((parts * i) / around);
      for (const corners of [[i * across + j, next * across + j, next * across + beside], [i * across + j, next * across + beside, i * across + beside]]) {
        triangles.set(corners, 3 * t);
        of[t++] = part;
      }
    }
  return { vertices, triangles, parts: of };
}

const frame = () => new Promise(requestAnimationFrame);
const median = (/** @type {number[]} */ values) => values.sort((a, b) => a - b)[Math.floor(values.length / 2)];

/** Median milliseconds of what `work` does, the drawing it causes included. */
function time(viewer, work, repetitions = 31) {
  const gl = viewer.renderer.getContext(), pixel = new Uint8Array(4), times = [];
  for (let k = 0; k < repetitions; ++k) {
    const begin = performance.now();
    work(k);
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);  // waits until all is drawn
    times.push(performance.now() - begin);
  }
  return median(times);
}

/** Frames per second while an object turns. @param {Viewer} viewer @param {number} seconds */
async function turnFor(viewer, seconds) {
  const first = viewer.framesDrawn, start = performance.now();
  while (performance.now() - start < 1000 * seconds) {
    viewer.turn(0.02, 0);
    await frame();
  }
  return ((viewer.framesDrawn - first) * 1000) / (performance.now() - start);
}

/** @param {number} count  of triangles */
async function measure(count) {
  const viewer = new Viewer(document.querySelector('canvas')), mesh = ring(count), moved = ring(count, 0.4).vertices;
  const begin = performance.now();
  viewer.setMesh(mesh);
  viewer.main.show(mesh.vertices, 0.5);
  viewer.resize();
  viewer.fit();
  await frame();
  await frame();
  const open = performance.now() - begin, gl = viewer.renderer.getContext();
  const draw = () => viewer.renderer.render(viewer.main.scene, viewer.camera);
  const drawn = time(viewer, draw);
  const step = time(viewer, (k) => viewer.main.show(k % 2 ? mesh.vertices : moved, 0.5));
  await turnFor(viewer, warmUp);
  const frames = await turnFor(viewer, seconds);
  const known = gl.getExtension('WEBGL_debug_renderer_info');
  return { triangles: mesh.triangles.length / 3, frames_per_second: frames, frame_ms: drawn, step_ms: step, open_ms: open,
    renderer: gl.getParameter(known ? known.UNMASKED_RENDERER_WEBGL : gl.RENDERER) };
}

let answer;
try {
  answer = await measure(Number(query.get('triangles')));
} catch (error) {
  answer = { error: String(error) };
}
await fetch('/found', { method: 'POST', body: JSON.stringify(answer) });

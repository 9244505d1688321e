// The WebSocket to the program: JSON both ways, and frames of little-endian numbers from it.

/** Kinds of frames, as apps/editor/state_json.h has them. */
export const frameKind = { mesh: 1, shown: 2, suggestion: 3, node: 4, found: 5, contacts: 6, envelopes: 7 };

/**
 * @typedef {object} Frame
 * @property {number} kind
 * @property {number} number
 * @property {number} count
 * @property {number} stamp
 * @property {ArrayBuffer} buffer
 */

const headBytes = 16;

/** Tries to reach the program in a row, further and further apart: three quarters of a minute. */
const maxTries = 20;

/** Reads the head of a frame. @param {ArrayBuffer} buffer @returns {Frame} */
export function frameOf(buffer) {
  const head = new DataView(buffer);
  const [kind, number, count, stamp] = [0, 4, 8, 12].map((at) => head.getUint32(at, true));
  return { kind, number, count, stamp, buffer };
}

/** The vertices of a frame. @param {Frame} frame */
export function verticesOf(frame) {
  return new Float32Array(frame.buffer, headBytes, 3 * frame.count);
}

/** The mesh of a frame. @param {Frame} frame @returns {import('./viewer/mesh_surface.js').MeshData} */
export function meshOf(frame) {
  const vertices = verticesOf(frame);
  const at = headBytes + vertices.byteLength;
  return {
    vertices,
    triangles: new Uint32Array(frame.buffer, at, 3 * frame.number),
    parts: new Uint32Array(frame.buffer, at + 12 * frame.number, frame.number),
  };
}

/** The envelopes of a frame. @param {Frame} frame */
export function envelopesOf(frame) {
  const [place, upper, lower] = [[0, 12], [12, frame.count], [12 + frame.count, frame.count]].map(([at, count]) => new Float32Array(frame.buffer, headBytes + 4 * at, count));
  return { columns: frame.number, place, upper, lower };
}

export class Connection {
  /**
   * @param {object} handlers
   * @param {(message: any) => void} handlers.message
   * @param {(frame: Frame) => void} handlers.frame
   * @param {(open: boolean) => void} handlers.open
   * @param {() => void} handlers.gaveUp  nobody answers, and it is not tried again
   */
  constructor(handlers) {
    this.handlers = handlers;
    this.socket = /** @type {WebSocket | null} */ (null);
    this.tries = 0;
    this.#connect();
  }

  #connect() {
    const address = new URL('socket', location.href);
    address.protocol = 'ws:';
    address.search = '';
    const socket = new WebSocket(address);
    socket.binaryType = 'arraybuffer';
    socket.onopen = () => {
      this.tries = 0;
      this.handlers.open(true);
    };
    socket.onmessage = (event) => {
      if (typeof event.data === 'string') this.handlers.message(JSON.parse(event.data));
      else this.handlers.frame(frameOf(event.data));
    };
    socket.onclose = () => {
      this.handlers.open(false);
      if (++this.tries < maxTries) setTimeout(() => this.#connect(), 250 * this.tries);
      else this.handlers.gaveUp();
    };
    this.socket = socket;
  }

  /** Tries again, after it gave up. */
  retry() {
    this.tries = 0;
    this.handlers.open(false);
    this.#connect();
  }

  /** @param {object} command */
  send(command) {
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(command));
  }
}

// As much of a WebSocket as the tests of the server need, on a plain connection (RFC 6455).
import crypto from 'node:crypto';
import net from 'node:net';

export class WebSocket {
  /** @param {URL} address */
  static open(address) {
    return new Promise((resolve, reject) => {
      const socket = net.connect(Number(address.port), '127.0.0.1', () =>
        socket.write(`GET ${address.pathname}socket HTTP/1.1\r\nHost: ${address.host}\r\nOrigin: http://${address.host}\r\n` +
          'Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n'));
      socket.once('error', reject);
      const own = new WebSocket(socket);
      own.opened = () => resolve(own);
    });
  }

  /** @param {net.Socket} socket */
  constructor(socket) {
    this.socket = socket;
    this.data = Buffer.alloc(0);
    this.head = true;
    /** @type {any[]} */
    this.messages = [];
    /** @type {{wanted: (message: any) => boolean, found: (message: any) => void}[]} */
    this.waiting = [];
    this.closed = new Promise((resolve) => socket.on('close', resolve));
    socket.on('error', () => {});
    socket.on('data', (data) => {
      this.data = Buffer.concat([this.data, data]);
      this.#read();
    });
  }

  #read() {
    if (this.head) {
      const end = this.data.indexOf('\r\n\r\n');
      if (end < 0) return;
      this.data = this.data.subarray(end + 4);
      this.head = false;
      this.opened();
    }
    while (this.data.length >= 2) {
      let length = this.data[1] & 127, at = 2;
      if (length === 126) { length = this.data.length < 4 ? Infinity : this.data.readUInt16BE(2); at = 4; }
      else if (length === 127) { length = this.data.length < 10 ? Infinity : Number(this.data.readBigUInt64BE(2)); at = 10; }
      if (this.data.length < at + length) return;
      const kind = this.data[0] & 15, body = this.data.subarray(at, at + length);
      this.data = this.data.subarray(at + length);
      if (kind === 1) this.#take(JSON.parse(body.toString()));
      if (kind === 8) this.socket.end();
    }
  }

  #take(message) {
    const at = this.waiting.findIndex((one) => one.wanted(message));
    if (at < 0) this.messages.push(message);
    else this.waiting.splice(at, 1)[0].found(message);
  }

  /** The next message of this kind; messages of other kinds stay. */
  next(wanted) {
    const at = this.messages.findIndex(wanted);
    if (at >= 0) return Promise.resolve(this.messages.splice(at, 1)[0]);
    return new Promise((found) => this.waiting.push({ wanted, found }));
  }

  /** @param {string} text */
  send(text) {
    const body = Buffer.from(text), mask = crypto.randomBytes(4);
    const head = body.length < 126 ? Buffer.from([0x81, 0x80 | body.length])
      : body.length < 65536 ? Buffer.from([0x81, 0xfe, body.length >> 8, body.length & 255])
        : Buffer.concat([Buffer.from([0x81, 0xff]), (() => { const size = Buffer.alloc(8); size.writeBigUInt64BE(BigInt(body.length)); return size; })()]);
    for (let k = 0; k < body.length; ++k) body[k] ^= mask[k & 3];
    this.socket.write(Buffer.concat([head, mask, body]));
  }

  close() { this.socket.end(); }
  destroy() { this.socket.resetAndDestroy(); }
}

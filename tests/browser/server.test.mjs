// What the server refuses, and that nothing of it harms a session.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import http from 'node:http';
import path from 'node:path';
import { after, before, test } from 'node:test';
import { Editor, Folder, seconds } from './editor.mjs';

let folder, editor, address;
before(async () => {
  folder = new Folder('cup.obj');
  editor = await Editor.start(folder, ['--keep-open']);
  address = new URL(editor.address);
});
after(async () => {
  await editor?.kill();
  folder?.remove();
});

/** @returns {Promise<{status: number, headers: http.IncomingHttpHeaders, body: string}>} */
const ask = (path, options = {}) =>
  new Promise((resolve, reject) => {
    const request = http.request({ host: '127.0.0.1', port: address.port, path, ...options }, (reply) => {
      let body = '';
      reply.on('data', (data) => (body += data));
      reply.on('end', () => resolve({ status: reply.statusCode, headers: reply.headers, body }));
    });
    request.on('upgrade', (reply, socket) => {
      socket.destroy();
      resolve({ status: reply.statusCode, headers: reply.headers, body: '' });
    });
    request.on('error', reject);
    request.end(options.body);
  });

const upgrade = (headers) => ({
  headers: { Connection: 'Upgrade', Upgrade: 'websocket', 'Sec-WebSocket-Version': '13', 'Sec-WebSocket-Key': 'dGhlIHNhbXBsZSBub25jZQ==', ...headers },
});

/** A WebSocket as the page has one, without a browser. */
async function socket() {
  const { WebSocket } = await import('./websocket.mjs');
  return WebSocket.open(address);
}

test('nothing is answered without the secret', async () => {
  for (const path of ['/', '/index.html', '/socket', '/export/obj', '/../etc/passwd'])
    assert.equal((await ask(path)).status, 404);
});

test('files of the page are there, others are not', async () => {
  const page = await ask(address.pathname);
  assert.equal(page.status, 200);
  assert.match(page.headers['content-type'], /text\/html/);
  assert.match(page.headers['content-security-policy'], /default-src 'self'/);
  assert.ok(!page.body.includes('{{nonce}}'));
  assert.equal(page.headers['access-control-allow-origin'], undefined);
  for (const path of ['cup.obj', '../cup.obj', '%2e%2e/cup.obj', 'export/exe', 'three/'])
    assert.equal((await ask(address.pathname + path)).status, 404, path);
});

test('a report tells of ten copies, or of as many as it is asked for', async () => {
  assert.match((await ask(address.pathname + 'export/html')).body, /10 copies</);
  const good = await ask(address.pathname + 'export/html?copies=12');
  assert.equal(good.status, 200);
  assert.match(good.body, /12 copies</);
  for (const query of ['?copies=', '?copies=1', '?copies=1001', '?copies=2x', '?copies=-3', '?copies=99999999999', '?n=3'])
    assert.equal((await ask(address.pathname + 'export/html' + query)).status, 400, query);
});

test('another host is refused: a name that somebody bound to 127.0.0.1', async () => {
  for (const host of ['evil.example', 'localhost.evil.example', '192.168.0.1'])
    assert.equal((await ask(address.pathname, { headers: { Host: host } })).status, 403, host);
  assert.equal((await ask(address.pathname, { headers: { Host: 'localhost:8080' } })).status, 200);
});

test('another site gets no socket', async () => {
  const path = address.pathname + 'socket', own = `http://127.0.0.1:${address.port}`;
  assert.equal((await ask(path, upgrade({ Origin: own }))).status, 101);
  for (const headers of [{}, { Origin: 'http://evil.example' }, { Origin: 'null' }, { Origin: 'http://127.0.0.1:1' }])
    assert.equal((await ask(path, upgrade(headers))).status, 403, JSON.stringify(headers));
  assert.equal((await ask(address.pathname, { method: 'POST', body: 'x' })).status, 403);
});

/** Sends the head of a POST whose body never comes. @returns {Promise<number>} the status */
const headOnly = (path, headers, length = 200 << 20) =>
  new Promise((resolve, reject) => {
    const request = http.request({ host: '127.0.0.1', port: address.port, path, method: 'POST', headers: { 'Content-Length': length, ...headers } }, (reply) => {
      reply.resume();
      resolve(reply.statusCode);
      request.destroy();
    });
    request.on('error', reject);
    request.flushHeaders();
  });

test('a large body is read only of a file that the page of this server sends', { timeout: seconds(20) }, async () => {
  const open = address.pathname + 'open?name=x.obj', Origin = address.origin;
  assert.equal(await headOnly('/open?name=x.obj', { Origin }), 404, 'no secret');
  assert.equal(await headOnly(open, { Origin: 'http://evil.example' }), 403, 'another site');
  assert.equal(await headOnly(open, { Origin, Host: 'evil.example' }), 403, 'another host');
  assert.equal(await headOnly(address.pathname + 'export/obj', { Origin }), 413, 'no path for files');
  assert.equal(await headOnly(open, { Origin }, 300 << 20), 413, 'a file that is too large');
  assert.equal((await ask(address.pathname, { method: 'POST', headers: { Origin, 'Transfer-Encoding': 'chunked' }, body: 'x'.repeat(1 << 20) }).catch(() => ({ status: 413 }))).status, 413, 'of unknown length');
  const reply = await ask(open, { method: 'POST', headers: { Origin }, body: '# '.padEnd(1 << 20, 'x') });
  assert.equal(reply.status, 422, 'it is read, and no mesh');
  assert.match(reply.body, /x\.obj/);
});

test('commands that are none are answered with a sentence, and the session stays', async () => {
  const page = await socket();
  const before = await page.next((message) => message.type === 'tree');
  for (const text of ['', '{', '[]', '7', '{"do": 3}', '{"do": "fly"}', '{"do": "apply"}', '{"do": "apply", "number": -1}',
    '{"do": "apply", "number": 1e9}', '{"do": "drag", "edit": "nothing"}', '{"do": "drag", "edit": "body move 0 0 1e300"}',
    '{"do": "target", "value": "much"}', '{"do": "direction", "direction": [0, 0, 0]}', '{"do": "limit", "measure": "beauty", "value": 1}',
    '{"do": "keep", "parts": [77]}', '{"do": "keep", "parts": [4294967296]}', '{"do": "picture", "node": 4294967296}', '{"do": "picture", "node": 4000000000}', '{"do": "picture", "node": "\ud800"}']) {
    page.send(text);
    const answer = await page.next((message) => message.type === 'error');
    assert.ok(answer.words.length > 5, text);
  }
  page.send('{"do": "write"}');
  page.close();
  const again = await socket();
  assert.deepEqual(await again.next((message) => message.type === 'tree'), before);
  again.close();
});

test('a message that is too large ends the page, not the program', async () => {
  const page = await socket();
  page.send('x'.repeat(5 << 20));
  await page.closed;
  assert.equal((await ask(address.pathname)).status, 200);
});

test('a page that vanishes in the middle of a drag leaves the design as it was', async () => {
  const page = await socket();
  await page.next((message) => message.type === 'tree');
  page.send('{"do": "drag", "edit": "body scale 1.05 along 1 0 0"}');
  await page.next((message) => message.type === 'design' && message.dragging);
  page.destroy();
  const again = await socket();
  const design = await again.next((message) => message.type === 'design');
  assert.ok(design.change < 1e-12);
  assert.equal(design.dragging, false);
  again.close();
});

test('only drags of one page replace each other, and no other command is one of them', async () => {
  const page = await socket(), reader = await socket();
  await reader.next((message) => message.type === 'tree');
  page.send('{"do": "write"}');
  for (let k = 0; k < 20; ++k) {
    page.send('{"do": "drag", "edit": "body scale 1.02 along 1 0 0"}');
    reader.send('{"do": "drag", "edit": "body scale 1.05 along 1 0 0"}');
  }
  for (let k = 0; k < 30; ++k) page.send('{"do": "keep", "parts": [0], "why": "drag"}');
  page.send('{"do": "target", "value": 0.66}');
  await page.next((message) => message.type === 'wishes' && message.target === 0.66);
  const told = page.messages.filter((message) => message.type === 'wishes' && message.kept.length);
  assert.ok(told.length >= 30, `${told.length} of 30 commands were obeyed`);
  assert.ok(page.messages.some((message) => message.type === 'design' && message.dragging), 'the drags of the page were not all replaced');
  page.send('{"do": "keep", "parts": []}');
  await page.next((message) => message.type === 'wishes' && !message.kept.length);
  page.close();
  reader.close();
});

test('a flood of commands ends the page, not the program, and others need not wait for it', async () => {
  const page = await socket(), other = await socket();
  await other.next((message) => message.type === 'tree');
  for (let k = 0; k < 20_000; ++k) page.send(`{"do": "target", "value": ${(k + 1) / 40_000}}`);
  await page.closed;
  assert.equal((await ask(address.pathname)).status, 200);
  other.send('{"do": "write"}');
  other.send('{"do": "target", "value": 0.75}');
  await other.next((message) => message.type === 'wishes' && message.target === 0.75);
  const obeyed = other.messages.filter((message) => message.type === 'wishes').length;
  assert.ok(obeyed < 1000, `${obeyed} commands of the flood were obeyed, which had 1000 waiting when it was closed`);
  other.close();
});

test('a session that goes on wants what the command line says', async () => {
  const other = new Folder('cup.obj');
  const wishes = async (...options) => {
    const program = await Editor.start(other, options);
    try {
      const { WebSocket } = await import('./websocket.mjs');
      const page = await WebSocket.open(new URL(program.address));
      const { target, within } = await page.next((message) => message.type === 'wishes');
      page.send('{"do": "write"}');
      page.send('{"do": "keep", "parts": [0]}'); // saved with it
      await page.next((message) => message.type === 'wishes' && message.kept.length);
      page.close();
      await program.ended;
      return { target, within };
    } finally {
      await program.kill();
    }
  };
  try {
    const room = await wishes('--copies', '5', '--within', '0.15');
    assert.deepEqual(room.within, { copies: 5, length: 0.15 });
    assert.ok(room.target > 0.8 && room.target < 0.9, `S ${room.target}`);
    assert.deepEqual(await wishes(), room);
    assert.deepEqual(await wishes('--target', '0.85'), { target: 0.85, within: null });
    await assert.rejects(Editor.start(other, ['--copies', '5']), /--copies and --within go together/);
    await assert.rejects(Editor.start(other, ['--target', '0.8', '--copies', '5', '--within', '1']), /give one of them/);
    await assert.rejects(Editor.start(other, ['--copies', '5', '--within', '0.01']), /room/);
  } finally {
    other.remove();
  }
});

test('a dropped file replaces no file, and no session of another shape', async () => {
  const cube = ['o cube', ...[0, 1].flatMap((x) => [0, 1].flatMap((y) => [0, 1].map((z) => `v ${x} ${y} ${z}`))),
    'f 1 3 4 2', 'f 5 6 8 7', 'f 1 2 6 5', 'f 3 7 8 4', 'f 1 5 7 3', 'f 2 4 8 6', ''].join('\n');
  const drop = (name, body) =>
    ask(`${address.pathname}open?name=${encodeURIComponent(name)}`, { method: 'POST', headers: { Origin: address.origin }, body });
  const others = () => ({ ...folder.contents(), 'cup.obj.session.json': 'may be saved at any time' });
  const refused = async (name, body, words) => {
    const before = others();
    const reply = await drop(name, body);
    assert.equal(reply.status, 422, name);
    assert.match(reply.body, words);
    assert.deepEqual(others(), before, name);
  };
  for (const name of ['', '.hidden.obj', '../cube.obj', 'a/b.obj', 'a\\b.obj', 'a\0.obj']) await refused(name, cube, /no name of a mesh file/);
  await refused('cube.txt', cube, /cube\.txt/);
  await refused('broken.obj', 'v 1 x\n', /expected the y coordinate/);
  await refused('cup.obj', cube, /exists and is another file/);

  fs.copyFileSync(folder.session, path.join(folder.path, 'cube.obj.session.json'));
  await refused('cube.obj', cube, /is not the file that .*cube\.obj\.session\.json was made of: move one of them away/);
  fs.writeFileSync(path.join(folder.path, 'cube.obj.session.json'), 'notes of a person');
  await refused('cube.obj', cube, /cube\.obj\.session\.json/);
  fs.rmSync(path.join(folder.path, 'cube.obj.session.json'));

  assert.equal((await drop('cube.obj', cube)).status, 200);
  assert.equal(folder.contents()['cube.obj'], cube);
});

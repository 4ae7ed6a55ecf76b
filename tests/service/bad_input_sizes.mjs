// Tests input that is too large or too slow: the service may accept only a limited part of such input before it refuses
// the rest.
import net from 'node:net';
import { answersIn, must, place, requestBytes, sleep, talk } from './http_probe.mjs';
import { mustBeWell, problemIn, residentMebibytes } from './bad_input_rows.mjs';

const kMebibyte = 1 << 20;

/**
 * Sends one chunk of a body after the other, waiting after each for a refusal: the service may accept only a little
 * more than its limit.
 */
export async function tooManyChunks({ base, operations }) {
  const piece = Buffer.alloc(1 << 16, 'a');
  let sent = 0;
  const said = await talk(base, async (socket, stopped) => {
    let answered = false;
    socket.once('data', () => { answered = true; });
    socket.write(requestBytes(base, { method: 'POST', target: '/api/v1/validate',
      headers: { 'Content-Type': 'model/stl', 'Transfer-Encoding': 'chunked' } }));
    while (!answered && !stopped.now && sent < 64 * kMebibyte) {
      socket.write(Buffer.concat([Buffer.from('10000\r\n'), piece, Buffer.from('\r\n')]));
      sent += piece.length;
      for (let i = 0; i < 200 && sent > kMebibyte && !answered; ++i) await sleep(10);
    }
  }, { wanted: Infinity, patience: 30000 });
  problemIn(said.answers[0], 413, 'too_large');
  must(said.closed && said.answers.length === 1, 'the connection was not closed');
  must(sent > kMebibyte, `refused after ${sent} bytes, within the limit`);
  must(sent <= kMebibyte + 2 * piece.length, `${sent} bytes were taken`);
  console.log(`        ${sent} bytes of chunks were sent where ${kMebibyte} are taken`);
  await mustBeWell(operations);
}

/**
 * Sends a line that never ends: the service must refuse it early and close the connection, and its memory must not
 * grow.
 */
export async function hugeLine({ base, operations, pid }, beginning, status, code) {
  const { host, port } = place(base);
  const piece = Buffer.alloc(1 << 16, 'a'), before = residentMebibytes(pid);
  let most = before, sent = 0, over = false;
  const pieces = [];
  await new Promise((resolve, reject) => {
    const socket = net.connect({ host, port, allowHalfOpen: true });
    const end = (settle, value) => { over = true; clearTimeout(timer); socket.destroy(); settle(value); };
    const timer = setTimeout(() => end(reject, new Error('the connection stays open')), 30000);
    socket.on('connect', async () => {
      socket.write(beginning);
      while (!over && sent < 100 * kMebibyte) {
        sent += piece.length;
        const goesOn = socket.write(piece);
        most = Math.max(most, residentMebibytes(pid));
        if (!goesOn) await Promise.race([new Promise((ready) => socket.once('drain', ready)), sleep(1000)]);
        else await sleep(0);
      }
    });
    socket.on('data', (bytes) => pieces.push(bytes));
    socket.on('error', () => end(resolve));
    socket.on('close', () => end(resolve));
  });
  problemIn(answersIn(Buffer.concat(pieces)).answers[0], status, code);
  must(sent < 40 * kMebibyte, `${sent} bytes could be sent`);
  must(most - before < 8, `the service grew by ${(most - before).toFixed(1)} MiB`);
  console.log(`        closed after ${(sent / kMebibyte).toFixed(1)} MiB, grown by ${(most - before).toFixed(2)} MiB`);
  await mustBeWell(operations);
}

/**
 * Starts slow clients, which run while other tests do. Returns pairs [name, promise of an error, or of null if the
 * client passed].
 */
export function slowly({ base, operations }) {
  const drip = (beginning, bytes) => (socket, stopped) => {
    socket.write(beginning);
    const timer = setInterval(() => { if (stopped.now) clearInterval(timer); else socket.write(bytes); }, 1000);
  };
  const field = `GET / HTTP/1.1\r\nHost: ${place(base).name}\r\nX-Slow: `;
  const post = (headers) => requestBytes(base, { method: 'POST', target: '/api/v1/validate',
    headers: { 'Content-Type': 'model/stl', ...headers } });
  const late = (play, least, most) => async () => {
    const said = await talk(base, play, { wanted: Infinity, patience: 90000 });
    problemIn(said.answers[0], 408, 'timeout');
    must(said.answers[0].headers.connection === 'close' && said.closed, 'the connection was not closed');
    must(said.seconds > least && said.seconds < most, `answered after ${said.seconds.toFixed(1)} s`);
    await mustBeWell(operations);
  };
  const clients = {
    '408, a head of a byte a second': late(drip('GET / HT', 'T'), 9.5, 20),
    '408, fields of a byte a second': late(drip(field, 'a'), 9.5, 20),
    '408, half a head': late((socket) => socket.write('GET / HTTP/1.1\r\n'), 9.5, 20),
    '408, a body of a byte a second': late(drip(post({ 'Content-Length': 100000 }), 'a'), 29.5, 45),
    '408, chunks of a byte a second': late(drip(post({ 'Transfer-Encoding': 'chunked' }), '1\r\na\r\n'), 29.5, 45),
    'a client that says nothing is let go': async () => {
      const said = await talk(base, () => {}, { patience: 60000 });
      must(said.closed && said.answers.length === 0, `${said.answers.length} answers, closed: ${said.closed}`);
      must(said.seconds > 14.5 && said.seconds < 30, `after ${said.seconds.toFixed(1)} s`);
    },
  };
  return Object.entries(clients).map(([name, play]) => [name, play().then(() => null, (error) => error)]);
}

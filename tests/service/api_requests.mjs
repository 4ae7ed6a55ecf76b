// Sends the HTTP requests of api_test.mjs, and draws its random numbers.
import http from 'node:http';
import net from 'node:net';

export const seed = Number(process.env.SGM_SEED ?? Date.now() % 1e9);
let state = seed >>> 0;
/// Returns a random number from 0 to 1 (generator: Mulberry32).
function draw() {
  state = (state + 0x6d2b79f5) | 0;
  let t = Math.imul(state ^ (state >>> 15), state | 1);
  t ^= t + Math.imul(t ^ (t >>> 7), t | 61);
  return ((t ^ (t >>> 14)) >>> 0) / 2 ** 32;
}
export const chance = (share) => draw() < share;
export const pick = (list) => list[Math.floor(draw() * list.length)];

/// Sends an HTTP request; resolves to the complete response, or to status 0 with the reason in `problem`. unsized:
/// sends the body with neither Content-Length nor chunked encoding.
export function ask(base, method, { path, headers, body, unsized }) {
  const { hostname, port } = new URL(base);
  return new Promise((resolve) => {
    const request = http.request({ hostname, port, method, path, agent: false, timeout: 60000,
      headers: { ...(body !== null ? { 'content-length': Buffer.byteLength(body) } : {}), ...headers } });
    if (unsized) request.useChunkedEncodingByDefault = false;
    request.on('response', (answer) => {
      const pieces = [];
      answer.on('data', (piece) => pieces.push(piece));
      answer.on('end', () => {
        resolve({ status: answer.statusCode, headers: answer.headers, body: Buffer.concat(pieces) });
        request.destroy();
      });
    });
    request.on('timeout', () => request.destroy(new Error('no answer in 60 s')));
    request.on('error', (error) => resolve({ status: 0, headers: {}, body: Buffer.alloc(0), problem: error.message }));
    // If a request has a false Content-Length and no body, do not end it, so that its connection stays open for the
    // response.
    if (headers['content-length'] && body === null) request.flushHeaders();
    else request.end(body ?? undefined);
  });
}

/// Sends a request whose header section never ends, one byte a second.
export function askSlowly(base, method, path) {
  const { hostname, port } = new URL(base);
  return new Promise((resolve) => {
    let text = '';
    const socket = net.connect(Number(port), hostname, () => socket.write(`${method} ${path} HTTP/1.1\r\nHost: localhost\r\nX-Slow: `));
    const drip = setInterval(() => socket.write('a'), 1000);
    const end = () => {
      clearInterval(drip);
      const [head, body] = text.split('\r\n\r\n');
      const status = Number(/^HTTP\/1\.1 (\d+)/.exec(head)?.[1] ?? 0);
      const headers = Object.fromEntries(head.split('\r\n').slice(1).map((line) => [line.split(': ')[0].toLowerCase(), line.split(': ')[1]]));
      resolve({ status, headers, body: Buffer.from(body ?? ''), ...(status ? {} : { problem: 'no answer' }) });
    };
    socket.on('data', (piece) => { text += piece; });
    socket.on('error', () => {});
    socket.on('close', end);
  });
}

// An HTTP client on a plain socket, which can also make the protocol errors that a test needs, and a parser for
// responses.
import net from 'node:net';

/**
 * Parses the responses in the bytes that a server sent. heads: indices of the responses to HEAD requests, which have no
 * body.
 */
export function answersIn(bytes, heads = []) {
  const answers = [];
  let at = 0;
  while (at < bytes.length) {
    const end = bytes.indexOf('\r\n\r\n', at);
    if (end < 0) return { answers, rest: bytes.subarray(at) };
    const [line, ...lines] = bytes.subarray(at, end).toString('latin1').split('\r\n');
    const match = /^HTTP\/1\.[01] (\d{3}) .+$/.exec(line);
    if (!match) throw new Error(`no status line: ${JSON.stringify(line.slice(0, 80))}`);
    const headers = {};
    for (const field of lines) {
      const colon = field.indexOf(':');
      const name = field.slice(0, colon).toLowerCase();
      if (colon < 1 || name in headers) throw new Error(`a bad or repeated header: ${field.slice(0, 80)}`);
      headers[name] = field.slice(colon + 1).trim();
    }
    const status = Number(match[1]);
    const bodiless = status < 200 || status === 204 || status === 304 || heads.includes(answers.length);
    const length = bodiless ? 0 : Number(headers['content-length'] ?? NaN);
    if (Number.isNaN(length)) throw new Error(`an answer of ${status} without Content-Length`);
    if (bytes.length < end + 4 + length) return { answers, rest: bytes.subarray(at) };
    at = end + 4 + length;
    if (status >= 200) answers.push({ status, headers, body: bytes.subarray(end + 4, at) });
    else (answers.informal ??= []).push(status);
  }
  return { answers, rest: bytes.subarray(at) };
}

export function place(base) {
  const url = new URL(base);
  return { host: url.hostname.replace(/[[\]]/g, ''), port: Number(url.port), name: url.host };
}

/** Returns the bytes of a request. body: undefined for none. chunk: sends the body in chunks of this many bytes. */
export function requestBytes(base, { method = 'GET', target = '/', headers = {}, body, chunk, version = '1.1' }) {
  const fields = { Host: place(base).name, ...headers };
  if (body !== undefined && chunk) fields['Transfer-Encoding'] = 'chunked';
  else if (body !== undefined) fields['Content-Length'] = body.length;
  const sent = Object.entries(fields).filter(([, value]) => value !== null);
  const lines = sent.map(([name, value]) => `${name}: ${value}`);
  const parts = [Buffer.from([`${method} ${target} HTTP/${version}`, ...lines, '', ''].join('\r\n'), 'latin1')];
  if (body !== undefined && chunk) {
    for (let at = 0; at < body.length; at += chunk) {
      const piece = body.subarray(at, at + chunk);
      parts.push(Buffer.from(`${piece.length.toString(16)}\r\n`), piece, Buffer.from('\r\n'));
    }
    parts.push(Buffer.from('0\r\n\r\n'));
  } else if (body !== undefined) {
    parts.push(body);
  }
  return Buffer.concat(parts);
}

/**
 * Sends bytes, or calls a function (socket, stop) that writes to the socket. Collects the responses until the server
 * closes the connection, or `patience` ms are over, or `wanted` responses have arrived and then `linger` ms have passed
 * (to see whether the server closes the connection). Resolves to {answers, informal, closed, reset, seconds, rest};
 * rejects only if it cannot connect.
 */
export function talk(base, bytes, { wanted = 1, linger = 0, patience = 20000, heads = [] } = {}) {
  const { host, port } = place(base);
  return new Promise((resolve, reject) => {
    const started = performance.now();
    const pieces = [];
    const stopped = { now: false };
    let connected = false, reset = false, timer, lingering;
    const socket = net.connect({ host, port, allowHalfOpen: true });
    const finish = (closed) => {
      if (stopped.now) return;
      stopped.now = true;
      clearTimeout(timer);
      clearTimeout(lingering);
      socket.destroy();
      const seconds = (performance.now() - started) / 1000;
      try {
        const { answers, rest } = answersIn(Buffer.concat(pieces), heads);
        resolve({ answers, informal: answers.informal ?? [], closed, reset, seconds, rest });
      } catch (error) {
        reject(error);
      }
    };
    timer = setTimeout(() => finish(false), patience);
    socket.setNoDelay(true);
    socket.on('connect', () => {
      connected = true;
      if (typeof bytes === 'function') bytes(socket, stopped);
      else socket.write(bytes);
    });
    socket.on('data', (piece) => {
      pieces.push(piece);
      let count = 0;
      try {
        count = answersIn(Buffer.concat(pieces), heads).answers.length;
      } catch {
        return finish(false);
      }
      if (count < wanted || lingering) return;
      if (linger === 0) finish(false);
      else lingering = setTimeout(() => finish(false), linger);
    });
    socket.on('end', () => finish(true));
    socket.on('close', () => finish(true));
    socket.on('error', (error) => {
      reset = true;
      if (!connected) {
        stopped.now = true;
        clearTimeout(timer);
        reject(error);
      }
    });
  });
}

/** Sends one request on a new connection; resolves to the response, or to null if none arrived. */
export async function ask(base, request, options = {}) {
  const heads = request.method === 'HEAD' ? [0] : [];
  const { answers } = await talk(base, requestBytes(base, request), { patience: 60000, heads, ...options });
  return answers[0] ?? null;
}

export const jsonOf = (answer) => JSON.parse(answer.body.toString('utf8'));
export const sleep = (milliseconds) => new Promise((resolve) => setTimeout(resolve, milliseconds));

/** Runs checks and prints each result; finish() ends the process, with status 1 if a check failed. */
export class Checks {
  #made = 0;
  #failed = [];

  check(name, holds, detail = '') {
    ++this.#made;
    if (!holds) this.#failed.push(name);
    console.log(`${holds ? 'ok     ' : 'FAILED '} ${name}${detail !== '' && !holds ? `: ${detail}` : ''}`);
    return holds;
  }
  /** Runs a function as a check, which fails if the function throws or rejects. */
  async run(name, body) {
    try {
      await body();
      this.check(name, true);
    } catch (error) {
      this.check(name, false, error.message);
    }
  }
  finish() {
    console.log(`${this.#made - this.#failed.length} of ${this.#made} checks hold`);
    for (const name of this.#failed) console.error(`failed: ${name}`);
    process.exit(this.#failed.length === 0 && this.#made > 0 ? 0 : 1);
  }
}

export function must(holds, message) {
  if (!holds) throw new Error(message);
}

// Tests 1,000 concurrent clients: 590 send valid requests, 200 are slow, 100 send too much data, 100 send malformed
// requests, and 10 upload meshes. Each must get the right response, while the operations port responds as fast as
// usual.
//
//   node load_test.mjs BASE_URL OPERATIONS_URL PID MESH      the service must accept uploads of up to 1 MiB
import { spawn } from 'node:child_process';
import fs from 'node:fs';
import net from 'node:net';

const [base, operations, pid, meshFile] = process.argv.slice(2);
const { hostname, port } = new URL(base);
const mesh = fs.readFileSync(meshFile);
const kMaxMilliseconds = 50, kMaxMebibytes = 256;

/// Runs a client's function on a new connection; resolves to the status of the response, or 0 if there is none.
function client(play) {
  return new Promise((resolve) => {
    const socket = net.connect(Number(port), hostname);
    let text = '', timer = null, done = false;
    const end = (status) => {
      if (done) return;
      done = true;
      clearInterval(timer);
      socket.destroy();
      resolve(status);
    };
    socket.on('connect', () => { timer = play(socket) ?? null; });
    socket.on('data', (bytes) => {
      text += bytes.toString('latin1');
      const found = /^HTTP\/1\.1 (\d\d\d) /.exec(text);
      if (found && found[1] !== '100') end(Number(found[1]));
    });
    socket.on('error', () => end(0));
    socket.on('close', () => end(0));
    setTimeout(() => end(0), 90000);
  });
}

const paths = ['/', '/api/v1/summary', '/api/v1/reports', '/api/v1/masters', '/api/v1/openapi.json'];
const good = (i) => client((socket) => {
  socket.write(`GET ${paths[i % paths.length]} HTTP/1.1\r\nHost: localhost\r\n\r\n`);
});
const postHead = 'POST /api/v1/validate HTTP/1.1\r\nHost: localhost\r\nContent-Type: model/stl\r\n';
/// A client that sends one byte a second: every other client within the header section, the others within the body.
const slow = (i) => client((socket) => {
  socket.write(i % 2 === 0 ? 'GET / HTTP/1.1\r\nHost: localhost\r\nX-Slow: ' : `${postHead}Content-Length: 100000\r\n\r\n`);
  return setInterval(() => socket.write('a'), 1000);
});
const sixteenth = Buffer.alloc(1 << 16, 'a');
const oversize = (i) => client((socket) => {
  if (i % 2 === 0) {
    socket.write(`${postHead}Content-Length: 300000000\r\n\r\n`);
    return null;
  }
  socket.write(`${postHead}Transfer-Encoding: chunked\r\n\r\n`);
  return setInterval(() => {
    if (socket.writableNeedDrain) return;
    socket.write(`${sixteenth.length.toString(16)}\r\n`);
    socket.write(sixteenth);
    socket.write('\r\n');
  }, 20);
});
const wrong = ['NONSENSE\r\n\r\n', 'GET / HTTP/1.1\r\nNo colon here\r\n\r\n', 'GET / HTTP/1.1\r\nHost: a\r\nHost: b\r\n\r\n',
  `${postHead}Content-Length: 3\r\nTransfer-Encoding: chunked\r\n\r\n`, 'GET /%zz HTTP/1.1\r\nHost: localhost\r\n\r\n'];
const malformed = (i) => client((socket) => { socket.write(wrong[i % wrong.length]); });
const uploads = () => client((socket) => {
  socket.write(`POST /api/v1/validate HTTP/1.1\r\nHost: localhost\r\nContent-Type: model/gltf-binary\r\nContent-Length: ${mesh.length}\r\n\r\n`);
  socket.write(mesh);
});

const probe = spawn(process.execPath, [new URL('health_probe.mjs', import.meta.url).pathname, operations],
  { stdio: ['pipe', 'pipe', 'inherit'] });
let said = '';
probe.stdout.on('data', (bytes) => { said += bytes; });
await new Promise((resolve) => setTimeout(resolve, 500));

const kinds = [['good', 590, good, 200], ['slow', 200, slow, 408], ['oversize', 100, oversize, 413],
  ['malformed', 100, malformed, 400], ['uploads', 10, uploads, 200]];
const begun = Date.now();
const all = [];
for (const [name, count, play, wanted] of kinds) {
  for (let i = 0; i < count; ++i) all.push(play(i).then((status) => ({ name, status, wanted })));
}
let failures = 0;
const fail = (text) => { ++failures; console.log(`FAILED: ${text}`); };
const answers = await Promise.all(all);
for (const [name, count, , wanted] of kinds) {
  const tally = {};
  for (const answer of answers) if (answer.name === name) tally[answer.status] = (tally[answer.status] ?? 0) + 1;
  console.log(`${name.padEnd(10)} ${count} clients: ${JSON.stringify(tally)}`);
  if (tally[wanted] !== count) fail(`${name} must be answered with ${wanted}`);
}
console.log(`${((Date.now() - begun) / 1000).toFixed(1)} s`);

probe.stdin.end();
await new Promise((resolve) => probe.on('close', resolve));
const { times, failures: lost } = JSON.parse(said);
times.sort((a, b) => a - b);
const share = (of) => times[Math.min(times.length - 1, Math.floor(times.length * of))];
console.log(`/healthz asked ${times.length} times: median ${share(0.5).toFixed(2)} ms, p99 ${share(0.99).toFixed(2)} ms, ` +
  `longest ${share(1).toFixed(2)} ms, ${lost} lost`);
if (lost > 0 || times.length < 100) fail('/healthz was not answered each time');
if (share(0.99) >= kMaxMilliseconds) fail(`/healthz p99 must stay below ${kMaxMilliseconds} ms`);
const status = fs.readFileSync(`/proc/${pid}/status`, 'utf8');
const mebibytes = Number(/VmHWM:\s+(\d+)/.exec(status)[1]) / 1024;
console.log(`resident at most ${mebibytes.toFixed(1)} MiB`);
if (mebibytes >= kMaxMebibytes) fail(`the service must stay below ${kMaxMebibytes} MiB`);
process.exit(failures === 0 ? 0 : 1);

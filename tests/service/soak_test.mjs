// Tests a service under a mixed load for some time: at the end, it must use as much memory as after its warm-up.
//
//   node soak_test.mjs BASE_URL OPERATIONS_URL PID MESH SECONDS FOLDER
//
// Writes soak.csv and soak.svg into the folder.
import fs from 'node:fs';
import net from 'node:net';
import path from 'node:path';

const [base, operations, pid, meshFile, secondsText, folder] = process.argv.slice(2);
const seconds = Number(secondsText), mesh = fs.readFileSync(meshFile);
/// Allowed growth of resident memory after the warm-up, in MiB: the memory use of allocators varies by this much at any
/// time.
const kMaxGrowth = 6;
const kClients = 6;
/// Pause between a client's requests in milliseconds, so that other processes of the machine are not slowed down.
const kPause = 30;
const until = Date.now() + seconds * 1000;
let failures = 0, asked = 0;
const fail = (text) => { if (++failures <= 10) console.log(`FAILED: ${text}`); };

async function asks(url, wanted, options = {}) {
  const answer = await fetch(url, options);
  await answer.arrayBuffer();
  ++asked;
  if (answer.status !== wanted) fail(`${url} is answered with ${answer.status}, not ${wanted}`);
}
const post = (body, type, wanted) => asks(`${base}/api/v1/validate?name=soak`, wanted, { method: 'POST', body, headers: { 'content-type': type } });

/// A client that closes its connection in the middle of its request.
function leaves(text) {
  const { hostname, port } = new URL(base);
  return new Promise((resolve) => {
    const socket = net.connect(Number(port), hostname, () => {
      socket.write(text);
      setTimeout(() => socket.destroy(), 20);
    });
    socket.on('error', () => {});
    socket.on('close', resolve);
    ++asked;
  });
}

const parts = [
  () => asks(`${base}/`, 200), () => asks(`${base}/main.js`, 200), () => asks(`${base}/api/v1/summary`, 200),
  () => asks(`${base}/api/v1/worlds/sphere/chunks`, 200), () => asks(`${base}/api/v1/reports`, 200),
  () => asks(`${base}/api/v1/masters`, 200), () => asks(`${base}/nothing`, 404), () => asks(`${operations}/metrics`, 200),
  () => asks(`${operations}/healthz`, 200), () => post(mesh, 'model/gltf-binary', 200),
  () => post(mesh.subarray(0, 1000), 'model/gltf-binary', 422), () => post('sgm 1; nonsense', 'text/x-sgm', 422),
  () => post('x', 'text/plain', 415), () => leaves('GET / HTTP/1.1\r\nHost: local'), () => leaves('NONSENSE\r\n\r\n'),
  () => leaves('POST /api/v1/validate HTTP/1.1\r\nHost: localhost\r\nContent-Type: model/stl\r\nContent-Length: 90000\r\n\r\nabc'),
];
async function client(number) {
  for (let i = number; Date.now() < until; i += 1) {
    try { await parts[i % parts.length](); } catch (error) { fail(`${error.cause ?? error}`); }
    await new Promise((resolve) => setTimeout(resolve, kPause));
  }
}

const samples = [];
function sample() {
  const status = fs.readFileSync(`/proc/${pid}/status`, 'utf8');
  const figure = (name) => Number(new RegExp(`${name}:\\s+(\\d+)`).exec(status)[1]);
  samples.push({ seconds: seconds - (until - Date.now()) / 1000, mebibytes: figure('VmRSS') / 1024,
    threads: figure('Threads'), files: fs.readdirSync(`/proc/${pid}/fd`).length });
}
sample();
const timer = setInterval(sample, Math.max(1000, seconds * 5));
await Promise.all(Array.from({ length: kClients }, (_, number) => client(number)));
clearInterval(timer);
// Wait until the connections of clients that have left are closed: the service ends idle connections after 15 s.
for (let i = 0; i < 25 && (i < 2 || samples.at(-1).files > samples[0].files + 2); ++i) {
  await new Promise((resolve) => setTimeout(resolve, 1000));
  sample();
}

const first = samples.findIndex((s) => s.seconds >= seconds / 3), warm = samples.slice(first), last = warm.at(-1);
const mean = (of) => warm.reduce((sum, s) => sum + of(s), 0) / warm.length;
const middle = mean((s) => s.seconds), level = mean((s) => s.mebibytes);
const slope = warm.reduce((sum, s) => sum + (s.seconds - middle) * (s.mebibytes - level), 0)
  / warm.reduce((sum, s) => sum + (s.seconds - middle) ** 2, 0);
const growth = slope * (last.seconds - warm[0].seconds);
console.log(`${asked} requests in ${seconds} s, ${failures} failures; warm from ${warm[0].seconds.toFixed(0)} s on: ` +
  `${level.toFixed(1)} MiB on average, ${growth.toFixed(2)} MiB by the fitted line (${(slope * 3600).toFixed(2)} MiB/h); ` +
  `files ${samples[0].files} to ${last.files}, threads ${samples[0].threads} to ${last.threads}`);
if (growth > kMaxGrowth) fail(`it grew by ${growth.toFixed(1)} MiB`);
if (last.files > samples[0].files + 2) fail('files stay open');
if (last.threads > samples[0].threads) fail('threads stay');
if (asked < seconds) fail('next to nothing was asked');

fs.writeFileSync(path.join(folder, 'soak.csv'), `seconds,resident_mebibytes,threads,open_files\n${
  samples.map((s) => `${s.seconds.toFixed(1)},${s.mebibytes.toFixed(3)},${s.threads},${s.files}`).join('\n')}\n`);
const high = Math.max(...samples.map((s) => s.mebibytes)) * 1.1, end = last.seconds;
const x = (s) => (60 + (s / end) * 720).toFixed(1), y = (m) => (340 - (m / high) * 300).toFixed(1);
const step = 10 ** Math.floor(Math.log10(high)), lines = [];
for (let m = 0; m <= high; m += step / 2) {
  lines.push(`<line x1="60" x2="780" y1="${y(m)}" y2="${y(m)}" stroke="#ddd"/><text x="52" y="${y(m)}" dy="4" text-anchor="end">${m}</text>`);
}
for (let k = 0; k <= 6; ++k) lines.push(`<text x="${x((end * k) / 6)}" y="360" text-anchor="middle">${((end * k) / 6).toFixed(0)} s</text>`);
fs.writeFileSync(path.join(folder, 'soak.svg'), `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 800 380" font-family="sans-serif" font-size="13">
<rect width="800" height="380" fill="white"/><text x="60" y="22">Resident memory, MiB, under mixed load: ${asked} requests</text>
${lines.join('\n')}
<polyline fill="none" stroke="#0b5cad" stroke-width="2" points="${samples.map((s) => `${x(s.seconds)},${y(s.mebibytes)}`).join(' ')}"/>
</svg>\n`);
process.exit(failures === 0 ? 0 : 1);

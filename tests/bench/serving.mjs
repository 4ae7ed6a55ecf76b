// Measures how much the metrics service costs a flight, while a page and a Prometheus poll it as often as usual: the
// share of the service's threads in the processor time of all threads, and the time on the engine's thread with and
// without the service.
//
//   node tests/bench/serving.mjs SGM GRAMMAR [FRAMES] [PAIRS]
import { spawn } from 'node:child_process';
import fs from 'node:fs';

const [sgm, grammar, frames = '3000', pairs = '4'] = process.argv.slice(2);
const served = new Set(['sgm watcher', 'sgm work', 'sgm operations', 'sgm inspector']);

/// Returns the processor time, in nanoseconds, of each running thread of process `pid`, by thread name.
function timesOf(pid) {
  const times = {};
  for (const task of fs.readdirSync(`/proc/${pid}/task`)) {
    try {
      const name = fs.readFileSync(`/proc/${pid}/task/${task}/comm`, 'utf8').trim();
      times[name] = (times[name] ?? 0) + Number(fs.readFileSync(`/proc/${pid}/task/${task}/schedstat`, 'utf8').split(' ')[0]);
    } catch { /* it has ended */ }
  }
  return times;
}

async function fly(serves) {
  const flight = spawn(sgm, ['fly', grammar, '--measure', '--unpaced', '--frames', frames, '--json',
    ...(serves ? ['--serve', '--port', '0', '--operations-port', '0'] : [])]);
  let out = '', err = '', times = {};
  flight.stdout.on('data', (piece) => { out += piece; });
  flight.stderr.on('data', (piece) => { err += piece; });
  const timer = setInterval(async () => {
    const [page, metrics] = [/^page (\S+)/m.exec(err)?.[1], /^metrics (\S+)/m.exec(err)?.[1]];
    try {
      if (page) {
        const { worlds } = await (await fetch(`${page}api/v1/summary`)).json();
        await (await fetch(`${page}api/v1/worlds/${worlds[0].name}/chunks`)).text();
        await (await fetch(metrics)).text();
      }
      times = timesOf(flight.pid);
    } catch { /* it ends */ }
  }, 1000);
  await new Promise((resolve) => flight.on('close', resolve));
  clearInterval(timer);
  const all = Object.values(times).reduce((sum, t) => sum + t, 0);
  const service = Object.entries(times).reduce((sum, [name, t]) => sum + (served.has(name) ? t : 0), 0);
  const report = JSON.parse(out);
  return { share: service / all, report };
}

const inMilliseconds = ({ p50, p99, max }) => `${p50.toFixed(3)} ${p99.toFixed(3)} ${max.toFixed(3)}`;
for (let pair = 0; pair < Number(pairs); ++pair) {
  const without = await fly(false), beside = await fly(true);
  console.log(`serving takes ${(100 * beside.share).toFixed(2)} % of the processor time; engine's thread, ms a frame, median p99 max: ` +
    `${inMilliseconds(without.report.main_thread_ms)} without, ${inMilliseconds(beside.report.main_thread_ms)} with`);
}

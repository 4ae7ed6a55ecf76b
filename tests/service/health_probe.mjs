// Requests /healthz every 20 ms until standard input ends, then prints all response times in milliseconds. It is a
// separate process, so that the work of the test's other clients does not lengthen the measured response times.
//
//   node health_probe.mjs OPERATIONS_URL
import http from 'node:http';

const url = new URL('/healthz', process.argv[2]);
const agent = new http.Agent({ keepAlive: true, maxSockets: 4 });
const times = [];
let failures = 0;

function ask() {
  const begun = process.hrtime.bigint();
  const request = http.get(url, { agent, timeout: 10000 }, (answer) => {
    answer.resume();
    answer.on('end', () => {
      times.push(Number(process.hrtime.bigint() - begun) / 1e6);
      if (answer.statusCode !== 200) ++failures;
    });
  });
  request.on('timeout', () => request.destroy(new Error('timeout')));
  request.on('error', () => ++failures);
}

const timer = setInterval(ask, 20);
process.stdin.resume();
process.stdin.on('end', () => {
  clearInterval(timer);
  setTimeout(() => {
    console.log(JSON.stringify({ times, failures }));
    process.exit(0);
  }, 500);
});

// Tests one row of the table of bad input: sends bad bytes on a new connection, followed by a valid request, and checks
// all properties of the response.
import fs from 'node:fs';
import { ask, jsonOf, must, requestBytes, talk } from './http_probe.mjs';

/** Checks the security headers that every response of the service must have. */
export function mustBeSafe({ headers }) {
  must(headers['x-content-type-options'] === 'nosniff', 'X-Content-Type-Options: nosniff is missing');
  must(headers['referrer-policy'] === 'no-referrer', 'Referrer-Policy: no-referrer is missing');
}

/** Checks that a response has this status and code; returns its problem object. */
export function problemIn(answer, status, code) {
  must(answer, 'no answer came');
  const text = answer.body.toString('utf8');
  must(answer.status === status, `answered with ${answer.status} ${text.slice(0, 200)}, not ${status}`);
  mustBeSafe(answer);
  must(answer.headers['cache-control'] === 'no-store', 'a problem may be kept by caches');
  must(answer.headers['content-type'] === 'application/problem+json', `it is ${answer.headers['content-type']}`);
  const problem = JSON.parse(text);
  must(problem.code === code, `the code is ${problem.code}, not ${code}`);
  must(problem.status === status, `the problem's status is ${problem.status}`);
  must(problem.type === 'about:blank' && problem.title.length > 3, `a problem without a title: ${text}`);
  must(problem.detail.length > 10, `a problem that does not say what to do: ${text}`);
  must(!/root:.*:0:0/.test(text), 'a file of the machine is in the answer');
  return problem;
}

export async function mustBeWell(operations) {
  const health = await ask(operations, { target: '/healthz' }, { patience: 5000 });
  must(health?.status === 200 && health.body.toString() === 'ok\n', '/healthz is not well afterwards');
}

/**
 * Sends bytes, then a valid request. If the service must close the connection, it must answer the bytes only; otherwise
 * it must also answer the request. The third argument is the required response to the bytes: {status, code, closes,
 * headers: {name: pattern}, problem(object), head}.
 */
export async function mustRefuse({ base, operations }, bytes, { status, code, closes, headers = {}, problem, head }) {
  const behind = requestBytes(base, { target: '/api/v1/reports' });
  const said = await talk(base, Buffer.concat([Buffer.from(bytes, 'latin1'), behind]),
    { wanted: closes ? Infinity : 2, heads: head ? [0] : [], patience: 60000 });
  must(said.answers.length > 0, 'no answer came');
  const [first, second] = said.answers;
  if (head) must(first.status === status && first.body.length === 0, `HEAD was answered with ${first.status}`);
  else problem?.(problemIn(first, status, code));
  if (!head && !problem) problemIn(first, status, code);
  for (const [name, pattern] of Object.entries(headers))
    must(pattern.test(first.headers[name] ?? ''), `${name} is ${first.headers[name]}`);
  must((first.headers.connection === 'close') === closes, `Connection: ${first.headers.connection}`);
  if (closes) must(said.closed && !second && said.rest.length === 0, 'the connection was not closed behind it');
  else must(second?.status === 200 && Array.isArray(jsonOf(second).reports), 'the connection was not kept');
  await mustBeWell(operations);
}

/** Returns the child processes of a process, including zombies: {pid, state, command}. */
export function childrenOf(pid) {
  const children = [];
  for (const name of fs.readdirSync('/proc').filter((entry) => /^\d+$/.test(entry))) {
    try {
      const stat = fs.readFileSync(`/proc/${name}/stat`, 'latin1');
      const [state, parent] = stat.slice(stat.lastIndexOf(')') + 2).split(' ');
      if (Number(parent) !== pid) continue;
      const command = fs.readFileSync(`/proc/${name}/cmdline`, 'utf8').split('\0');
      children.push({ pid: Number(name), state, command });
    } catch {
      // ignore a process that has ended since /proc was listed
    }
  }
  return children;
}

export function residentMebibytes(pid) {
  return Number(/VmRSS:\s+(\d+)/.exec(fs.readFileSync(`/proc/${pid}/status`, 'utf8'))[1]) / 1024;
}

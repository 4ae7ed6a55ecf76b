// Rows of the table of bad input that the validating process refuses, and those where that process fails or is
// overloaded.
import fs from 'node:fs';
import net from 'node:net';
import path from 'node:path';
import { ask, jsonOf, must, requestBytes, sleep } from './http_probe.mjs';
import { childrenOf, mustBeSafe, mustBeWell, mustRefuse, problemIn } from './bad_input_rows.mjs';
import { damaged, elsewhere, refusedGrammars, soup } from './bad_input_files.mjs';
import { ball, files, glb, stl, types } from './meshes.mjs';

const upload = (name, bytes, { query = '', headers = {} } = {}) => ({ method: 'POST',
  target: `/api/v1/validate?name=${encodeURIComponent(name)}${query}`,
  headers: { 'Content-Type': types[path.extname(name)], ...headers }, body: bytes });

/** Returns an upload that takes seconds to validate on any machine. */
const heavy = (triangles = 60000) => upload('soup.stl', stl(soup(triangles)));

async function until(what, holds, seconds = 30) {
  for (let i = 0; i < seconds * 100; ++i) {
    const value = holds();
    if (value) return value;
    await sleep(10);
  }
  throw new Error(`it never came to ${what}`);
}
const validatorsOf = (pid) =>
  childrenOf(pid).filter((child) => child.command.some((word) => word.startsWith('--kind')));
const mustHaveNoChildren = (pid) => until('the end of all its processes', () => childrenOf(pid).length === 0);

async function refusedFiles(service) {
  const { checks, base, pid } = service;
  const refused = Object.entries(files).filter(([, file]) => file.valid === null);
  must(refused.length > 10, 'there are no bad files');
  for (const [name, file] of [...refused, ...Object.entries(damaged), ...Object.entries(refusedGrammars)]) {
    await checks.run(`422, ${name}`, async () => {
      await mustRefuse(service, requestBytes(base, upload(name, file.bytes())), { status: 422, code: 'bad_input',
        closes: false, problem: (problem) => {
          const expected = file.pointer === true ? /^\/\w+\/\d+/ : file.pointer;
          const { pointer = '', detail } = problem;
          if (expected) must(expected.test(pointer), `the pointer is ${pointer}: ${detail}`);
          if (file.line === true) must(problem.line >= 1, `the line is ${problem.line}: ${problem.detail}`);
          else if (file.line) must(problem.line === file.line, `the line is ${problem.line}: ${problem.detail}`);
          if (name.endsWith('.sgm')) must(problem.column >= 1, `the column is ${problem.column}: ${problem.detail}`);
          if (file.column) must(problem.column === file.column, `the column is ${problem.column}`);
          if (name.endsWith('.sgm')) must(problem.diagnostics?.length > 0, 'there are no diagnostics');
        } });
    });
  }
  const wrong = { cell: '0', region: '1,2', seed: '-1', set: 'radius' };
  for (const [key, value] of Object.entries(wrong))
    await checks.run(`422, ${key}=${value}`, () => mustRefuse(service,
      requestBytes(base, upload('ball.sgm', files['ball.sgm'].bytes(), { query: `&${key}=${value}` })),
      { status: 422, code: 'bad_input', closes: false, problem: (p) => must(p.detail.includes(key), p.detail) }));
  await checks.run('400, a cell for a mesh', () => mustRefuse(service,
    requestBytes(base, upload('sphere.glb', files['sphere.glb'].bytes(), { query: '&cell=1' })),
    { status: 400, code: 'bad_parameter', closes: true }));
  await checks.run('no process is left of them', () => mustHaveNoChildren(pid));
}

/** Uploads files whose external buffers exist, as a local file or on a server: the service must not load them. */
async function externalBuffers(service) {
  const { checks, base, work } = service;
  const wants = { status: 422, code: 'bad_input', closes: false,
    problem: ({ pointer }) => must(/^\/(buffers|bufferViews)\/0/.test(pointer ?? ''), `the pointer is ${pointer}`) };
  let visitors = 0;
  const other = net.createServer((socket) => { ++visitors; socket.destroy(); });
  await new Promise((ready) => other.listen(0, '127.0.0.1', ready));
  const uris = [`http://127.0.0.1:${other.address().port}/a.bin`, `file://${work}/million.glb`, `${work}/million.glb`,
    'million.glb', 'data:application/octet-stream;base64,AAAA'];
  for (const uri of uris)
    await checks.run(`422, a buffer at ${uri.replace(work, '').replace(/:\d+/, '')}`,
      () => mustRefuse(service, requestBytes(base, upload('ball.glb', elsewhere(uri))), wants));
  checks.check('nobody asked the server that a buffer names', visitors === 0, `${visitors} connections`);
  other.close();
}

async function notWatertight({ checks, base, operations }) {
  await checks.run('200, a sphere without one of its triangles', async () => {
    const answer = await ask(base, upload('hole.glb', files['hole.glb'].bytes()));
    must(answer?.status === 200, `answered with ${answer?.status} ${answer?.body}`);
    mustBeSafe(answer);
    const { valid, measures } = jsonOf(answer);
    must(valid === false && measures.watertight === false, `valid: ${valid}`);
    must(measures.open_edges === 3 && measures.problems.length > 0, `${measures.open_edges} open edges`);
    const places = measures.places.filter((place) => place.kind === 'open_edge');
    must(places.length === 3, `${places.length} places`);
    for (const { at } of places) must(Math.abs(Math.hypot(...at) - 1) < 0.05, `a place at ${at}, off the sphere`);
  });
  await checks.run('200, 500 open edges: not all places, yet all are counted', async () => {
    const { points, triangles } = ball(4);
    const holed = { points, triangles: triangles.filter((_, i) => i % 5 !== 0) };
    const sides = new Map();
    for (const t of holed.triangles) for (let i = 0; i < 3; ++i) {
      const key = String([t[i], t[(i + 1) % 3]].sort((a, b) => a - b));
      sides.set(key, (sides.get(key) ?? 0) + 1);
    }
    const open = [...sides.values()].filter((count) => count === 1).length;
    const answer = await ask(base, upload('holes.glb', glb(holed)));
    const { valid, measures } = jsonOf(answer);
    must(answer.status === 200 && valid === false, `answered with ${answer.status}, valid: ${valid}`);
    must(measures.open_edges === open && open > 500, `${measures.open_edges} open edges of ${open}`);
    must(measures.places.length > 0 && measures.places.length < open, `${measures.places.length} places`);
  });
  await mustBeWell(operations);
}

async function manyGood({ checks, base, operations }) {
  await checks.run('200, ten good uploads at once', async () => {
    const names = ['sphere.glb', 'sphere.obj', 'sphere.ply', 'sphere.stl', 'ball.sgm'];
    const all = [...names, ...names].map((name) => ask(base, upload(name, files[name].bytes())));
    for (const answer of await Promise.all(all)) {
      must(answer?.status === 200, `answered with ${answer?.status} ${answer?.body}`);
      must(jsonOf(answer).valid === true, `${jsonOf(answer).name} is not valid`);
    }
    await mustBeWell(operations);
  });
}

async function killed({ checks, base, operations, pid }) {
  await checks.run('500, a validator that is killed', async () => {
    const waits = ask(base, heavy(100000), { patience: 120000 });
    const [validator] = await until('a validator', () => validatorsOf(pid).length > 0 && validatorsOf(pid));
    await sleep(100);
    process.kill(validator.pid, 'SIGKILL');
    const answer = await waits;
    const problem = problemIn(answer, 500, 'validator_crashed');
    must(problem.detail.includes('signal 9'), problem.detail);
    const report = jsonOf(await ask(base, { target: answer.headers.location }));
    must(report.state === 'failed' && report.problem.code === 'validator_crashed', `the report is ${report.state}`);
    await mustHaveNoChildren(pid);
    await mustBeWell(operations);
  });
  await checks.run('200, the upload after it', async () => {
    must((await ask(base, upload('sphere.glb', files['sphere.glb'].bytes())))?.status === 200, 'it is refused');
  });
}

async function million({ checks, base, operations, work }) {
  const bytes = fs.readFileSync(path.join(work, 'million.glb'));
  const most = process.env.SGM_LONG ? 3 : 30;
  await checks.run(`200, a million triangles within ${most} s`, async () => {
    const began = performance.now();
    const answer = await ask(base, upload('million.glb', bytes), { patience: 120000 });
    const seconds = (performance.now() - began) / 1000;
    const report = answer && jsonOf(answer);
    must(answer?.status === 200 && report.valid === true, `answered with ${answer?.status}`);
    must(report.measures.triangles >= 1e6, `${report.measures.triangles} triangles`);
    console.log(`        ${report.measures.triangles} triangles, ${(bytes.length / 1e6).toFixed(1)} MB: ` +
      `${seconds.toFixed(2)} s, ${report.seconds.toFixed(2)} s of them in the validator`);
    must(seconds < most, `it took ${seconds.toFixed(2)} s`);
    await mustBeWell(operations);
  });
}

/** Runs the checks for a service with default options. */
export async function uploads(service) {
  await refusedFiles(service);
  await externalBuffers(service);
  await notWatertight(service);
  await manyGood(service);
  await killed(service);
  await million(service);
}

/** Runs the checks for a service that runs one job at a time and queues one more. */
export async function full({ checks, base, operations, pid }) {
  await checks.run('503, a queue that is full', async () => {
    const first = ask(base, heavy(), { patience: 300000 });
    await until('a validator', () => validatorsOf(pid).length > 0);
    const others = [...Array(6)].map(() => ask(base, heavy(30000), { patience: 300000 }));
    await mustBeWell(operations);
    const answers = await Promise.all([first, ...others]);
    const full = answers.filter((answer) => answer?.status === 503);
    for (const answer of full) {
      problemIn(answer, 503, 'queue_full');
      must(/^[1-9]\d*$/.test(answer.headers['retry-after'] ?? ''), `Retry-After is ${answer.headers['retry-after']}`);
    }
    const taken = answers.filter((answer) => answer?.status === 200);
    must(answers[0]?.status === 200, `the first was answered with ${answers[0]?.status}`);
    must(taken.length >= 2 && full.length >= 1 && taken.length + full.length === 7,
      `of 7, ${taken.length} were judged and ${full.length} sent away`);
    for (const answer of taken) must(jsonOf(answer).state === 'done', 'a report is not done');
    console.log(`        of 7 uploads ${taken.length} were judged and ${full.length} sent away`);
    await mustHaveNoChildren(pid);
  });
  await checks.run('200, the queue once it is empty', async () => {
    must((await ask(base, upload('sphere.glb', files['sphere.glb'].bytes())))?.status === 200, 'it is refused');
  });
}

async function limited({ checks, base, operations, pid }, name, request, says) {
  await checks.run(name, async () => {
    const answer = await ask(base, request, { patience: 120000 });
    const problem = problemIn(answer, 500, 'validator_limit');
    must(says.test(problem.detail), problem.detail);
    const report = jsonOf(await ask(base, { target: answer.headers.location }));
    must(report.state === 'failed' && report.problem.code === 'validator_limit', `the report is ${report.state}`);
    await mustHaveNoChildren(pid);
    await mustBeWell(operations);
  });
}

/** Runs the checks for a service with a limit of one second per job. */
export const late = (service) => limited(service, '500, more time than the limit', heavy(200000), /1 s/);

/** Runs the checks for a service with a limit of 128 MB per job. */
export async function cramped(service) {
  await limited(service, '500, more memory than the limit', upload('soup.stl', stl(soup(1000000, 0.001))), /128 MB/);
}

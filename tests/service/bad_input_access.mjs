// Rows of the table of bad input that need a service with a token, or a service that stores reference histograms
// ("masters").
import { ask, jsonOf, must, requestBytes } from './http_probe.mjs';
import { mustBeSafe, mustRefuse } from './bad_input_rows.mjs';

const secret = '0123456789abcdefXYZ';

export async function token(service) {
  const { checks, base, operations } = service;
  const bearer = (text) => ({ Authorization: text });
  const refused = { '401, no token': {}, '401, a wrong token': bearer('Bearer 0123456789abcdefXYy'),
    '401, the token and more': bearer(`Bearer ${secret}0`), '401, half a token': bearer(`Bearer ${secret.slice(0, 9)}`),
    '401, an empty token': bearer('Bearer '), '401, another scheme': bearer(`Basic ${secret}`) };
  const isRefused = (answer, name) => {
    must(answer?.status === 401, `${name}: answered with ${answer?.status}`);
    must(answer.headers['www-authenticate'] === 'Bearer', `${name}: no WWW-Authenticate`);
    must(jsonOf(answer).code === 'no_token', `${name}: the code is ${jsonOf(answer).code}`);
    must(answer.headers['content-type'] === 'application/problem+json', `${name}: no problem object`);
    mustBeSafe(answer);
  };
  for (const [name, headers] of Object.entries(refused)) {
    await checks.run(name, async () => {
      for (const target of ['/api/v1/summary', '/api/v1/nothing', '/api/v1/reports/0123456789abcdef'])
        isRefused(await ask(base, { target, headers }), target);
      isRefused(await ask(operations, { target: '/metrics', headers }), '/metrics');
      const upload = { method: 'POST', target: '/api/v1/validate?name=a.stl', headers, body: Buffer.alloc(84) };
      isRefused(await ask(base, upload), 'an upload');
    });
  }
  await checks.run('200, the right token', async () => {
    for (const headers of [bearer(`Bearer ${secret}`), bearer(`bearer ${secret}`)]) {
      must((await ask(base, { target: '/api/v1/summary', headers }))?.status === 200, 'the interface refuses it');
      must((await ask(operations, { target: '/metrics', headers }))?.status === 200, '/metrics refuses it');
      must((await ask(base, { target: '/api/v1/nothing', headers }))?.status === 404, 'there is something');
    }
  });
  await checks.run('200, the page and the health without a token', async () => {
    must((await ask(base, { target: '/' }))?.status === 200, 'the page');
    must((await ask(operations, { target: '/healthz' }))?.status === 200, '/healthz');
    must((await ask(operations, { target: '/readyz' }))?.status === 200, '/readyz');
  });
}

export async function masters(service) {
  const { checks, base } = service;
  const put = (text, headers = { 'Content-Type': 'application/json' }) =>
    requestBytes(base, { method: 'PUT', target: '/api/v1/masters', headers, body: Buffer.from(text) });
  const wellFormed = { status: 422, code: 'bad_input', closes: false };
  const malformed = { status: 400, code: 'bad_json', closes: false };
  const there = async () => jsonOf(await ask(base, { target: '/api/v1/masters' }));
  const before = await there();
  checks.check('masters to begin with', before.writable === true && before.masters.length > 0);
  const spoilt = (change) => {
    const copy = structuredClone(before);
    change(copy);
    return JSON.stringify(copy);
  };
  const at = (pattern) => (problem) => must(pattern.test(problem.pointer ?? ''), `the pointer is ${problem.pointer}`);
  const rows = {
    '400, JSON that ends early': ['{"masters":[', malformed],
    '400, no JSON': ['not json', malformed],
    '400, no text at all': ['', malformed],
    '400, JSON and more': [`${JSON.stringify(before)}x`, malformed],
    '400, JSON that is no UTF-8': [Buffer.from('{"masters":["\xff\xfe"]}', 'latin1'), malformed],
    '400, JSON that nests deep': ['['.repeat(100000), malformed],
    '422, an array': ['[]', wellFormed],
    '422, no masters': ['{}', wellFormed],
    '422, a share below 0': [spoilt((m) => { m.masters[0].shares[3] = -1; }),
      { ...wellFormed, problem: at(/^\/masters\/0\/shares/) }],
    '422, a share that is a word': [spoilt((m) => { m.masters[1].shares[2] = 'half'; }),
      { ...wellFormed, problem: at(/^\/masters\/1\/shares\/2$/) }],
    '422, too few shares': [spoilt((m) => { m.masters[0].shares.pop(); }),
      { ...wellFormed, problem: at(/^\/masters\/0/) }],
    '422, a mode that nobody knows': [spoilt((m) => { m.masters[0].key.mode = 'guessed'; }),
      { ...wellFormed, problem: at(/^\/masters\/0\/key\/mode$/) }],
    '422, a limit below 0': [spoilt((m) => { m.limits[0].mse = -1; }), { ...wellFormed, problem: at(/^\/limits\/0/) }],
  };
  for (const [name, [text, wants]] of Object.entries(rows))
    await checks.run(`${name} to /api/v1/masters`, () => mustRefuse(service, put(text), wants));
  await checks.run('415, masters of an unknown type', () => mustRefuse(service,
    put('{}', { 'Content-Type': 'text/plain' }), { status: 415, code: 'unsupported_type', closes: true }));
  await checks.run('413, 5 MB of masters', () => mustRefuse(service,
    requestBytes(base, { method: 'PUT', target: '/api/v1/masters',
      headers: { 'Content-Type': 'application/json', 'Content-Length': 5 << 20 } }),
    { status: 413, code: 'too_large', closes: true }));
  await checks.run('the masters are what they were', async () => {
    must(JSON.stringify((await there()).masters) === JSON.stringify(before.masters), 'something was kept');
  });
  await checks.run('200, masters as they should be', async () => {
    const answer = await ask(base, { method: 'PUT', target: '/api/v1/masters',
      headers: { 'Content-Type': 'application/json' }, body: Buffer.from(JSON.stringify(before)) });
    must(answer?.status === 200, `answered with ${answer?.status} ${answer?.body}`);
    must(JSON.stringify(jsonOf(answer).masters) === JSON.stringify(before.masters), 'they are others');
  });
}

// Rows of the table of bad input that the HTTP layer refuses: request lines, headers, targets, lengths, names.
import { ask, must, requestBytes, talk } from './http_probe.mjs';
import { mustBeSafe, mustBeWell, mustRefuse, problemIn } from './bad_input_rows.mjs';
import { hugeLine, slowly, tooManyChunks } from './bad_input_sizes.mjs';

const bad = { status: 400, code: 'bad_request', closes: true };
const missing = { status: 404, code: 'not_found', closes: false };
const stl = { 'Content-Type': 'model/stl' };

/** For each name: the bytes that a client sends, and the required response. `host` is a valid Host field. */
const refusals = (base, host) => {
  const get = (target, headers = {}) => requestBytes(base, { target, headers });
  const post = (headers, extra = {}) =>
    requestBytes(base, { method: 'POST', target: '/api/v1/validate', headers, ...extra });
  const raw = (line, ...fields) => [line, ...fields, '', ''].join('\r\n');
  const fields = (count, value) => Object.fromEntries([...Array(count).keys()].map((i) => [`X-${i}`, value]));
  const long = 'a'.repeat(9000);
  return {
    '400, a request line that is none': ['NONSENSE\r\n\r\n', bad],
    '400, a request line of four words': [raw('GET / x HTTP/1.1', host), bad],
    '400, a version that is none': [raw('GET / FTP/1.1', host), bad],
    '400, HTTP/0.9': ['GET /\r\n\r\n', bad],
    '400, TLS': [Buffer.from([22, 3, 1, 0, 165, 1, 0, 0, 161, 3, 3]), bad],
    '400, a line feed alone': [`GET / HTTP/1.1\n${host}\n\n`, bad],
    '400, a header without a colon': [raw('GET / HTTP/1.1', host, 'No colon here'), bad],
    '400, a blank before the colon': [raw('GET / HTTP/1.1', host, 'Accept : x'), bad],
    '400, a folded header': [raw('GET / HTTP/1.1', host, 'Accept: x', ' y'), bad],
    '400, a NUL in a header': [raw('GET / HTTP/1.1', host, 'Accept: a\0b'), bad],
    '400, no Host': [raw('GET / HTTP/1.1'), bad],
    '400, two Hosts': [raw('GET / HTTP/1.1', host, host), bad],
    '400, a Content-Length that is no number': [post({ ...stl, 'Content-Length': '1x' }), bad],
    '400, a Content-Length below 0': [post({ ...stl, 'Content-Length': '-1' }), bad],
    '400, a Content-Length beyond 64 bits': [post({ ...stl, 'Content-Length': '99999999999999999999' }), bad],
    '400, a chunk whose size is no number': [Buffer.concat([post({ ...stl, 'Transfer-Encoding': 'chunked' }),
      Buffer.from('zz\r\n')]), bad],
    '400, smuggling: both lengths': [post({ ...stl, 'Content-Length': 3, 'Transfer-Encoding': 'chunked' }), bad],
    '400, smuggling: two lengths': [raw('POST /api/v1/validate HTTP/1.1', host, 'Content-Type: model/stl',
      'Content-Length: 0', 'Content-Length: 30'), bad],
    '400, smuggling: two lengths in one field': [post({ ...stl, 'Content-Length': '0, 30' }), bad],
    '400, smuggling: two encodings': [raw('POST /api/v1/validate HTTP/1.1', host, 'Content-Type: model/stl',
      'Transfer-Encoding: chunked', 'Transfer-Encoding: identity'), bad],
    '400, smuggling: chunks in HTTP/1.0': [raw('POST /api/v1/validate HTTP/1.0', host, 'Content-Type: model/stl',
      'Transfer-Encoding: chunked'), bad],
    '400, a target of another server': [get('http://example.com/'), bad],
    '400, CONNECT': [raw('CONNECT example.com:443 HTTP/1.1', host), bad],
    '400, half an escape': [get('/%zz'), bad],
    '400, traversal': [get('/../../etc/passwd'), bad],
    '400, traversal in escapes': [get('/..%2f..%2fetc/passwd'), bad],
    '400, traversal in escaped points': [get('/%2e%2e/%2e%2e/etc/passwd'), bad],
    '400, traversal with backslashes': [get('/..%5c..%5cetc%5cpasswd'), bad],
    '400, a NUL in the path': [get('/%00'), bad],
    '400, a NUL behind a page\'s file': [get('/page.css%00.txt'), bad],
    '400, an overlong escape of a slash': [get('/..%c0%af..%c0%afetc/passwd'), bad],
    '400, many slashes': [get('/'.repeat(8000)), bad],
    '400, a parameter that nobody knows': [post(stl, { target: '/api/v1/validate?colour=red', body: Buffer.alloc(3) }),
      { status: 400, code: 'bad_parameter', closes: true }],
    '404, a file of the machine': [get('/etc/passwd'), missing],
    '404, an unknown path': [get('/api/v1/nothing'), missing],
    '404, a folder of the page': [get('/api'), missing],
    '404, an unknown report': [get('/api/v1/reports/0123456789abcdef'), missing],
    '404, an unknown preview': [get('/api/v1/reports/0123456789abcdef/preview'), missing],
    '404, an unknown world': [get('/api/v1/worlds/nowhere/chunks'), missing],
    '405, DELETE of the reports': [requestBytes(base, { method: 'DELETE', target: '/api/v1/reports' }),
      { status: 405, code: 'method_not_allowed', closes: false, headers: { allow: /^GET, HEAD$/ } }],
    '405, GET of what is sent': [get('/api/v1/validate'),
      { status: 405, code: 'method_not_allowed', closes: false, headers: { allow: /^POST$/ } }],
    '405, a method that nobody knows': [requestBytes(base, { method: 'BREW', target: '/' }),
      { status: 405, code: 'method_not_allowed', closes: false, headers: { allow: /^GET, HEAD$/ } }],
    '405, POST of the masters': [post({}, { target: '/api/v1/masters', body: Buffer.from('{}') }),
      { status: 405, code: 'method_not_allowed', closes: true, headers: { allow: /^GET, HEAD, PUT$/ } }],
    '409, masters where none are kept': [requestBytes(base, { method: 'PUT', target: '/api/v1/masters',
      headers: { 'Content-Type': 'application/json' }, body: Buffer.from('{}') }),
    { status: 409, code: 'read_only', closes: true }],
    '411, neither a length nor chunks': [post(stl), { status: 411, code: 'length_required', closes: true }],
    '413, a length of 300 MB': [post({ ...stl, 'Content-Length': 300000000 }),
      { status: 413, code: 'too_large', closes: true }],
    '413, one byte too many': [post({ ...stl, 'Content-Length': (1 << 20) + 1 }),
      { status: 413, code: 'too_large', closes: true }],
    '413, one chunk of 4 GB': [Buffer.concat([post({ ...stl, 'Transfer-Encoding': 'chunked' }),
      Buffer.from('ffffffff\r\n')]),
    { status: 413, code: 'too_large', closes: true }],
    '413, a body behind GET': [requestBytes(base, { target: '/', body: Buffer.from('abc') }),
      { status: 413, code: 'too_large', closes: true }],
    '413, too large and 100-continue': [post({ ...stl, 'Content-Length': 300000000, Expect: '100-continue' }),
      { status: 413, code: 'too_large', closes: true }],
    '414, a long target': [get(`/${long}`), { status: 414, code: 'target_too_long', closes: true }],
    '414, a long query': [get(`/?a=${long}`), { status: 414, code: 'target_too_long', closes: true }],
    '415, an unknown type': [post({ 'Content-Type': 'image/png' }, { body: Buffer.from('abc') }),
      { status: 415, code: 'unsupported_type', closes: true }],
    '415, no type and no name': [post({}, { body: Buffer.from('abc') }),
      { status: 415, code: 'unsupported_type', closes: true }],
    '415, an unknown ending': [post({ 'Content-Type': 'application/octet-stream' },
      { target: '/api/v1/validate?name=a.exe', body: Buffer.from('abc') }),
    { status: 415, code: 'unsupported_type', closes: true }],
    '415, Content-Encoding': [post({ ...stl, 'Content-Encoding': 'gzip' }, { body: Buffer.from('abc') }),
      { status: 415, code: 'content_encoding', closes: true }],
    '417, an expectation that nobody knows': [post({ ...stl, Expect: 'miracle' }, { body: Buffer.from('abc') }),
      { status: 417, code: 'expectation_failed', closes: true }],
    '431, 65 fields': [get('/', fields(64, 'a')),
      { status: 431, code: 'header_too_large', closes: true }],
    '431, a long field': [get('/', { Cookie: long }), { status: 431, code: 'header_too_large', closes: true }],
    '431, 33 KB of fields': [get('/', fields(8, 'a'.repeat(4200))),
      { status: 431, code: 'header_too_large', closes: true }],
    '421, Host of another name': [get('/', { Host: 'evil.example' }),
      { status: 421, code: 'misdirected', closes: false }],
    '421, Host of a name that begins as ours': [get('/', { Host: 'localhost.evil.example' }),
      { status: 421, code: 'misdirected', closes: false }],
    '403, Origin of another site': [get('/api/v1/summary', { Origin: 'http://evil.example' }),
      { status: 403, code: 'foreign_origin', closes: false }],
    '403, Origin null': [get('/api/v1/summary', { Origin: 'null' }),
      { status: 403, code: 'foreign_origin', closes: false }],
    '403, an upload from another site': [post({ ...stl, Origin: 'http://localhost:1' }, { body: Buffer.alloc(84) }),
      { status: 403, code: 'foreign_origin', closes: true }],
    '501, Transfer-Encoding gzip': [post({ ...stl, 'Transfer-Encoding': 'gzip' }),
      { status: 501, code: 'transfer_encoding', closes: true }],
    '501, gzip before chunked': [post({ ...stl, 'Transfer-Encoding': 'gzip, chunked' }),
      { status: 501, code: 'transfer_encoding', closes: true }],
    '505, HTTP/3.0': [raw('GET / HTTP/3.0', host), { status: 505, code: 'http_version', closes: true }],
    '404 to HEAD, without a body': [requestBytes(base, { method: 'HEAD', target: '/nothing' }),
      { status: 404, head: true, closes: false }],
  };
};

async function goodManners({ checks, base, operations }) {
  await checks.run('requests in one piece are answered in order', async () => {
    const targets = ['/api/v1/reports', '/nothing', '/api/v1/openapi.json', '/api/v1/validate', '/'];
    const bytes = Buffer.concat(targets.map((target) => requestBytes(base, { target })));
    const { answers } = await talk(base, bytes, { wanted: targets.length });
    must(String(answers.map((a) => a.status)) === '200,404,200,405,200', String(answers.map((a) => a.status)));
    must(answers[0].body.toString().startsWith('{"reports"'), 'the first is not of the reports');
    must(answers[2].body.toString().includes('"openapi"'), 'the third is not the description');
    must(answers[4].body.toString().startsWith('<!doctype html>'), 'the fifth is not the page');
  });
  await checks.run('an upload and a request in one piece', async () => {
    const upload = requestBytes(base,
      { method: 'POST', target: '/api/v1/validate?name=a.obj', body: Buffer.from('v 1\n') });
    const { answers } = await talk(base, Buffer.concat([upload, requestBytes(base, { target: '/' })]),
      { wanted: 2, patience: 60000 });
    must(String(answers.map((a) => a.status)) === '422,200', String(answers.map((a) => a.status)));
  });
  await checks.run('HEAD has what GET has, but for the body', async () => {
    for (const target of ['/', '/page.css', '/api/v1/reports', '/api/v1/openapi.json']) {
      const got = await ask(base, { target }), head = await ask(base, { method: 'HEAD', target });
      must(got?.status === 200 && head?.status === 200, `${target}: ${got?.status} and ${head?.status}`);
      must(got.body.length > 0 && head.headers['content-length'] === String(got.body.length), `${target}: its length`);
      must(head.headers['content-type'] === got.headers['content-type'], `${target}: another type`);
      mustBeSafe(got);
      mustBeSafe(head);
    }
    const { answers, rest } = await talk(base, requestBytes(base, { method: 'HEAD', target: '/' }),
      { heads: [0], linger: 300 });
    must(answers.length === 1 && rest.length === 0, 'bytes follow the head');
  });
  await checks.run('100 before a body that is waited with', async () => {
    const { answers, informal } = await talk(base, (socket) => {
      socket.write(requestBytes(base, { method: 'POST', target: '/api/v1/validate',
        headers: { ...stl, 'Content-Length': 4, Expect: '100-continue' } }));
      socket.once('data', () => socket.write('abcd'));
    }, { patience: 60000 });
    must(String(informal) === '100', `first came ${informal}`);
    problemIn(answers[0], 422, 'bad_input');
  });
  await checks.run('no 100 before a refusal', async () => {
    const { informal, answers } = await talk(base, requestBytes(base, { method: 'POST', target: '/api/v1/validate',
      headers: { ...stl, 'Content-Length': 300000000, Expect: '100-continue' } }));
    must(informal.length === 0 && answers[0]?.status === 413, `${informal} ${answers[0]?.status}`);
  });
  await checks.run('our own Origin is welcome', async () => {
    const answer = await ask(base, { target: '/api/v1/summary', headers: { Origin: base } });
    must(answer?.status === 200, `answered with ${answer?.status}`);
  });
  await mustBeWell(operations);
}

export async function rows(service) {
  const { checks, base } = service;
  const slow = slowly(service);
  const host = `Host: ${new URL(base).host}`;
  for (const [name, [bytes, wants]] of Object.entries(refusals(base, host)))
    await checks.run(name, () => mustRefuse(service, bytes, wants));
  await goodManners(service);
  await checks.run('413, chunks beyond the limit', () => tooManyChunks(service));
  await checks.run('431, 100 MB of a field', () => hugeLine(service,
    `GET / HTTP/1.1\r\n${host}\r\nX: `, 431, 'header_too_large'));
  await checks.run('414, 100 MB of a target', () => hugeLine(service, 'GET /', 414, 'target_too_long'));
  for (const [name, outcome] of slow)
    await checks.run(name, () => outcome.then((error) => must(!error, error?.message)));
}

// Sends random requests, some that the OpenAPI description allows and some that it does not, and checks every response:
// its status must be in the description, and its body must have the described type and schema. Every described status
// must occur.
//
//   node api_test.mjs BASE_URL OPERATIONS_URL TOKEN_BASE_URL TOKEN_OPERATIONS_URL MESH NODE_MODULES
//
// The first service may write masters and needs no token; the second one's token is 0123456789abcdef.
import fs from 'node:fs';
import { createRequire } from 'node:module';
import { ask, askSlowly, chance, pick, seed } from './api_requests.mjs';

const [base, operations, tokenBase, tokenOperations, meshFile, modules] = process.argv.slice(2);
const load = createRequire(`${modules}/`);
const { Validator } = load('@seriousme/openapi-schema-validator');
const Ajv = load('ajv').default, addFormats = load('ajv-formats').default;
const kToken = { authorization: 'Bearer 0123456789abcdef' };
const kRounds = process.env.SGM_LONG ? 2000 : 150;
/// Statuses that a test cannot provoke in a healthy service; other tests cover them.
const kOutOfReach = new Set(['500', '503', '507']);

let failures = 0;
const fail = (text) => { if (++failures <= 20) console.log(`FAILED: ${text}`); };
console.log(`seed ${seed}`);

const description = await (await fetch(`${base}/api/v1/openapi.json`)).json();
const verdict = await new Validator().validate(structuredClone(description));
if (!verdict.valid) fail(`the description is no OpenAPI: ${JSON.stringify(verdict.errors).slice(0, 500)}`);

/// Converts a schema of OpenAPI 3.0 to JSON Schema: `nullable` becomes the additional type null.
function jsonSchema(value) {
  if (Array.isArray(value)) return value.map(jsonSchema);
  if (value === null || typeof value !== 'object') return value;
  const { nullable, ...rest } = Object.fromEntries(Object.entries(value).map(([key, inner]) => [key, jsonSchema(inner)]));
  return nullable === true ? { anyOf: [{ type: 'null' }, rest] } : rest;
}
const ajv = addFormats(new Ajv({ strict: false, allErrors: false }));
ajv.addSchema({ $id: 'doc', components: jsonSchema(description.components) });
const resolve = (node) => (node.$ref ? node.$ref.slice(2).split('/').reduce((at, key) => at[key], description) : node);
const checkers = new Map();
function schemaFails(schema, value) {
  const text = JSON.stringify(jsonSchema(schema)).replaceAll('"#/', '"doc#/');
  if (!checkers.has(text)) checkers.set(text, ajv.compile(JSON.parse(text)));
  const check = checkers.get(text);
  return check(value) ? null : ajv.errorsText(check.errors);
}

const mesh = fs.readFileSync(meshFile);
const known = { name: ['nothing'], id: ['0123456789abcdef'] };
{
  const report = await fetch(`${base}/api/v1/validate`, { method: 'POST', body: mesh, headers: { 'content-type': 'model/gltf-binary' } });
  known.id.push((await report.json()).id);
  const { worlds } = await (await fetch(`${base}/api/v1/summary`)).json();
  known.name.push(...worlds.map((world) => world.name));
}
const masters = await (await fetch(`${base}/api/v1/masters`)).text();
const bodies = {
  'model/gltf-binary': [mesh, mesh.subarray(0, 100), Buffer.alloc(0)],
  'model/gltf+json': [mesh, '{"asset":{"version":"2.0"}}', '{'],
  'model/obj': ['v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n', 'f 1 2 9\n'],
  'model/stl': ['solid a\nendsolid a\n', 'not at all'],
  'text/x-sgm': ['sgm 1; units m; start Ball; rule Ball { sphere(2m); }', 'sgm 1; rule', 'sgm 1; import "/etc/passwd" as x;'],
  'application/json': [masters, '{', '[]', '{"masters":[],"limits":7}'],
  'application/octet-stream': [mesh, 'x'],
  'text/plain': ['x'],
};

/// Every operation of the OpenAPI description, with the statuses that the service has returned for it so far (`seen`).
const all = [];
for (const [path, item] of Object.entries(description.paths)) {
  for (const method of ['get', 'put', 'post']) {
    if (!item[method]) continue;
    const atOperations = item[method].tags.includes('operations');
    all.push({ path, method: method.toUpperCase(), operation: item[method], seen: new Set(),
      from: atOperations ? operations : base, guarded: atOperations ? tokenOperations : tokenBase });
  }
}

function hold(one, answer, what) {
  const { status, headers, body, problem } = answer;
  const where = `${one.method} ${one.path} (${what}): ${status}`;
  if (problem) return fail(`${where}: ${problem}`);
  if (headers['x-content-type-options'] !== 'nosniff') fail(`${where}: lacks nosniff`);
  const described = one.operation.responses[String(status)];
  if (!described) return fail(`${where} is not described: ${body.toString().slice(0, 200)}`);
  one.seen.add(String(status));
  const { content, headers: wanted } = resolve(described);
  for (const name of Object.keys(wanted ?? {})) if (!headers[name.toLowerCase()]) fail(`${where}: lacks ${name}`);
  if (status === 503 && !headers['retry-after'] && !body.includes('no_validator')) fail(`${where}: lacks Retry-After`);
  const type = (headers['content-type'] ?? '').split(';')[0];
  if (!content[type]) return fail(`${where}: is of the type '${type}'`);
  if (!/json$/.test(type) || what === 'HEAD') return;
  let value;
  try { value = JSON.parse(body); } catch { return fail(`${where}: is no JSON`); }
  const wrong = schemaFails(content[type].schema, value);
  if (wrong) fail(`${where}: ${wrong}: ${body.toString().slice(0, 300)}`);
  if (type === 'application/problem+json' && value.status !== status) fail(`${where}: its problem says ${value.status}`);
}

/// Returns a random value for a parameter: mostly one that fits its schema, sometimes one that does not.
function valueFor(parameter) {
  if (parameter.in === 'path') return chance(0.8) ? pick(known[parameter.name]) : pick(['..', 'a b', 'ä', 'x'.repeat(300)]);
  if (parameter.schema.type === 'number' || parameter.schema.type === 'integer') return pick(['0.5', '1', '-1', 'x', '1e999']);
  return pick({ name: ['a.glb', 'b.obj', 'c', '<i>.sgm', 'x'.repeat(300)], region: ['0,0,0:4,4,4', 'nonsense'],
    set: ['radius=1m', 'x'], Prefer: ['respond-async', 'wait=1'] }[parameter.name]);
}
function drawRequest(one) {
  let path = one.path;
  const query = [], headers = {};
  for (const parameter of one.operation.parameters ?? []) {
    const value = encodeURIComponent(valueFor(parameter));
    if (parameter.in === 'path') path = path.replace(`{${parameter.name}}`, value);
    else if (parameter.in === 'query' && chance(0.25)) query.push(`${parameter.name}=${value}`);
    else if (parameter.in === 'header' && chance(0.2)) headers[parameter.name] = decodeURIComponent(value);
  }
  if (chance(0.05)) query.push(pick(['unknown=1', 'a=%zz', 'a', '&&']));
  let body = null;
  if (one.operation.requestBody) {
    const described = Object.keys(one.operation.requestBody.content).filter((type) => bodies[type]);
    const type = chance(0.9) ? pick(described) : pick(Object.keys(bodies));
    body = pick(bodies[type]);
    headers['content-type'] = type;
  }
  return { path: query.length ? `${path}?${query.join('&')}` : path, headers, body };
}
/// Returns the simplest valid request for an operation, with existing ids and names.
const plain = (one) => ({ path: one.path.replace('{id}', known.id[1]).replace('{name}', known.name.at(-1)), headers: {}, body: null });

// These requests time out; they run while the others are sent.
const slow = all.map((one) => askSlowly(one.from, one.method, plain(one).path).then((answer) => hold(one, answer, 'slow')));
for (const one of all) {
  for (let i = 0; i < kRounds / 10; ++i) hold(one, await ask(one.from, one.method, drawRequest(one)), 'drawn');
  const request = plain(one), asks = (changed) => ask(one.from, one.method, { ...request, ...changed });
  hold(one, await asks({ headers: { host: 'evil.example' } }), 'Host');
  hold(one, await asks({ headers: { origin: 'http://evil.example' } }), 'Origin');
  hold(one, await asks({ path: `${request.path}?a=%zz` }), 'a bad escape');
  hold(one, await asks({ headers: { 'content-length': '99999999999', 'content-type': 'model/stl', ...(one.method === 'PUT' ? { 'content-type': 'application/json' } : {}) } }), 'too much');
  hold(one, await ask(one.guarded, one.method, request), 'no token');
  if (one.method === 'GET') {
    hold(one, await asks({}), 'plain');
    const found = await ask(one.guarded, 'HEAD', { ...request, headers: kToken });
    if (found.body.length > 0) fail(`HEAD ${one.path} has a body`);
    const wrong = await ask(one.from, 'DELETE', request);
    if (wrong.status !== 405 || !wrong.headers.allow?.includes('GET')) fail(`DELETE ${one.path} is no 405 with Allow`);
  } else {
    const type = one.method === 'PUT' ? 'application/json' : 'model/gltf-binary';
    hold(one, await asks({ headers: { 'content-type': type }, unsized: true }), 'no length');
    hold(one, await asks({ headers: { 'content-type': 'text/plain' }, body: 'x' }), 'type');
    hold(one, await asks({ headers: { 'content-type': type }, body: one.method === 'PUT' ? masters : mesh }), 'well');
    hold(one, await asks({ headers: { 'content-type': type }, body: one.method === 'PUT' ? '{"masters":1}' : 'x' }), 'wrong');
    hold(one, await ask(one.guarded, one.method, { ...request, headers: { 'content-type': type, ...kToken }, body: one.method === 'PUT' ? masters : mesh }), 'read only');
    if (one.method === 'POST') hold(one, await asks({ headers: { 'content-type': type, prefer: 'respond-async' }, body: mesh }), 'no wait');
  }
}
for (let i = 0; i < kRounds; ++i) {
  const one = pick(all);
  hold(one, await ask(one.from, one.method, drawRequest(one)), 'drawn');
}
await Promise.all(slow);

let answers = 0;
for (const one of all) {
  answers += one.seen.size;
  const missing = Object.keys(one.operation.responses).filter((status) => !one.seen.has(status) && !kOutOfReach.has(status));
  if (missing.length > 0) fail(`${one.method} ${one.path} was never answered with ${missing.join(', ')}`);
}
console.log(`${all.length} operations, ${answers} described answers seen, ${failures} failures`);
process.exit(failures === 0 ? 0 : 1);

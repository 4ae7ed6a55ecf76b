// Tests the language server as an editor would use it, with VS Code's own client library: opens and edits grammars, and
// sends requests about them.
//
//   node lsp_client.js FOLDER_OF_NODE_MODULES COMMAND PROJECT
const { spawn } = require('child_process');
const fs = require('fs');
const os = require('os');
const path = require('path');
const { pathToFileURL } = require('url');

const [tools, command, project] = process.argv.slice(2);
let protocol;
try {
  protocol = require(path.resolve(tools, 'vscode-languageserver-protocol/node'));
} catch (e) {
  console.error(`SKIPPED: no vscode-languageserver-protocol in ${tools}: tests/run.sh installs it`);
  process.exit(process.env.SGM_REQUIRE_ALL === '1' ? 1 : 77);
}

let failures = 0;
function check(holds, what, seen) {
  if (holds) return;
  ++failures;
  console.error(`FAILED: ${what}${seen === undefined ? '' : `: ${JSON.stringify(seen)}`}`);
}

const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'sgm lsp '));
process.on('exit', () => fs.rmSync(folder, { recursive: true, force: true }));
const uriOf = (name) => pathToFileURL(path.join(folder, name)).toString();

const child = spawn(command, ['lsp'], { stdio: ['pipe', 'pipe', 'inherit'] });
const connection = protocol.createProtocolConnection(
  new protocol.StreamMessageReader(child.stdout), new protocol.StreamMessageWriter(child.stdin));
const published = new Map();
let awaited = [];
connection.onNotification(protocol.PublishDiagnosticsNotification.type, ({ uri, diagnostics }) => {
  published.set(uri, diagnostics);
  awaited = awaited.filter(([wanted, resolve]) => wanted !== uri || resolve(diagnostics));
});
connection.listen();

const nextDiagnostics = (uri) => new Promise((resolve) => awaited.push([uri, (d) => void resolve(d)]));
async function open(uri, text) {
  const diagnostics = nextDiagnostics(uri);
  connection.sendNotification('textDocument/didOpen', { textDocument: { uri, languageId: 'sgm', version: 1, text } });
  return diagnostics;
}
let version = 1;
async function change(uri, text) {
  const diagnostics = nextDiagnostics(uri);
  connection.sendNotification('textDocument/didChange', {
    textDocument: { uri, version: ++version }, contentChanges: [{ text }] });
  return diagnostics;
}
/// Returns the position of the n-th `word` of the text, plus `into`, in UTF-16 units as in JavaScript strings.
function placeOf(text, word, n = 0, into = 0) {
  let at = -1;
  for (let i = 0; i <= n; ++i) at = text.indexOf(word, at + 1);
  const before = text.slice(0, at + into).split('\n');
  return { line: before.length - 1, character: before[before.length - 1].length };
}
const ask = (method, uri, position) => connection.sendRequest(method, { textDocument: { uri }, position });

const cave = `sgm 1;
import "std/cave.sgm" as cave;
import "parts/arch.sgm" as parts;
units m;
// Häuser 𝔸 and 😀: what is no ASCII counts as editors count.
param wet = 50% in 10%..100% "how wet 😀 it is";
domain infinite solid limestone;
layer net cell 96m reach 92m { start Node; }
let hub(c) = c.point(jitter 0.3);

// A room of a radius.
rule Node { cut { at(hub(cell)) /* 😀 */ Room(rand(7m, 12m)*wet); } }
rule Room(r) { cave.Hall(r); parts.Arch(r); let twice = 2*r; sphere(twice); }
override "net(0, 0, 0)/Node/Room[0]" { sphere(0.5*r); }
`.replace(' /* 😀 */', '');

(async () => {
  fs.mkdirSync(path.join(folder, 'parts'));
  fs.writeFileSync(path.join(folder, 'parts/arch.sgm'), 'sgm 1;\n// An arch.\nrule Arch(r) { torus(r, 0.2*r); }\n');

  let refused = await connection.sendRequest('textDocument/hover', {}).catch((e) => e);
  check(refused.code === -32002, 'a request before initialize is refused', refused);
  const { capabilities } = await connection.sendRequest(protocol.InitializeRequest.type, {
    processId: process.pid, rootUri: null, capabilities: {} });
  check(capabilities.hoverProvider && capabilities.definitionProvider, 'capabilities are told', capabilities);
  connection.sendNotification(protocol.InitializedNotification.type, {});

  // Diagnostics.
  const uri = uriOf('a cave.sgm');
  check((await open(uri, cave)).length === 0, 'a good grammar has no diagnostics', published.get(uri));
  let wrong = await change(uri, cave.replace('*wet); }', '*wett); }'));
  check(wrong.length === 1 && wrong[0].code === 'unknown-name' && wrong[0].severity === 1, 'an error is told', wrong);
  check(wrong[0].message.includes('did you mean `wet`?'), 'with what to write instead', wrong);
  const place = placeOf(cave, 'wet)');
  const { start, end } = wrong[0].range;
  check(start.line === place.line && start.character === place.character && end.line === start.line &&
    end.character === start.character + 4, 'at its place', wrong[0].range);
  wrong = await change(uri, cave.replace('"how wet 😀 it is";', '"how wet 😀 it is" nonsense;'));
  check(wrong.length === 1 && wrong[0].range.start.character === placeOf(cave, '"how wet 😀 it is";').character + 19,
    'characters are UTF-16 units', wrong);
  check((await change(uri, cave)).length === 0, 'and taken back');

  // If an imported file is open in the editor, its document must be used rather than the file on the disk; its errors
  // must be reported in that document.
  const arch = uriOf('parts/arch.sgm');
  fs.writeFileSync(path.join(folder, 'parts/bad.sgm'), 'sgm 1;\nrule Bad { sphere(2); }\n');
  const bad = nextDiagnostics(uriOf('parts/bad.sgm'));
  await change(uri, cave.replace('parts/arch.sgm', 'parts/bad.sgm'));
  check((await bad).some((d) => d.code === 'unit-mismatch' && d.range.start.line === 1), 'of an import', await bad);
  await change(uri, cave);
  check(published.get(uriOf('parts/bad.sgm')).length === 0, 'and taken back with it');
  await open(arch, 'sgm 1;\nrule Arc(r) { torus(r, 0.2*r); }\n');
  wrong = await change(uri, cave + '\n');
  check(wrong.length === 1 && wrong[0].code === 'unknown-name', 'an open import counts before its file', wrong);
  connection.sendNotification('textDocument/didClose', { textDocument: { uri: arch } });
  check((await change(uri, cave)).length === 0, 'until it is closed', published.get(uri));

  // Definitions.
  const startOf = async (word, n, into) => {
    const places = await ask('textDocument/definition', uri, placeOf(cave, word, n, into));
    return places.map((p) => [p.uri, p.range.start.line, p.range.start.character].join(' '));
  };
  const at = (word, n = 0, into = 0) => {
    const p = placeOf(cave, word, n, into);
    return `${uri} ${p.line} ${p.character}`;
  };
  check((await startOf('Room(rand'))[0] === at('rule Room', 0, 5), 'of a rule', await startOf('Room(rand'));
  check((await startOf('wet); }', 0, 3))[0] === at('param wet', 0, 6), 'of a parameter');
  check((await startOf('hub(cell)'))[0] === at('let hub', 0, 4), 'of a let');
  check((await startOf('c.point'))[0] === at('hub(c)', 0, 4), 'of a let\'s own parameter');
  check((await startOf('(twice)', 0, 1))[0] === at('let twice', 0, 4), 'of a local');
  check((await startOf('2*r', 0, 2))[0] === at('Room(r)', 0, 5), 'of a rule\'s parameter');
  check((await startOf('0.5*r', 0, 4))[0] === at('Room(r)', 0, 5), 'in an override of the rule');
  check((await startOf('Arch(r)'))[0] === `${arch} 2 5`, 'in an import', await startOf('Arch(r)'));
  const hall = await ask('textDocument/definition', uri, placeOf(cave, 'Hall(r)'));
  check(hall[0].uri === 'sgm-std:/cave.sgm', 'in the standard library', hall);
  const text = await connection.sendRequest('sgm/standardText', { uri: hall[0].uri });
  check(text.split('\n')[hall[0].range.start.line].includes('rule Hall'), 'whose text can be had', hall);
  check((await startOf('sphere(twice')).length === 0, 'a shape has none');

  // Hover.
  const hover = async (word, n, into) => (await ask('textDocument/hover', uri, placeOf(cave, word, n, into)))?.contents.value;
  check((await hover('wet); }')).includes('param wet = 50% in 10%..100%'), 'a parameter', await hover('wet); }'));
  check((await hover('wet); }')).includes('how wet 😀 it is'), 'with its text');
  check((await hover('Node;')).includes('A room of a radius.'), 'a rule with the comment above it', await hover('Node;'));
  check((await hover('rand(')).includes('rand(a, b)'), 'a function', await hover('rand('));
  check((await hover('Hall(r)')).includes('rule Hall('), 'a rule of the library', await hover('Hall(r)'));
  check((await hover('cut {')).length > 20, 'a keyword');
  check((await ask('textDocument/hover', uri, placeOf(cave, 'Häuser'))) === null, 'not a comment');

  // Tests completion in an unfinished text; `|` marks the cursor.
  const labels = async (written) => {
    await change(uri, written);
    const p = placeOf(written, '|');
    await change(uri, written.replace('|', ''));
    return (await ask('textDocument/completion', uri, p)).map((item) => item.label);
  };
  let list = await labels(cave.replace('sphere(twice)', 'sp|'));
  check(['sphere', 'split', 'Room', 'twice', 'r', 'wet', 'hub', 'cave'].every((w) => list.includes(w)), 'all that is known', list);
  check(new Set(list).size === list.length, 'each once');
  check(!(await labels(cave.replace('at(hub(cell))', 'at(|)'))).includes('twice'), 'but no locals of other rules');
  list = await labels(cave.replace('cave.Hall(r)', 'cave.|'));
  check(list.includes('Hall') && list.includes('Passage') && !list.includes('sphere'), 'of an import', list);
  check((await labels(cave.replace('parts.Arch(r)', 'parts.A|'))).join() === 'Arch', 'of a file');
  list = await labels(cave.replace('c.point(', 'cell.|('));
  check(list.includes('point') && list.includes('links'), 'of a cell', list);
  check((await labels(cave.replace('Häuser', 'Hä|user'))).length === 0, 'nothing in a comment');

  // Tests symbols and formatting.
  await change(uri, cave);
  const symbols = await connection.sendRequest('textDocument/documentSymbol', { textDocument: { uri } });
  check(symbols.map((s) => s.name).join() === 'cave,parts,wet,net,hub,Node,Room', 'symbols', symbols.map((s) => s.name));
  const rough = cave.replace('rule Room(r) {', 'rule   Room( r )\n{');
  await change(uri, rough);
  const edits = await connection.sendRequest('textDocument/formatting', {
    textDocument: { uri }, options: { tabSize: 2, insertSpaces: true } });
  check(edits.length === 1 && edits[0].newText.includes('rule Room(r) {'), 'formatting', edits);
  await change(uri, edits[0].newText);
  check((await connection.sendRequest('textDocument/formatting', {
    textDocument: { uri }, options: { tabSize: 2, insertSpaces: true } })).length === 0, 'done is done');
  await change(uri, 'rule {');
  check((await connection.sendRequest('textDocument/formatting', {
    textDocument: { uri }, options: { tabSize: 2, insertSpaces: true } })).length === 0, 'what is wrong stays');

  // Invalid requests.
  for (const [method, params, code] of [
    ['no/such', {}, -32601],
    ['initialize', {}, -32600],
    ['textDocument/hover', { textDocument: { uri: 'file:///nowhere.sgm' }, position: { line: 0, character: 0 } }, -32602],
    ['textDocument/hover', { textDocument: { uri }, position: { line: 'a', character: 0 } }, -32602],
    ['sgm/standardText', { uri: 'file:///etc/passwd' }, -32602],
  ]) {
    refused = await connection.sendRequest(method, params).catch((e) => e);
    check(refused.code === code, `${method} is refused`, refused);
  }

  // Every sample grammar must open without diagnostics.
  const samples = (dir) => fs.readdirSync(dir, { withFileTypes: true }).flatMap((entry) =>
    entry.isDirectory() ? samples(path.join(dir, entry.name)) : entry.name.endsWith('.sgm') ? [path.join(dir, entry.name)] : []);
  for (const file of samples(path.join(project, 'samples/grammars'))) {
    const sample = pathToFileURL(file).toString();
    const diagnostics = await open(sample, fs.readFileSync(file, 'utf8'));
    check(diagnostics.length === 0, file, diagnostics);
    connection.sendNotification('textDocument/didClose', { textDocument: { uri: sample } });
  }

  await connection.sendRequest(protocol.ShutdownRequest.type);
  refused = await ask('textDocument/hover', uri, { line: 0, character: 0 }).catch((e) => e);
  check(refused.code === -32600, 'after shutdown nothing is answered', refused);
  const ended = new Promise((resolve) => child.on('exit', resolve));
  connection.sendNotification(protocol.ExitNotification.type);
  check((await ended) === 0, 'and the end is a good one');
  if (failures === 0) console.log('all passed');
  process.exit(failures === 0 ? 0 : 1);
})().catch((e) => { console.error(`FAILED: ${e.stack}`); process.exit(1); });

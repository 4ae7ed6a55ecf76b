// Tokenizes grammars as VS Code does, and checks that each word of the language has the right scope for its colour.
//
//   node highlighting.js FOLDER_OF_NODE_MODULES PROJECT
const fs = require('fs');
const path = require('path');

const [tools, project] = process.argv.slice(2);
let textmate, oniguruma;
try {
  textmate = require(path.resolve(tools, 'vscode-textmate'));
  oniguruma = require(path.resolve(tools, 'vscode-oniguruma'));
} catch (e) {
  console.error(`SKIPPED: no vscode-textmate in ${tools}: tests/run.sh installs it`);
  process.exit(process.env.SGM_REQUIRE_ALL === '1' ? 1 : 77);
}

/// Returns the words of the table `name` in keywords.cpp.
function table(source, name) {
  return [...source.match(new RegExp(`${name} = \\{([^}]*)\\}`))[1].matchAll(/"(\w+)"/g)].map((m) => m[1]);
}

function samples(folder) {
  return fs.readdirSync(folder, { withFileTypes: true }).flatMap((entry) => {
    const full = path.join(folder, entry.name);
    return entry.isDirectory() ? samples(full) : entry.name.endsWith('.sgm') ? [full] : [];
  });
}

let failures = 0;
function check(holds, what) {
  if (!holds && ++failures <= 20) console.error(`FAILED: ${what}`);
}

(async () => {
  const wasm = fs.readFileSync(path.resolve(tools, 'vscode-oniguruma/release/onig.wasm'));
  await oniguruma.loadWASM(wasm.buffer.slice(wasm.byteOffset, wasm.byteOffset + wasm.byteLength));
  const file = path.join(project, 'editor_plugin/vscode/syntaxes/sgm.tmLanguage.json');
  const registry = new textmate.Registry({
    onigLib: Promise.resolve({
      createOnigScanner: (patterns) => new oniguruma.OnigScanner(patterns),
      createOnigString: (text) => new oniguruma.OnigString(text),
    }),
    loadGrammar: async () => textmate.parseRawGrammar(fs.readFileSync(file, 'utf8'), file),
  });
  const grammar = await registry.loadGrammar('source.sgm');
  const scopeOf = (line, word) => {
    const at = line.indexOf(word);
    const token = grammar.tokenizeLine(line, textmate.INITIAL).tokens.find((t) => t.startIndex <= at && at < t.endIndex);
    return token.scopes[token.scopes.length - 1];
  };

  // Every token of a sample must have a scope other than `invalid`.
  let tokens = 0;
  for (const sample of samples(path.join(project, 'samples/grammars'))) {
    let stack = textmate.INITIAL;
    fs.readFileSync(sample, 'utf8').split('\n').forEach((line, number) => {
      const result = grammar.tokenizeLine(line, stack);
      stack = result.ruleStack;
      for (const token of result.tokens) {
        const text = line.slice(token.startIndex, token.endIndex);
        if (text.trim() === '') continue;
        ++tokens;
        check(token.scopes.length > 1, `${sample}:${number + 1}: '${text}' has no scope`);
      }
    });
  }
  check(tokens > 5000, `only ${tokens} tokens in the samples`);

  const source = fs.readFileSync(path.join(project, 'runtime/grammar/syntax/keywords.cpp'), 'utf8');
  // A keyword that begins a statement is a reserved word, unless it is in the table kClauseWords.
  const statements = fs.readFileSync(path.join(project, 'runtime/grammar/syntax/stmts.def'), 'utf8');
  const words = [...statements.matchAll(/^SGM_STMT\(\w+, "(\w+)"/gm)].map((m) => m[1]);
  check(words.length > 25, `only ${words.length} words of statements`);
  const clauses = new Set(table(source, 'kClauseWords'));
  for (const word of [...table(source, 'kOtherKeywords'), ...words.filter((word) => !clauses.has(word))]) {
    const scope = scopeOf(`${word} ;`, word);
    check(/^(keyword|constant\.language)/.test(scope), `the keyword ${word} has the scope ${scope}`);
  }
  for (const word of [...table(source, 'kClauseWords'), ...table(source, 'kMeasures'), ...table(source, 'kBoxParts')]) {
    if (/^(m|cm|mm|km)$/.test(word)) continue;
    const scope = scopeOf(`${word} ;`, word);
    check(/^(keyword|support|variable\.language)/.test(scope), `the word ${word} has the scope ${scope}`);
  }
  const builtins = fs.readFileSync(path.join(project, 'runtime/grammar/syntax/builtins.cpp'), 'utf8');
  for (const [, word] of builtins.matchAll(/\{"(\w+)", (?:Primitive|Builtin)::/g)) {
    const scope = scopeOf(`  ${word}(1m);`, word);
    check(/^support\.function/.test(scope), `${word} has the scope ${scope}`);
  }
  for (const [line, word, wanted] of [
    ['sphere(2.5m);', '2.5', 'constant.numeric.sgm'],
    ['sphere(2.5m);', 'm)', 'keyword.other.unit.sgm'],
    ['param wet = 50% in 0%..100%;', '%', 'keyword.other.unit.sgm'],
    ['for i in 0..4 { }', '..', 'keyword.operator.sgm'],
    ['rule Hall(r) { }', 'Hall', 'entity.name.type.rule.sgm'],
    ['tag "cave // hall"; // tag', '// hall', 'string.quoted.double.sgm'],
    ['tag "cave"; // tag', '// tag', 'comment.line.double-slash.sgm'],
    ['displace rock.fbm(period 5m)', 'rock', 'entity.name.namespace.sgm'],
  ])
    check(scopeOf(line, word) === wanted, `'${word}' of '${line}' has the scope ${scopeOf(line, word)}`);
  if (failures === 0) console.log(`${tokens} tokens of samples, all words of the language: all have their colour`);
  process.exit(failures === 0 ? 0 : 1);
})().catch((e) => { console.error(String(e)); process.exit(1); });

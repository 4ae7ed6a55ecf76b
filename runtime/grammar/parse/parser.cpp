#include "grammar/parse/parser.h"

#include <algorithm>

#include "grammar/syntax/keywords.h"
#include "grammar/text/codes.h"

namespace sgm {

Parser::Parser(Program& program, NameTable& names, uint32_t module, const CompileLimits& limits, DiagnosticSink& sink)
    : program_(program),
      names_(names),
      limits_(limits),
      sink_(sink),
      text_(program.modules[module].text),
      lexed_(lex(text_, module, limits.nodes, sink, program.modules.get_allocator().resource())),
      first_expr_(program.ast.exprs.size()) {
  out_.module = module;
  panic_token_.span = lexed_.tokens.back().span;
  last_ = lexed_.tokens.front().span;
  program.modules[module].comments = lexed_.comments;
}

ModuleSyntax Parser::run() {
  out_.readable = lexed_.readable;
  out_.complete = lexed_.readable;
  if (!lexed_.readable) return std::move(out_);
  const Span first = here();
  if (acceptWord("sgm")) {
    const bool foreign_version = at(Tok::number) && !peek().broken && textOf(peek()) != "1";
    if (foreign_version)
      fail(here(), codes::kVersion, join({"this is version 1 of the language, not ", textOf(peek())}),
           "write `sgm 1;`");
    else if (expect(Tok::number, "the version number 1"))
      expect(Tok::semicolon, "`;`");
    if (foreign_version) {
      out_.readable = out_.complete = false;
      return std::move(out_);
    }
    if (panic_)
      synchronise(true, 0);
    else
      item(ItemKind::version, 0, first);
  } else if (!sink_.full()) {
    sink_.error(first, codes::kVersion, "a grammar starts with the version of its language", "write `sgm 1;` first");
  }
  while (!at(Tok::end) && !sink_.full()) {
    const size_t begin = next_;
    const bool of_rules = atWord("rule") || atWord("morphic") || atWord("let") || atWord("field") || atWord("import");
    declaration();
    if (!panic_) continue;
    synchronise(true, begin);
    if (!of_rules) out_.bounded = false;
  }
  return std::move(out_);
}

const Token& Parser::peek(size_t ahead) const {
  if (panic_ || exhausted_) return panic_token_;
  return lexed_.tokens[std::min(next_ + ahead, lexed_.tokens.size() - 1)];
}

const Token& Parser::take() {
  const Token& token = peek();
  if (!panic_ && !exhausted_) {
    last_ = token.span;
    if (next_ + 1 < lexed_.tokens.size()) ++next_;
  }
  return token;
}

std::string_view Parser::textOf(const Token& token) const {
  return text_.substr(token.span.begin, token.span.end - token.span.begin);
}

bool Parser::atWord(std::string_view word) const { return peek().kind == Tok::word && textOf(peek()) == word; }

bool Parser::accept(Tok kind) {
  if (!at(kind) || kind == Tok::end) return false;
  take();
  return true;
}

bool Parser::acceptWord(std::string_view word) {
  if (!atWord(word)) return false;
  take();
  return true;
}

bool Parser::expect(Tok kind, std::string_view what) {
  if (accept(kind)) return true;
  unexpected(what);
  return false;
}

bool Parser::expectWord(std::string_view word) {
  if (acceptWord(word)) return true;
  unexpected(join({"`", word, "`"}));
  return false;
}

void Parser::fail(const Span& span, std::string_view code, std::string message, std::string hint) {
  if (panic_ || exhausted_) return;
  panic_ = true;
  if (!isSaid(span)) sink_.error(span, code, std::move(message), std::move(hint));
}

/// Whether a lexical error nearby may be the cause of this error.
bool Parser::isSaid(const Span& span) const {
  const std::vector<int>& lines = lexed_.broken_lines;
  const auto broken = [&](int line) { return std::find(lines.begin(), lines.end(), line) != lines.end(); };
  return lexed_.tokens[next_].span.begin > lexed_.torn_at || broken(span.line) || broken(last_.end_line);
}

/// Names in the omitted part may be declared there: they are not reported as unknown.
void Parser::leaveOut(size_t first) {
  out_.complete = false;
  if (joined_ > 0) out_.bounded = false;
  const size_t end = exhausted_ ? lexed_.tokens.size() : next_;
  for (size_t i = first; i < end; ++i)
    if (lexed_.tokens[i].kind == Tok::word) out_.in_doubt.insert(intern(textOf(lexed_.tokens[i])));
}

std::string Parser::habitHint(std::string_view wanted, const Token& token) const {
  const std::string_view word = textOf(token);
  const bool after_number = next_ > 0 && lexed_.tokens[next_ - 1].kind == Tok::number;
  if (after_number && token.kind == Tok::word && isUnit(word))
    return join({"write the unit against its number, `", textOf(lexed_.tokens[next_ - 1]), word, "`"});
  const std::span<const std::string_view> transforms = transformTable();
  if (wanted == "`;`" && std::find(transforms.begin(), transforms.end(), word) != transforms.end())
    return "a transform stands in front of its shape: `at(1m, 0m, 0m) sphere(2m);`";
  if (wanted == "a statement" && word == "if")
    return "give a rule alternatives: `rule A when ... { }` and `rule A else { }`, or `weight`";
  if (wanted.starts_with("a text") && token.kind == Tok::word) return join({"write it in quotes, \"", word, "\""});
  if (wanted.starts_with("the name of ") || wanted.starts_with("the kind of ")) {
    const std::string name = token.kind == Tok::text ? textContent(word) : std::string();
    if (isName(name)) return join({"write it without quotes, `", name, "`"});
    if (!name.empty()) return "names consist of the letters a to z, digits and `_`, without quotes";
  }
  if (token.kind == Tok::dots)
    return "a range such as 1m..2m stands after `in`; a function takes both ends, `rand(1m, 2m)`";
  return {};
}

void Parser::unexpected(std::string_view wanted) {
  if (panic_ || exhausted_ || unavailable()) return;
  const Token& token = peek();
  // A missing token is reported at its place, after the last token, if that ends an earlier line.
  Span span = token.span;
  if (wanted == "`;`" && (token.kind == Tok::end || token.span.line != last_.end_line)) {
    span = last_;
    span.begin = span.end;
    span.line = last_.end_line;
    span.column = last_.end_column;
  }
  std::string found = token.kind == Tok::end ? "the end of the text" : join({"`", textOf(token), "`"});
  std::string hint;
  if (token.kind == Tok::word) {
    Suggestion suggestion(textOf(token));
    // "`flat`, `gable` or `hip`"
    for (size_t open = wanted.find('`'); open < wanted.size(); open = wanted.find('`', open)) {
      const size_t close = std::min(wanted.find('`', open + 1), wanted.size());
      suggestion.offer(wanted.substr(open + 1, close - open - 1));
      open = close + 1;
    }
    hint = suggestion.hint();
  }
  if (hint.empty()) hint = habitHint(wanted, token);
  if (token.kind == Tok::assign) hint = "`=` names a value only in let, param and field; compare with `==`";
  fail(span, codes::kSyntax, join({"expected ", wanted, ", found ", found}), std::move(hint));
}

bool Parser::unavailable() {
  const Token& token = peek();
  if (token.kind != Tok::word || !token.unavailable) return false;
  fail(token.span, codes::kNotAvailable, join({"`", textOf(token), "` is not available in sgm 1 of this version"}),
       "the word is reserved for a later version");
  return true;
}

NameId Parser::wordName(std::string_view of_what) {
  if (!at(Tok::word)) {
    unexpected(of_what);
    return kNoId;
  }
  return intern(textOf(take()));
}

NameId Parser::declaredName(std::string_view of_what) {
  if (at(Tok::word) && (peek().keyword || peek().unavailable)) {
    fail(here(), codes::kReservedWord,
         join({"`", textOf(peek()), "` is a word of the language and cannot be ", of_what}),
         join({"choose another name, such as `", textOf(peek()), "_`"}));
    return kNoId;
  }
  return wordName(of_what);
}

NameId Parser::textName(std::string_view of_what) {
  if (!at(Tok::text)) {
    unexpected(of_what);
    return kNoId;
  }
  return intern(textContent(textOf(take())));
}

Span Parser::since(const Span& begin) const {
  Span span = begin;
  span.end = std::max(begin.end, last_.end);
  if (last_.end > begin.end) {
    span.end_line = last_.end_line;
    span.end_column = last_.end_column;
  }
  return span;
}

bool Parser::nodeBudget() {
  if (exhausted_) return false;
  if (program_.ast.exprs.size() + program_.ast.stmts.size() < limits_.nodes) return true;
  fail(here(), codes::kTooLarge,
       join({"the text has more than ", std::to_string(limits_.nodes), " expressions and statements"}),
       "use loops and rules to say the same in fewer");
  exhausted_ = true;
  return false;
}

IdRange Parser::store(const std::vector<uint32_t>& ids) {
  const IdRange range{static_cast<uint32_t>(program_.ast.ids.size()), static_cast<uint32_t>(ids.size())};
  program_.ast.ids.insert(program_.ast.ids.end(), ids.begin(), ids.end());
  return range;
}

IdRange Parser::storeArgs(const std::vector<ArgNode>& args) {
  const IdRange range{static_cast<uint32_t>(program_.ast.args.size()), static_cast<uint32_t>(args.size())};
  program_.ast.args.insert(program_.ast.args.end(), args.begin(), args.end());
  return range;
}

bool Parser::Deeper::fits() {
  if (parser_.nesting_ <= parser_.limits_.nesting) return true;
  parser_.fail(parser_.here(), codes::kTooDeep,
               join({"this is nested more than ", std::to_string(parser_.limits_.nesting), " deep"}),
               "name a part of it: a value with let, a block with a rule");
  return false;
}

/// Skips past the next ';', or to the '}' of the enclosing block, or past a block that opened after the error. At top
/// level a declaration keyword at the start of a line also ends the search.
void Parser::synchronise(bool top_level, size_t first) {
  panic_ = false;
  skip(top_level);
  leaveOut(first);
}

void Parser::skip(bool top_level) {
  uint32_t open = 0;
  while (!at(Tok::end)) {
    const Token& token = peek();
    if (top_level && token.kind == Tok::word && token.span.column == 1 && token.span.begin > last_.begin) {
      if (startsDeclaration(textOf(token))) return;
    }
    if (token.kind == Tok::open_brace) {
      ++open;
    } else if (token.kind == Tok::close_brace) {
      if (open == 0 && !top_level) return;
      take();
      if (open <= 1) {
        // `{ ... };` and `} -> ...` belong to the skipped part.
        accept(Tok::semicolon);
        return;
      }
      --open;
      continue;
    } else if (token.kind == Tok::semicolon && open == 0) {
      take();
      return;
    }
    take();
  }
}

}  // namespace sgm

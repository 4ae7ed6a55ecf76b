#include "grammar/parse/token_stream.h"

#include <algorithm>

#include "grammar/syntax/keywords.h"
#include "grammar/text/codes.h"

namespace sgm::parse {

namespace {

/// Returns a hint if the author seems to follow the syntax of another language; otherwise an empty text. kind, word: of
/// the token found instead of `wanted`; number: the text of a number directly before it, or empty.
std::string habitHint(std::string_view wanted, Tok kind, std::string_view word, std::string_view number) {
  if (!number.empty() && kind == Tok::word && isUnit(word))
    return join({"write the unit against its number, `", number, word, "`"});
  const std::span<const std::string_view> transforms = transformTable();
  if (wanted == "`;`" && std::find(transforms.begin(), transforms.end(), word) != transforms.end())
    return "a transform stands in front of its shape: `at(1m, 0m, 0m) sphere(2m);`";
  if (wanted == "a statement" && word == "if")
    return "give a rule alternatives: `rule A when ... { }` and `rule A else { }`, or `weight`";
  if (wanted.starts_with("a text") && kind == Tok::word) return join({"write it in quotes, \"", word, "\""});
  if (wanted.starts_with("the name of ") || wanted.starts_with("the kind of ")) {
    const std::string name = kind == Tok::text ? textContent(word) : std::string();
    if (isName(name)) return join({"write it without quotes, `", name, "`"});
    if (!name.empty()) return "names consist of the letters a to z, digits and `_`, without quotes";
  }
  if (kind == Tok::dots) return "a range such as 1m..2m stands after `in`; a function takes both ends, `rand(1m, 2m)`";
  return {};
}

/// Returns "did you mean `gable`?" if `word` resembles a word in backquotes in `wanted`; otherwise an empty text.
std::string spellingHint(std::string_view wanted, std::string_view word) {
  Suggestion suggestion(word);
  for (size_t open = wanted.find('`'); open < wanted.size(); open = wanted.find('`', open)) {
    const size_t close = std::min(wanted.find('`', open + 1), wanted.size());
    suggestion.offer(wanted.substr(open + 1, close - open - 1));
    open = close + 1;
  }
  return suggestion.hint();
}

}  // namespace

TokenStream::TokenStream(std::string_view text, uint32_t file, const CompileLimits& limits, DiagnosticSink& sink,
                         std::pmr::memory_resource* memory)
    : text_(text), sink_(sink), max_nested_(limits.nesting), lexed_(lex(text, file, limits.nodes, sink, memory)) {
  end_token_.span = lexed_.tokens.back().span;
  last_ = lexed_.tokens.front().span;
}

const Token& TokenStream::peek(size_t ahead) const {
  if (panic_ || exhausted_) return end_token_;
  return lexed_.tokens[std::min(next_ + ahead, lexed_.tokens.size() - 1)];
}

const Token& TokenStream::take() {
  const Token& token = peek();
  if (!panic_ && !exhausted_) {
    last_ = token.span;
    if (next_ + 1 < lexed_.tokens.size()) ++next_;
  }
  return token;
}

std::string_view TokenStream::textOf(const Token& token) const {
  return text_.substr(token.span.begin, token.span.end - token.span.begin);
}

bool TokenStream::atWord(std::string_view word) const { return at(Tok::word) && text() == word; }

bool TokenStream::accept(Tok kind) {
  if (!at(kind) || kind == Tok::end) return false;
  take();
  return true;
}

bool TokenStream::acceptWord(std::string_view word) {
  if (!atWord(word)) return false;
  take();
  return true;
}

bool TokenStream::expect(Tok kind, std::string_view what) {
  if (accept(kind)) return true;
  failExpecting(what);
  return false;
}

bool TokenStream::expectWord(std::string_view word) {
  if (acceptWord(word)) return true;
  failExpecting(join({"`", word, "`"}));
  return false;
}

Span TokenStream::since(const Span& begin) const {
  Span span = begin;
  span.end = std::max(begin.end, last_.end);
  if (last_.end > begin.end) {
    span.end_line = last_.end_line;
    span.end_column = last_.end_column;
  }
  return span;
}

void TokenStream::report(const Span& span, std::string_view code, std::string message, std::string hint) {
  if (panic_ || exhausted_ || isExplained(span)) return;
  sink_.error(span, code, std::move(message), std::move(hint));
}

void TokenStream::fail(const Span& span, std::string_view code, std::string message, std::string hint) {
  report(span, code, std::move(message), std::move(hint));
  if (!exhausted_) panic_ = true;
}

/// Whether a lexical error nearby, which is already reported, may be the cause of a syntax error at `span`.
bool TokenStream::isExplained(const Span& span) const {
  const std::vector<int>& lines = lexed_.broken_lines;
  const auto broken = [&](int line) { return std::find(lines.begin(), lines.end(), line) != lines.end(); };
  return lexed_.tokens[next_].span.begin > lexed_.torn_at || broken(span.line) || broken(last_.end_line);
}

void TokenStream::exhaust(std::string_view code, std::string message, std::string hint) {
  fail(here(), code, std::move(message), std::move(hint));
  exhausted_ = true;
}

void TokenStream::failExpecting(std::string_view wanted) {
  if (panic_ || exhausted_ || failIfUnavailable()) return;
  const Token& token = peek();
  // If the wanted token is missing at the end of a line, the error is reported there, behind the last token.
  Span span = token.span;
  if (wanted == "`;`" && (token.kind == Tok::end || token.span.line != last_.end_line)) {
    span = last_;
    span.begin = span.end;
    span.line = last_.end_line;
    span.column = last_.end_column;
  }
  std::string found = token.kind == Tok::end ? "the end of the text" : join({"`", textOf(token), "`"});
  std::string hint;
  if (token.kind == Tok::word) hint = spellingHint(wanted, textOf(token));
  const bool after_number = next_ > 0 && lexed_.tokens[next_ - 1].kind == Tok::number;
  const std::string_view number = after_number ? textOf(lexed_.tokens[next_ - 1]) : std::string_view();
  if (hint.empty()) hint = habitHint(wanted, token.kind, textOf(token), number);
  if (token.kind == Tok::assign) hint = "`=` names a value only in let, param and field; compare with `==`";
  fail(span, codes::kSyntax, join({"expected ", wanted, ", found ", found}), std::move(hint));
}

bool TokenStream::failIfUnavailable() {
  const Token& token = peek();
  if (token.kind != Tok::word || !token.unavailable) return false;
  fail(token.span, codes::kNotAvailable, join({"`", textOf(token), "` is not available in sgm 1 of this version"}),
       "the word is reserved for a later version");
  return true;
}

std::span<const Token> TokenStream::skipFailed(Level level, size_t first) {
  panic_ = false;
  skip(level);
  const size_t end = exhausted_ ? lexed_.tokens.size() : next_;
  return std::span<const Token>(lexed_.tokens).subspan(first, end - first);
}

void TokenStream::skip(Level level) {
  uint32_t open = 0;
  while (!at(Tok::end)) {
    const Token& token = peek();
    const bool starts_line = token.kind == Tok::word && token.span.column == 1 && token.span.begin > last_.begin;
    if (level == Level::declaration && starts_line && startsDeclaration(textOf(token))) return;
    if (token.kind == Tok::open_brace) {
      ++open;
    } else if (token.kind == Tok::close_brace) {
      if (open == 0 && level == Level::statement) return;
      take();
      if (open <= 1) {
        // A ';' directly behind the '}', as in `{ ... };`, belongs to the skipped part.
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

bool Nested::fits() {
  if (tokens_.nesting_ <= tokens_.max_nested_) return true;
  tokens_.fail(tokens_.here(), codes::kTooDeep,
               join({"this is nested more than ", std::to_string(tokens_.max_nested_), " deep"}),
               "name a part of it: a value with let, a block with a rule");
  return false;
}

}  // namespace sgm::parse

#include "grammar/help/declarations.h"

#include <algorithm>

#include "grammar/syntax/keywords.h"
#include "grammar/syntax/lexer.h"

namespace sgm {
namespace {

constexpr uint32_t kMaxTokens = 1u << 20;
constexpr size_t kLongestHead = 240;

LexResult tokensOf(std::string_view text) {
  DiagnosticSink unread(1);
  return lex(text, 0, kMaxTokens, unread, std::pmr::get_default_resource());
}

/// Reads declarations from the tokens.
class DeclarationReader {
 public:
  explicit DeclarationReader(std::string_view text) : text_(text), lexed_(tokensOf(text)) {}

  Declarations read() {
    while (kind() != Tok::end) {
      if (kind() == Tok::word && startsDeclaration(word()))
        declaration();
      else
        ++next_;
    }
    formalsOfEdits();
    return std::move(out_);
  }

 private:
  const Token& token(size_t ahead = 0) const {
    return lexed_.tokens[std::min(next_ + ahead, lexed_.tokens.size() - 1)];
  }
  Tok kind(size_t ahead = 0) const { return token(ahead).kind; }
  std::string_view word(size_t ahead = 0) const {
    const Span& span = token(ahead).span;
    return text_.substr(span.begin, span.end - span.begin);
  }
  bool isName(size_t ahead = 0) const { return kind(ahead) == Tok::word && !token(ahead).keyword; }

  /// Reads one declaration, up to its `;` or the end of its block, or up to the next declaration if these are missing.
  void declaration() {
    const size_t first = next_;
    const size_t first_name = out_.names.size();
    const std::string_view what = word();
    ++next_;
    size_t head_end = first;  // index of the token after the declaration's head
    if (what == "import")
      import();
    else if (what == "param")
      named(NameKind::parameter);
    else if (what == "let")
      named(NameKind::let);
    else if (what == "field")
      named(NameKind::field);
    else if (what == "rule")
      named(NameKind::rule);
    else if (what == "morphic")
      named(NameKind::morphic);
    else if (what == "layer")
      named(NameKind::layer);
    else if (what == "override" && kind() == Tok::text)
      edits_.push_back({textContent(word()), {}});
    const bool edit = what == "override" && kind() == Tok::text;

    int depth = 0;
    std::string doc;
    for (; kind() != Tok::end; ++next_) {
      if (kind() == Tok::open_brace) {
        if (head_end == first) head_end = next_;
        ++depth;
      } else if (kind() == Tok::close_brace) {
        if (--depth <= 0) {
          ++next_;
          break;
        }
      } else if (kind() == Tok::semicolon && depth == 0) {
        if (head_end == first) head_end = next_;
        ++next_;
        break;
      } else if (kind() == Tok::text && depth == 0 && what == "param") {
        doc = textContent(word());
      } else if (kind() == Tok::word && depth == 0 && token().span.column == 1 && startsDeclaration(word())) {
        break;
      } else {
        local();
      }
    }
    if (head_end == first) head_end = next_;
    const Span& begin = lexed_.tokens[first].span;
    const uint32_t end = next_ == 0 ? begin.end : lexed_.tokens[next_ - 1].span.end;
    const TextRange whole{begin.begin, end};
    if (edit) edits_.back().whole = whole;
    for (size_t i = first_name; i < out_.names.size(); ++i) {
      DeclaredName& name = out_.names[i];
      if (name.kind == NameKind::local) {
        name.known = whole;
        continue;
      }
      name.whole = whole;
      name.known = {0, static_cast<uint32_t>(text_.size())};
      name.head = oneLine(text_.substr(begin.begin, lexed_.tokens[head_end].span.begin - begin.begin));
      name.doc = name.kind == NameKind::parameter ? doc : commentAbove(begin.line);
    }
  }

  void add(NameKind kind, const Span& span) {
    DeclaredName name;
    name.kind = kind;
    name.name = text_.substr(span.begin, span.end - span.begin);
    name.at = name.whole = {span.begin, span.end};
    out_.names.push_back(std::move(name));
  }

  void import() {
    if (kind() != Tok::text) return;
    std::string path = textContent(word());
    if (word(1) != "as" || !isName(2)) return;
    next_ += 2;
    add(NameKind::import, token().span);
    out_.names.back().path = std::move(path);
    ++next_;
  }

  void named(NameKind kind_of) {
    if (!isName()) return;
    add(kind_of, token().span);
    ++next_;
    if (kind() == Tok::open_paren && kind_of != NameKind::parameter && kind_of != NameKind::layer) formals();
  }

  /// Reads formals in parentheses: (a, b = 3, c).
  void formals() {
    int depth = 0;
    bool first = false;  // the next word is the name of a formal
    for (; kind() != Tok::end && kind() != Tok::open_brace && kind() != Tok::semicolon; ++next_) {
      if (kind() == Tok::open_paren) {
        first = ++depth == 1;
        continue;
      }
      if (kind() == Tok::close_paren && --depth == 0) {
        ++next_;
        return;
      }
      if (first && isName()) addLocal(token().span, "parameter " + formalText());
      first = kind() == Tok::comma && depth == 1;
    }
  }

  /// Returns the text of a formal with its default and range: from the current token to the next comma or parenthesis.
  std::string formalText() const {
    size_t last = next_;
    for (int depth = 0; last + 1 < lexed_.tokens.size(); ++last) {
      const Tok next = lexed_.tokens[last + 1].kind;
      if (next == Tok::open_brace || next == Tok::semicolon || next == Tok::end) break;
      if (depth == 0 && (next == Tok::comma || next == Tok::close_paren)) break;
      depth += next == Tok::open_paren ? 1 : next == Tok::close_paren ? -1 : 0;
    }
    const uint32_t begin = token().span.begin;
    return oneLine(text_.substr(begin, lexed_.tokens[last].span.end - begin));
  }

  /// Records the name that a statement at the current token declares, if it declares one.
  void local() {
    const std::string_view what = word();
    if (kind() != Tok::word) return;
    if ((what == "let" || what == "field") && isName(1)) {
      addLocal(token(1).span, statementText());
      if (kind(2) == Tok::open_paren) {
        next_ += 2;
        formals();
        --next_;
      }
    } else if (what == "for" && isName(1)) {
      addLocal(token(1).span, statementText());
    } else if ((what == "as" || what == "gap") && isName(1)) {
      addLocal(token(1).span, std::string(what) + " " + std::string(word(1)));
    }
  }

  void addLocal(const Span& span, std::string head) {
    add(NameKind::local, span);
    out_.names.back().head = std::move(head);
  }

  /// Returns the text from the current token to the end of the statement's head.
  std::string statementText() const {
    size_t last = next_;
    while (last + 1 < lexed_.tokens.size() && lexed_.tokens[last + 1].kind != Tok::semicolon &&
           lexed_.tokens[last + 1].kind != Tok::open_brace && lexed_.tokens[last + 1].kind != Tok::close_brace &&
           lexed_.tokens[last + 1].kind != Tok::end)
      ++last;
    const uint32_t begin = token().span.begin;
    return oneLine(text_.substr(begin, lexed_.tokens[last].span.end - begin));
  }

  std::string oneLine(std::string_view part) const {
    std::string line;
    for (const char c : part) {
      const bool blank = c == ' ' || c == '\n' || c == '\r' || c == '\t';
      if (!blank)
        line += c;
      else if (!line.empty() && line.back() != ' ')
        line += ' ';
      if (line.size() >= kLongestHead) return line + " ...";
    }
    while (!line.empty() && line.back() == ' ') line.pop_back();
    return line;
  }

  /// Returns the text of the comment lines directly above this line.
  std::string commentAbove(int line) const {
    std::vector<std::string_view> lines;
    for (size_t i = lexed_.comments.size(); i-- > 0;) {
      const Comment& comment = lexed_.comments[i];
      if (comment.line >= line) continue;
      if (comment.line != line - 1 || !comment.own_line) break;
      std::string_view content = text_.substr(comment.begin, comment.end - comment.begin);
      while (content.starts_with('/') || content.starts_with(' ')) content.remove_prefix(1);
      lines.push_back(content);
      --line;
    }
    std::string doc;
    for (size_t i = lines.size(); i-- > 0;) doc.append(doc.empty() ? "" : "\n").append(lines[i]);
    return doc;
  }

  /// Adds the parameters of the overridden rule as local names to each override's block.
  void formalsOfEdits() {
    for (const Edit& edit : edits_) {
      std::string rule = edit.path.substr(edit.path.find_last_of('/') + 1);
      rule = rule.substr(0, rule.find('['));
      std::vector<DeclaredName> formals;
      for (const DeclaredName& head : out_.names) {
        if (head.name != rule || (head.kind != NameKind::rule && head.kind != NameKind::morphic)) continue;
        for (const DeclaredName& name : out_.names)
          if (name.kind == NameKind::local && head.whole.holds(name.at.begin) && name.head.starts_with("parameter "))
            formals.push_back(name);
        break;
      }
      for (DeclaredName& formal : formals) {
        formal.known = edit.whole;
        out_.names.push_back(std::move(formal));
      }
    }
  }

  struct Edit {
    std::string path;
    TextRange whole;
  };

  std::string_view text_;
  LexResult lexed_;
  size_t next_ = 0;
  std::vector<Edit> edits_;
  Declarations out_;
};

}  // namespace

std::string_view nameKindText(NameKind kind) {
  switch (kind) {
    case NameKind::import:
      return "import";
    case NameKind::parameter:
      return "param";
    case NameKind::let:
      return "let";
    case NameKind::field:
      return "field";
    case NameKind::rule:
      return "rule";
    case NameKind::morphic:
      return "morphic";
    case NameKind::layer:
      return "layer";
    case NameKind::local:
      break;
  }
  return "local";
}

std::vector<const DeclaredName*> Declarations::find(std::string_view name, uint32_t offset) const {
  std::vector<const DeclaredName*> global;
  for (const DeclaredName& declared : names) {
    if (declared.name != name) continue;
    if (declared.kind != NameKind::local)
      global.push_back(&declared);
    else if (declared.known.holds(offset))
      return {&declared};
  }
  return global;
}

Declarations declarationsOf(std::string_view text) { return DeclarationReader(text).read(); }

std::optional<WordAt> wordAt(std::string_view text, uint32_t offset) {
  const LexResult lexed = tokensOf(text);
  for (const Comment& comment : lexed.comments)
    if (offset > comment.begin && offset <= comment.end) return std::nullopt;
  WordAt found{{offset, offset}, {}, {}, false};
  for (size_t i = 0; i < lexed.tokens.size(); ++i) {
    const Token& token = lexed.tokens[i];
    if (token.kind == Tok::text && offset > token.span.begin && offset < token.span.end) return std::nullopt;
    const bool behind = token.kind == Tok::dot && offset == token.span.end;
    const bool in_word =
        (token.kind == Tok::word || token.keyword) && offset >= token.span.begin && offset <= token.span.end;
    if (!behind && !in_word) continue;
    const size_t dot = behind ? i : i - 1;
    if (in_word) {
      found.at = {token.span.begin, token.span.end};
      found.word = text.substr(token.span.begin, token.span.end - token.span.begin);
    }
    found.behind_dot = behind || (i > 0 && lexed.tokens[dot].kind == Tok::dot);
    found.qualifier.clear();
    if (found.behind_dot && dot > 0 && lexed.tokens[dot - 1].kind == Tok::word) {
      const Span& before = lexed.tokens[dot - 1].span;
      found.qualifier = text.substr(before.begin, before.end - before.begin);
    }
    // Prefer a word: if the offset lies between a dot and a word, the word is chosen, not the empty place behind the
    // dot.
    if (in_word) return found;
  }
  return found;
}

}  // namespace sgm

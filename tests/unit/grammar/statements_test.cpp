// Tests stmts.def against the parser, the published grammar and the editor's syntax colours.

#include <map>
#include <regex>
#include <set>

#include "grammar/syntax/declared_members.h"
#include "grammar/syntax/keywords.h"
#include "parsed_text.h"

using namespace sgm;
using namespace sgm::test;

namespace {

using Words = std::set<std::string, std::less<>>;

std::string textOf(const char* path) {
  std::ifstream file(std::string(SGM_SOURCE_DIR) + path, std::ios::binary);
  REQUIRE(file);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

/// For each member of a statement, whether the statement's line in stmts.def lists it.
struct Listed {
  bool power = false, expr = false, amount = false, plan = false, body = false, extra = false, extra2 = false;
  bool name = false, name2 = false, children = false, xforms = false, parts = false;
};

Listed listedOf(StmtKind kind) {
  Listed listed;
  switch (kind) {
#define EXPR(m) listed.m = true;
#define STMT(m) listed.m = true;
#define STMTS(m) listed.m = true;
#define NAME(m) listed.m = true;
#define VALUE(m) listed.m = true;
#define NODE(m, table) listed.m = true;
#define NODES(m, table) listed.m = true;
#define PARTS listed.parts = listed.children = true;
#define FOUND(m) listed.m = true;
#define SGM_STMT(kind_name, word, role, members) \
  case StmtKind::kind_name:                      \
    members break;
#include "grammar/syntax/stmts.def"
  }
  return listed;
}

/// Visits all statements and expressions of a parsed file, and counts the visits of each.
class Walk {
 public:
  explicit Walk(const Parsed& file)
      : program_(*file.program), stmts_(program_.ast.stmts.size()), exprs_(program_.ast.exprs.size()) {
    for (const Item& item : file.syntax.items) visit(Declaration{file.syntax, item});
  }
  const std::vector<int>& stmts() const { return stmts_; }
  const std::vector<int>& exprs() const { return exprs_; }

 private:
  template <class Node>
  void visit(const Node& node) {
    forEachExpr(program_, node, [&](ExprId id) {
      ++exprs_[id];
      visit(program_.expr(id));
    });
    forEachStmt(program_, node, [&](StmtId id) {
      ++stmts_[id];
      visit(program_.stmt(id));
    });
  }

  const Program& program_;
  std::vector<int> stmts_, exprs_;
};

/// The words and signs with which each production of the published grammar can begin.
class FirstWords {
 public:
  FirstWords() {
    const std::string text =
        std::regex_replace(textOf("/runtime/grammar/grammar.ebnf"), std::regex("\\(\\*[^]*?\\*\\)"), "");
    const std::regex token("\"[^\"]*\"|[A-Za-z_]+|[=|;()\\[\\]{}]");
    std::vector<std::string> tokens;
    for (std::sregex_iterator i(text.begin(), text.end(), token), end; i != end; ++i) tokens.push_back(i->str());
    for (size_t i = 0; i + 1 < tokens.size(); ++i) {
      REQUIRE(tokens[i + 1] == "=");
      std::vector<std::string>& production = productions_[tokens[i]];
      for (i += 2; tokens[i] != ";"; ++i) production.push_back(tokens[i]);
      production.push_back(";");
    }
  }

  Words of(const std::string& production) const {
    Words words;
    size_t at = 0;
    alternatives(productions_.at(production), at, &words);
    return words;
  }

 private:
  using Tokens = std::vector<std::string>;

  // Each of these functions parses one part of a production, adds the part's first words, and returns whether the part
  // can be empty. If words is null, the function only finds the part's end.
  bool alternatives(const Tokens& tokens, size_t& at, Words* words) const {
    bool empty = sequence(tokens, at, words);
    while (tokens[at] == "|") empty = sequence(tokens, ++at, words) || empty;
    return empty;
  }

  bool sequence(const Tokens& tokens, size_t& at, Words* words) const {
    bool empty = true;
    while (std::string(";|)]}").find(tokens[at]) == std::string::npos)
      empty = factor(tokens, at, empty ? words : nullptr) && empty;
    return empty;
  }

  bool factor(const Tokens& tokens, size_t& at, Words* words) const {
    const std::string token = tokens[at++];
    if (token == "(" || token == "[" || token == "{") {
      const bool empty = alternatives(tokens, at, words);
      ++at;
      return token != "(" || empty;
    }
    const bool is_text = token.front() == '"';
    if (words == nullptr) return false;
    if (!is_text && productions_.count(token) == 1) {
      size_t begin = 0;
      return alternatives(productions_.at(token), begin, words);
    }
    words->insert(is_text ? token.substr(1, token.size() - 2) : token);
    return false;
  }

  std::map<std::string, Tokens> productions_;
};

}  // namespace

TEST_CASE("a statement sets the members that stmts.def lists, and no others", "[grammar][statements]") {
  std::map<StmtKind, Listed> set;
  for (const std::string& text : grammarTexts()) {
    const Parsed file = parsed(text);
    REQUIRE(file.program);
    for (const StmtNode& s : file.program->ast.stmts) {
      Listed& here = set[s.kind];
      const Listed listed = listedOf(s.kind);
      CAPTURE(static_cast<int>(s.kind), text.substr(s.span.begin, s.span.end - s.span.begin));
      const auto see = [](bool is_set, bool is_listed, bool& was_set) {
        if (is_set && !is_listed) CHECK(is_listed);
        was_set = was_set || is_set;
      };
      see(s.power, listed.power, here.power);
      see(s.expr != kNoId, listed.expr, here.expr);
      see(s.amount != kNoId, listed.amount, here.amount);
      see(s.plan != kNoId, listed.plan, here.plan);
      see(s.body != kNoId, listed.body, here.body);
      see(s.extra != kNoId, listed.extra, here.extra);
      see(s.extra2 != kNoId, listed.extra2, here.extra2);
      see(s.name != kNoId, listed.name, here.name);
      see(s.name2 != kNoId, listed.name2, here.name2);
      see(s.children.count > 0, listed.children, here.children);
      see(s.xforms.count > 0, listed.xforms, here.xforms);
      see(s.parts.count > 0, listed.parts, here.parts);
    }
  }
  // The repository's grammars use every statement, so that the checks above cover all of them.
  for (size_t kind = 0; kind < kStmtInfos.size(); ++kind) {
    CAPTURE(kind, kStmtInfos[kind].word);
    CHECK(set.count(static_cast<StmtKind>(kind)) == 1);
    const Listed &here = set[static_cast<StmtKind>(kind)], listed = listedOf(static_cast<StmtKind>(kind));
    CHECK(here.expr == listed.expr);
    CHECK(here.plan == listed.plan);
    CHECK(here.body == listed.body);
    CHECK(here.extra == listed.extra);
    CHECK(here.name == listed.name);
    CHECK(here.children == listed.children);
    CHECK(here.xforms == listed.xforms);
    CHECK(here.parts == listed.parts);
    CHECK(kStmtInfos[kind].has_parts == listed.parts);
  }
}

TEST_CASE("walks from the declarations reach every statement once, and every expression", "[grammar][statements]") {
  for (const std::string& text : grammarTexts()) {
    const Parsed file = parsed(text);
    REQUIRE(file.program);
    const Walk walk(file);
    CHECK(std::all_of(walk.stmts().begin(), walk.stmts().end(), [](int times) { return times == 1; }));
    for (ExprId id = 0; id < walk.exprs().size(); ++id) {
      // The parser replaces a name or a member by a call when it reads arguments; the replaced node is not visited.
      const ExprNode& e = file.program->expr(id);
      const bool may_be_replaced = e.kind == ExprKind::name || e.kind == ExprKind::member;
      CAPTURE(text.substr(e.span.begin, e.span.end - e.span.begin), walk.exprs()[id]);
      const bool good = walk.exprs()[id] == 1 || (walk.exprs()[id] == 0 && may_be_replaced);
      if (!good) CHECK(good);
    }
  }
}

TEST_CASE("statements begin in the published grammar as in stmts.def", "[grammar][statements]") {
  const FirstWords first;
  Words expected{"{", "NAME"};
  for (const std::string_view word : transformTable()) expected.emplace(word);
  for (const StmtInfo& info : kStmtInfos) {
    if (info.role != StmtRole::part && !info.word.empty()) expected.emplace(info.word);
    if (info.role == StmtRole::part) CHECK(first.of(std::string(info.word)) == Words{std::string(info.word)});
  }
  CHECK(first.of("stmt") == expected);
}

TEST_CASE("the editor colours the words of the language as such, and no others", "[grammar][statements]") {
  const std::string text = textOf("/editor_plugin/vscode/syntaxes/sgm.tmLanguage.json");
  const auto wordsBetween = [&](const char* begin, const char* end) {
    const size_t from = text.find(begin), to = text.find(end, from);
    REQUIRE(from != std::string::npos);
    REQUIRE(to != std::string::npos);
    const std::string part = text.substr(from, to - from);
    Words words;
    const std::regex list("\\(\\?:([a-z|]+)\\)"), word("[a-z]+");
    for (std::sregex_iterator i(part.begin(), part.end(), list), last; i != last; ++i) {
      const std::string all = (*i)[1].str();
      for (std::sregex_iterator w(all.begin(), all.end(), word); w != last; ++w) words.insert(w->str());
    }
    return words;
  };
  Words keywords;
  for (const std::string_view word : keywordTable()) keywords.emplace(word);
  for (const std::string_view word : unavailableTable()) keywords.emplace(word);
  CHECK(wordsBetween("\"keyword\": {", "\"call\": {") == keywords);
  for (const StmtInfo& info : kStmtInfos)
    if (!info.word.empty() && !isKeyword(info.word))
      CHECK(wordsBetween("\"clause\": {", "\"operator\": {").count(info.word) == 1);
}

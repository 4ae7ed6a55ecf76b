#pragma once
// Recursive descent over one file's tokens into the shared arrays of a Program.
//
// After an error the parser panics: it sees only the end of the text, so that every loop ends by itself, and the loop
// over statements (or declarations) skips to the next ';' or '}' and continues.

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "grammar/syntax/lexer.h"
#include "grammar/syntax/name_table.h"
#include "grammar/syntax/program.h"
#include "grammar/syntax/syntax.h"
#include "grammar/text/limits.h"
#include "grammar/text/sink.h"

namespace sgm {

class Parser {
 public:
  /// Precondition: program.modules[module] has the module's text.
  Parser(Program& program, NameTable& names, uint32_t module, const CompileLimits& limits, DiagnosticSink& sink);

  ModuleSyntax run();

 private:
  /// Counts nesting for its lifetime.
  class Deeper {
   public:
    explicit Deeper(Parser& parser) : parser_(parser) { ++parser_.nesting_; }
    ~Deeper() { --parser_.nesting_; }
    Deeper(const Deeper&) = delete;
    Deeper& operator=(const Deeper&) = delete;
    /// Returns false, after an error, if the limit is exceeded.
    bool fits();

   private:
    Parser& parser_;
  };

  // parser.cpp: tokens, errors, recovery
  const Token& peek(size_t ahead = 0) const;
  /// What to write here instead of another language's syntax, or empty.
  std::string habitHint(std::string_view wanted, const Token& token) const;
  const Token& take();
  bool at(Tok kind) const { return peek().kind == kind; }
  bool atWord(std::string_view word) const;
  bool accept(Tok kind);
  bool acceptWord(std::string_view word);
  bool expect(Tok kind, std::string_view what);
  bool expectWord(std::string_view word);
  /// Parses a new name: not a keyword. kNoId in panic.
  NameId declaredName(std::string_view of_what);
  NameId wordName(std::string_view of_what);
  NameId textName(std::string_view of_what);
  void fail(const Span& span, std::string_view code, std::string message, std::string hint = {});
  void unexpected(std::string_view wanted);
  bool unavailable();
  /// Continues after an error; first: the first token of the omitted part.
  void synchronise(bool top_level, size_t first);
  void skip(bool top_level);
  void leaveOut(size_t first);
  bool isSaid(const Span& span) const;
  std::string_view textOf(const Token& token) const;
  std::string_view nameOf(NameId id) const { return program_.text(id); }
  Span here() const { return peek().span; }
  Span since(const Span& begin) const;
  NameId intern(std::string_view text) { return names_.intern(text); }
  bool nodeBudget();
  IdRange store(const std::vector<uint32_t>& ids);
  IdRange storeArgs(const std::vector<ArgNode>& args);

  // parser_declarations.cpp
  void declaration();
  void importDeclaration();
  void paramDeclaration();
  void letDeclaration();
  void fieldDeclaration();
  void domainDeclaration();
  void layerDeclaration();
  void startDeclaration();
  void ruleDeclaration();
  void morphicDeclaration();
  void expectation(bool expect);
  void overrideDeclaration();
  void item(ItemKind kind, size_t index, const Span& begin, size_t sub = 0);
  IdRange formals();
  uint32_t ruleNamed(NameId name, bool morphic, const Span& span);
  uint32_t addField(bool local);

  // parser_statements.cpp
  StmtId block();
  StmtId statement();
  StmtId bodyOf(std::string_view word);
  StmtId addStmt(StmtNode node, const Span& begin);
  StmtId callStatement();
  StmtId combiner(StmtKind kind, bool smooth);
  StmtId morphStatement();
  StmtId displaceStatement(StmtKind kind);
  StmtId repeatStatement();
  StmtId forStatement();
  StmtId scatterStatement();
  StmtId letStatement();
  StmtId fieldStatement();
  StmtId nameStatement(StmtKind kind);
  StmtId detailStatement();
  StmtId innerStatement();
  StmtId transformStatement();

  // parser_split.cpp
  struct Parts {
    std::vector<PartNode> nodes;
    std::vector<uint32_t> bodies;
  };
  std::optional<uint32_t> axisLetter(std::string_view what);
  StmtId splitStatement();
  StmtId snapStatement();
  StmtId compStatement();
  void splitParts(Parts& parts, bool repeated);
  void splitGroup(Parts& parts, bool repeated);
  void splitPart(Parts& parts, bool repeated);
  void compPart(Parts& parts);
  bool partsEnd(const Span& begin);

  // parser_treemap.cpp
  StmtId treemapStatement();
  void floorPart(Parts& parts);
  StmtId linkStatement();

  // parser_wfc.cpp
  StmtId wfcStatement();
  void wavePart(Parts& parts);
  std::optional<SocketNode> socket(const std::vector<SocketNode>& before);
  IdRange socketLabels();
  uint32_t addTile(bool turns, const std::vector<SocketNode>& sockets);
  StmtId borderStatement(uint32_t& tile);

  // parser_fit.cpp
  StmtId fitStatement();

  // parser_split.cpp
  StmtId addParts(StmtNode node, const Parts& parts, const Span& begin);

  // parser_statements.cpp
  StmtId morphOperand();
  bool atXform() const;
  IdRange xforms();
  XformNode xform();

  // parser_profiles.cpp
  StmtId footprintStatement();
  StmtId extrudeStatement();
  StmtId roofStatement();
  ExprId planName();

  // parser_expressions.cpp
  ExprId expression();
  ExprId rangeOrExpression();
  ExprId binaryLevel(int lowest);
  ExprId unary();
  ExprId postfix();
  ExprId primary();
  ExprId callExpression(std::string_view what);
  ExprId parenthesised();
  ExprId query();
  std::vector<ArgNode> arguments(std::string_view callee);
  bool namedArgumentAhead(std::string_view callee) const;
  ExprId addExpr(ExprNode node, const Span& begin);

  Program& program_;
  NameTable& names_;
  CompileLimits limits_;
  DiagnosticSink& sink_;
  std::string_view text_;
  LexResult lexed_;
  ModuleSyntax out_;
  size_t next_ = 0;
  bool panic_ = false;
  bool exhausted_ = false;  ///< out of nodes or of errors: only the end of the text is left
  uint32_t nesting_ = 0;
  Token panic_token_;
  Span last_;
  std::vector<uint16_t> depth_;  ///< of each expression, so that the depth of trees built by loops is limited, too
  size_t first_expr_ = 0;
  std::map<NameId, uint32_t> rules_;
  bool overriding_ = false;  ///< in the block of an override
  uint32_t inners_ = 0;      ///< in that block so far
  uint32_t joined_ = 0;      ///< blocks of `meet` and `sum` around
};

}  // namespace sgm

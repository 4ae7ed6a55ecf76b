#pragma once
// The tokens of one file, read from front to back, with the errors about them.
//
// After an error the stream panics: it shows only the end of the text, so that every loop ends by itself, until
// skipFailed() omits the part with the error.

#include <cstdint>
#include <memory_resource>
#include <span>
#include <string>
#include <string_view>

#include "grammar/syntax/lexer.h"
#include "grammar/text/limits.h"
#include "grammar/text/sink.h"

namespace sgm::parse {

/// The loop that recovers from an error: the one over declarations, or one over statements or parts within braces.
enum class Level : uint8_t { declaration, statement };

/// A place among the tokens of one file, and whether an error has hidden the tokens behind it.
class TokenStream {
 public:
  /// Lexes `text`, which must outlive the stream, as the file with this index.
  TokenStream(std::string_view text, uint32_t file, const CompileLimits& limits, DiagnosticSink& sink,
              std::pmr::memory_resource* memory);

  /// False if the text is not to be parsed; the lexer has reported the reason.
  bool isReadable() const { return lexed_.readable; }
  const std::pmr::vector<Comment>& comments() const { return lexed_.comments; }

  const Token& peek(size_t ahead = 0) const;
  /// Returns the current token and moves on; at the end of the text it stays.
  const Token& take();
  bool at(Tok kind) const { return peek().kind == kind; }
  bool atWord(std::string_view word) const;
  /// Take the current token if it is this one; return whether it was.
  bool accept(Tok kind);
  bool acceptWord(std::string_view word);
  /// The same, but another token is an error; the message calls the missing one `what`.
  bool expect(Tok kind, std::string_view what);
  bool expectWord(std::string_view word);

  std::string_view textOf(const Token& token) const;
  /// The text of the current token.
  std::string_view text() const { return textOf(peek()); }
  Span here() const { return peek().span; }
  /// The span of the token that was taken last.
  const Span& last() const { return last_; }
  /// The span from `begin` to the token that was taken last.
  Span since(const Span& begin) const;
  /// The index of the current token, for skipFailed().
  size_t position() const { return next_; }

  /// Reports an error, unless a lexical error nearby may be its cause.
  void report(const Span& span, std::string_view code, std::string message, std::string hint = {});
  /// The same, and panics. Errors during panic are not reported: they may follow from the first one.
  void fail(const Span& span, std::string_view code, std::string message, std::string hint = {});
  /// Fails, since the current token is not `wanted`: "a name", "`flat`, `gable` or `hip`". Words in backquotes are
  /// suggested for misspelt ones.
  void failExpecting(std::string_view wanted);
  /// Fails, and returns true, if the current token is a word that is reserved for a later version.
  bool failIfUnavailable();
  /// Fails at the current token for good: from now on the stream shows only the end of the text.
  void exhaust(std::string_view code, std::string message, std::string hint);

  /// Whether the stream panics.
  bool hasFailed() const { return panic_; }
  bool isExhausted() const { return exhausted_; }
  /// Whether parsing may go on after an error.
  bool canContinue() const { return !exhausted_ && !sink_.full(); }
  /// Ends the panic and moves behind the part with the error: past the next ';', to the '}' of the enclosing block, or
  /// past a block that opened after the error. Among declarations the first word of one, at the start of a line, ends
  /// the search, too. Returns the omitted tokens from the index `first` on.
  std::span<const Token> skipFailed(Level level, size_t first);

 private:
  friend class Nested;

  bool isExplained(const Span& span) const;
  void skip(Level level);

  std::string_view text_;
  DiagnosticSink& sink_;
  uint32_t most_nested_;
  LexResult lexed_;
  size_t next_ = 0;
  bool panic_ = false;
  bool exhausted_ = false;  ///< only the end of the text is left
  uint32_t nesting_ = 0;
  Token end_token_;
  Span last_;
};

/// Counts a level of nesting for its lifetime, so that hostile texts do not exhaust the stack.
class Nested {
 public:
  explicit Nested(TokenStream& tokens) : tokens_(tokens) { ++tokens_.nesting_; }
  ~Nested() { --tokens_.nesting_; }
  Nested(const Nested&) = delete;
  Nested& operator=(const Nested&) = delete;
  /// Returns false, after an error, if the limit is exceeded.
  bool fits();

 private:
  TokenStream& tokens_;
};

}  // namespace sgm::parse

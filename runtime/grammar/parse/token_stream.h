#pragma once
// The tokens of one file, read from front to back, and errors about them.
//
// After an error the stream is in panic mode: every token reads as the end of the text, so that all parse loops end,
// until skipFailed() skips the part with the error.

#include <cstdint>
#include <memory_resource>
#include <span>
#include <string>
#include <string_view>

#include "grammar/syntax/lexer.h"
#include "grammar/text/limits.h"
#include "grammar/text/sink.h"

namespace sgm::parse {

/// The kind of loop that recovers from an error: over declarations, or over statements or parts within braces.
enum class Level : uint8_t { declaration, statement };

/// A cursor over the tokens of one file, with panic mode after errors.
class TokenStream {
 public:
  /// Splits `text` into tokens. text: must outlive the stream. file: index for Span::file.
  TokenStream(std::string_view text, uint32_t file, const CompileLimits& limits, DiagnosticSink& sink,
              std::pmr::memory_resource* memory);

  /// Returns false if the text must not be parsed, for example because it is not UTF-8. The lexer has reported the
  /// reason.
  bool isReadable() const { return lexed_.readable; }
  const std::pmr::vector<Comment>& comments() const { return lexed_.comments; }

  const Token& peek(size_t ahead = 0) const;
  /// Returns the current token and advances; does not advance past the end of the text.
  const Token& take();
  bool at(Tok kind) const { return peek().kind == kind; }
  bool atWord(std::string_view word) const;
  /// If the current token has this kind or text, takes it and returns true. Otherwise returns false.
  bool accept(Tok kind);
  bool acceptWord(std::string_view word);
  /// Like accept(), but any other token is an error; its message calls the missing token `what`.
  bool expect(Tok kind, std::string_view what);
  bool expectWord(std::string_view word);

  std::string_view textOf(const Token& token) const;
  /// The text of the current token.
  std::string_view text() const { return textOf(peek()); }
  Span here() const { return peek().span; }
  /// The span of the last token taken.
  const Span& last() const { return last_; }
  /// The span from `begin` to the last token taken.
  Span since(const Span& begin) const;
  /// The index of the current token, for skipFailed().
  size_t position() const { return next_; }

  /// Reports an error, unless a nearby lexical error, already reported, may be its cause.
  void report(const Span& span, std::string_view code, std::string message, std::string hint = {});
  /// Like report(), and enters panic mode. In panic mode errors are not reported, since they may follow from the first
  /// error.
  void fail(const Span& span, std::string_view code, std::string message, std::string hint = {});
  /// Fails because the current token is not one of `wanted`: "a name", "`flat`, `gable` or `hip`". If the token
  /// resembles a word in backquotes, the hint suggests that word.
  void failExpecting(std::string_view wanted);
  /// Fails and returns true if the current token is a word reserved for a later version of the language.
  bool failIfUnavailable();
  /// Fails at the current token and ends parsing of this file: from now on the stream only returns the end of the text.
  void exhaust(std::string_view code, std::string message, std::string hint);

  /// Whether the stream is in panic mode.
  bool hasFailed() const { return panic_; }
  bool isExhausted() const { return exhausted_; }
  /// Whether parsing may continue after an error: the stream is not exhausted, and the limit of errors is not reached.
  bool canContinue() const { return !exhausted_ && !sink_.full(); }
  /// Ends panic mode and skips the part with the error. The skipped part ends with the next ';', before the '}' of the
  /// enclosing block, or with a block that opened after the error. At Level::declaration it also ends before a
  /// declaration's first word at the start of a line. Returns the skipped tokens from the index `first` on.
  std::span<const Token> skipFailed(Level level, size_t first);

 private:
  friend class Nested;

  bool isExplained(const Span& span) const;
  void skip(Level level);

  std::string_view text_;
  DiagnosticSink& sink_;
  uint32_t max_nested_;
  LexResult lexed_;
  size_t next_ = 0;
  bool panic_ = false;
  bool exhausted_ = false;  ///< see exhaust()
  uint32_t nesting_ = 0;
  Token end_token_;
  Span last_;
};

/// Counts one level of nesting during its lifetime, to bound the stack depth for untrusted text.
class Nested {
 public:
  explicit Nested(TokenStream& tokens) : tokens_(tokens) { ++tokens_.nesting_; }
  ~Nested() { --tokens_.nesting_; }
  Nested(const Nested&) = delete;
  Nested& operator=(const Nested&) = delete;
  /// Returns false, after reporting an error, if the nesting limit is exceeded.
  bool fits();

 private:
  TokenStream& tokens_;
};

}  // namespace sgm::parse

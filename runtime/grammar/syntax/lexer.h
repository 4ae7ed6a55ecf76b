#pragma once
// Text to tokens: spans, numbers with units, text constants, comments kept aside for the printer.

#include <cstdint>
#include <memory_resource>
#include <string>
#include <string_view>
#include <vector>

#include "grammar/syntax/ast.h"
#include "grammar/text/sink.h"

namespace sgm {

enum class Tok : uint8_t {
  end,
  word,    ///< a name or keyword; keyword says which
  number,  ///< value, dim
  text,    ///< a text constant, quotes included in the span
  open_paren,
  close_paren,
  open_brace,
  close_brace,
  comma,
  semicolon,
  colon,
  dot,
  dots,
  arrow,
  assign,
  plus,
  minus,
  star,
  slash,
  less,
  less_equal,
  greater,
  greater_equal,
  equal,
  not_equal,
  tilde,
  broken,  ///< a character that the language does not have
};

struct Token {
  Tok kind = Tok::end;
  bool keyword = false;
  bool unavailable = false;
  bool space_before = false;  ///< something blank stands before it
  bool broken = false;        ///< a number with an error: it has no value
  Dim dim;
  double value = 0;
  Span span;
};

struct LexResult {
  std::pmr::vector<Token> tokens;  ///< ends with Tok::end
  std::pmr::vector<Comment> comments;
  bool readable = true;           ///< false: the file is not a text in UTF-8, or too long; nothing is to be parsed
  std::vector<int> broken_lines;  ///< those with an error, in order: what else they hold may be misread
  size_t torn_at = SIZE_MAX;      ///< offset from which on a text without its end may hide signs of the syntax
};

/// Whether numbers may have it as their unit.
bool isUnit(std::string_view word);
/// Whether the text is spelt like a name; it may be a word of the language.
bool isName(std::string_view text);

/// Reports what is wrong and goes on; always gives a stream that ends. At most `max_tokens`, otherwise an error.
LexResult lex(std::string_view text, uint32_t file, uint32_t max_tokens, DiagnosticSink& sink,
              std::pmr::memory_resource* memory);

/// The content of a text constant without its quotes and escapes.
std::string textContent(std::string_view quoted);
/// The constant with quotes and escapes.
std::string quoteText(std::string_view content);

}  // namespace sgm

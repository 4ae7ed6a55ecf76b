#pragma once
// Splits text into tokens: spans, numbers with units, text constants; comments are kept for the printer.

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
  broken,  ///< an invalid character
};

struct Token {
  Tok kind = Tok::end;
  bool keyword = false;
  bool unavailable = false;
  bool space_before = false;  ///< white space before it
  bool broken = false;        ///< a number with an error: it has no value
  Dim dim;
  double value = 0;
  Span span;
};

struct LexResult {
  std::pmr::vector<Token> tokens;  ///< ends with Tok::end
  std::pmr::vector<Comment> comments;
  bool readable = true;           ///< false: the file is not UTF-8 text, or too long; do not parse it
  std::vector<int> broken_lines;  ///< lines with an error, ascending: their other tokens may be wrong
  size_t torn_at = SIZE_MAX;      ///< from this offset on an unterminated text may hide syntax
};

/// Whether a number may have it as its unit.
bool isUnit(std::string_view word);
/// Whether the text has the form of a name; it may be a word of the language.
bool isName(std::string_view text);

/// Reports errors and continues; the result always has an end token. More than `max_tokens` is an error.
LexResult lex(std::string_view text, uint32_t file, uint32_t max_tokens, DiagnosticSink& sink,
              std::pmr::memory_resource* memory);

/// The content of a text constant without its quotes and escapes.
std::string textContent(std::string_view quoted);
/// The constant for this content, with quotes and escapes.
std::string quoteText(std::string_view content);

}  // namespace sgm

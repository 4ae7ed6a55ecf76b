#pragma once
// Splits text into tokens with spans, numbers with units, and text constants. Comments are stored for the printer.

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
  word,    ///< a name or keyword; Token::keyword tells which
  number,  ///< a number; Token::value and Token::dim are set
  text,    ///< a text constant; the span includes its quotes
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
  bool space_before = false;  ///< the text has white space directly before the token
  bool broken = false;        ///< a malformed number; value is not set
  Dim dim;
  double value = 0;
  Span span;
};

struct LexResult {
  std::pmr::vector<Token> tokens;  ///< all tokens of the text; the last one is Tok::end
  std::pmr::vector<Comment> comments;
  bool readable = true;  ///< false: the file is not UTF-8 text, or too long, and must not be parsed
  /// numbers of lines with a lexical error, ascending; other tokens of these lines may be wrong, too
  std::vector<int> broken_lines;
  /// offset of a text constant without a closing quote; the constant may include syntax that follows it. SIZE_MAX: none
  size_t torn_at = SIZE_MAX;
};

/// Whether the word is a unit of numbers, such as m or deg.
bool isUnit(std::string_view word);
/// Whether the text has the form of a name. Words of the language have it, too.
bool isName(std::string_view text);

/// Reports errors and continues; the tokens always end with Tok::end. More than `max_tokens` tokens are an error.
LexResult lex(std::string_view text, uint32_t file, uint32_t max_tokens, DiagnosticSink& sink,
              std::pmr::memory_resource* memory);

/// Returns the content of a text constant: without quotes, with escapes replaced.
std::string textContent(std::string_view quoted);
/// Returns a text constant with this content: quoted and escaped.
std::string quoteText(std::string_view content);

}  // namespace sgm

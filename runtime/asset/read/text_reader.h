#pragma once
// Reads words and numbers of an untrusted text, line by line. A line ends in \n, \r\n or \r. The locale has no effect.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace sgm::asset {

class TextReader {
 public:
  /// continued: true if a backslash at the end of a line joins it with the next line.
  explicit TextReader(std::string_view text, bool continued = false)
      : first_(text.data()), at_(first_), end_(first_ + text.size()), continued_(continued) {}

  /// Returns the next word of the line; empty at the end of the line.
  std::string_view word() {
    skipBlanks();
    const char* const from = at_;
    while (at_ < end_ && (static_cast<unsigned char>(*at_) > ' ' || (!isBlank(*at_) && !isLineEnd(*at_)))) ++at_;
    if (continued_ && at_ - from > 1 && at_[-1] == '\\' && at_ < end_) --at_;
    return {from, static_cast<size_t>(at_ - from)};
  }

  /// Returns the next word of this line or a later line; empty at the end of the text.
  std::string_view wordOfAnyLine() {
    std::string_view next = word();
    while (next.empty() && nextLine()) next = word();
    return next;
  }

  /// Returns the rest of the line, without blanks at its beginning and end.
  std::string_view rest();

  /// True if the line has no further word.
  bool isLineDone() {
    skipBlanks();
    return at_ == end_ || isLineEnd(*at_);
  }

  /// Moves to the beginning of the next line; returns false if there is none. plain: a backslash at the end of the line
  /// has no meaning.
  bool nextLine(bool plain = false);

  size_t line() const { return line_; }                              ///< number of the current line, counted from 1
  size_t byte() const { return static_cast<size_t>(at_ - first_); }  ///< offset of the next character in bytes
  size_t bytesLeft() const { return static_cast<size_t>(end_ - at_); }

 private:
  static bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
  static bool isLineEnd(char c) { return c == '\n' || c == '\r'; }
  void passLineEnd() {
    at_ += *at_ == '\r' && at_ + 1 < end_ && at_[1] == '\n' ? 2 : 1;
    ++line_;
  }
  void skipBlanks() {
    while (at_ < end_) {
      if (isBlank(*at_)) {
        ++at_;
      } else if (continued_ && *at_ == '\\' && at_ + 1 < end_ && isLineEnd(at_[1])) {
        ++at_;
        passLineEnd();
      } else {
        return;
      }
    }
  }

  const char *first_, *at_, *end_;
  bool continued_;
  size_t line_ = 1;
};

/// Parses a decimal number with optional sign and exponent; also "nan" and "inf". Returns infinity if the number is too
/// large for a double; nullopt if the word is not a number.
std::optional<double> numberIn(std::string_view word);

/// Formats a word of a file for a message: in quotes, shortened if it is long, and without control characters.
std::string shown(std::string_view word);

/// Returns a name from a file, with '?' in place of invalid UTF-8 and control characters.
std::string cleanName(std::string_view name);

}  // namespace sgm::asset

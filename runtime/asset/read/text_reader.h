#pragma once
// Words and numbers of a text from outside, line by line. Lines end in \n, \r\n or \r; the locale has no effect.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace sgm::asset {

class TextReader {
 public:
  /// continued: a line that ends in a backslash continues on the next one.
  explicit TextReader(std::string_view text, bool continued = false)
      : first_(text.data()), at_(first_), end_(first_ + text.size()), continued_(continued) {}

  /// The next word of the line; empty at its end.
  std::string_view word() {
    skipBlanks();
    const char* const from = at_;
    while (at_ < end_ && (static_cast<unsigned char>(*at_) > ' ' || (!isBlank(*at_) && !isLineEnd(*at_)))) ++at_;
    if (continued_ && at_ - from > 1 && at_[-1] == '\\' && at_ < end_) --at_;
    return {from, static_cast<size_t>(at_ - from)};
  }

  /// The next word of this line or of a later one; empty at the text's end.
  std::string_view wordOfAnyLine() {
    std::string_view next = word();
    while (next.empty() && nextLine()) next = word();
    return next;
  }

  /// The rest of the line, without blanks around it.
  std::string_view rest();

  /// True if the line has no more words.
  bool isLineDone() {
    skipBlanks();
    return at_ == end_ || isLineEnd(*at_);
  }

  /// Moves to the beginning of the next line; false if there is none. plain: ignores a backslash at the end of the
  /// line.
  bool nextLine(bool plain = false);

  size_t line() const { return line_; }                              ///< from 1
  size_t byte() const { return static_cast<size_t>(at_ - first_); }  ///< of the next character
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

/// A decimal number, with or without a sign and an exponent; also "nan" and "inf". Infinite if it is too large for a
/// double; nullopt if the word is not a number.
std::optional<double> numberIn(std::string_view word);

/// A word of a file for a message: in quotes, cut off if it is long, without control characters for a terminal.
std::string shown(std::string_view word);

/// A name from a file: invalid UTF-8 and control characters become '?'.
std::string cleanName(std::string_view name);

}  // namespace sgm::asset

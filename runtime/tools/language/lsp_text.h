#pragma once
// Conversion between offsets in a document and editors' positions.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace sgm::cli {

/// A line and a character in it, both from 0; characters are UTF-16 code units, as in the protocol.
struct TextPosition {
  uint32_t line = 0, character = 0;
};

/// A text, and the starts of its lines.
class DocumentText {
 public:
  explicit DocumentText(std::string text = {});

  const std::string& text() const { return text_; }
  TextPosition position(uint32_t offset) const;
  /// Clamped: to the end of the text, or to the end of the line.
  uint32_t offset(TextPosition position) const;
  /// line and column as in Diagnostic: from 1, columns in bytes.
  uint32_t offsetOf(int line, int column) const;

 private:
  uint32_t endOf(const std::vector<uint32_t>& lines, uint32_t line) const;
  /// Advances by one character.
  void step(uint32_t& at, uint32_t& character) const;

  /// A place in the text and its character in the line. Each line has one at its start, and more if it is long, so that
  /// no query scans a whole line.
  struct Mark {
    uint32_t at, character;
  };

  std::string text_;
  std::vector<Mark> marks_;      ///< by place
  std::vector<uint32_t> lines_;  ///< starts by editors' rules: a single \r also ends a line
  std::vector<uint32_t> rows_;   ///< starts by the compiler's rules
};

/// "file:///a%20b.sgm" becomes "/a b.sgm"; empty if it is not a file URI.
std::string pathOfUri(std::string_view uri);
std::string uriOfPath(std::string_view path);

}  // namespace sgm::cli

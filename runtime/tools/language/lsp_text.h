#pragma once
// Converts between byte offsets in a document and editors' positions.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace sgm::cli {

/// A line, and a character in that line, both counted from 0. Characters are UTF-16 code units, as the protocol
/// requires.
struct TextPosition {
  uint32_t line = 0, character = 0;
};

/// A text, and the starts of its lines.
class DocumentText {
 public:
  explicit DocumentText(std::string text = {});

  const std::string& text() const { return text_; }
  TextPosition position(uint32_t offset) const;
  /// The byte offset of a position. Positions beyond the text, or beyond their line, become the end of the text or
  /// line.
  uint32_t offset(TextPosition position) const;
  /// The byte offset of a line and column as in Diagnostic: counted from 1, columns in bytes.
  uint32_t offsetOf(int line, int column) const;

 private:
  uint32_t endOf(const std::vector<uint32_t>& lines, uint32_t line) const;
  /// Advances by one Unicode character: `at` in bytes, `character` in UTF-16 code units.
  void step(uint32_t& at, uint32_t& character) const;

  /// A byte offset, and the UTF-16 column of that offset in its line. Each line has a mark at its start, and further
  /// marks if it is long, so that no query scans a whole line.
  struct Mark {
    uint32_t at, character;
  };

  std::string text_;
  std::vector<Mark> marks_;      ///< ascending by offset
  std::vector<uint32_t> lines_;  ///< offsets of line starts by the rules of editors: a single \r also ends a line
  std::vector<uint32_t> rows_;   ///< offsets of line starts by the rules of the compiler
};

/// The path of a file URI: "file:///a%20b.sgm" becomes "/a b.sgm"; empty for any other URI.
std::string pathOfUri(std::string_view uri);
std::string uriOfPath(std::string_view path);

}  // namespace sgm::cli

#pragma once
// Converts between byte offsets in a document and the positions that editors use.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace sgm::cli {

/// A line, and a character in that line, both counted from 0. Characters are counted in UTF-16 code units, as the
/// Language Server Protocol requires.
struct TextPosition {
  uint32_t line = 0, character = 0;
};

/// A text with an index of its line starts.
class DocumentText {
 public:
  explicit DocumentText(std::string text = {});

  const std::string& text() const { return text_; }
  TextPosition position(uint32_t offset) const;
  /// The byte offset of a position. A position beyond the text or beyond the end of its line is clamped.
  uint32_t offset(TextPosition position) const;
  /// The byte offset of a line and column in the form of Diagnostic: counted from 1, columns in bytes.
  uint32_t offsetOf(int line, int column) const;

 private:
  uint32_t endOf(const std::vector<uint32_t>& lines, uint32_t line) const;
  /// Advances a position by one Unicode character. at: offset in bytes; character: column in UTF-16 code units.
  void step(uint32_t& at, uint32_t& character) const;

  /// A byte offset, and the UTF-16 column of that offset in its line. Each line has a mark at its start; a long line
  /// has further marks, so that no conversion scans a whole line.
  struct Mark {
    uint32_t at, character;
  };

  std::string text_;
  std::vector<Mark> marks_;      ///< all marks, in ascending order of their offsets
  std::vector<uint32_t> lines_;  ///< offsets of line starts as editors count them: a single \r also ends a line
  std::vector<uint32_t> rows_;   ///< offsets of line starts as the compiler counts them: only \n ends a line
};

/// The path of a file URI: "file:///a%20b.sgm" becomes "/a b.sgm"; empty for any other URI.
std::string pathOfUri(std::string_view uri);
std::string uriOfPath(std::string_view path);

}  // namespace sgm::cli

#pragma once
// Places of a document as editors count them.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace sgm::cli {

/// A line and a character in it, both from 0; characters are UTF-16 code units, as the protocol has it.
struct TextPosition {
  uint32_t line = 0, character = 0;
};

/// A text and where its lines begin.
class DocumentText {
 public:
  explicit DocumentText(std::string text = {});

  const std::string& text() const { return text_; }
  TextPosition position(uint32_t offset) const;
  /// Of a line beyond the end: the end; of a character beyond its line: the line's end.
  uint32_t offset(TextPosition position) const;
  /// line and column as in Diagnostic: from 1, columns in bytes.
  uint32_t offsetOf(int line, int column) const;

 private:
  uint32_t endOf(const std::vector<uint32_t>& lines, uint32_t line) const;
  /// One character on.
  void step(uint32_t& at, uint32_t& character) const;

  /// A place in the text and its character in the line; one at the start of each line, and more in long ones, so that
  /// no question costs a walk along all of a line.
  struct Mark {
    uint32_t at, character;
  };

  std::string text_;
  std::vector<Mark> marks_;      ///< by place
  std::vector<uint32_t> lines_;  ///< as editors count them: a \r alone ends one, too
  std::vector<uint32_t> rows_;   ///< as the compiler counts them
};

/// "file:///a%20b.sgm" as "/a b.sgm"; empty where it is no file's.
std::string pathOfUri(std::string_view uri);
std::string uriOfPath(std::string_view path);

}  // namespace sgm::cli

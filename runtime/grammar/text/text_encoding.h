#pragma once
// Checks whether the bytes of a file can be grammar text, that is, UTF-8 with or without a byte order mark.

#include <cstddef>
#include <optional>
#include <string_view>

namespace sgm {

/// The reason why a whole file is not UTF-8 text.
struct EncodingFault {
  size_t at = 0;  ///< offset of the first byte that shows the fault
  std::string_view message;
  std::string_view hint;
};

/// Detects UTF-16 and UTF-32 with and without a byte order mark, files of other formats, and bytes that never occur in
/// text. Returns nullopt if the file may be UTF-8; it may still contain invalid sequences, which the lexer reports.
std::optional<EncodingFault> encodingFault(std::string_view text);

}  // namespace sgm

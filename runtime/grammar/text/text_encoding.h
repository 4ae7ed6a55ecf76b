#pragma once
// Checks whether bytes can be the text of a grammar at all: UTF-8, with or without a byte order mark.

#include <cstddef>
#include <optional>
#include <string_view>

namespace sgm {

/// The reason why a file is not UTF-8 text, as one cause for all of it.
struct EncodingFault {
  size_t at = 0;  ///< offset of the first byte that proves it
  std::string_view message;
  std::string_view hint;
};

/// nullopt if the bytes may be UTF-8; single bytes may still be invalid. Recognises UTF-16 and UTF-32 with and without
/// a byte order mark, files of other formats, and bytes that never occur in text.
std::optional<EncodingFault> encodingFault(std::string_view text);

}  // namespace sgm

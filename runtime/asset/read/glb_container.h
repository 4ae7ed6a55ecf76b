#pragma once
// The parts of a glTF file: its JSON and, in a binary file (GLB), the bytes after it.

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace sgm::asset {

struct GlbContainer {
  std::string_view json;
  std::span<const std::byte> binary;
  bool has_binary = false, is_text = false;
  size_t binary_at = 0;            ///< offset of the binary part in the file
  std::vector<std::string> notes;  ///< problems of parts that violate the format, for the user
};

/// Splits a file of binary glTF 2.0, or of glTF as JSON text. Accepts chunks whose length is not padded, with a note,
/// and ignores bytes after the end. Error: bad_input, with the byte in the message.
Result<GlbContainer> openGlb(std::span<const std::byte> bytes);

/// True if a text begins like glTF in JSON: as an object with the member `asset`.
bool beginsAsGltf(std::string_view text);

}  // namespace sgm::asset

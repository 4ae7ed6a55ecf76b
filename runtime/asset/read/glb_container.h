#pragma once
// The parts of a glTF file: its JSON and, of a binary one (GLB), the bytes behind it.

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
  size_t binary_at = 0;            ///< where the binary part begins in the file
  std::vector<std::string> notes;  ///< about parts that are not as the format demands
};

/// Binary glTF 2.0, or glTF as JSON text. Reads parts whose lengths are not padded, with a note, and leaves out what
/// stands behind the end. Error: bad_input, with the byte in the message.
Result<GlbContainer> openGlb(std::span<const std::byte> bytes);

/// Whether a text begins as glTF in JSON does: an object with the member `asset`.
bool beginsAsGltf(std::string_view text);

}  // namespace sgm::asset

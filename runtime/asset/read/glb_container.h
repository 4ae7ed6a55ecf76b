#pragma once
// The chunks of a glTF file: its JSON and, in a binary file (GLB), the binary data.

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
  size_t binary_at = 0;            ///< offset of the binary chunk's data in the file
  std::vector<std::string> notes;  ///< messages for the user about chunks that violate the format but were accepted
};

/// Splits a binary glTF 2.0 file into its chunks; also accepts glTF as JSON text. A chunk whose length is not padded is
/// accepted with a note; bytes after the end are ignored. Error: bad_input, with the byte in the message.
Result<GlbContainer> openGlb(std::span<const std::byte> bytes);

/// True if a text begins as glTF in JSON does: as an object with the member `asset`.
bool beginsAsGltf(std::string_view text);

}  // namespace sgm::asset

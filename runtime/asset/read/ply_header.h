#pragma once
// Parses the header of a PLY file: its format, elements and properties.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace sgm::asset {

enum class PlyFormat { ascii, binary_little_endian, binary_big_endian };
enum class PlyType : uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

constexpr size_t sizeOf(PlyType type) {
  constexpr size_t kSizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<size_t>(type)];
}

struct PlyProperty {
  std::string name;
  PlyType type{};
  std::optional<PlyType> count;  ///< type of the list's length; nullopt if the property is a single number
};

struct PlyElement {
  std::string name;
  size_t count = 0;  ///< number of elements that the file declares, not yet checked
  std::vector<PlyProperty> properties;

  /// Returns the index of a property by its name; the number of properties if there is none.
  size_t find(std::string_view property) const;
};

struct PlyHeader {
  PlyFormat format{};
  std::vector<PlyElement> elements;
  size_t bytes = 0;  ///< size of the header in bytes; the body starts there
  size_t lines = 0;
};

/// Reads the header of a PLY file. Errors: bad_input, with the line in the message.
Result<PlyHeader> readPlyHeader(std::string_view file);

}  // namespace sgm::asset

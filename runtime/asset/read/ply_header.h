#pragma once
// What a PLY file says of itself before its numbers begin.

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
  std::optional<PlyType> count;  ///< of a list: what tells its length; nothing: one number
};

struct PlyElement {
  std::string name;
  size_t count = 0;  ///< as the file says; nothing vouches for it
  std::vector<PlyProperty> properties;

  /// The number of a property; as many as there are where it is none of them.
  size_t find(std::string_view property) const;
};

struct PlyHeader {
  PlyFormat format{};
  std::vector<PlyElement> elements;
  size_t bytes = 0;  ///< where the numbers begin
  size_t lines = 0;
};

/// Errors: bad_input, with the line in the message.
Result<PlyHeader> readPlyHeader(std::string_view file);

}  // namespace sgm::asset

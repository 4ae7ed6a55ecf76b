#pragma once
// The numbers in a GLB file's binary part, as its accessors describe them. Nothing of what the file says of itself is
// believed before it is compared with the bytes that are there.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "asset/json_reader.h"
#include "asset/point.h"
#include "base/result.h"

namespace sgm::asset {

class GlbAccessors {
 public:
  GlbAccessors(const JsonValue& root, std::span<const std::byte> binary) : root_(root), binary_(binary) {}

  /// Three floats an element, at most `most` elements. Errors: bad_input, limit.
  Result<std::vector<Point>> points(size_t accessor, size_t most) const;
  /// Unsigned whole numbers of one, two or four bytes, at most `most` of them. Errors: bad_input, limit.
  Result<std::vector<uint32_t>> indices(size_t accessor, size_t most) const;

 private:
  struct View {
    const std::byte* first = nullptr;
    size_t count = 0, stride = 0, component_bytes = 0;
  };
  Result<View> view(size_t accessor, std::string_view type, bool floats, size_t most) const;

  const JsonValue& root_;
  std::span<const std::byte> binary_;
};

}  // namespace sgm::asset

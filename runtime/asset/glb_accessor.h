#pragma once
// The numbers in a GLB file's binary part, as its accessors describe them. Nothing of what the file says of itself is
// believed before it is compared with the bytes that are there.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "asset/json_reader.h"
#include "asset/mesh_limits.h"
#include "asset/triangle_mesh.h"

namespace sgm::asset {

/// Which corners a primitive's triangles have.
struct GlbCorners {
  size_t points = 0;      ///< the primitive's own
  uint32_t first = 0;     ///< the number that the first of them has in the mesh
  bool mirrored = false;  ///< turns the triangles round
};

class GlbAccessors {
 public:
  /// binary_at: where the binary part begins in the file.
  GlbAccessors(const JsonValue& root, std::span<const std::byte> binary, size_t binary_at);

  size_t size() const { return accessors_.size(); }
  size_t bytes() const { return binary_.size(); }
  /// As many elements as accessor a says that it holds, but no more than there are bytes; 0 where it is none of them.
  size_t countAtMost(size_t a) const {
    return a < accessors_.size() ? std::min(accessors_[a].count.value_or(0), binary_.size()) : 0;
  }

  // Each appends what accessor a, one of them, holds, and leaves `out` as it likes where it refuses. Errors: bad_input,
  // with the JSON pointer or the byte in the message; limit.

  /// Three floats each; in all as many as the limits allow.
  Result<void> points(size_t a, const MeshLimits& limits, std::vector<Point>& out) const;
  /// Three floats each, as many as `count`; not yet of length one.
  Result<void> normals(size_t a, size_t count, std::vector<Normal>& out) const;
  /// Two floats each, or whole numbers that stand for 0 to 1; as many as `count`.
  Result<void> coordinates(size_t a, size_t count, std::vector<TextureCoordinates>& out) const;
  /// Unsigned whole numbers of one, two or four bytes; in all as many triangles as the limits allow.
  Result<void> triangles(size_t a, const GlbCorners& corners, const MeshLimits& limits,
                         std::vector<std::array<uint32_t, 3>>& out) const;

 private:
  enum class Type { scalar, pair, triple, other };
  /// As the file says.
  struct Accessor {
    Type type = Type::other;
    size_t component = 0, offset = 0;
    std::optional<size_t> count, view;
    bool normalized = false, sparse = false;
  };
  struct BufferView {
    bool own = false;
    size_t offset = 0, length = 0;
    std::optional<size_t> stride;
  };
  /// What is there.
  struct Elements {
    const std::byte* first = nullptr;
    size_t count = 0, stride = 0;
  };

  Result<Elements> elements(size_t a, Type type) const;
  Result<void> asManyAs(size_t a, size_t count) const;
  size_t byteOf(const std::byte* at) const { return binary_at_ + static_cast<size_t>(at - binary_.data()); }

  std::vector<Accessor> accessors_;
  std::vector<BufferView> views_;
  std::span<const std::byte> binary_;
  size_t binary_at_;
};

}  // namespace sgm::asset

#pragma once
// The numbers of a glTF file, as its accessors describe them. Nothing of what the file says of itself is believed
// before it is compared with the bytes that are there.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "asset/read/glb_buffers.h"
#include "asset/read/mesh_limits.h"
#include "asset/triangle_mesh.h"
#include "base/json_reader.h"

namespace sgm::asset {

/// Which corners a primitive's triangles have.
struct GlbCorners {
  size_t points = 0;      ///< the primitive's own
  uint32_t first = 0;     ///< the number that the first of them has in the mesh
  bool mirrored = false;  ///< turns the triangles round
};

class GlbAccessors {
 public:
  /// quantized: positions, normals and coordinates may be whole numbers (KHR_mesh_quantization).
  GlbAccessors(const JsonValue& root, const GlbContainer& file, bool quantized);

  size_t size() const { return accessors_.size(); }
  size_t bytes() const { return buffers_.bytes(); }
  /// As many elements as accessor a says that it holds, but no more than there are bytes; 0 if it is not one of them.
  size_t countAtMost(size_t a) const {
    return a < accessors_.size() ? std::min(accessors_[a].count.value_or(0), bytes()) : 0;
  }
  std::optional<size_t> countOf(size_t a) const { return accessors_[a].count; }
  /// Whether accessor a, one of them, has no bytes: all its numbers are 0.
  bool isZero(size_t a) const { return !accessors_[a].view && !accessors_[a].sparse; }

  // Each appends what accessor a, one of them, holds, and leaves `out` in any state if it refuses. Errors: bad_input,
  // with the JSON pointer or the byte in the message; limit.

  /// Three numbers each; in all as many as the limits allow.
  Result<void> points(size_t a, const MeshLimits& limits, std::vector<Point>& out) const;
  /// Three numbers each, as many as `count`, such as a morph target's differences.
  Result<void> vectors(size_t a, size_t count, std::vector<Point>& out) const;
  /// Three numbers each, as many as `count`; not yet of length one.
  Result<void> normals(size_t a, size_t count, std::vector<Normal>& out) const;
  /// Two numbers each, as many as `count`; the second grows downward.
  Result<void> coordinates(size_t a, size_t count, std::vector<TextureCoordinates>& out) const;
  /// Four numbers each, as many as `count`: weights of joints, or quaternions.
  Result<void> fractions(size_t a, size_t count, std::vector<std::array<double, 4>>& out) const;
  /// Four unsigned whole numbers each, as many as `count`.
  Result<void> joints(size_t a, size_t count, std::vector<std::array<double, 4>>& out) const;
  /// Sixteen floats each, `least` at least.
  Result<void> matrices(size_t a, size_t least, std::vector<std::array<double, 16>>& out) const;
  /// Unsigned whole numbers of one, two or four bytes that name points of a primitive; at most as many as three times
  /// the triangles that the limits allow.
  Result<void> indices(size_t a, size_t points, const MeshLimits& limits, std::vector<uint32_t>& out) const;
  /// The same as triangles; in all as many as the limits allow.
  Result<void> triangles(size_t a, const GlbCorners& corners, const MeshLimits& limits,
                         std::vector<std::array<uint32_t, 3>>& out) const;

 private:
  enum class Type { scalar, pair, triple, quadruple, matrix, other };
  /// What an accessor may hold.
  enum class Holds { floats, small, fractions, unsigned_small, indices };

  struct Sparse {
    size_t count = 0;
    std::optional<size_t> index_view, value_view;
    size_t index_offset = 0, value_offset = 0, index_component = 0;
  };
  /// As the file says.
  struct Accessor {
    Type type = Type::other;
    size_t component = 0, offset = 0;
    std::optional<size_t> count, view;
    bool normalized = false;
    std::optional<Sparse> sparse;
  };
  /// Bytes that are there.
  struct Elements {
    const std::byte* first = nullptr;  ///< null: all numbers are 0
    size_t count = 0, stride = 0, buffer = 0;
  };

  static Accessor accessorIn(const JsonValue& value);
  Result<Elements> elements(size_t a, Type type, Holds holds) const;
  Result<Elements> elementsIn(size_t a, std::string_view member, size_t view, size_t offset, size_t count, size_t size,
                              bool packed) const;
  bool mayHold(const Accessor& accessor, Holds holds) const;
  Result<void> asManyAs(size_t a, size_t count) const;
  Error wrongAt(size_t a, std::string_view what, size_t buffer, const std::byte* at) const;
  template <size_t N, class Put>
  Result<void> each(size_t a, const Elements& from, std::string_view complaint, const Put& put) const;
  template <size_t N, class Put>
  Result<void> eachSparse(size_t a, std::string_view complaint, const Put& put) const;

  std::vector<Accessor> accessors_;
  GlbBuffers buffers_;
  bool quantized_;
};

}  // namespace sgm::asset

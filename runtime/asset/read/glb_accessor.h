#pragma once
// Reads the numbers of a glTF file as its accessors describe them. Every offset and count in the file is checked
// against the bytes that are present.

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

/// Where a primitive's points are in the mesh that is being built.
struct GlbCorners {
  size_t points = 0;      ///< number of the primitive's points
  uint32_t first = 0;     ///< index, in the mesh, of the primitive's first point
  bool mirrored = false;  ///< true: the transform mirrors the primitive, so its triangles must be reversed
};

class GlbAccessors {
 public:
  /// quantized: positions, normals and coordinates may be integers (KHR_mesh_quantization).
  GlbAccessors(const JsonValue& root, const GlbContainer& file, bool quantized);

  size_t size() const { return accessors_.size(); }
  size_t bytes() const { return buffers_.bytes(); }
  /// Returns the number of elements that accessor a declares, clamped to the number of bytes in the file; 0 if a is not
  /// an accessor.
  size_t countAtMost(size_t a) const {
    return a < accessors_.size() ? std::min(accessors_[a].count.value_or(0), bytes()) : 0;
  }
  std::optional<size_t> countOf(size_t a) const { return accessors_[a].count; }
  /// True if accessor a, which must exist, refers to no bytes: all its numbers are 0 then.
  bool isZero(size_t a) const { return !accessors_[a].view && !accessors_[a].sparse; }

  // Each of the following functions appends the content of accessor a, which must exist, to `out`. After an error, the
  // content of `out` is unspecified. Errors: bad_input, with the JSON pointer or the byte in the message; limit.

  /// Three numbers per element. `out` must not exceed the limit on points afterwards.
  Result<void> points(size_t a, const MeshLimits& limits, std::vector<Point>& out) const;
  /// Three numbers per element, exactly `count` elements, such as a morph target's differences.
  Result<void> vectors(size_t a, size_t count, std::vector<Point>& out) const;
  /// Three numbers per element, exactly `count`; not normalised yet.
  Result<void> normals(size_t a, size_t count, std::vector<Normal>& out) const;
  /// Two numbers per element, exactly `count`; the second one grows downward.
  Result<void> coordinates(size_t a, size_t count, std::vector<TextureCoordinates>& out) const;
  /// Four numbers per element, exactly `count`: weights of joints, or quaternions.
  Result<void> fractions(size_t a, size_t count, std::vector<std::array<double, 4>>& out) const;
  /// Four unsigned integers per element, exactly `count`.
  Result<void> joints(size_t a, size_t count, std::vector<std::array<double, 4>>& out) const;
  /// Sixteen floats per element, at least `least` elements.
  Result<void> matrices(size_t a, size_t least, std::vector<std::array<double, 16>>& out) const;
  /// Unsigned integers of one, two or four bytes, each an index of a point of a primitive; at most three times the
  /// number of triangles that the limits allow.
  Result<void> indices(size_t a, size_t points, const MeshLimits& limits, std::vector<uint32_t>& out) const;
  /// Same as indices, for the three corners of each triangle. `out` must not exceed the limit on triangles afterwards.
  Result<void> triangles(size_t a, const GlbCorners& corners, const MeshLimits& limits,
                         std::vector<std::array<uint32_t, 3>>& out) const;

 private:
  enum class Type { scalar, pair, triple, quadruple, matrix, other };
  /// The component types that an accessor may have.
  enum class Holds { floats, small, fractions, unsigned_small, indices };

  struct Sparse {
    size_t count = 0;
    std::optional<size_t> index_view, value_view;
    size_t index_offset = 0, value_offset = 0, index_component = 0;
  };
  /// The values as declared by the file.
  struct Accessor {
    Type type = Type::other;
    size_t component = 0, offset = 0;
    std::optional<size_t> count, view;
    bool normalized = false;
    std::optional<Sparse> sparse;
  };
  /// Bytes that are present.
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

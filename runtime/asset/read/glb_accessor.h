#pragma once
// Reads numbers of a glTF file through its accessors. Every offset and count in the file is checked against the bytes
// that are present.

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

/// The range of a primitive's points within the points of the output mesh.
struct GlbCorners {
  size_t points = 0;      ///< number of the primitive's points
  uint32_t first = 0;     ///< index of the primitive's first point within the mesh's points
  bool mirrored = false;  ///< true: the node's transform mirrors the primitive, so the triangles' orientation must be
                          ///< reversed
};

class GlbAccessors {
 public:
  /// quantized: true if positions, normals and texture coordinates may be integers (KHR_mesh_quantization).
  GlbAccessors(const JsonValue& root, const GlbContainer& file, bool quantized);

  size_t size() const { return accessors_.size(); }
  size_t bytes() const { return buffers_.bytes(); }
  /// Returns the number of elements that accessor a declares, but at most the total size of all buffers in bytes; 0 if
  /// accessor a does not exist.
  size_t countAtMost(size_t a) const {
    return a < accessors_.size() ? std::min(accessors_[a].count.value_or(0), bytes()) : 0;
  }
  std::optional<size_t> countOf(size_t a) const { return accessors_[a].count; }
  /// True if accessor a, which must exist, has no buffer view and no sparse values: all its numbers are then 0.
  bool isZero(size_t a) const { return !accessors_[a].view && !accessors_[a].sparse; }

  // Each of the following functions appends the content of accessor a, which must exist, to `out`. After an error, the
  // content of `out` is unspecified. Errors: bad_input, with the JSON pointer or the byte in the message; limit.

  /// Positions: three numbers per element. Afterwards, `out` must not exceed the limit on points.
  Result<void> points(size_t a, const MeshLimits& limits, std::vector<Point>& out) const;
  /// Displacements of a morph target: three numbers per element, exactly `count` elements.
  Result<void> vectors(size_t a, size_t count, std::vector<Point>& out) const;
  /// Normals, not yet normalised: three numbers per element, exactly `count` elements.
  Result<void> normals(size_t a, size_t count, std::vector<Normal>& out) const;
  /// Texture coordinates: two numbers per element, exactly `count` elements; the second coordinate grows downward.
  Result<void> coordinates(size_t a, size_t count, std::vector<TextureCoordinates>& out) const;
  /// Weights of joints, or quaternions: four numbers per element, exactly `count` elements.
  Result<void> fractions(size_t a, size_t count, std::vector<std::array<double, 4>>& out) const;
  /// Indices of joints: four unsigned integers per element, exactly `count` elements.
  Result<void> joints(size_t a, size_t count, std::vector<std::array<double, 4>>& out) const;
  /// 4 x 4 matrices: sixteen floats per element, at least `least` elements.
  Result<void> matrices(size_t a, size_t least, std::vector<std::array<double, 16>>& out) const;
  /// Indices of a primitive's points: unsigned integers of one, two or four bytes, each below `points`. Their number
  /// must be at most three times the limit on triangles.
  Result<void> indices(size_t a, size_t points, const MeshLimits& limits, std::vector<uint32_t>& out) const;
  /// Same as indices(), for triangle lists: three indices per triangle. Afterwards, `out` must not exceed the limit on
  /// triangles.
  Result<void> triangles(size_t a, const GlbCorners& corners, const MeshLimits& limits,
                         std::vector<std::array<uint32_t, 3>>& out) const;

 private:
  enum class Type { scalar, pair, triple, quadruple, matrix, other };
  /// The kinds of numbers that an accessor may hold, each of which allows certain component types.
  enum class Holds { floats, small, fractions, unsigned_small, indices };

  struct Sparse {
    size_t count = 0;
    std::optional<size_t> index_view, value_view;
    size_t index_offset = 0, value_offset = 0, index_component = 0;
  };
  /// An accessor as the file declares it, not yet checked.
  struct Accessor {
    Type type = Type::other;
    size_t component = 0, offset = 0;
    std::optional<size_t> count, view;
    bool normalized = false;
    std::optional<Sparse> sparse;
  };
  /// The checked position of an accessor's elements in a buffer.
  struct Elements {
    const std::byte* first = nullptr;  ///< address of the first element; null means that all numbers are 0
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

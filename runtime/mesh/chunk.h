#pragma once
// The basic types of meshing: a chunk's samples, packed vertices, meshes with their six seams, vertex keys.

#include <array>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "base/fixed.h"
#include "base/raw_vector.h"

namespace sgm {

inline constexpr int kChunkCells = 32;                 ///< cells on each axis
inline constexpr int kChunkSamples = kChunkCells + 1;  ///< samples on each axis, both borders included
inline constexpr int kSubcell = 256;                   ///< vertex positions are 1/256 of the chunk's cell edge
inline constexpr int32_t kMaxQ = 1 << 22;              ///< quantised samples lie in -kMaxQ..kMaxQ; solid is Q < 0

/// Faces: -x +x -y +y -z +z.
enum class Face : uint8_t { x_lo, x_hi, y_lo, y_hi, z_lo, z_hi };
inline constexpr int faceAxis(Face f) { return static_cast<int>(f) >> 1; }
inline constexpr bool faceIsHigh(Face f) { return static_cast<int>(f) & 1; }

/// The position of a chunk: its lowest corner in units and its cell edge in units (finest cell << level).
struct ChunkGrid {
  Int3 origin;
  int32_t cell = kUnitsPerMetre;
  int level = 0;
};

/// Quantised samples of one chunk. q has kChunkSamples^3 entries, x fastest, then y, then z.
/// signs has one word per row (y + z * kChunkSamples): bit x is set if sample x is solid (Q < 0).
/// q is only defined at the ends of edges whose ends differ in sign; signs are always defined.
struct ChunkSamples {
  std::pmr::vector<int32_t> q;
  std::pmr::vector<uint64_t> signs;

  explicit ChunkSamples(std::pmr::memory_resource* memory = std::pmr::get_default_resource())
      : q(size_t{kChunkSamples} * kChunkSamples * kChunkSamples, memory),
        signs(size_t{kChunkSamples} * kChunkSamples, memory) {}
};

/// The crossed edge that a vertex stands for. The kind is part of the vertex, so that positions alone suffice to derive
/// exact keys (VertexKey). Feature vertices have kinds of their own (mesh/feature_kind.h).
enum VertexKind : uint16_t {
  kOwnEdge = 0,      ///< of the chunk's own level: one coordinate, the edge's axis, is not a multiple of kSubcell
  kCoarserEdge = 1,  ///< of the level above, only in seams: one coordinate is not a multiple of 2 * kSubcell
  kLateralEdge = 2,  ///< only in seams: lies on a corner of the level above and joins the two levels
};

/// A packed vertex, 16 bytes, the same on every backend.
struct Vertex {
  int16_t x, y, z;             ///< 1/256 of the chunk's cell edge, from the chunk's origin: 0..8192; of a feature
                               ///< vertex of the coarser level in a seam -400..8592
  uint16_t material;           ///< index into the grammar's materials
  int16_t normal_x, normal_y;  ///< octahedral, 1/32767; points out of the solid
  uint16_t tag;                ///< index into the grammar's tags
  uint16_t kind;               ///< a VertexKind, 0 throughout a body; or a kind of a feature vertex
};
static_assert(sizeof(Vertex) == 16);

/// Identifies a crossed edge, and so a vertex, without any tolerance. It follows from a chunk and a packed vertex:
/// corner is the vertex's position rounded down to the grid of the edge's level, axis the coordinate that is not a
/// multiple of that level's cell; the fan of a lateral edge follows from the blocks around the chunk (mesh/fans.h). A
/// grid edge starts at `corner` and runs along `axis` for one cell of `level`. A lateral edge (axis kLateral) joins the
/// two levels `level` and `level + 1` at one corner of a seam; `fan` numbers the cycle of seam cells around it, so that
/// every vertex's link is one cycle even if the two levels' fields differ.
struct VertexKey {
  Int3 corner;
  uint8_t level = 0;
  uint8_t axis = 0;
  uint8_t fan = 0;
  friend auto operator<=>(const VertexKey&, const VertexKey&) = default;
};
inline constexpr uint8_t kLateral = 3;
/// Axes of feature vertices (mesh/sharpen.h). kFaceVertex plus the normal axis of its face, with the face's lowest
/// corner; kCellVertex with the cell's lowest corner. `fan` distinguishes the sides of a face, and the loops of a cell;
/// kSecondOfSide is added to it for the second face vertex of a side.
inline constexpr uint8_t kFaceVertex = 4;
inline constexpr uint8_t kCellVertex = 7;
inline constexpr uint8_t kSecondOfSide = 8;

/// Two 32-bit sums of mixed words, keyed by their index: the same on any device and in any order of addition.
struct ContentHash {
  uint32_t a = 0, b = 0;
  friend auto operator<=>(const ContentHash&, const ContentHash&) = default;
  uint64_t value() const { return uint64_t{b} << 32 | a; }
};

/// A part of a chunk that is drawn as a whole: the body, or one seam. Triangles index the part's own vertices.
struct MeshPart {
  RawVector<Vertex> vertices;
  RawVector<uint32_t> indices;  ///< three per triangle, counter-clockwise seen from the void
  RawVector<VertexKey> keys;    ///< one per vertex
  ContentHash hash;             ///< of vertices and indices

  explicit MeshPart(std::pmr::memory_resource* memory = std::pmr::get_default_resource())
      : vertices(memory), indices(memory), keys(memory) {}
};

}  // namespace sgm

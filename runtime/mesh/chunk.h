#pragma once
// The basic types of meshing: a chunk's samples, packed vertices, vertex keys and mesh parts (a body or one of six
// seams).

#include <array>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "base/fixed.h"
#include "base/raw_vector.h"

namespace sgm {

inline constexpr int kChunkCells = 32;                 ///< number of cells of a chunk along each axis
inline constexpr int kChunkSamples = kChunkCells + 1;  ///< number of samples along each axis, both faces included
/// positions of vertices are integers in 1/256 of the chunk's cell edge
inline constexpr int kSubcell = 256;
/// quantised samples Q lie in -kMaxQ..kMaxQ; a sample is solid if Q < 0
inline constexpr int32_t kMaxQ = 1 << 22;

/// The faces of a chunk, in the order -x +x -y +y -z +z.
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
/// q is only defined at the ends of edges whose ends differ in sign, the only values that vertices need; signs are
/// always defined.
struct ChunkSamples {
  std::pmr::vector<int32_t> q;
  std::pmr::vector<uint64_t> signs;

  explicit ChunkSamples(std::pmr::memory_resource* memory = std::pmr::get_default_resource())
      : q(size_t{kChunkSamples} * kChunkSamples * kChunkSamples, memory),
        signs(size_t{kChunkSamples} * kChunkSamples, memory) {}
};

/// The kind of crossed edge that a vertex lies on. A packed vertex stores it, so that its exact key (VertexKey) follows
/// from the vertex and its chunk. Feature vertices have kinds of their own (mesh/feature_kind.h).
enum VertexKind : uint16_t {
  kOwnEdge = 0,      ///< grid edge of the chunk's level: only the coordinate along it is not a multiple of kSubcell
  kCoarserEdge = 1,  ///< only in seams: grid edge of the next coarser level, with a grid step of 2 * kSubcell
  kLateralEdge = 2,  ///< only in seams: joins the grids of the two levels, at a corner of the coarser grid
};

/// A packed vertex, 16 bytes, the same on every backend.
struct Vertex {
  /// position in 1/256 of the chunk's cell edge, from the chunk's origin: 0..8192; -400..8592 for feature vertices of
  /// the coarser level in a seam
  int16_t x, y, z;
  uint16_t material;           ///< index into the grammar's materials
  int16_t normal_x, normal_y;  ///< unit normal in octahedral encoding, in 1/32767; points out of the solid
  uint16_t tag;                ///< index into the grammar's tags
  /// a VertexKind (0 for all edge vertices of a body), or the encoding of a feature vertex (mesh/feature_kind.h)
  uint16_t kind;
};
static_assert(sizeof(Vertex) == 16);

/// Identifies an edge that the surface crosses, and so the vertex on this edge, without any tolerance. There are two
/// kinds of edges. A grid edge starts at `corner` and runs along `axis` for one cell of `level`. A lateral edge (axis
/// kLateral) joins the levels `level` and `level + 1` at one corner of a seam. `fan` distinguishes the vertices on a
/// lateral edge: it is the number of the vertex's cycle of seam cells around this edge. So the triangles around every
/// vertex form one cycle, even if the fields of the two levels differ. A key can be computed from a chunk and a packed
/// vertex: `corner` is the vertex's position rounded down to the grid of the edge's level; `axis` is the axis on which
/// the position is not a multiple of that level's cell; and the fan of a lateral edge follows from the blocks around
/// the chunk (mesh/fans.h).
struct VertexKey {
  Int3 corner;
  uint8_t level = 0;
  uint8_t axis = 0;
  uint8_t fan = 0;
  friend auto operator<=>(const VertexKey&, const VertexKey&) = default;
};
inline constexpr uint8_t kLateral = 3;
/// Keys of feature vertices (mesh/sharpen.h). A face vertex, which belongs to a face of a cell: `axis` is kFaceVertex
/// plus the axis of the face's normal; `corner` is the lowest corner of the face; `fan` identifies the loop side in
/// this face, plus kSecondOfSide for the second face vertex of the same side. A cell vertex, the centre of a loop's
/// fan: `axis` is kCellVertex; `corner` is the lowest corner of the cell; `fan` identifies the loop in the cell.
inline constexpr uint8_t kFaceVertex = 4;
inline constexpr uint8_t kCellVertex = 7;
inline constexpr uint8_t kSecondOfSide = 8;

/// A hash of a part's words: two 32-bit sums of the words, each mixed with its index (mesh/hash.h). The same on any
/// device and for any order of addition.
struct ContentHash {
  uint32_t a = 0, b = 0;
  friend auto operator<=>(const ContentHash&, const ContentHash&) = default;
  uint64_t value() const { return uint64_t{b} << 32 | a; }
};

/// A mesh that is drawn as a whole: the body of a chunk, or one seam. Triangles index the part's own vertices.
struct MeshPart {
  RawVector<Vertex> vertices;
  RawVector<uint32_t> indices;  ///< three per triangle, counter-clockwise seen from the void
  RawVector<VertexKey> keys;    ///< one per vertex
  ContentHash hash;             ///< content hash of vertices and indices (mesh/hash.h)

  explicit MeshPart(std::pmr::memory_resource* memory = std::pmr::get_default_resource())
      : vertices(memory), indices(memory), keys(memory) {}
};

}  // namespace sgm

#pragma once
// Marching cubes with bit operations: crossed edges and active cells are found from signs, 64 samples a word; vertices
// and loops are then processed in vectors. For a caller's grid of floats, and for the samples of a chunk, including all
// other work on a chunk that does not need the field. One source is compiled for each instruction set (the .inl files
// here); all give the same bits.

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory_resource>

#include "base/raw_array.h"
#include "field/evaluate.h"
#include "mesh/chunk.h"

namespace sgm {

/// Signs of a lattice of samples: by z, y and word; bit 1 means solid. Bits after the last sample of a row are 0. Owns
/// nothing.
struct SignLattice {
  std::array<size_t, 3> size{};  ///< samples: at least 2 and at most 2^14 on each axis
  size_t words = 0;              ///< in a row: size[0] / 64, rounded up
  const uint64_t* signs = nullptr;
  /// Two words a row. Bit g is set if all samples of the row's words g * group..(g + 1) * group - 1 are void (first
  /// word) or solid (second word). Null: unknown.
  const uint64_t* uniform = nullptr;

  size_t group() const { return (words + 63) / 64; }
  const uint64_t* row(size_t y, size_t z) const { return signs + (z * size[1] + y) * words; }
  const uint64_t* uniformRow(size_t y, size_t z) const { return uniform + (z * size[1] + y) * 2; }
};

/// Input and output of the passes over a grid. Owns nothing.
struct GridJob {
  const float* values = nullptr;
  SignLattice lattice;
  size_t stride_y = 0, stride_z = 0;  ///< floats; stride_y * size[1] and 4 * stride_z are below 2^31
  float scale = 0;                    ///< Q per unit of the values
  double step = 0;                    ///< a 256th of a cell, in the unit of the positions

  float* positions = nullptr;   ///< three a vertex
  float* normals = nullptr;     ///< three a vertex; null if not wanted
  uint32_t* indices = nullptr;  ///< three a triangle

  const float* row(size_t y, size_t z) const { return values + y * stride_y + z * stride_z; }
};

/// For rows of a plane: the crossed edges that they own, which become vertices, and the active cells of the layer
/// above.
struct ListCounts {
  uint64_t vertices = 0, cells = 0, triangles = 0;
};

/// Lanes of the widest vector: passes may write this much past the end of scratch.
inline constexpr size_t kMostLanes = 16;

/// The sizes of lists of `rows` rows: edges (packed as in lattice.inl) and cells.
constexpr size_t edgeRoom(size_t size_x, size_t rows) { return 3 * size_x * rows + kMostLanes; }
constexpr size_t cellRoom(size_t size_x, size_t rows) { return size_x * rows + kMostLanes; }

/// Bounds of a slab's own vertices, in 256ths of a cell; lo above hi if there are none.
struct GridBounds {
  std::array<int32_t, 3> lo{INT32_MAX, INT32_MAX, INT32_MAX}, hi{INT32_MIN, INT32_MIN, INT32_MIN};
};

/// The planes first..last - 1, and the layers of cells below each: their lists, and the counts before them. A layer has
/// the number of the plane below it.
struct GridSlab {
  size_t first = 0, last = 0;
  const uint64_t* first_vertex = nullptr;  ///< by plane, with one more element at the end
  const uint64_t* first_cell = nullptr;    ///< by layer, same as above
  uint64_t first_triangle = 0;             ///< of the slab
  const uint32_t* edges = nullptr;         ///< of the slab's planes
  const uint64_t* cells = nullptr;         ///< of the layers from `first` on
  /// Of plane first - 1 and of the layer above it; null where `first` is 0.
  const uint32_t* edges_below = nullptr;
  const uint64_t* cells_below = nullptr;
};

/// Scratch of one slab: raw memory that need not be cleared.
struct GridScratch {
  uint32_t* numbers = nullptr;  ///< 2 * size[0] * size[1]
  uint32_t* offsets = nullptr;  ///< one for each vertex of the slab and of the plane below it, plus kMostLanes
};

inline constexpr int kBrickSamples = 8;                      ///< on each axis; the last brick has one more
inline constexpr int kBricks = kChunkCells / kBrickSamples;  ///< on each axis
inline constexpr int kBrickCount = kBricks * kBricks * kBricks;

/// Scratch of one chunk; grows once.
struct MeshScratch {
  explicit MeshScratch(std::pmr::memory_resource* memory)
      : numbers(memory),
        edges(memory),
        offsets(memory),
        cells(memory),
        brick(memory),
        place_x(memory),
        place_y(memory),
        place_z(memory),
        order(memory),
        label(memory),
        x(memory),
        y(memory),
        z(memory),
        q(memory),
        normal_x(memory),
        normal_y(memory) {}

  RawArray<uint32_t> numbers, edges, offsets;
  RawArray<uint64_t> cells;
  /// For a body's vertices: the brick of the sample that owns the vertex's edge, x fastest, and the place in units.
  RawArray<uint32_t> brick;
  RawArray<int32_t> place_x, place_y, place_z;
  /// For the evaluated vertices, in their order.
  RawArray<uint32_t> order, label;
  RawArray<int32_t> x, y, z, q;
  RawArray<int16_t> normal_x, normal_y;

  void growPlaces(size_t count) {
    brick.grow(0, count);
    for (RawArray<int32_t>* array : {&place_x, &place_y, &place_z}) array->grow(0, count);
  }
};

/// Pure except for the memory their arguments point at, which concurrent calls must not share.
struct MeshKernels {
  const char* name;
  /// Writes the signs of a row of the grid to `signs`, and which are uniform. Returns false if a value is not finite.
  bool (*signs)(const GridJob&, size_t y, size_t z, uint64_t* signs, uint64_t* uniform);
  /// Lists the edges and cells that the rows first..last - 1 of plane z own.
  using List = ListCounts(const SignLattice&, size_t z, size_t first, size_t last, uint32_t* edges, uint64_t* cells);
  List* list;
  /// Writes the vertices and triangles of a slab.
  GridBounds (*mesh)(const GridJob&, const GridSlab&, const GridScratch&);
  /// Counts the solid samples of a chunk, without those of its high faces.
  uint32_t (*count)(const ChunkSamples&);
  /// polygonizeBody of mesh/body.h, with or without the keys; also fills scratch.brick and scratch.place_x, y, z.
  void (*polygonize)(const ChunkSamples&, const ChunkGrid&, bool keys, MeshScratch&, MeshPart&);
  /// Sorts the last polygonized vertices by brick: fills scratch.order, and x, y and z in units. start[b] is the index
  /// where brick b begins.
  void (*sort)(MeshScratch&, size_t count, std::array<uint32_t, kBrickCount + 1>& start);
  /// Copies the attributes in scratch to the vertices scratch.order[0..count).
  void (*attribute)(MeshScratch&, size_t count, MeshPart&);
  /// hashPart of mesh/hash.h.
  void (*hash)(MeshPart&);
};

const MeshKernels& scalarMeshKernels();
/// Without scalar; null if not in this build.
const MeshKernels* findWideMeshKernels(const char* name);
/// By the names of findKernels; null if this build or this processor lacks the set.
const MeshKernels* findMeshKernels(const char* name);
/// For the instruction set of bestKernels().
const MeshKernels& bestMeshKernels();

}  // namespace sgm

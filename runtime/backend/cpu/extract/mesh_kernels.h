#pragma once
// Marching cubes with bit operations. Crossed edges and active cells are found from signs, 64 samples per word;
// vertices and loops are then processed in vectors. Used for a caller's grid of floats, and for chunks, including all
// work on a chunk that does not need the field. The same source (the .inl files here) is compiled for each instruction
// set; all give the same bits.

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory_resource>

#include "base/raw_array.h"
#include "field/evaluate.h"
#include "mesh/chunk.h"

namespace sgm {

/// The signs of a lattice of samples, by z, y and word; bit 1 means solid. Bits after the last sample of a row are 0.
/// Does not own the arrays.
struct SignLattice {
  std::array<size_t, 3> size{};  ///< number of samples on each axis, 2 to 2^14
  size_t words = 0;              ///< number of words in a row: size[0] / 64, rounded up
  const uint64_t* signs = nullptr;
  /// Tells which parts of the rows are uniform. A row is divided into groups of `group()` successive words. For each
  /// row there are two words: bit g of the first is set if all samples of group g are void; bit g of the second is set
  /// if all are solid. Null: unknown.
  const uint64_t* uniform = nullptr;

  size_t group() const { return (words + 63) / 64; }
  const uint64_t* row(size_t y, size_t z) const { return signs + (z * size[1] + y) * words; }
  const uint64_t* uniformRow(size_t y, size_t z) const { return uniform + (z * size[1] + y) * 2; }
};

/// Input and output of the passes over a grid. Does not own the arrays.
struct GridJob {
  const float* values = nullptr;
  SignLattice lattice;
  /// distances between rows and between planes, in floats; stride_y * size[1] and 4 * stride_z are below 2^31
  size_t stride_y = 0, stride_z = 0;
  float scale = 0;  ///< factor from values to quantised samples Q
  double step = 0;  ///< 1/256 of a cell, in the unit of the positions

  float* positions = nullptr;   ///< three coordinates per vertex
  float* normals = nullptr;     ///< three components per vertex; null if not wanted
  uint32_t* indices = nullptr;  ///< three per triangle

  const float* row(size_t y, size_t z) const { return values + y * stride_y + z * stride_z; }
};

/// The results of listing rows of a plane. vertices: number of crossed edges that start in these rows (each edge has
/// one vertex). cells, triangles: numbers of active cells, and of the triangles in them, in the layer of cells above.
struct ListCounts {
  uint64_t vertices = 0, cells = 0, triangles = 0;
};

/// Number of lanes of the widest vector. A pass may write up to this number of elements past the end of a list.
inline constexpr size_t kMaxLanes = 16;

/// Capacities of the lists for `rows` rows of samples: of crossed edges (packed as in lattice.inl), and of active
/// cells.
constexpr size_t edgeRoom(size_t size_x, size_t rows) { return 3 * size_x * rows + kMaxLanes; }
constexpr size_t cellRoom(size_t size_x, size_t rows) { return size_x * rows + kMaxLanes; }

/// Bounds of the vertices that a slab owns, in 1/256 of a cell; lo is above hi if it has none.
struct GridBounds {
  std::array<int32_t, 3> lo{INT32_MAX, INT32_MAX, INT32_MAX}, hi{INT32_MIN, INT32_MIN, INT32_MIN};
};

/// A slab to be meshed: planes first..last - 1, and the layers of cells below each of these planes. Holds their lists
/// of edges and cells, and the numbers of the first vertices, cells and triangles. A layer has the number of the plane
/// below it.
struct GridSlab {
  size_t first = 0, last = 0;
  /// for each plane, the number of its first vertex; one more element marks the end
  const uint64_t* first_vertex = nullptr;
  /// for each layer, the number of its first cell; one more element marks the end
  const uint64_t* first_cell = nullptr;
  uint64_t first_triangle = 0;      ///< number of the slab's first triangle
  const uint32_t* edges = nullptr;  ///< list of crossed edges of the slab's planes
  const uint64_t* cells = nullptr;  ///< list of active cells of the layers from `first` on
  /// Lists of plane first - 1 and of the layer above that plane; null if `first` is 0.
  const uint32_t* edges_below = nullptr;
  const uint64_t* cells_below = nullptr;
};

/// Working memory for meshing one slab; the caller need not initialise it. Capacities: of `numbers`, 2 * size[0] *
/// size[1]; of `offsets`, the number of vertices of the slab and of the plane below it, plus kMaxLanes.
struct GridScratch {
  /// for each sample of two planes: number of the first vertex on the edges that start at the sample
  uint32_t* numbers = nullptr;
  uint32_t* offsets = nullptr;  ///< for each vertex of the slab and of the plane below the slab: its offset along its
                                ///< edge
};

/// number of samples of a brick along each axis; a chunk's last brick has one more
inline constexpr int kBrickSamples = 8;
inline constexpr int kBricks = kChunkCells / kBrickSamples;  ///< number of bricks of a chunk along each axis
inline constexpr int kBrickCount = kBricks * kBricks * kBricks;

/// Working memory for one chunk; allocated once, then reused.
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
  /// For each vertex of a body: the number of a brick (a block of 8^3 samples; x varies fastest), and the vertex's
  /// position in units. The brick contains the sample at which the vertex's edge starts.
  RawArray<uint32_t> brick;
  RawArray<int32_t> place_x, place_y, place_z;
  /// The order in which the vertices are evaluated, brick by brick: `order` contains their indices; the arrays after it
  /// contain their positions and attributes in this order.
  RawArray<uint32_t> order, label;
  RawArray<int32_t> x, y, z, q;
  RawArray<int16_t> normal_x, normal_y;

  void growPlaces(size_t count) {
    brick.grow(0, count);
    for (RawArray<int32_t>* array : {&place_x, &place_y, &place_z}) array->grow(0, count);
  }
};

/// The functions of one instruction set. They change only the memory to which their arguments point, and concurrent
/// calls must not write to the same memory.
struct MeshKernels {
  const char* name;
  /// Writes the signs of a row of the grid, and the bits of its uniform groups (SignLattice::uniform). Returns false if
  /// a value is not finite.
  bool (*signs)(const GridJob&, size_t y, size_t z, uint64_t* signs, uint64_t* uniform);
  /// Lists the crossed edges and active cells of rows first..last - 1 of plane z.
  using List = ListCounts(const SignLattice&, size_t z, size_t first, size_t last, uint32_t* edges, uint64_t* cells);
  List* list;
  /// Writes the vertices and triangles of a slab.
  GridBounds (*mesh)(const GridJob&, const GridSlab&, const GridScratch&);
  /// Counts the solid samples of a chunk, except those in its upper faces (at the maximum x, y or z).
  uint32_t (*count)(const ChunkSamples&);
  /// Same as polygonizeBody of mesh/body.h, with or without keys; also fills scratch.brick and scratch.place_x, y, z.
  void (*polygonize)(const ChunkSamples&, const ChunkGrid&, bool keys, MeshScratch&, MeshPart&);
  /// Sorts the vertices of the last polygonize() by brick: fills scratch.order, and scratch.x, y and z in units.
  /// start[b]: index in scratch.order where brick b begins.
  void (*sort)(MeshScratch&, size_t count, std::array<uint32_t, kBrickCount + 1>& start);
  /// Copies the attributes from scratch to the vertices scratch.order[0..count).
  void (*attribute)(MeshScratch&, size_t count, MeshPart&);
  /// Same as hashPart of mesh/hash.h.
  void (*hash)(MeshPart&);
};

const MeshKernels& scalarMeshKernels();
/// Returns the kernels of a vector instruction set; null if this build does not contain it. The set "scalar" is not
/// among them.
const MeshKernels* findWideMeshKernels(const char* name);
/// Returns the kernels of an instruction set. name: as for findKernels(). Null if this build does not contain the set,
/// or this processor does not support it.
const MeshKernels* findMeshKernels(const char* name);
/// Returns the kernels for the instruction set of bestKernels().
const MeshKernels& bestMeshKernels();

}  // namespace sgm

#pragma once
// Marching cubes over a caller's grid of floats, in the three passes that run for each plane: signs, counts, mesh. Made
// from one source for each instruction set (grid_kernels.inl); all give the same bits.

#include <array>
#include <cstddef>
#include <cstdint>

namespace sgm {

/// What the passes read and write. Owns nothing.
struct GridJob {
  const float* values = nullptr;
  std::array<size_t, 3> size{};       ///< samples, at least 2 on each axis
  size_t stride_y = 0, stride_z = 0;  ///< floats
  float scale = 0;                    ///< Q by unit of the values
  double step = 0;                    ///< a 256th of a cell in the unit of the positions

  size_t words = 0;           ///< of a row of signs: size[0] / 64, rounded up
  uint64_t* signs = nullptr;  ///< by z, y and word: bit 1 where a sample is solid

  float* positions = nullptr;   ///< three a vertex
  float* normals = nullptr;     ///< three a vertex; null where not wanted
  uint32_t* indices = nullptr;  ///< three a triangle

  const float* row(size_t y, size_t z) const { return values + y * stride_y + z * stride_z; }
  const uint64_t* signRow(size_t y, size_t z) const { return signs + (z * size[1] + y) * words; }
};

struct GridCounts {
  uint64_t vertices = 0, triangles = 0;
};

/// The planes first..last - 1 with the layers of cells above them, and what is numbered before them.
struct GridSlab {
  size_t first = 0, last = 0;
  const uint64_t* first_vertex = nullptr;    ///< by plane, one more than there are
  const uint64_t* first_triangle = nullptr;  ///< by layer, likewise
};

/// Scratch of one slab: raw memory, nothing of it has to be cleared.
struct GridScratch {
  uint32_t* numbers = nullptr;   ///< 2 * size[0] * size[1]
  uint32_t* edges = nullptr;     ///< 6 * gridEdgeRoom(size[0])
  uint8_t* crossings = nullptr;  ///< one for each vertex of the slab and of the plane above it
};

/// Edges that are taken together at least, and the room for as many with another row's.
inline constexpr size_t kGridEdges = 512;
constexpr size_t gridEdgeRoom(size_t samples) { return kGridEdges + samples + 64; }

/// Pure but for what their arguments point at, which no two calls that run at a time share.
struct GridKernels {
  const char* name;
  /// Signs of a row. False where a value is not finite.
  bool (*signs)(const GridJob&, size_t y, size_t z);
  /// The vertices that plane z owns, and the triangles of the layer above it.
  GridCounts (*count)(const GridJob&, size_t z);
  /// Vertices and triangles of a slab.
  void (*mesh)(const GridJob&, const GridSlab&, const GridScratch&);
};

const GridKernels& scalarGridKernels();
/// Without scalar; not there in a scalar build.
const GridKernels* findWideGridKernels(const char* name);
/// Those of findKernels' names that this build and this processor have; else null.
const GridKernels* findGridKernels(const char* name);
/// Of the instruction set of bestKernels().
const GridKernels& bestGridKernels();

}  // namespace sgm

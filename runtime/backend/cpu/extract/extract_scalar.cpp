#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "backend/cpu/extract/mesh_kernels.h"
#include "backend/cpu/instruction_sets.h"
#include "base/kernel.h"
#include "mesh/body.h"
#include "mesh/hash.h"
#include "mesh/tables.h"
#include "mesh/triangulate.h"
#include "mesh/vertex.h"

namespace sgm {

namespace scalar_extract {

using std::memcpy;

#include "common/portable.h"
#include "common/real.h"

inline constexpr size_t kLanes = 1;
FN Real loadValues(const float* p) { return *p; }
FN Int loadLanes(const uint32_t* p) { return static_cast<Int>(*p); }
FN Real loadAt(const float* p, Int i) { return p[i]; }
FN void loadFour(const float* p, Real& a, Real& b, Real& c, Real& d) { a = p[0], b = p[1], c = p[2], d = p[3]; }
FN void storeLanes(Int i, int32_t* p) { *p = i; }
FN void storeLanes(Int i, uint32_t* p) { *p = static_cast<uint32_t>(i); }
FN void storeThree(Real a, Real b, Real c, float* p) { p[0] = a, p[1] = b, p[2] = c; }
FN Real squareRoot(Real r) { return std::sqrt(r); }
FN Real quotient(Real a, Real b) { return a / b; }
FN Real scaledDouble(Int i, double scale) { return static_cast<float>(i * scale); }
FN uint64_t maskOf(Bool b) { return b ? 1 : 0; }
FN bool all(Bool b) { return b; }
FN bool any(Bool b) { return b; }
FN Int minInt(Int a, Int b) { return std::min(a, b); }
FN Int maxInt(Int a, Int b) { return std::max(a, b); }

// Transposes bits, eight bytes at a time: a multiplication copies bits into each byte, and a mask selects the right
// one.
template <size_t kCount>
FN void spreadBits(const uint64_t* words, uint8_t* out) {
  for (int at = 0; at < 64; at += 8) {
    uint64_t sum = 0;
    for (size_t k = 0; k < kCount; ++k) {
      const uint64_t copies = (words[k] >> at & 0xFF) * 0x0101010101010101u & 0x8040201008040201u;
      sum |= (((copies + 0x7F7F7F7F7F7F7F7Fu) | copies) >> 7 & 0x0101010101010101u) << k;
    }
    memcpy(out + at, &sum, 8);
  }
}

template <size_t N>
FN void writeTriangles(size_t way, const uint32_t* vertex, uint32_t* out) {
  const uint8_t* triangles = triangulation::kTriangles<N>[way].data();
  for (size_t i = 0; i < 3 * (N - 2); ++i) out[i] = vertex[triangles[i]];
}

FN void addSteps(const uint32_t* r0, const uint32_t* r1, const uint32_t* r2, const uint32_t* r3, uint64_t steps,
                 uint32_t* number) {
  const uint32_t first[12] = {r0[0], r1[0], r2[0], r3[0], r0[0], r0[1], r2[0], r2[1], r0[0], r0[1], r1[0], r1[1]};
  for (size_t e = 0; e < 4; ++e) number[e] = first[e];
  for (size_t e = 4; e < 12; ++e) number[e] = first[e] + static_cast<uint32_t>(steps >> 8 * (e - 4) & 0xFF);
}

#include "backend/cpu/extract/lattice.inl"

#include "backend/cpu/extract/list.inl"

#include "backend/cpu/extract/cells.inl"

#include "backend/cpu/extract/edges.inl"

#include "backend/cpu/extract/grid_passes.inl"

#include "backend/cpu/extract/chunk_passes.inl"

void polygonizeChunk(const ChunkSamples& samples, const ChunkGrid& grid, bool /*keys*/, MeshScratch& scratch,
                     MeshPart& part) {
  polygonizeBody(samples, grid, part);
  const size_t count = part.vertices.size();
  scratch.growPlaces(count);
  for (size_t i = 0; i < count; ++i) {
    const Vertex& v = part.vertices[i];
    const Int3 p = vertexUnits(grid, v);
    scratch.place_x.data()[i] = p.x;
    scratch.place_y.data()[i] = p.y;
    scratch.place_z.data()[i] = p.z;
    scratch.brick.data()[i] = static_cast<uint32_t>(brickOf(v.x >> 8, v.y >> 8, v.z >> 8));
  }
}

}  // namespace scalar_extract

const MeshKernels& scalarMeshKernels() {
  static constexpr MeshKernels kernels{"scalar",
                                       scalar_extract::signsOfRow,
                                       scalar_extract::listRows,
                                       scalar_extract::meshSlab,
                                       scalar_extract::countSolid,
                                       scalar_extract::polygonizeChunk,
                                       scalar_extract::sortVertices,
                                       scalar_extract::attributeVertices,
                                       hashPart};
  return kernels;
}

const MeshKernels* findMeshKernels(const char* name) {
  if (std::strcmp(name, scalarMeshKernels().name) == 0) return &scalarMeshKernels();
#ifdef SGM_SCALAR
  return nullptr;
#else
  return findWideMeshKernels(name);
#endif
}

const MeshKernels& bestMeshKernels() {
  static const MeshKernels& best = []() -> const MeshKernels& {
    const MeshKernels* found = findMeshKernels(bestKernels().name);
    return found != nullptr ? *found : scalarMeshKernels();
  }();
  return best;
}

}  // namespace sgm

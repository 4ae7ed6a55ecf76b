#pragma once
// Measures a meshed chunk (chunk_measures.h).

#include <memory_resource>
#include <span>
#include <vector>

#include "measure/chunk_measures.h"
#include "measure/chunk_stars.h"
#include "mesh/body_pairs.h"
#include "mesh/packed_mesh.h"
#include "mesh/triangle_terms.h"

namespace sgm::measure {

/// A view of a part's vertices and triangles. The triangles' indices are relative to first_vertex.
struct PartView {
  std::span<const Vertex> vertices;
  std::span<const uint32_t> indices;
  uint32_t first_vertex = 0;
};
inline PartView viewOf(const MeshPart& part) { return {part.vertices, part.indices}; }
PartView viewOf(const PackedMesh& mesh, size_t part);

/// Working memory of measureBody(), reused for several chunks: about 80 bytes per triangle of the largest body. Not
/// thread-safe.
struct MeasureScratch {
  StarScratch stars;
  /// for each vertex: bit (1 << Face) is set if the vertex lies in that border plane of the chunk; the higher bits are
  /// for internal use
  std::pmr::vector<uint8_t> planes;
  std::pmr::vector<PackedDirection> directions;  ///< unpacked normal of each vertex
  std::pmr::vector<uint32_t> indices;            ///< corners of the triangles that are not excluded
  /// splitCreases() copies vertices. `first`: for each vertex, the first copy of the same vertex; `table`: the hash
  /// table with which the copies are found
  std::pmr::vector<uint32_t> first, table;
  std::pmr::vector<PairCorner> corners;  ///< corners of the triangles that have an area, three per triangle
  PairScratch pairs;

  explicit MeasureScratch(std::pmr::memory_resource* memory)
      : stars(memory),
        planes(memory),
        directions(memory),
        indices(memory),
        first(memory),
        table(memory),
        corners(memory),
        pairs(memory) {}
};

/// Measures the body into parts[0] and topology. signs: ChunkSamples::signs of the body's samples; if empty, vertices
/// are not compared with samples. Precondition: fewer than 2^20 triangles, so that no sum can overflow. Takes about 35
/// ns per triangle. Throws std::bad_alloc.
void measureBody(const PartView& body, std::span<const uint64_t> signs, MeasureScratch& scratch,
                 ChunkMeasures& measures);

/// Measures a seam: counts the defects index, outside and degenerate (chunk_measures.h), and sums area and flux.
PartMeasures measureSeam(const PartView& seam);

}  // namespace sgm::measure

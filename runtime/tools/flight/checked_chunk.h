#pragma once
// The parts of a drawn chunk, as the checks of the surface need them.

#include <sgm/sgm.h>

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "mesh/body_pairs.h"
#include "tools/flight/vertex_place.h"
#include "world/chunk_key.h"

namespace sgm::cli {

/// The drawn seams of a chunk, and its coarser neighbours.
struct DrawnParts {
  uint32_t seams = 0;         ///< faces whose seams are drawn, bit (1u << sgm_face)
  Neighbourhood coarser = 0;  ///< blocks around it that belong to coarser chunks, as in sgm_chunk_request; those across
                              ///< the faces in `seams` always count as coarser
  friend bool operator==(const DrawnParts&, const DrawnParts&) = default;
};

/// Counts of undirected edges, as in FrameReport.
struct EdgeCounts {
  uint64_t edges = 0, open = 0, nonmanifold = 0;
};

/// Faults of a part's triangles by themselves.
struct TriangleCounts {
  uint64_t degenerate = 0, flat = 0;
  PairCounts pairs;
};

/// A body or a seam.
struct CheckedPart {
  std::vector<VertexPlace> vertices;
  std::vector<uint32_t> indices;  ///< three per triangle: indices into `vertices`
  /// one id per vertex, equal for identical vertices; valid while the part is drawn
  std::vector<uint32_t> ids;
  EdgeCounts inside;         ///< counts of the edges that no other part can share; valid while the part is drawn
  TriangleCounts triangles;  ///< faults of the part's triangles; valid while the part is drawn
};

struct CheckedChunk {
  ChunkGrid grid;
  DrawnParts drawn;
  std::array<CheckedPart, 1 + SGM_FACE_COUNT> parts;  ///< the body, then the seams
};

using CheckedChunks = std::map<ChunkKey, CheckedChunk>;

ChunkKey keyOf(const sgm_chunk_key& key);

/// Returns an error (invalid_argument) about the mesh of a chunk. what: the end of the sentence.
Error malformed(const ChunkKey& key, const std::string& what);

/// Copies all parts of a mesh; none of them is drawn yet. Error: invalid_argument if the mesh is malformed.
Result<CheckedChunk> copyChunk(const sgm_mesh_view& mesh);

/// Returns the seam with this number of a part; the default for a body.
SeamOf seamOf(const DrawnParts& drawn, size_t number);

/// Calls visit(part, its number) for every drawn part.
template <class ChunkOrConst, class Visit>
void forEachDrawn(ChunkOrConst& chunk, const Visit& visit) {
  for (size_t number = 0; number < chunk.parts.size(); ++number)
    if (number == 0 || (chunk.drawn.seams >> (number - 1) & 1) != 0) visit(chunk.parts[number], number);
}

/// Finds for every vertex of a body the lowest vertex number on the same edge: its own, unless the mesh has duplicates.
void numberByEdge(const CheckedPart& part, std::vector<uint32_t>& first);

/// Counts faults of triangles. ids: of the part's vertices, equal for identical vertices.
TriangleCounts countTriangles(const CheckedPart& part, size_t number, std::span<const uint32_t> ids,
                              PairScratch& scratch);

}  // namespace sgm::cli

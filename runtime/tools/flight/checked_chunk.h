#pragma once
// The parts of a drawn chunk mesh (body and seams), in the form in which the surface is checked.

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
  uint32_t seams = 0;  ///< bit (1u << sgm_face) is set if the seam over that face of the chunk is drawn
  /// Neighbouring chunk-sized cubes (blocks) that belong to coarser chunks, as in sgm_chunk_request; blocks across the
  /// faces in `seams` always count as coarser.
  Neighbourhood coarser = 0;
  friend bool operator==(const DrawnParts&, const DrawnParts&) = default;
};

/// Counts of undirected edges: all edges, open edges, and non-manifold edges, as FrameReport defines them.
struct EdgeCounts {
  uint64_t edges = 0, open = 0, nonmanifold = 0;
};

/// Counts of faulty triangles and of faulty pairs of triangles within one part.
struct TriangleCounts {
  uint64_t degenerate = 0, flat = 0;
  PairCounts pairs;
};

/// One part of a chunk mesh: its body, or one of its seams, each of which joins the body to a coarser neighbour.
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
  std::array<CheckedPart, 1 + SGM_FACE_COUNT> parts;  ///< index 0: the body; then the seams, in the order of sgm_face
};

using CheckedChunks = std::map<ChunkKey, CheckedChunk>;

ChunkKey keyOf(const sgm_chunk_key& key);

/// Makes an error (invalid_argument) about the mesh of a chunk. what: end of the message's sentence, such as "is not
/// drawn".
Error malformed(const ChunkKey& key, const std::string& what);

/// Copies all parts of a chunk mesh and marks none as drawn. Error: invalid_argument if the mesh is malformed.
Result<CheckedChunk> copyChunk(const sgm_mesh_view& mesh);

/// Returns the seam that is part `number` of a chunk; a default value for the body (number 0).
SeamOf seamOf(const DrawnParts& drawn, size_t number);

/// Calls visit(part, number) for the body and every drawn seam; number: index in chunk.parts.
template <class ChunkOrConst, class Visit>
void forEachDrawn(ChunkOrConst& chunk, const Visit& visit) {
  for (size_t number = 0; number < chunk.parts.size(); ++number)
    if (number == 0 || (chunk.drawn.seams >> (number - 1) & 1) != 0) visit(chunk.parts[number], number);
}

/// Sets first[v], for every vertex v of a body, to the lowest number of a vertex on the same grid edge. This is v
/// itself, unless the mesh contains duplicate vertices.
void numberByEdge(const CheckedPart& part, std::vector<uint32_t>& first);

/// Counts the faults of the part's triangles. number: index of the part in its chunk. ids: one id for each vertex of
/// the part, equal for identical vertices.
TriangleCounts countTriangles(const CheckedPart& part, size_t number, std::span<const uint32_t> ids,
                              PairScratch& scratch);

}  // namespace sgm::cli

#pragma once
// The parts of a chunk with their own entries in the disk cache: its body and each of its seams.
//
// Each part is a function of the world, the chunk and the brushes around it alone. The seams of a request depend on the
// viewer's path, which is another one next time: so seams are stored separately.
//
// The key of an entry contains everything that it depends on: kMeshingVersion, the codec's version (chunk_codec.h), the
// meaning of the grammar's files (with imports from the standard library), its assets, the parameters' values, the
// seed, the finest cell, the host's fields, the flags of the request (crisp edges, for example), and the brushes
// visible around the chunk. A change of the grammar, except in layout or comments, orphans all entries of its worlds;
// they age and are evicted. A saved world loses only time by that: meshing gives the same again.

#include <array>
#include <optional>

#include "chunk/mesh_chunks.h"
#include "mesh/void_components.h"

namespace sgm {

/// The version of everything between a grammar's meaning and a chunk's vertices, indices, anchors and voids. Raise it
/// with every change of the library that changes one of these, including seams; golden hashes show such changes.
inline constexpr uint32_t kMeshingVersion = 10;

inline constexpr int kChunkParts = 7;  ///< 0 is the body, 1 + Face a seam

/// Whether the request asks for the part.
bool asksFor(const ChunkRequest& request, int part);

/// The inputs of all baked parts of a world, for BakedParts::worldOf: equal inputs give equal parts. nullopt if the
/// world has no identity.
std::optional<std::vector<std::byte>> bakedWorldInputs(const WorldField& world, bool sharp);

/// The inputs of a request's parts. Immutable.
class ChunkPartInputs {
 public:
  /// nullopt if the world has no identity. Precondition: the chunk lies in the world (chunkGrid).
  static std::optional<ChunkPartInputs> of(const WorldField& world, const ChunkRequest& request,
                                           const EditSnapshot* edits);

  /// Equal bytes mean equal parts; for DiskCache::keyOf.
  std::vector<std::byte> bytes(int part) const;

  /// Whether a baked part can serve the request: no brush is visible there, a seam leads to the next level's chunks,
  /// and the request wants no anchors or voids of coarser bodies.
  bool isAsBaked(int part) const;
  /// The inputs of the baked part, which has everything that a streamed world may ask for.
  ChunkPartInputs asBaked() const;

  const ChunkRequest& request() const { return request_; }
  const IntBox& box() const { return box_; }
  /// Whether the number is a material (or tag) of the grammar or of a brush.
  bool isMaterial(uint16_t number) const;
  bool isTag(uint16_t number) const;
  /// Whether the number is a kind or name of anchors.
  bool isName(uint16_t number) const { return number < program_->names.size(); }

 private:
  ChunkPartInputs(const WorldField& world, const ChunkRequest& request, const EditSnapshot* edits,
                  std::vector<std::byte>&& identity);
  bool isOfBrush(uint16_t number, uint16_t Brush::*member) const;

  ChunkRequest request_;
  IntBox box_;
  std::shared_ptr<const Program> program_;
  std::vector<std::byte> identity_;
  std::pmr::vector<Brush> brushes_, coarser_;  ///< visible at the chunk's level; visible at the next level, if seams
                                               ///< read it
};

/// A part, without the keys of its vertices.
struct ChunkPart {
  MeshPart mesh;
  std::vector<Anchor> anchors;  ///< of a body, if requested
  VoidComponents voids;         ///< of a body, if signs were requested

  explicit ChunkPart(std::pmr::memory_resource* memory) : mesh(memory), voids(memory) {}
};

/// The parts found for a chunk, by part number, and their inputs.
struct FoundParts {
  std::array<std::optional<ChunkPart>, kChunkParts> parts;
  ChunkPartInputs inputs;
};

std::pmr::vector<std::byte> encodeChunkPart(int part, const MeshPart& mesh, std::span<const Anchor> anchors,
                                            std::span<const VoidComponent> voids, std::pmr::memory_resource* memory);

/// Whether the bytes were already verified by a hash over all of them.
enum class BytesAre { unknown, whole };

/// Accepts any bytes. nullopt if meshing cannot have given them: all numbers are checked, and the mesh is compared with
/// its stored hash, unless the bytes are `whole`. Throws std::bad_alloc.
std::optional<ChunkPart> decodeChunkPart(std::span<const std::byte> bytes, int part, const ChunkPartInputs& inputs,
                                         std::pmr::memory_resource* memory, BytesAre are = BytesAre::unknown);

}  // namespace sgm

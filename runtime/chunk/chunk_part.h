#pragma once
// What of a chunk has an entry in the disk cache: its body, or one of its seams.
//
// Each is a function of the world, the chunk and the brushes around it alone. Which seams were asked for together
// follows from the way a viewer has come, and the next time he comes another way: so they are kept apart.
//
// An entry serves as long as nothing changes that it depends on, and is never found again after: kMeshingVersion, the
// codec's version (chunk_codec.h), the meaning of the grammar's files, those of the standard library that it imports
// included, its assets, the parameters' values, the seed, the finest cell, the host's fields, the flags of the request
// (crisp edges, for example), and the brushes that show around the chunk. So a change of a grammar, but in layout or
// comments, leaves all entries of its worlds behind, to age and be evicted. A saved world loses nothing by that but
// time: entries are only what meshing gives again.

#include <array>
#include <optional>

#include "chunk/mesh_chunks.h"
#include "mesh/void_components.h"

namespace sgm {

/// Of all that stands between a grammar's meaning and a chunk's vertices, indices, anchors and voids. To be raised by
/// every change of the library after which one of them comes out differently: with golden hashes, for seams as well.
inline constexpr uint32_t kMeshingVersion = 10;

inline constexpr int kChunkParts = 7;  ///< 0 is the body, 1 + Face a seam

/// Whether the request asks for the part.
bool asksFor(const ChunkRequest& request, int part);

/// All that baked parts of a world depend on: equal where they are, for BakedParts::worldOf. None where the world has
/// no identity.
std::optional<std::vector<std::byte>> bakedWorldInputs(const WorldField& world, bool sharp);

/// All that the parts of a request depend on. Immutable.
class ChunkPartInputs {
 public:
  /// None where the world has no identity. Precondition: the chunk lies in the world (chunkGrid).
  static std::optional<ChunkPartInputs> of(const WorldField& world, const ChunkRequest& request,
                                           const EditSnapshot* edits);

  /// Equal where a part is: for DiskCache::keyOf.
  std::vector<std::byte> bytes(int part) const;

  /// Whether a baked part may have all that is asked for: no brush shows there, a seam leads to the next level's
  /// chunks, and of coarser bodies nobody wants anchors or voids.
  bool isAsBaked(int part) const;
  /// Those of a part that was baked, which has all that a streamed world may ask for.
  ChunkPartInputs asBaked() const;

  const ChunkRequest& request() const { return request_; }
  const IntBox& box() const { return box_; }
  /// Whether there is one of that number, in the grammar or of a brush.
  bool isMaterial(uint16_t number) const;
  bool isTag(uint16_t number) const;
  /// Of an anchor's kind or name.
  bool isName(uint16_t number) const { return number < program_->names.size(); }

 private:
  ChunkPartInputs(const WorldField& world, const ChunkRequest& request, const EditSnapshot* edits,
                  std::vector<std::byte>&& identity);
  bool isOfBrush(uint16_t number, uint16_t Brush::*member) const;

  ChunkRequest request_;
  IntBox box_;
  std::shared_ptr<const Program> program_;
  std::vector<std::byte> identity_;
  std::pmr::vector<Brush> brushes_, coarser_;  ///< that show at the chunk's level; at the next, where seams see it
};

/// A part, without the keys of its vertices.
struct ChunkPart {
  MeshPart mesh;
  std::vector<Anchor> anchors;  ///< of a body, where asked for
  VoidComponents voids;         ///< of a body, where signs were asked for

  explicit ChunkPart(std::pmr::memory_resource* memory) : mesh(memory), voids(memory) {}
};

/// What there is of a chunk, by the numbers of its parts, and what that depends on.
struct FoundParts {
  std::array<std::optional<ChunkPart>, kChunkParts> parts;
  ChunkPartInputs inputs;
};

std::pmr::vector<std::byte> encodeChunkPart(int part, const MeshPart& mesh, std::span<const Anchor> anchors,
                                            std::span<const VoidComponent> voids, std::pmr::memory_resource* memory);

/// Whether somebody has compared the bytes with a hash of all of them.
enum class BytesAre { unknown, whole };

/// For any bytes. None where meshing cannot have given them: nothing is believed that a reader could stumble over, and
/// the mesh has the hash that it says, which bytes that are known to be whole are believed. Throws std::bad_alloc.
std::optional<ChunkPart> decodeChunkPart(std::span<const std::byte> bytes, int part, const ChunkPartInputs& inputs,
                                         std::pmr::memory_resource* memory, BytesAre are = BytesAre::unknown);

}  // namespace sgm

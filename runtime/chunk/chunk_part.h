#pragma once
// The parts of a chunk that have entries of their own in the disk cache: its body and each of its seams.
//
// Each part depends only on the world, the chunk and the brushes around it. Which seams a request wants depends on the
// viewer's path, which differs from run to run; therefore seams are stored separately.
//
// The key of an entry contains everything that the entry depends on: kMeshingVersion, the codec's version
// (chunk_codec.h), the meaning of the grammar's files (with imports from the standard library), its assets, the
// parameters' values, the seed, the finest cell, the host's fields, the flags of the request (crisp edges, for
// example), and the brushes visible around the chunk. After a change of the grammar, except in layout or comments, the
// old entries of its worlds are no longer found; they age and are evicted. That costs only time, since meshing produces
// the same chunks again.

#include <array>
#include <optional>

#include "chunk/mesh_chunks.h"
#include "mesh/void_components.h"

namespace sgm {

/// The version of the code that turns a grammar's meaning into a chunk's vertices, indices, anchors and voids. Raise it
/// with every change of the library that changes any of these, also in seams; changed golden hashes indicate such a
/// change.
inline constexpr uint32_t kMeshingVersion = 10;

inline constexpr int kChunkParts = 7;  ///< number of parts of a chunk: part 0 is the body, part 1 + Face a seam

/// True if the request wants the part. part: 0 for the body, 1 + Face for a seam.
bool asksFor(const ChunkRequest& request, int part);

/// Returns the inputs that all baked parts (parts meshed in advance) of a world have in common, for
/// BakedParts::worldOf: equal inputs mean equal parts. nullopt if the world has no identity (WorldField::identity).
/// sharp: whether the parts have sharp features.
std::optional<std::vector<std::byte>> bakedWorldInputs(const WorldField& world, bool sharp);
/// Returns the same inputs in the encoding of version 0.2 (WorldField::formerIdentity).
std::optional<std::vector<std::byte>> formerBakedWorldInputs(const WorldField& world, bool sharp);

/// All inputs that the parts of a request depend on. Immutable.
class ChunkPartInputs {
 public:
  /// Returns the inputs of a request; nullopt if the world has no identity. Precondition: the chunk lies in the world
  /// (chunkGrid).
  static std::optional<ChunkPartInputs> of(const WorldField& world, const ChunkRequest& request,
                                           const EditSnapshot* edits);

  /// Returns the inputs of a part as bytes, for DiskCache::keyOf. Equal bytes mean equal parts.
  std::vector<std::byte> bytes(int part) const;

  /// True if a baked part can serve the request. Conditions: no brush is visible in the part; if it is a seam, it leads
  /// to chunks of the next level, not to virtual neighbours; if it is the body of a level above 0, neither anchors nor
  /// voids are requested.
  bool isAsBaked(int part) const;
  /// Returns the inputs of the corresponding part as `sgm bake` stores it. A baked part must serve every streamed
  /// world, so at level 0 it also contains the anchors and the voids, which only some worlds request.
  ChunkPartInputs asBaked() const;

  const ChunkRequest& request() const { return request_; }
  const IntBox& box() const { return box_; }
  /// isMaterial(): true if the number is a valid material of the grammar or of a brush; isTag(): the same for tags.
  bool isMaterial(uint16_t number) const;
  bool isTag(uint16_t number) const;
  /// True if the number is a valid kind or name of anchors.
  bool isName(uint16_t number) const { return number < program_->names.size(); }

 private:
  ChunkPartInputs(const WorldField& world, const ChunkRequest& request, const EditSnapshot* edits,
                  std::vector<std::byte>&& identity);
  bool isOfBrush(uint16_t number, uint16_t Brush::*member) const;

  ChunkRequest request_;
  IntBox box_;
  std::shared_ptr<const Program> program_;
  std::vector<std::byte> identity_;
  /// brushes_: brushes visible at the chunk's level; coarser_: brushes visible at the next coarser level, if a seam
  /// samples it
  std::pmr::vector<Brush> brushes_, coarser_;
};

/// A decoded part of a chunk, without the keys of vertices, which are not stored.
struct ChunkPart {
  MeshPart mesh;
  std::vector<Anchor> anchors;  ///< anchors of a body, if requested
  VoidComponents voids;         ///< voids of a body, if signs were requested

  explicit ChunkPart(std::pmr::memory_resource* memory) : mesh(memory), voids(memory) {}
};

/// The parts of a chunk that were found in the cache, indexed by part number, and the inputs on which these parts
/// depend.
struct FoundParts {
  std::array<std::optional<ChunkPart>, kChunkParts> parts;
  ChunkPartInputs inputs;
};

std::pmr::vector<std::byte> encodeChunkPart(int part, const MeshPart& mesh, std::span<const Anchor> anchors,
                                            std::span<const VoidComponent> voids, std::pmr::memory_resource* memory);

/// States whether a hash over all bytes was verified before decoding (whole), or not (unknown).
enum class BytesAre { unknown, whole };

/// Decodes bytes from an untrusted file. nullopt if meshing cannot have produced them: all numbers are checked and,
/// unless the bytes are `whole`, the hash of the mesh is compared with the stored hash. Throws std::bad_alloc.
std::optional<ChunkPart> decodeChunkPart(std::span<const std::byte> bytes, int part, const ChunkPartInputs& inputs,
                                         std::pmr::memory_resource* memory, BytesAre are = BytesAre::unknown);

}  // namespace sgm

#pragma once
// The connected voids of a chunk, and the places where each touches the chunk's faces. Walking, flying and visibility
// use them.
//
// The voids are those of the mesh, so they follow its rule for faces of a cell (mesh/case_rule.h), which cuts off every
// run of solid corners by itself: void samples are connected along the axes and across the diagonal of a face.
// If only the axes connected samples, voids that the mesh connects would be separate. A sharp mesh closes some of those
// diagonals (mesh/ambiguous_faces.h), so the voids here may be larger than those of the mesh: what is visible is never
// taken for hidden.

#include <array>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "mesh/chunk.h"

namespace sgm {

inline constexpr int kVoidBlock = 4;                          ///< number of cells along each axis of a block
inline constexpr int kVoidBlocks = kChunkCells / kVoidBlock;  ///< number of blocks along each axis of a chunk
inline constexpr size_t kMaxVoidComponents = 64;              ///< per chunk

/// One void. Block i of an axis has the samples 4 i to 4 i + 4: a sample on the border of two blocks counts for both.
struct VoidComponent {
  /// By Face: bit a + 8 b is set if a sample of the void lies in that block of the face; a and b count along the two
  /// other axes, the lower axis first, so that chunks which share a face agree. 0: the void does not touch the face.
  std::array<uint64_t, 6> faces{};
  /// Bit x + 8 y of word z is set if a sample of the void lies in that block of the chunk.
  std::array<uint64_t, kVoidBlocks> blocks{};

  friend bool operator==(const VoidComponent&, const VoidComponent&) = default;
};

/// The voids of a chunk; empty if the chunk is solid. The voids that touch a face come first, in the order of their
/// first samples; then follows one entry for all voids that touch no face. If more than 63 voids touch a face, the 63rd
/// entry also stands for all further ones. So separate voids may share an entry, but connected ones are never split.
using VoidComponents = std::pmr::vector<VoidComponent>;

/// Returns the voids of a chunk from the signs of its samples (ChunkSamples::signs). Pure.
VoidComponents voidComponents(std::span<const uint64_t> signs,
                              std::pmr::memory_resource* memory = std::pmr::get_default_resource());

/// Returns the voids of a chunk whose samples all have the same sign.
VoidComponents voidOfUniform(bool solid, std::pmr::memory_resource* memory = std::pmr::get_default_resource());

/// Returns a mask: bit i is set if components[i] has a sample in the block that contains `cell` (0..31 on each axis).
/// So the void of a position in this cell is always in the mask, possibly together with other voids of the same block.
/// 0: all samples of the block are solid.
uint64_t voidsAround(std::span<const VoidComponent> components, Int3 cell);

}  // namespace sgm

#pragma once
// The separate voids of a chunk, and where each comes to the chunk's faces: what can be walked, flown or seen through.
//
// Voids are those that the mesh has, so they follow its rule for faces of a cell (mesh/case_rule.h), which cuts every
// run of solid corners off by itself: void samples join along the axes and across the diagonal of a face. Joining along
// the axes alone would call a void closed that the mesh leaves open. In a sharp mesh some of those diagonals are closed
// (mesh/ambiguous_faces.h): there more voids join here than there, and nothing that can be seen is taken for hidden.

#include <array>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "mesh/chunk.h"

namespace sgm {

inline constexpr int kVoidBlock = 4;                          ///< cells on each axis that a mask does not tell apart
inline constexpr int kVoidBlocks = kChunkCells / kVoidBlock;  ///< on each axis
inline constexpr size_t kMostVoidComponents = 64;             ///< of one chunk

/// One void. Block i of an axis has the samples 4 i to 4 i + 4: what lies in a border counts for both sides.
struct VoidComponent {
  /// By Face: bit a + 8 b is set where a sample of the void lies in that block of the face; a and b count along the two
  /// other axes, the lower axis first, so that chunks which share a face agree. 0: the void does not touch the face.
  std::array<uint64_t, 6> faces{};
  /// Bit x + 8 y of word z is set where a sample of the void lies in that block of the chunk.
  std::array<uint64_t, kVoidBlocks> blocks{};

  friend bool operator==(const VoidComponent&, const VoidComponent&) = default;
};

/// None in solid rock. First those that touch a face, in the order of their first samples; then one more that stands
/// for all voids that touch none. Beyond 63 of the former the last stands for all further ones: that joins what is
/// apart, and never parts what is joined.
using VoidComponents = std::pmr::vector<VoidComponent>;

/// The voids of a chunk from the signs of its samples (ChunkSamples::signs). Pure.
VoidComponents voidComponents(std::span<const uint64_t> signs,
                              std::pmr::memory_resource* memory = std::pmr::get_default_resource());

/// The voids of a chunk whose samples have one sign.
VoidComponents voidOfUniform(bool solid, std::pmr::memory_resource* memory = std::pmr::get_default_resource());

/// Bit i is set where components[i] has a sample in the block that holds the cell (0..31 on each axis): the void that a
/// place in that cell lies in, and any other within four cells. 0: all around is solid.
uint64_t voidsAround(std::span<const VoidComponent> components, Int3 cell);

}  // namespace sgm

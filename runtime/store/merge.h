#pragma once
// Merges tiles that were baked independently into one world of a store.

#include <functional>

#include "store/bake.h"
#include "store/folder.h"
#include "store/world_file.h"

namespace sgm::store {

struct Merged {
  WorldSummary world;
  uint64_t new_bytes = 0;     ///< total size in bytes of the packs that were added to the store
  bool there_before = false;  ///< true if the store already had the world, so that nothing was merged
  /// messages about other worlds of the store that cannot be read, and so cannot share content with this world
  std::vector<std::string> warnings;
};

/// True if the store already contains exactly this world, and all packs have their expected sizes. Error:
/// invalid_argument if the store contains another region, or other levels, of the same world, which merging would
/// replace.
Result<bool> isBaked(const Folder& store, const Bakery& bakery);

/// Returns the text of the manifest, a file that is stored next to the index for human readers.
using Manifest = std::function<std::string(const WorldSummary& world)>;

/// Merges the baked tiles of a region into a world of the store. Content that occurs several times is stored once:
/// where another world of the store already has it, otherwise at its first occurrence in the order of tiles. Then
/// writes the manifest and the index, and removes the job's folder; the world exists once its index exists. A pack is
/// used only if all of its bytes match the hash in its name; tiles with damaged packs count as missing. The result is a
/// pure function of the tiles and the store. If the process is killed at any time, merging can be repeated. Errors:
/// those of StoreLock::take and isBaked; invalid_argument if tiles are missing (the message says how many); io. Throws
/// std::bad_alloc.
Result<Merged> merge(const Folder& store, const Bakery& bakery, const Manifest& manifest, const Progress& progress = {},
                     std::chrono::milliseconds patience = StoreLock::kPatience);

}  // namespace sgm::store

#pragma once
// Merges tiles that were baked independently into one world of a store.

#include <functional>

#include "store/bake.h"
#include "store/folder.h"
#include "store/world_file.h"

namespace sgm::store {

struct Merged {
  WorldSummary world;
  uint64_t new_bytes = 0;     ///< size of the packs that were added for the world
  bool there_before = false;  ///< true if the store had the world already, so that nothing was done
  /// other worlds of the store that cannot be read, with which no content can be shared
  std::vector<std::string> warnings;
};

/// True if the store already contains exactly this world, with all packs in their right sizes. Error: invalid_argument
/// if it contains another region, or other levels, of the same world, which merging would replace.
Result<bool> isBaked(const Folder& store, const Bakery& bakery);

/// Returns the content of the text file that is stored beside the index for human readers.
using Manifest = std::function<std::string(const WorldSummary& world)>;

/// Merges the tiles of a bakery into a world. Each content is stored once, however many tiles and worlds have it: at
/// its first place in the order of tiles, or where another world of the store has it. Then writes the manifest and the
/// index, whose existence makes the world exist, and removes the job's folder. A pack is used only if all of its bytes
/// match its name; tiles with other packs count as missing. The result is a pure function of the tiles and the store.
/// The process may be killed at any time, and merging repeated. Errors: busy and unsupported as StoreLock;
/// invalid_argument if tiles are missing (the message says how many), or as isBaked; io. Throws std::bad_alloc.
Result<Merged> merge(const Folder& store, const Bakery& bakery, const Manifest& manifest, const Progress& progress = {},
                     std::chrono::milliseconds patience = StoreLock::kPatience);

}  // namespace sgm::store

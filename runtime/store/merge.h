#pragma once
// Merges independently baked tiles into one world of a store.

#include <functional>

#include "store/bake.h"
#include "store/folder.h"
#include "store/world_file.h"

namespace sgm::store {

struct Merged {
  WorldSummary world;
  uint64_t new_bytes = 0;             ///< of packs added for it
  bool there_before = false;          ///< nothing had to be done
  std::vector<std::string> warnings;  ///< other worlds that cannot be read, so that nothing is shared with them
};

/// Whether the store already has exactly this world, complete as far as sizes tell. invalid_argument: it has another
/// region, or other levels, of the same world, which this would replace.
Result<bool> isBaked(const Folder& store, const Bakery& bakery);

/// Creates the text file for people that lies beside the index.
using Manifest = std::function<std::string(const WorldSummary& world)>;

/// Stores each content once, however many tiles and worlds have it: at its first place in the order of tiles, or where
/// another world of the store has it. Then writes the manifest and the index, which makes the world exist, and removes
/// the job's folder. Packs are trusted only after all their bytes were compared with their names; tiles with other
/// packs count as missing. Apart from that a pure function: the same tiles and the same store give the same bytes. May
/// be stopped at any time and repeated. busy, unsupported: as StoreLock. invalid_argument: tiles are missing (the
/// message says how many), or as isBaked. io. Throws std::bad_alloc.
Result<Merged> merge(const Folder& store, const Bakery& bakery, const Manifest& manifest, const Progress& progress = {},
                     std::chrono::milliseconds patience = StoreLock::kPatience);

}  // namespace sgm::store

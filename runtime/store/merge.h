#pragma once
// From tiles that were baked each by itself to one world of a store.

#include <functional>

#include "store/bake.h"
#include "store/folder.h"
#include "store/world_file.h"

namespace sgm::store {

struct Merged {
  WorldSummary world;
  uint64_t new_bytes = 0;             ///< of packs that have come with it
  bool there_before = false;          ///< nothing was to be done
  std::vector<std::string> warnings;  ///< other worlds that cannot be read, and so share nothing
};

/// Whether the store has just this already, whole as far as sizes tell. invalid_argument: it has another region, or
/// other levels, of the same world, which this would replace.
Result<bool> isBaked(const Folder& store, const Bakery& bakery);

/// The text that lies beside the index, for people.
using Manifest = std::function<std::string(const WorldSummary& world)>;

/// Gives the store each content once, whatever tiles and worlds have it: where it comes first in the order of tiles, or
/// where another world of the store has it. Then writes the manifest and the index, which is when the world is there,
/// and removes the job's folder. Packs are trusted only after all their bytes were compared with their names; tiles
/// with others count as missing. Pure but for that: the same tiles and the same store give the same bytes. May be
/// stopped at any time and begun again. busy, unsupported: as StoreLock. invalid_argument: tiles are missing, and how
/// many; as isBaked. io. Throws std::bad_alloc.
Result<Merged> merge(const Folder& store, const Bakery& bakery, const Manifest& manifest, const Progress& progress = {},
                     std::chrono::milliseconds patience = StoreLock::kPatience);

}  // namespace sgm::store

#pragma once
// From tiles that were baked each by itself to one world of a store.

#include "store/bake.h"
#include "store/folder.h"

namespace sgm::store {

struct Merged {
  uint64_t tiles = 0, chunks = 0;
  uint64_t contents = 0;    ///< that differ from each other, inlined ones too
  uint64_t packs = 0;       ///< files that the world needs
  uint64_t pack_bytes = 0;  ///< of those that have come with it
  uint64_t index_bytes = 0;
  uint64_t plain_bytes = 0;  ///< as if each part were stored by itself
  measure::SurfaceSums measured;
};

/// Gives the store each content once, whatever tiles and worlds have it: where it comes first in the order of tiles, or
/// where another world of the store has it. Then writes the index, which is when the world is there, and removes the
/// job's folder. Pure but for that: the same tiles and the same store give the same bytes. May be stopped at any time
/// and begun again.
/// busy: as StoreLock. invalid_argument: tiles are missing, and how many. bad_input: a tile or another world's index is
/// damaged. io. Throws std::bad_alloc.
Result<Merged> merge(const Folder& store, const Bakery& bakery, const Progress& progress = {});

}  // namespace sgm::store

#pragma once
// Checks a store's content, and removes files that no world needs.

#include <span>

#include "store/bake.h"
#include "store/folder.h"
#include "store/world_file.h"

namespace sgm::store {

/// The first few descriptions of problems, and their number.
struct Problems {
  static constexpr size_t kMostTold = 20;
  std::vector<std::string> told;
  uint64_t count = 0;
  void add(std::string problem) {
    if (++count <= kMostTold) told.push_back(std::move(problem));
  }
};

struct Verified {
  uint64_t tiles = 0, chunks = 0, contents = 0, packs = 0, bytes = 0;
  uint64_t borders = 0;  ///< between chunks and levels, with edges
  Problems problems;
};

/// Reads everything that a world needs. Checks that records and packs are whole; that each content exists, matches its
/// id and can be decoded; and that bodies and seams fit at every common border, so that all drawable frames are closed
/// (closure.h). Throws std::bad_alloc.
Verified verify(const Folder& store, const WorldFile& world, const Progress& progress = {});

struct Compared {
  uint64_t chunks = 0;
  Problems problems;
};

/// Makes this many chunks of the world anew and compares them. The seed selects them, preferring chunks with triangles;
/// fewer if few have any. Errors: those of meshing; bad_input (verify says more).
Result<Compared> compareWithBaking(const Bakery& bakery, const WorldFile& world, size_t chunks, uint64_t seed);

struct Cleaned {
  uint64_t packs = 0, bytes = 0;  ///< removed
  uint64_t unfinished = 0;        ///< bakes that are not merged; they stay
};

/// Removes packs that no world of the store needs, and the rest of merged bakes. busy, unsupported: as StoreLock.
/// Errors: of reading any index, before anything is removed; io.
Result<Cleaned> clean(const Folder& store, std::pmr::memory_resource* memory,
                      std::chrono::milliseconds patience = StoreLock::kPatience);

}  // namespace sgm::store

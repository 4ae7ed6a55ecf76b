#pragma once
// Checks the content of a store, and removes files that no world of the store needs.

#include <span>

#include "store/bake.h"
#include "store/folder.h"
#include "store/world_file.h"

namespace sgm::store {

/// The number of problems, and descriptions of the first few.
struct Problems {
  static constexpr size_t kMaxReported = 20;
  std::vector<std::string> told;
  uint64_t count = 0;
  void add(std::string problem) {
    if (++count <= kMaxReported) told.push_back(std::move(problem));
  }
};

struct Verified {
  uint64_t tiles = 0, chunks = 0, contents = 0, packs = 0, bytes = 0;
  uint64_t borders = 0;  ///< number of non-empty borders between chunks, or between levels, that were checked
  Problems problems;
};

/// Checks everything that a world needs, by reading it. Records and packs must be complete; the content of each chunk
/// part must exist, match its hash and be decodable; bodies and seams must fit at every common border, so that the
/// surface is closed whichever chunks are drawn together (closure.h). Throws std::bad_alloc.
Verified verify(const Folder& store, const WorldFile& world, const Progress& progress = {});

struct Compared {
  uint64_t chunks = 0;
  Problems problems;
};

/// Meshes `chunks` chunks of the world again, and compares them with the stored ones. The chunks are selected at random
/// by `seed`, preferably ones with triangles; if only few have triangles, fewer chunks are compared. Errors: those of
/// meshing; bad_input if the store is damaged (verify() reports details).
Result<Compared> compareWithBaking(const Bakery& bakery, const WorldFile& world, size_t chunks, uint64_t seed);

struct Cleaned {
  uint64_t packs = 0, bytes = 0;  ///< number and total size in bytes of the packs that were removed
  uint64_t unfinished = 0;        ///< number of baking jobs that are not merged yet; their files are kept
};

/// Removes the packs that no world of the store needs, and the remaining files of baking jobs that were merged. Errors:
/// those of StoreLock::take; errors of reading an index, before anything is removed; io.
Result<Cleaned> clean(const Folder& store, std::pmr::memory_resource* memory,
                      std::chrono::milliseconds patience = StoreLock::kPatience);

}  // namespace sgm::store

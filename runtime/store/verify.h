#pragma once
// Checks the content of a store, and removes files that no world needs.

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
  uint64_t borders = 0;  ///< number of borders with edges between chunks, or between levels, that were checked
  Problems problems;
};

/// Reads everything that a world needs, and checks it: records and packs are complete; each content exists, matches its
/// id and can be decoded; bodies and seams fit at every common border, so that all frames that can be drawn are closed
/// (closure.h). Throws std::bad_alloc.
Verified verify(const Folder& store, const WorldFile& world, const Progress& progress = {});

struct Compared {
  uint64_t chunks = 0;
  Problems problems;
};

/// Meshes `chunks` chunks of the world again and compares them with the stored ones. They are selected by `seed`,
/// preferring chunks with triangles; fewer are compared if few have triangles. Errors: those of meshing; bad_input
/// (verify reports details).
Result<Compared> compareWithBaking(const Bakery& bakery, const WorldFile& world, size_t chunks, uint64_t seed);

struct Cleaned {
  uint64_t packs = 0, bytes = 0;  ///< number and size of the removed packs
  uint64_t unfinished = 0;        ///< number of bakes that are not merged yet; they are not removed
};

/// Removes packs that no world of the store needs, and the rest of merged bakes. Errors: busy and unsupported as
/// StoreLock; errors of reading an index, before anything is removed; io.
Result<Cleaned> clean(const Folder& store, std::pmr::memory_resource* memory,
                      std::chrono::milliseconds patience = StoreLock::kPatience);

}  // namespace sgm::store

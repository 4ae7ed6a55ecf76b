#pragma once
// A world that is baked into a temporary folder.

#include "store/merge.h"
#include "store/plan.h"
#include "store/source.h"
#include "store/verify.h"
#include "stream/chunk_cache_support.h"

namespace sgm {

/// For the cave, 64 m at two levels: 8 x 8 x 8 chunks of 8 m, and 4 x 4 x 4 chunks of 16 m.
inline store::BakedRegion regionOf(const Excerpt& scene, int first_level, int last_level) {
  return {scene.box, first_level, last_level, scene.cell};
}

struct Baking {
  Machine machine;
  WorldField world;
  store::Folder folder;
  store::BakedRegion region;
  bool sharp = false;

  Baking(WorldFieldSettings settings, const store::BakedRegion& of, const fs::path& path)
      : world(std::move(settings), std::pmr::get_default_resource()), folder(path), region(of) {
    REQUIRE(folder.make());
  }
  store::Bakery bakery() const {
    Result<store::Bakery> own = store::bakeryOf(world, *machine.backend, *machine.jobs, region, sharp, folder,
                                                std::pmr::get_default_resource());
    REQUIRE(own);
    REQUIRE(store::makeFolder(own->folder));
    return *own;
  }
  void bakeAll() const {
    const store::Bakery own = bakery();
    for (const store::TileKey& tile : store::tilesOf(region)) {
      const auto record = store::bakeTile(own, tile);
      INFO((record ? "" : record.error().message));
      REQUIRE(record);
    }
  }
  Result<store::Merged> tryToMerge(const Progress& progress = {}) const {
    const auto manifest = [](const store::WorldSummary& baked) { return std::to_string(baked.chunks) + " chunks\n"; };
    return store::merge(folder, bakery(), manifest, progress);
  }
  store::Merged merge() const {
    Result<store::Merged> merged = tryToMerge();
    INFO((merged ? "" : merged.error().message));
    REQUIRE(merged);
    return *merged;
  }
  fs::path index() const { return folder.world(bakery().key); }
  store::WorldFile file() const {
    Result<store::WorldFile> file = store::WorldFile::open(index());
    INFO((file ? "" : file.error().message));
    REQUIRE(file);
    return std::move(*file);
  }
};

struct Told {
  std::vector<std::string> messages;
  std::mutex mutex;
  store::Log log() {
    return [this](const std::string& message) {
      const std::lock_guard lock(mutex);
      messages.push_back(message);
    };
  }
};

inline std::shared_ptr<BakedParts> sourceAt(const std::string& place, store::Log log = {}) {
  auto source = store::openStores(std::array{place}, std::move(log), std::pmr::get_default_resource());
  INFO((source ? "" : source.error().message));
  REQUIRE(source);
  return *source;
}

/// Names and contents of all files in a folder.
inline std::vector<std::pair<std::string, Bytes>> contentsOf(const CacheFolder& folder) {
  std::vector<std::pair<std::string, Bytes>> all;
  for (const fs::path& file : folder.files())
    all.emplace_back(fs::relative(file, folder.path).string(), readFile(file));
  return all;
}

}  // namespace sgm

// Tests that stores which version 0.2 has baked still serve their worlds.

#include "store_support.h"
#include "world/version_0_2.h"

using namespace sgm;

static_assert(kMeshingVersion == 10,
              "no world is found in stores of version 0.2 any more: remove this file and data/version_0_2/store");

namespace {

struct FormerStore {
  CacheFolder folder;
  store::Folder store{folder.path};

  FormerStore() { fs::copy(formerFile("store"), folder.path, fs::copy_options::recursive); }
  store::BakedRegion region() const {
    const Result<store::ContentId> key =
        store::worldKey(store, WorldField(formerWorld(), std::pmr::get_default_resource()), false);
    REQUIRE(key);
    const Result<store::WorldFile> file = store::WorldFile::open(store.world(*key));
    REQUIRE(file);
    return file->index.region;
  }
};

/// Meshes all chunks of the store's region with parts from the store, and compares them with derived chunks.
void compare(const WorldFieldSettings& settings, const store::BakedRegion& region, BakedParts& source) {
  const Machine machine;
  const WorldField world(settings, std::pmr::get_default_resource());
  ChunkMesher stored = machine.mesher(world, nullptr);
  stored.baked = &source;
  for (const store::TileKey& tile : store::tilesOf(region)) {
    for (const size_t number : store::chunksIn(region, tile)) {
      ChunkRequest request;
      request.key = store::chunkOf(tile, number);
      request.seams = store::seamsOf(request.key);
      request.anchors = request.signs = tile.level == 0;
      CHECK(same(meshed(machine.mesher(world, nullptr), request), meshed(stored, request)));
    }
  }
}

}  // namespace

TEST_CASE("a world streams from a store that version 0.2 has baked", "[store]") {
  const FormerStore former;
  Told told;
  const auto source = sourceAt(former.folder.path.string(), told.log());
  compare(formerWorld(), former.region(), *source);
  CHECK(source->stats().hits > 2);
  CHECK(source->stats().misses == 0);
  CHECK(told.messages.empty());
  // With another grammar, the store belongs to another world, so nothing may be read from it.
  const uint64_t hits = source->stats().hits;
  compare(formerWorld("box(3m"), former.region(), *source);
  CHECK(source->stats().hits == hits);
  REQUIRE(told.messages.size() == 1);
  CHECK(told.messages[0].find("has no data of this world") != std::string::npos);
}

TEST_CASE("a world that version 0.2 has baked is known to be baked, and can be verified", "[store]") {
  const FormerStore former;
  const auto before = contentsOf(former.folder);
  const Baking baking(formerWorld(), former.region(), former.folder.path);
  CHECK(store::nameOf(baking.bakery().key) == "eceda7d6af0e922ca9d3554020d20b9f");
  const Result<bool> is_baked = store::isBaked(baking.folder, baking.bakery());
  REQUIRE(is_baked);
  CHECK(*is_baked);
  CHECK(store::verify(baking.folder, baking.file()).problems.count == 0);
  const auto compared = store::compareWithBaking(baking.bakery(), baking.file(), 4, 1);
  REQUIRE(compared);
  CHECK(compared->chunks > 0);
  CHECK(compared->problems.count == 0);
  CHECK(baking.merge().there_before);
  fs::remove_all(former.folder.path / "baking");
  CHECK(contentsOf(former.folder) == before);
}

TEST_CASE("of two stores each is asked by the key that it has", "[store]") {
  const FormerStore former;
  const CacheFolder folder;
  const Baking baking(formerWorld(), former.region(), folder.path);
  baking.bakeAll();
  baking.merge();
  CHECK(store::nameOf(baking.bakery().key) != "eceda7d6af0e922ca9d3554020d20b9f");
  const auto packs = [](const CacheFolder& of) {
    std::vector<std::pair<std::string, Bytes>> found;
    for (const auto& file : contentsOf(of))
      if (file.first.starts_with("packs")) found.push_back(file);
    return found;
  };
  CHECK(packs(folder) == packs(former.folder));
  for (const fs::path& without : {former.folder.path, folder.path}) {
    CAPTURE(without);
    fs::rename(without / "packs", without / "away");
    const auto source = store::openStores(std::array{former.folder.path.string(), folder.path.string()}, {},
                                          std::pmr::get_default_resource());
    REQUIRE(source);
    compare(formerWorld(), baking.region, **source);
    CHECK((*source)->stats().hits > 2);
    CHECK((*source)->stats().misses == 0);
    fs::rename(without / "away", without / "packs");
  }
}

// A store is the same however it was made, and has each content once.

#include "store_support.h"

using namespace sgm;

TEST_CASE("a store's bytes do not depend on who baked what, in which order, or how often", "[store]") {
  const auto seed = GENERATE(take(1, random(0, 1 << 30)));
  CAPTURE(seed);
  std::mt19937 random(static_cast<uint32_t>(seed));
  const Excerpt& scene = scenes()[0];
  const store::BakedRegion region = regionOf(scene, 0, 2);
  const CacheFolder one, many;
  {
    const Baking alone(scene.settings(), region, one.path);
    alone.bakeAll();
    const store::Merged merged = alone.merge();
    CHECK(merged.measured.sound());
    CHECK(merged.measured.triangles > 10000);
    CHECK(merged.pack_bytes + merged.index_bytes < 12 * merged.measured.triangles);
  }
  const std::vector<store::TileKey> tiles = store::tilesOf(region);
  const size_t shards = 2 + random() % 4;
  std::vector<size_t> order;
  for (size_t shard = 0; shard < shards; ++shard) order.push_back(shard);
  std::shuffle(order.begin(), order.end(), random);
  for (const size_t shard : order) {
    // Each worker knows nothing but what stands in the folder.
    const Baking worker(scene.settings(), region, many.path);
    const store::Bakery bakery = worker.bakery();
    const auto costs = store::planOf(bakery, tiles);
    REQUIRE(costs);
    const auto [first, last] = store::tilesOfShard(*costs, shard, shards);
    for (size_t i = first; i < last; ++i) {
      CHECK(!store::madeBefore(bakery, tiles[i]));
      REQUIRE(store::bakeTile(bakery, tiles[i]));
      CHECK(store::madeBefore(bakery, tiles[i]));
    }
  }
  const Baking last(scene.settings(), region, many.path);
  const store::Bakery bakery = last.bakery();
  // A worker that was killed has left a tile without its record, one that is cut off, and a pack that is.
  const fs::path lost = store::tileFile(bakery.folder, tiles[0]), torn = store::tileFile(bakery.folder, tiles[1]);
  fs::remove(lost);
  const auto refused = store::merge(last.folder, bakery);
  CHECK(refused.error().code == Code::invalid_argument);
  CHECK(refused.error().message.find("1 of ") == 0);
  fs::resize_file(torn, fs::file_size(torn) / 2);
  CHECK(!store::merge(last.folder, bakery));
  for (const store::TileKey& tile : tiles) {
    const fs::path pack = store::packFile(bakery.folder, tile);
    if (!fs::exists(pack)) continue;
    fs::resize_file(pack, fs::file_size(pack) - 1);
    CHECK(!store::madeBefore(bakery, tile));
    break;
  }
  size_t again = 0;
  for (const store::TileKey& tile : tiles) {
    if (store::madeBefore(bakery, tile)) continue;
    REQUIRE(store::bakeTile(bakery, tile));
    ++again;
  }
  CHECK(again <= 3);
  last.merge();
  CHECK(contentsOf(one) == contentsOf(many));
}

TEST_CASE("a merge that was stopped is done by the next one", "[store]") {
  const Excerpt& scene = scenes()[2];
  const store::BakedRegion region = regionOf(scene, 0, 3);
  const CacheFolder straight, stopped;
  const Baking plain(scene.settings(), region, straight.path), hindered(scene.settings(), region, stopped.path);
  plain.bakeAll();
  plain.merge();
  hindered.bakeAll();
  const size_t tiles = store::tilesOf(region).size();
  for (uint64_t after = 1; after < tiles; ++after) {
    const auto cancelled =
        store::merge(hindered.folder, hindered.bakery(), [&](uint64_t done, uint64_t) { return done < after; });
    CHECK(cancelled.error().code == Code::cancelled);
  }
  hindered.merge();
  CHECK(contentsOf(straight) == contentsOf(stopped));
}

TEST_CASE("contents that worlds and levels share are stored once, and go when nobody needs them", "[store]") {
  const CacheFolder folder;
  const Excerpt& scene = scenes()[2];
  const store::BakedRegion region = regionOf(scene, 0, 1);
  const std::string text = sample(scene.grammar);
  const Baking first(settingsOf(text, scene.cell, 3), region, folder.path);
  first.bakeAll();
  const store::Merged alone = first.merge();
  CHECK(alone.pack_bytes > 0);
  // A parameter that nothing reads makes another world of the same chunks.
  const Baking second(settingsOf(text + "\nparam unread = 1;\n", scene.cell, 3), region, folder.path);
  REQUIRE(store::worldKey(first.world, false)->low != store::worldKey(second.world, false)->low);
  second.bakeAll();
  const store::Merged shared = second.merge();
  CHECK(shared.pack_bytes == 0);
  CHECK(shared.contents == alone.contents);
  CHECK(store::verify(second.folder, second.file()).problems.count == 0);

  const auto kept = store::clean(first.folder, std::pmr::get_default_resource());
  REQUIRE(kept);
  CHECK(kept->packs == 0);
  fs::remove(first.folder.world(*store::worldKey(first.world, false)));
  REQUIRE(store::clean(first.folder, std::pmr::get_default_resource()));
  CHECK(store::verify(second.folder, second.file()).problems.count == 0);
  fs::remove(second.folder.world(*store::worldKey(second.world, false)));
  const auto gone = store::clean(first.folder, std::pmr::get_default_resource());
  REQUIRE(gone);
  CHECK(gone->packs == alone.packs);
  CHECK(gone->bytes == alone.pack_bytes);
}

TEST_CASE("who changes a store is alone", "[store]") {
  const CacheFolder folder;
  const store::Folder store(folder.path);
  REQUIRE(store.make());
  const auto lock = store::StoreLock::take(store);
  REQUIRE(lock);
  CHECK(store::StoreLock::take(store).error().code == Code::busy);
  CHECK(store::clean(store, std::pmr::get_default_resource()).error().code == Code::busy);
}

TEST_CASE("verification finds what is wrong, and baking again tells other worlds", "[store]") {
  const auto seed = GENERATE(take(1, random(0, 1 << 30)));
  CAPTURE(seed);
  std::mt19937 random(static_cast<uint32_t>(seed));
  const CacheFolder folder;
  const Excerpt& scene = scenes()[0];
  const Baking baking(scene.settings(), regionOf(scene, 0, 1), folder.path);
  baking.bakeAll();
  baking.merge();
  const store::Verified whole = store::verify(baking.folder, baking.file());
  CAPTURE(whole.problems.told);
  CHECK(whole.problems.count == 0);
  CHECK(whole.faces > 20);
  const auto equal = store::compareWithBaking(baking.bakery(), baking.file(), 12, random());
  REQUIRE(equal);
  CHECK(equal->count == 0);
  // The same index, taken for that of another seed's world.
  WorldFieldSettings other = scene.settings();
  other.seed += 1;
  const Baking stranger(other, regionOf(scene, 0, 1), folder.path);
  const auto differ = store::compareWithBaking(stranger.bakery(), baking.file(), 12, random());
  REQUIRE(differ);
  CHECK(differ->count > 0);

  for (const fs::path& file : folder.files()) {
    if (file.extension() != ".sgmp") continue;
    const Bytes was = readFile(file);
    Bytes bytes = was;
    bytes[random() % bytes.size()] ^= std::byte{4};
    writeFile(file, bytes);
    CHECK(store::verify(baking.folder, baking.file()).problems.count > 0);
    fs::remove(file);
    CHECK(store::verify(baking.folder, baking.file()).problems.count > 0);
    writeFile(file, was);
  }
  CHECK(store::verify(baking.folder, baking.file()).problems.count == 0);
}

// Tests that the bytes of a store do not depend on how it was made, and that it contains each content once.

#include <atomic>
#include <thread>

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
    CHECK(merged.world.measured.sound());
    CHECK(merged.world.measured.triangles > 10000);
    CHECK(one.bytes() < 12 * merged.world.measured.triangles);
    CHECK(merged.new_bytes == merged.world.pack_bytes);
    // A second merge finds that the first one has done the work.
    CHECK(alone.merge().there_before);
  }
  const std::vector<store::TileKey> tiles = store::tilesOf(region);
  const size_t shards = 2 + random() % 4;
  std::vector<size_t> order;
  for (size_t shard = 0; shard < shards; ++shard) order.push_back(shard);
  std::shuffle(order.begin(), order.end(), random);
  for (const size_t shard : order) {
    // The workers share nothing but the contents of the folder.
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
  // Simulates a worker that was killed: it has left one tile without a record, one truncated record, and one truncated
  // pack.
  const fs::path lost = store::tileFile(bakery.folder, tiles[0]), torn = store::tileFile(bakery.folder, tiles[1]);
  fs::remove(lost);
  const auto refused = last.tryToMerge();
  CHECK(refused.error().code == Code::invalid_argument);
  CHECK(refused.error().message.find("1 of ") == 0);
  fs::resize_file(torn, fs::file_size(torn) / 2);
  CHECK(last.tryToMerge().error().message.find("2 of ") == 0);
  size_t damaged = 2;
  for (const store::TileKey& tile : tiles) {
    const fs::path pack = store::packFile(bakery.folder, tile);
    if (damaged == 4 || !fs::exists(pack) || !store::madeBefore(bakery, tile)) continue;
    if (damaged++ == 2) {
      fs::resize_file(pack, fs::file_size(pack) - 1);
      CHECK(!store::madeBefore(bakery, tile));
    } else {
      Bytes bytes = readFile(pack);
      bytes[bytes.size() / 2] ^= std::byte{1};
      writeFile(pack, bytes);
    }
  }
  REQUIRE(damaged == 4);
  CHECK(last.tryToMerge().error().message.find("4 of ") == 0);
  size_t again = 0;
  for (const store::TileKey& tile : tiles) {
    if (store::madeBefore(bakery, tile)) continue;
    REQUIRE(store::bakeTile(bakery, tile));
    ++again;
  }
  CHECK(again == 4);
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
    const auto cancelled = hindered.tryToMerge([&](uint64_t done, uint64_t) { return done < after; });
    CHECK(cancelled.error().code == Code::cancelled);
  }
  hindered.merge();
  CHECK(contentsOf(straight) == contentsOf(stopped));
}

TEST_CASE("contents that worlds and levels share are stored once, and go when nobody needs them", "[store]") {
  const CacheFolder folder;
  const Excerpt& scene = scenes()[2];
  const store::BakedRegion region = regionOf(scene, 0, 1);
  const std::string text = yardstick(scene.grammar);
  const Baking first(settingsOf(text, scene.cell, 3), region, folder.path);
  first.bakeAll();
  const store::Merged alone = first.merge();
  CHECK(alone.new_bytes > 0);
  // A parameter that no rule uses makes another world with the same chunks.
  const Baking second(settingsOf(text + "\nparam unread = 1;\n", scene.cell, 3), region, folder.path);
  REQUIRE(first.index() != second.index());
  second.bakeAll();
  const store::Merged shared = second.merge();
  CHECK(shared.new_bytes == 0);
  CHECK(shared.world.contents == alone.world.contents);
  CHECK(shared.world.pack_bytes == alone.world.pack_bytes);
  CHECK(store::verify(second.folder, second.file()).problems.count == 0);
  // A third world shares few chunks with the first; the reported sizes must be only its own.
  const CacheFolder apart;
  const Baking third(scenes()[0].settings(), regionOf(scenes()[0], 1, 1), folder.path),
      lonely(scenes()[0].settings(), regionOf(scenes()[0], 1, 1), apart.path);
  third.bakeAll();
  lonely.bakeAll();
  CHECK(third.merge().world.contents == lonely.merge().world.contents);
  fs::remove(third.index());
  REQUIRE(store::clean(first.folder, std::pmr::get_default_resource()));

  const auto kept = store::clean(first.folder, std::pmr::get_default_resource());
  REQUIRE(kept);
  CHECK(kept->packs == 0);
  fs::remove(first.index());
  REQUIRE(store::clean(first.folder, std::pmr::get_default_resource()));
  CHECK(store::verify(second.folder, second.file()).problems.count == 0);
  fs::remove(second.index());
  const auto gone = store::clean(first.folder, std::pmr::get_default_resource());
  REQUIRE(gone);
  CHECK(gone->packs == alone.world.packs);
  CHECK(gone->bytes == alone.world.pack_bytes);
}

TEST_CASE("a pack that two worlds share comes back when one of them is baked again", "[store]") {
  const Excerpt& scene = scenes()[2];
  const store::BakedRegion region = regionOf(scene, 0, 1);
  const std::string text = yardstick(scene.grammar);
  for (const bool removed : {true, false}) {
    CAPTURE(removed);
    const CacheFolder folder;
    const Baking first(settingsOf(text, scene.cell, 3), region, folder.path),
        second(settingsOf(text + "\nparam unread = 1;\n", scene.cell, 3), region, folder.path);
    for (const Baking* baking : {&first, &second}) {
      baking->bakeAll();
      baking->merge();
    }
    const auto whole = contentsOf(folder);
    for (const fs::path& file : folder.files()) {
      if (file.extension() != ".sgmp") continue;
      if (removed) {
        fs::remove(file);
      } else {
        // Copies of a pack may be hard links to one file, so the test replaces the file by a truncated one instead of
        // shortening it in place.
        Bytes bytes = readFile(file);
        bytes.resize(bytes.size() - 3);
        fs::remove(file);
        writeFile(file, bytes);
      }
    }
    CHECK(store::verify(second.folder, second.file()).problems.count > 0);
    const auto baked = store::isBaked(first.folder, first.bakery());
    REQUIRE(baked);
    CHECK(!*baked);
    first.bakeAll();
    CHECK(first.merge().new_bytes > 0);
    CHECK(store::verify(first.folder, first.file()).problems.count == 0);
    CHECK(store::verify(second.folder, second.file()).problems.count == 0);
    fs::remove_all(folder.path / "baking");
    CHECK(contentsOf(folder) == whole);
  }
}

TEST_CASE("another region of a world does not take the place of the one that is there", "[store]") {
  const Excerpt& scene = scenes()[2];
  const CacheFolder folder;
  const Baking one(scene.settings(), regionOf(scene, 0, 1), folder.path),
      other(scene.settings(), regionOf(scene, 0, 2), folder.path);
  one.bakeAll();
  one.merge();
  const auto before = contentsOf(folder);
  CHECK(store::isBaked(other.folder, other.bakery()).error().code == Code::invalid_argument);
  other.bakeAll();
  CHECK(other.tryToMerge().error().message.find("another region of this world") != std::string::npos);
  const auto cleaned = store::clean(one.folder, std::pmr::get_default_resource());
  REQUIRE(cleaned);
  CHECK(cleaned->unfinished == 1);
  fs::remove_all(folder.path / "baking" / store::nameOf(other.bakery().job));
  // Removes the files of a job whose merge was killed.
  one.bakeAll();
  fs::rename(one.bakery().folder, one.bakery().folder.string() + store::kMergedEnding);
  one.bakeAll();
  REQUIRE(store::clean(one.folder, std::pmr::get_default_resource()));
  CHECK(contentsOf(folder) == before);
}

TEST_CASE("a damaged index is told, and stands in nobody's way but its own", "[store]") {
  const Excerpt& scene = scenes()[2];
  const CacheFolder folder;
  const std::string text = yardstick(scene.grammar);
  const store::BakedRegion region = regionOf(scene, 1, 1);
  const Baking good(settingsOf(text, scene.cell, 3), region, folder.path),
      bad(settingsOf(text + "\nparam unread = 1;\n", scene.cell, 3), region, folder.path);
  bad.bakeAll();
  bad.merge();
  fs::resize_file(bad.index(), fs::file_size(bad.index()) - 5);
  const auto opened = store::WorldFile::open(bad.index());
  CHECK(opened.error().code == Code::bad_input);
  CHECK(opened.error().message.find("remove it, and bake its world again") != std::string::npos);
  good.bakeAll();
  CHECK(good.merge().warnings.size() == 1);
  CHECK(store::verify(good.folder, good.file()).problems.count == 0);
  CHECK(store::clean(good.folder, std::pmr::get_default_resource()).error().code == Code::bad_input);
  bad.bakeAll();
  bad.merge();
  CHECK(store::verify(bad.folder, bad.file()).problems.count == 0);
}

TEST_CASE("who changes a store is alone", "[store]") {
  const CacheFolder folder;
  const store::Folder store(folder.path);
  REQUIRE(store.make());
  auto lock = store::StoreLock::take(store);
  REQUIRE(lock);
  CHECK(store::StoreLock::take(store, std::chrono::milliseconds(10)).error().code == Code::busy);
  // A second user of the lock waits until the lock is released.
  std::optional<store::StoreLock> had(std::move(*lock));
  std::atomic<bool> has_gone = false;
  std::thread other([&] {
    const auto cleaned = store::clean(store, std::pmr::get_default_resource());
    if (!cleaned || !has_gone) std::abort();
  });
  std::this_thread::sleep_for(std::chrono::milliseconds(150));
  has_gone = true;
  had.reset();
  other.join();
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
  CHECK(whole.borders > 20);
  const auto equal = store::compareWithBaking(baking.bakery(), baking.file(), 12, random());
  REQUIRE(equal);
  CHECK(equal->chunks == 12);
  CHECK(equal->problems.count == 0);
  // Reads the same index as if it belonged to a world with another seed.
  WorldFieldSettings other = scene.settings();
  other.seed += 1;
  const Baking stranger(other, regionOf(scene, 0, 1), folder.path);
  const auto differ = store::compareWithBaking(stranger.bakery(), baking.file(), 12, random());
  REQUIRE(differ);
  CHECK(differ->problems.count > 0);

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

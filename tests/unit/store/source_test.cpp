// Tests that parts from a store equal derived ones, byte by byte.

#include <atomic>
#include <thread>

#include "failing_memory.h"
#include "store_support.h"

using namespace sgm;

namespace {

std::shared_ptr<BakedParts> sourceOf(const fs::path& folder, store::Log log = {}) {
  return sourceAt(folder.string(), std::move(log));
}

}  // namespace

TEST_CASE("a chunk from a store is what it would have been derived to, with edits on top", "[store]") {
  const auto seed = GENERATE(take(1, random(0, 1 << 30)));
  CAPTURE(seed);
  std::mt19937 random(static_cast<uint32_t>(seed));
  for (const bool sharp : {false, true}) {
    const Excerpt& scene = scenes()[sharp ? 2 : 0];
    const CacheFolder folder;
    Baking baking(scene.settings(), regionOf(scene, 0, 2), folder.path);
    baking.sharp = sharp;
    baking.bakeAll();
    baking.merge();
    const std::shared_ptr<BakedParts> source = sourceOf(folder.path);
    const CacheFolder cache_folder;
    const auto cache = openCache(cache_folder, kAmple);
    size_t triangles = 0, edited = 0, found = 0;
    for (unsigned i = 0; i < rounds(30); ++i) {
      CAPTURE(sharp, i);
      const auto edits = i % 3 == 2 ? randomEdits(random, scene, 10) : nullptr;
      ChunkRequest request = randomRequest(random, scene);
      // Requests of coarse levels mostly omit anchors and signs, as those of a streamed world do.
      if (request.key.level != 0 && i % 4 != 0) request.anchors = request.signs = false;
      const bool as_baked =
          !edits && !request.outermost && (request.key.level == 0 || (!request.anchors && !request.signs));
      // A world that has derived nothing yet.
      const WorldField fresh(scene.settings(), std::pmr::get_default_resource());
      ChunkMesher derived = baking.machine.mesher(baking.world, nullptr),
                  stored = baking.machine.mesher(fresh, nullptr);
      derived.sharp = stored.sharp = sharp;
      stored.baked = source.get();
      if (i % 2) stored.cache = cache.get();
      const uint64_t hits = source->stats().hits;
      const MeshedChunk plain = meshed(derived, request, nullptr, edits.get());
      const MeshedChunk from_store = meshed(stored, request, nullptr, edits.get());
      CHECK(same(plain, from_store));
      if (as_baked) {
        uint64_t baked = 0;
        for (int part = 0; part < kChunkParts; ++part)
          baked += asksFor(request, part) && store::isBakedPart(request.key, part);
        CHECK(source->stats().hits - hits == baked);
        const bool all = baked == partCount(request);
        if (all) CHECK(from_store.from_disk);
        if (all) CHECK(fresh.cacheStats().misses == 0);
      }
      triangles += plain.surface.mesh.indices.size() / 3;
      edited += edits != nullptr;
      found += as_baked;
    }
    CHECK(triangles > 3 * rounds(30));
    CHECK(edited > 0);
    CHECK(found >= std::max(rounds(30) / 6, 1u));
    CHECK(source->stats().damaged + source->stats().errors == 0);
  }
}

TEST_CASE("what a store does not have is derived, and what is damaged there, which is told once", "[store]") {
  const auto seed = GENERATE(take(1, random(0, 1 << 30)));
  CAPTURE(seed);
  std::mt19937 random(static_cast<uint32_t>(seed));
  const Excerpt& scene = scenes()[0];
  const CacheFolder folder;
  const Baking baking(scene.settings(), regionOf(scene, 0, 1), folder.path);
  baking.bakeAll();
  baking.merge();
  const auto compare = [&](BakedParts* source, const WorldField& world) {
    for (unsigned i = 0; i < 12; ++i) {
      const ChunkRequest request = randomRequest(random, scene);
      ChunkMesher stored = baking.machine.mesher(world, nullptr);
      stored.baked = source;
      CHECK(same(meshed(baking.machine.mesher(world, nullptr), request), meshed(stored, request)));
    }
  };
  {
    INFO("another seed");
    WorldFieldSettings other = scene.settings();
    other.seed += 1;
    Told told;
    const auto source = sourceOf(folder.path, told.log());
    compare(source.get(), WorldField(other, std::pmr::get_default_resource()));
    CHECK(source->stats().hits == 0);
    REQUIRE(told.messages.size() == 1);
    CHECK(told.messages[0].find("has no data of this world") != std::string::npos);
  }
  const std::vector<fs::path> files = folder.files();
  for (const std::string extension : {".sgmp", ".sgmi"}) {
    for (const bool cut : {false, true}) {
      CAPTURE(extension, cut);
      std::vector<std::pair<fs::path, Bytes>> kept;
      for (const fs::path& file : files) {
        if (file.extension() != extension) continue;
        const Bytes bytes = readFile(file);
        kept.emplace_back(file, bytes);
        Bytes damaged = bytes;
        if (cut) {
          damaged.resize(damaged.size() / 3);
        } else {
          for (size_t i = 8; i < damaged.size(); i += 64) damaged[i] ^= std::byte{16};
        }
        writeFile(file, damaged);
      }
      REQUIRE(!kept.empty());
      Told told;
      const auto source = sourceOf(folder.path, told.log());
      ChunkRequest request = caveRequest();
      for (int again = 0; again < 3; ++again) {
        ChunkMesher stored = baking.machine.mesher(baking.world, nullptr);
        stored.baked = source.get();
        CHECK(same(meshed(baking.machine.mesher(baking.world, nullptr), request), meshed(stored, request)));
      }
      compare(source.get(), baking.world);
      CHECK(!told.messages.empty());
      CHECK(told.messages.size() <= kept.size());
      for (const std::string& message : told.messages) CHECK(message.find("derived instead") != std::string::npos);
      for (const auto& [file, bytes] : kept) writeFile(file, bytes);
    }
  }
  const auto mended = sourceOf(folder.path);
  compare(mended.get(), baking.world);
  CHECK(mended->stats().damaged == 0);
}

TEST_CASE("threads that stream from one store get what one gets", "[store][threads]") {
  const Excerpt& scene = scenes()[0];
  const CacheFolder folder;
  const Baking baking(scene.settings(), regionOf(scene, 0, 1), folder.path);
  baking.bakeAll();
  baking.merge();
  const auto source = sourceOf(folder.path);
  std::vector<ChunkRequest> requests;
  std::mt19937 random(7);
  while (requests.size() < 24) {
    const ChunkRequest request = randomRequest(random, scene);
    if (request.key.level > 1) continue;
    requests.push_back(request);
    requests.back().seams &= store::seamsOf(request.key);
    requests.back().outermost = requests.back().anchors = requests.back().signs = false;
  }
  std::vector<MeshedChunk> expected;
  for (const ChunkRequest& request : requests)
    expected.push_back(meshed(baking.machine.mesher(baking.world, nullptr), request));
  std::vector<std::thread> threads;
  std::atomic<int> unlike = 0;
  for (size_t t = 0; t < 4; ++t) {
    threads.emplace_back([&, t] {
      ChunkMesher stored = baking.machine.mesher(baking.world, nullptr);
      stored.baked = source.get();
      for (size_t i = 0; i < 2 * requests.size(); ++i) {
        const size_t number = (i * (2 * t + 1)) % requests.size();
        const Result<MeshedChunk> chunk = stored.mesh(requests[number], nullptr);
        unlike += !chunk || !same(*chunk, expected[number]);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  CHECK(unlike == 0);
  CHECK(source->stats().hits > 0);
  CHECK(source->stats().misses == 0);
}

TEST_CASE("a store whose memory gives out, anywhere, gives what it should once there is memory", "[store]") {
  const auto seed = GENERATE(take(1, random(0, 1 << 30)));
  CAPTURE(seed);
  std::mt19937 random(static_cast<uint32_t>(seed));
  const Excerpt& scene = scenes()[0];
  const CacheFolder folder;
  const Baking baking(scene.settings(), regionOf(scene, 0, 1), folder.path);
  baking.bakeAll();
  baking.merge();
  std::vector<ChunkRequest> requests{caveRequest()};
  requests[0].seams &= store::seamsOf(requests[0].key);
  std::vector<MeshedChunk> expected;
  while (requests.size() < 4) {
    const ChunkRequest request = randomRequest(random, scene);
    if (request.key.level == 0) requests.push_back(request);
  }
  for (const ChunkRequest& request : requests)
    expected.push_back(meshed(baking.machine.mesher(baking.world, nullptr), request));
  bool troubled = true;
  int64_t n = 0;
  for (; troubled; n += 1 + static_cast<int64_t>(random() % static_cast<uint64_t>(1 + n / 4))) {
    CAPTURE(n);
    Failing memory;
    Told told;
    {
      memory.until = n;
      memory.failures = random() % 2 == 0 ? 1 : 1 + static_cast<int64_t>(random() % 60);
      std::shared_ptr<BakedParts> source;
      while (source == nullptr) {
        try {
          auto opened = store::openStores(std::array{folder.path.string()}, told.log(), &memory);
          REQUIRE(opened);
          source = *opened;
        } catch (const std::bad_alloc&) {
          // Tries again, as a caller of a function that throws std::bad_alloc may do.
        }
      }
      ChunkMesher mesher = baking.machine.mesher(baking.world, nullptr);
      mesher.baked = source.get();
      mesher.memory = &memory;
      for (size_t i = 0; i < requests.size(); ++i) {
        std::optional<Result<MeshedChunk>> chunk;
        while (!chunk || !*chunk) {
          try {
            chunk.emplace(mesher.mesh(requests[i], nullptr));
          } catch (const std::bad_alloc&) {
            continue;
          }
          if (!*chunk) REQUIRE(chunk->error().code == Code::out_of_memory);
        }
        CHECK(same(**chunk, expected[i]));
      }
      CHECK(source->stats().hits > 0);
      CHECK(source->stats().damaged == 0);
      CHECK(told.messages.empty());
      troubled = memory.failed > 0;
    }
    CHECK(memory.live == 0);
  }
  CHECK(n > 50);
}

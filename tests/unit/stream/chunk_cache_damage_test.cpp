// Tests that cached parts which are damaged or wrong count as missing, and are meshed again.

#include "chunk/chunk_codec.h"
#include "chunk_cache_support.h"

using namespace sgm;

TEST_CASE("damaged files are missed, and made again", "[stream][disk]") {
  const auto seed = GENERATE(take(2, random(0, 1 << 30)));
  CAPTURE(seed);
  std::mt19937 random(static_cast<uint32_t>(seed));
  const Machine machine;
  const CacheFolder folder;
  const auto cache = openCache(folder, kAmple);
  const WorldField world(scenes()[0].settings(), std::pmr::get_default_resource());
  for (unsigned i = 0; i < rounds(12); ++i) {
    ChunkRequest request = randomRequest(random, scenes()[0]);
    const MeshedChunk plain = meshed(machine.mesher(world, nullptr), request);
    const auto look = [&] { REQUIRE(same(plain, meshed(machine.mesher(world, cache.get()), request))); };
    look();
    const std::vector<fs::path> files = folder.files();
    std::vector<Bytes> whole;
    for (const fs::path& file : files) {
      Bytes bytes = readFile(file);
      whole.push_back(bytes);
      if (random() % 3 == 0) {
        bytes.resize(random() % bytes.size());
      } else {
        bytes[random() % bytes.size()] ^= static_cast<std::byte>(1 << random() % 8);
      }
      writeFile(file, bytes);
    }
    const uint64_t damaged = cache->stats().damaged;
    look();
    CHECK(cache->stats().damaged - damaged == files.size());
    // The damaged files were replaced by files with the original contents.
    for (size_t f = 0; f < files.size(); ++f) CHECK((readFile(files[f]) == whole[f]));
    look();
    for (const fs::path& file : folder.files()) fs::remove(file);
  }
  CHECK(cache->stats().errors == 0);
}

TEST_CASE("an entry that is whole but says what meshing did not is missed, and made again", "[stream][disk]") {
  const auto seed = GENERATE(take(2, random(0, 1 << 30)));
  CAPTURE(seed);
  std::mt19937 random(static_cast<uint32_t>(seed));
  const Machine machine;
  const WorldField world(scenes()[0].settings(), std::pmr::get_default_resource());
  ChunkRequest request = caveRequest();
  request.seams = 1;
  const auto inputs = ChunkPartInputs::of(world, request, nullptr);
  REQUIRE(inputs);
  const MeshedChunk plain = meshed(machine.mesher(world, nullptr), request);
  REQUIRE(plain.surface.mesh.ranges[0].index_count > 300);
  REQUIRE(plain.voids->size() > 0);
  REQUIRE(plain.surface.anchors.size() == 1);

  const CacheFolder source;
  const auto honest = openCache(source, kAmple);
  meshed(machine.mesher(world, honest.get()), request);
  std::array<DiskKey, 2> keys{honest->keyOf(inputs->bytes(0)), honest->keyOf(inputs->bytes(1))};
  const std::array<Bytes, 2> contents{*getFrom(*honest, keys[0]), *getFrom(*honest, keys[1])};
  const auto miss = [&](size_t part, const Bytes& content, uint64_t damaged) {
    const CacheFolder folder;
    const auto cache = openCache(folder, kAmple);
    cache->put(keys[part], content);
    REQUIRE(same(plain, meshed(machine.mesher(world, cache.get()), request)));
    REQUIRE(cache->stats().damaged == damaged);
    REQUIRE(cache->stats().hits == 1 - damaged);
    REQUIRE(cache->stats().misses == 1 + damaged);
    REQUIRE((getFrom(*cache, keys[part]) == contents[part]) == (damaged == 1));
  };
  miss(0, contents[1], 1);
  miss(1, contents[0], 1);
  miss(0, {}, 1);
  miss(0, noise(1, 3000), 1);
  for (unsigned i = 0; i < rounds(10); ++i) {
    for (const size_t part : {size_t{0}, size_t{1}}) {
      Bytes cut = contents[part];
      cut.resize(random() % cut.size());
      miss(part, cut, 1);
    }
    // Flips a random bit of the vertices or triangles. The data that follow them in the file are not tested: only the
    // file's hash protects them.
    const size_t mesh_at = (6 + 7 * 6) * 4;
    const size_t mesh_bytes = plain.surface.mesh.ranges[0].vertex_count * sizeof(Vertex) +
                              plain.surface.mesh.ranges[0].index_count * sizeof(uint32_t);
    Bytes changed = contents[0];
    changed[mesh_at + random() % mesh_bytes] ^= static_cast<std::byte>(1 << random() % 8);
    miss(0, changed, 1);
  }

  // The following checks of a decoded part come after those of the codec.
  const ChunkPart good = *decodeChunkPart(contents[0], 0, *inputs, std::pmr::get_default_resource());
  const auto decodes = [&](const ChunkPart& p, int as = 0, const ChunkRequest* asked = nullptr) {
    const Bytes bytes = encodeChunkPart(as, p.mesh, p.anchors, p.voids, std::pmr::get_default_resource());
    const auto of = ChunkPartInputs::of(world, asked ? *asked : request, nullptr);
    return decodeChunkPart(bytes, as, *of, std::pmr::get_default_resource()).has_value();
  };
  const auto spoiled = [&](const std::function<void(ChunkPart&)>& spoil) {
    ChunkPart bad = good;
    spoil(bad);
    hashPart(bad.mesh);
    return !decodes(bad);
  };
  CHECK(decodes(good));
  CHECK(!spoiled([](ChunkPart&) {}));
  const auto& names = *world.settings().program;
  const auto past = [](const auto& list) { return static_cast<uint16_t>(list.size()); };
  CHECK(spoiled([&](ChunkPart& p) { p.mesh.vertices[7].material = past(names.materials); }));
  CHECK(spoiled([&](ChunkPart& p) { p.mesh.vertices[7].tag = past(names.tags); }));
  CHECK(spoiled([&](ChunkPart& p) { p.mesh.vertices[7].kind = kCoarserEdge; }));
  CHECK(spoiled([&](ChunkPart& p) { p.anchors[0].kind = past(names.names); }));
  CHECK(spoiled([&](ChunkPart& p) { p.anchors[0].name = past(names.names); }));
  CHECK(spoiled([&](ChunkPart& p) { p.anchors[0].tag = past(names.tags); }));
  CHECK(spoiled([&](ChunkPart& p) { p.anchors[0].frame.origin.y = inputs->box().lo.y - 1; }));
  CHECK(spoiled([&](ChunkPart& p) { p.voids.resize(kMaxVoidComponents + 1); }));
  ChunkPart unhashed = good;
  ++unhashed.mesh.hash.b;
  CHECK(!decodes(unhashed));
  const auto recorded = [&](int part, const std::function<void(ChunkRecord&)>& spoil) {
    Result<ChunkRecord> record = decodeChunk(contents[static_cast<size_t>(part)], std::pmr::get_default_resource());
    REQUIRE(record);
    spoil(*record);
    const Bytes bytes = encodeChunk(*record, std::pmr::get_default_resource());
    return decodeChunkPart(bytes, part, *inputs, std::pmr::get_default_resource()).has_value();
  };
  for (const int part : {0, 1}) {
    CHECK(recorded(part, [](ChunkRecord&) {}));
    CHECK(!recorded(part, [](ChunkRecord& r) { r.extra.push_back({}); }));
    CHECK(!recorded(part, [](ChunkRecord& r) { r.seams ^= 2; }));
  }
  CHECK(!recorded(0, [](ChunkRecord& r) { r.extra.pop_back(); }));
  CHECK(!recorded(0, [](ChunkRecord& r) { r.extra.clear(); }));
  ChunkRequest without = request;
  without.anchors = false;
  CHECK(!decodes(good, 0, &without));
  without = request;
  without.signs = false;
  CHECK(!decodes(good, 0, &without));
}

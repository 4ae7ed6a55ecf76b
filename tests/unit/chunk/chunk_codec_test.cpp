// Tests that a chunk's bytes decode to that chunk, and that no bytes decode to a chunk that cannot be drawn.

#include "chunk/chunk_codec.h"

#include <algorithm>
#include <cstring>
#include <random>

#include "chunk/chunk_surface.h"
#include "mesh/feature_kind.h"
#include "mesh/hash.h"
#include "rounds.h"
#include "stream/plan/frame.h"
#include "stream/plan/lod_target.h"
#include "world/world_support.h"

using namespace sgm;

namespace {

using Encoded = std::pmr::vector<std::byte>;

Encoded encoded(const ChunkRecord& record) { return encodeChunk(record, std::pmr::get_default_resource()); }
Result<ChunkRecord> decoded(std::span<const std::byte> bytes) {
  return decodeChunk(bytes, std::pmr::get_default_resource());
}

bool same(const ChunkRecord& a, const ChunkRecord& b) {
  const auto& u = a.mesh.vertices;
  const auto& v = b.mesh.vertices;
  return u.size() == v.size() && (u.empty() || std::memcmp(u.data(), v.data(), u.size() * sizeof(Vertex)) == 0) &&
         a.mesh.indices == b.mesh.indices && a.mesh.ranges == b.mesh.ranges && a.seams == b.seams &&
         a.solid_samples == b.solid_samples && a.extra == b.extra;
}

uint32_t below(std::mt19937& random, uint32_t end) { return static_cast<uint32_t>(random() % end); }

/// A random record that the decoder accepts: its parts have up to `most` vertices and triangles.
ChunkRecord randomRecord(std::mt19937& random, uint32_t most) {
  ChunkRecord record;
  PackedMesh& mesh = record.mesh;
  const auto position = [&](uint16_t kind) {
    return static_cast<int16_t>(isFeature(kind) ? static_cast<int>(below(random, 9217)) - 512
                                                : static_cast<int>(below(random, 8193)));
  };
  const auto word = [&] { return static_cast<uint16_t>(random()); };
  const auto normal = [&] { return static_cast<int16_t>(random()); };
  for (PackedRange& range : mesh.ranges) {
    if (random() % 3 == 0) continue;
    range.first_vertex = static_cast<uint32_t>(mesh.vertices.size());
    range.vertex_count = 1 + below(random, most);
    range.first_index = static_cast<uint32_t>(mesh.indices.size());
    range.index_count = 3 * below(random, most);
    range.hash = {static_cast<uint32_t>(random()), static_cast<uint32_t>(random())};
    for (uint32_t i = 0; i < range.vertex_count; ++i) {
      const uint16_t kind = word();
      mesh.vertices.push_back(
          {position(kind), position(kind), position(kind), word(), normal(), normal(), word(), kind});
    }
    for (uint32_t i = 0; i < range.index_count; ++i) {
      mesh.indices.push_back(range.first_vertex + below(random, range.vertex_count));
    }
  }
  record.seams = static_cast<uint8_t>(random() % 64);
  record.solid_samples = below(random, 32 * 32 * 32 + 1);
  record.extra.resize(random() % 40);
  for (std::byte& byte : record.extra) byte = static_cast<std::byte>(random());
  return record;
}

/// Checks the contract of decodeChunk by a second method: random access to the record instead of one pass.
bool canBeDrawn(const ChunkRecord& record) {
  const PackedMesh& mesh = record.mesh;
  std::vector<int> vertex_owner(mesh.vertices.size(), -1), index_owner(mesh.indices.size(), -1);
  for (int r = 0; r < 7; ++r) {
    const PackedRange& range = mesh.ranges[static_cast<size_t>(r)];
    for (uint64_t i = 0; i < range.vertex_count; ++i) {
      if (range.first_vertex + i >= vertex_owner.size()) return false;
      if (std::exchange(vertex_owner[range.first_vertex + i], r) != -1) return false;
    }
    for (uint64_t i = 0; i < range.index_count; ++i) {
      if (range.first_index + i >= index_owner.size()) return false;
      if (std::exchange(index_owner[range.first_index + i], r) != -1) return false;
    }
  }
  for (size_t i = 0; i < mesh.indices.size(); ++i) {
    const uint32_t index = mesh.indices[i];
    if (index >= mesh.vertices.size() || index_owner[i] == -1 || vertex_owner[index] != index_owner[i]) return false;
  }
  for (const Vertex& v : mesh.vertices) {
    const int beyond = isFeature(v.kind) ? 512 : 0;
    if (std::max({v.x, v.y, v.z}) > 8192 + beyond || std::min({v.x, v.y, v.z}) < -beyond) return false;
  }
  return std::find(vertex_owner.begin(), vertex_owner.end(), -1) == vertex_owner.end() && record.seams < 64 &&
         record.solid_samples <= 32 * 32 * 32;
}

}  // namespace

TEST_CASE("a chunk's record survives its bytes", "[stream][codec]") {
  const auto seed = GENERATE(take(3, random(0, 1 << 30)));
  CAPTURE(seed);
  std::mt19937 random(static_cast<uint32_t>(seed));
  CHECK(same(*decoded(encoded(ChunkRecord())), ChunkRecord()));
  for (unsigned i = 0; i < rounds(40); ++i) {
    const ChunkRecord record = randomRecord(random, i % 10 == 0 ? 3000 : 20);
    const Encoded bytes = encoded(record);
    const Result<ChunkRecord> back = decoded(bytes);
    REQUIRE(back);
    REQUIRE(same(*back, record));
    REQUIRE(canBeDrawn(*back));
  }
}

TEST_CASE("the cave's chunks survive their bytes, and their hashes hold", "[stream][codec]") {
  const WorldField world(settingsOf(yardstick("cave.sgm"), 1024), std::pmr::get_default_resource());
  const LodViewer viewer{{96 * 1024.0, 96 * 1024.0, 96 * 1024.0}};
  LodSettings lod;
  lod.top = 2;
  lod.finest_cell = 1024;
  lod.finest_distance = lod.view_distance = 40 * 1024.0;
  const auto chunks = meshAll(world, frameRequests(lodTarget({&viewer, 1}, lod)), 2);
  size_t triangles = 0, seams = 0;
  for (const PlacedChunk& chunk : chunks) {
    ChunkRecord record;
    record.mesh = packMesh(partsOf(chunk.mesh), nullptr, std::pmr::get_default_resource());
    record.solid_samples = chunk.mesh.solid_samples;
    const Result<ChunkRecord> back = decoded(encoded(record));
    REQUIRE(back);
    REQUIRE(same(*back, record));
    for (const PackedRange& range : back->mesh.ranges) {
      MeshPart part;
      const auto vertices = back->mesh.vertices.begin() + range.first_vertex;
      part.vertices.assign(vertices, vertices + range.vertex_count);
      for (uint32_t i = 0; i < range.index_count; ++i) {
        part.indices.push_back(back->mesh.indices[range.first_index + i] - range.first_vertex);
      }
      hashPart(part);
      REQUIRE(part.hash == range.hash);
      triangles += range.index_count / 3;
      seams += &range != &back->mesh.ranges[0] && range.index_count != 0;
    }
  }
  CHECK(triangles > 1000);
  CHECK(seams > 3);
}

TEST_CASE("bytes that were cut or changed are refused or still a chunk", "[stream][codec]") {
  const auto seed = GENERATE(take(4, random(0, 1 << 30)));
  CAPTURE(seed);
  std::mt19937 random(static_cast<uint32_t>(seed));
  const Encoded bytes = encoded(randomRecord(random, 8));
  for (size_t length = 0; length < bytes.size(); ++length) {
    const Result<ChunkRecord> back = decoded(std::span(bytes).first(length));
    REQUIRE(!back);
    REQUIRE(back.error().code == Code::bad_input);
  }
  size_t refused = 0, accepted = 0;
  const auto look = [&](const Encoded& changed) {
    const Result<ChunkRecord> back = decoded(changed);
    ++(back ? accepted : refused);
    if (!back) return;
    REQUIRE(canBeDrawn(*back));
    REQUIRE((encoded(*back) == changed));
  };
  for (size_t i = 0; i < bytes.size(); ++i) {
    for (int bit = 0; bit < 8; ++bit) {
      Encoded changed = bytes;
      changed[i] ^= static_cast<std::byte>(1 << bit);
      look(changed);
    }
  }
  for (unsigned i = 0; i < rounds(2000); ++i) {
    Encoded changed = bytes;
    for (auto n = 1 + random() % 4; n > 0; --n) changed[random() % changed.size()] = static_cast<std::byte>(random());
    look(changed);
  }
  CHECK(refused > 100);
  CHECK(accepted > 100);
}

TEST_CASE("every check of the decoder is one that can fail", "[stream][codec]") {
  // A record of two parts with one triangle each.
  ChunkRecord good;
  for (const size_t r : {size_t{0}, size_t{2}}) {
    const auto first = static_cast<uint32_t>(good.mesh.vertices.size());
    good.mesh.ranges[r] = {first, 3, first, 3, {}};
    for (uint32_t i = 0; i < 3; ++i) {
      good.mesh.vertices.push_back({8192, 0, static_cast<int16_t>(i), 0, 0, 0, 0, 0});
      good.mesh.indices.push_back(first + i);
    }
  }
  REQUIRE(decoded(encoded(good)));
  const auto refused = [&](const std::string& why, const std::function<void(ChunkRecord&)>& spoil) {
    ChunkRecord bad = good;
    spoil(bad);
    const Result<ChunkRecord> back = decoded(encoded(bad));
    REQUIRE(!back);
    CHECK(back.error().code == Code::bad_input);
    CHECK(back.error().message.find(why) != std::string::npos);
  };
  refused("outside", [](ChunkRecord& r) { r.mesh.vertices[4].x = 8193; });
  refused("outside", [](ChunkRecord& r) { r.mesh.vertices[5].y = 8193; });
  refused("outside", [](ChunkRecord& r) { r.mesh.vertices[0].z = -1; });
  refused("outside", [](ChunkRecord& r) { r.mesh.vertices[0].kind = kFeature, r.mesh.vertices[0].z = -513; });
  refused("outside", [](ChunkRecord& r) { r.mesh.vertices[0].kind = kFeature, r.mesh.vertices[0].y = 8705; });
  refused("ranges", [](ChunkRecord& r) { r.mesh.indices[0] = 3; });
  refused("ranges", [](ChunkRecord& r) { r.mesh.indices[5] = 2; });
  refused("ranges", [](ChunkRecord& r) { r.mesh.indices[5] = 6; });
  refused("ranges", [](ChunkRecord& r) { r.mesh.ranges[0].index_count = 0; });
  refused("ranges", [](ChunkRecord& r) { r.mesh.ranges[2].index_count = 2; });
  refused("ranges", [](ChunkRecord& r) { r.mesh.ranges[2].index_count = ~0u - 2; });
  refused("ranges", [](ChunkRecord& r) { r.mesh.ranges[2].vertex_count = ~0u - 2; });
  refused("ranges", [](ChunkRecord& r) { r.mesh.ranges[2].first_vertex = 2; });
  refused("ranges", [](ChunkRecord& r) { r.mesh.ranges[2].first_index = 6; });
  refused("ranges", [](ChunkRecord& r) { r.mesh.ranges[1].first_index = 7; });
  refused("ranges", [](ChunkRecord& r) { r.mesh.ranges[6].first_vertex = 7; });
  refused("ranges", [](ChunkRecord& r) { std::swap(r.mesh.ranges[0], r.mesh.ranges[2]); });
  refused("ranges", [](ChunkRecord& r) { r.mesh.ranges[2] = {}; });
  refused("out of range", [](ChunkRecord& r) { r.seams = 64; });
  refused("out of range", [](ChunkRecord& r) { r.solid_samples = 32 * 32 * 32 + 1; });

  const auto spoiled = [&](size_t word, uint32_t value) {
    Encoded bytes = encoded(good);
    std::memcpy(bytes.data() + 4 * word, &value, sizeof value);
    return decoded(bytes);
  };
  CHECK(spoiled(0, kChunkCodecVersion + 1).error().message.find("version") != std::string::npos);
  // Sizes in the header are validated before any memory is allocated for them.
  for (const size_t word : {size_t{1}, size_t{2}, size_t{3}}) {
    for (const uint32_t value : {0u, 1u, 0x80000000u, ~0u}) {
      CHECK(spoiled(word, value ^ (word == 3 && value == 0)).error().message.find("sizes") != std::string::npos);
    }
  }
}

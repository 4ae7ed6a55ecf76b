// Tests which chunks are found to be reachable through the void: all that really are, and few others.

#include "stream/plan/reachability.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <random>
#include <set>

#include "rounds.h"
#include "stream/plan/lod_target.h"
#include "world/world_support.h"

using namespace sgm;

namespace {

constexpr int32_t kFineCell = 256;
constexpr double kChunkEdge = 32.0 * kFineCell;

using Place = std::array<double, 3>;

std::vector<ReachedChunk> reachedFrom(const Place& viewer, double radius, const VoidLookup& voids) {
  return reachedChunks(std::span(&viewer, 1), radius, kFineCell, voids);
}

/// A cube of chunks that are cut from one lattice of samples, x fastest; everything outside is solid.
class Cluster {
 public:
  explicit Cluster(int chunks) : chunks_(chunks), side_(chunks * kChunkCells + 1) {
    solid_.resize(static_cast<size_t>(side_) * static_cast<size_t>(side_) * static_cast<size_t>(side_));
  }

  int chunks() const { return chunks_; }
  int side() const { return side_; }
  size_t index(Int3 p) const { return static_cast<size_t>(p.x + side_ * (p.y + side_ * p.z)); }
  Int3 sampleAt(size_t i) const {
    const auto s = static_cast<size_t>(side_);
    return {static_cast<int32_t>(i % s), static_cast<int32_t>(i / s % s), static_cast<int32_t>(i / s / s)};
  }
  bool has(Int3 p) const { return std::min({p.x, p.y, p.z}) >= 0 && std::max({p.x, p.y, p.z}) < side_; }
  bool solid(Int3 p) const { return solid_[index(p)]; }

  template <class Solid>
  void fill(const Solid& solid) {
    for (size_t i = 0; i < solid_.size(); ++i) solid_[i] = solid(sampleAt(i));
  }

  VoidComponents voids(const ChunkKey& key) const {
    std::vector<uint64_t> signs(size_t{kChunkSamples} * kChunkSamples);
    for (int32_t z = 0; z < kChunkSamples; ++z) {
      for (int32_t y = 0; y < kChunkSamples; ++y) {
        uint64_t& row = signs[static_cast<size_t>(y + kChunkSamples * z)];
        for (int32_t x = 0; x < kChunkSamples; ++x) {
          const Int3 p{key.at.x * 32 + x, key.at.y * 32 + y, key.at.z * 32 + z};
          row |= uint64_t{solid(p)} << x;
        }
      }
    }
    return voidComponents(signs);
  }

  std::map<ChunkKey, VoidComponents> allVoids() const {
    std::map<ChunkKey, VoidComponents> all;
    for (int32_t i = 0; i < chunks_ * chunks_ * chunks_; ++i) {
      const ChunkKey key{0, {i % chunks_, i / chunks_ % chunks_, i / chunks_ / chunks_}};
      all.emplace(key, voids(key));
    }
    return all;
  }

  /// The chunks that contain a sample of the void around `from`.
  std::set<ChunkKey> floodFill(Int3 from) const {
    std::vector<bool> seen = solid_;
    std::vector<Int3> open{from};
    std::set<ChunkKey> reached;
    seen[index(from)] = true;
    while (!open.empty()) {
      const Int3 p = open.back();
      open.pop_back();
      for (int corner = 0; corner < 8; ++corner) {
        const Int3 at{(p.x - (corner & 1)) >> 5, (p.y - (corner >> 1 & 1)) >> 5, (p.z - (corner >> 2)) >> 5};
        if (std::min({at.x, at.y, at.z}) >= 0 && std::max({at.x, at.y, at.z}) < chunks_) reached.insert({0, at});
      }
      for (int n = 0; n < 27; ++n) {
        const int dx = n % 3 - 1, dy = n / 3 % 3 - 1, dz = n / 9 - 1;
        const Int3 to{p.x + dx, p.y + dy, p.z + dz};
        if (std::abs(dx) + std::abs(dy) + std::abs(dz) > 2 || !has(to) || seen[index(to)]) continue;
        seen[index(to)] = true;
        open.push_back(to);
      }
    }
    return reached;
  }

 private:
  int chunks_, side_;
  std::vector<bool> solid_;
};

/// Digs small hollows, and tubes between random places; some of the tubes meet. Returns a place in each tube.
std::vector<Int3> digTubes(Cluster& cluster, std::mt19937& random, int count, double noise) {
  const auto real = [&](double lo, double hi) { return std::uniform_real_distribution<>(lo, hi)(random); };
  cluster.fill([&](Int3) { return real(0, 1) >= noise; });
  std::vector<bool> open(static_cast<size_t>(cluster.side()) * static_cast<size_t>(cluster.side()) *
                         static_cast<size_t>(cluster.side()));
  std::vector<Int3> inside;
  for (int i = 0; i < count; ++i) {
    std::array<double, 3> a{}, b{};
    for (size_t axis = 0; axis < 3; ++axis) a[axis] = real(0, cluster.side() - 1), b[axis] = real(0, cluster.side());
    const double radius = real(1.2, 4);
    for (double t = 0; t <= 1; t += 0.004) {
      Int3 c;
      for (int axis = 0; axis < 3; ++axis) {
        const auto k = static_cast<size_t>(axis);
        c[axis] = static_cast<int32_t>(a[k] + t * (b[k] - a[k]));
      }
      if (t == 0) inside.push_back(c);
      const int r = static_cast<int>(radius);
      for (int n = 0; n < (2 * r + 1) * (2 * r + 1) * (2 * r + 1); ++n) {
        const int w = 2 * r + 1, dx = n % w - r, dy = n / w % w - r, dz = n / w / w - r;
        const Int3 p{c.x + dx, c.y + dy, c.z + dz};
        if (cluster.has(p) && dx * dx + dy * dy + dz * dz <= radius * radius) open[cluster.index(p)] = true;
      }
    }
  }
  const Cluster before = cluster;
  cluster.fill([&](Int3 p) { return before.solid(p) && !open[cluster.index(p)]; });
  return inside;
}

VoidLookup lookupIn(const std::map<ChunkKey, VoidComponents>& chunks) {
  return [&](const ChunkKey& key) {
    const auto found = chunks.find(key);
    return found == chunks.end() ? nullptr : &found->second;
  };
}

/// The position of a sample, which is the lowest corner of a grid cell.
Place placeBy(Int3 sample) { return {sample.x * 256.0, sample.y * 256.0, sample.z * 256.0}; }
Place middleOf(const ChunkKey& key) {
  return {(key.at.x + 0.5) * kChunkEdge, (key.at.y + 0.5) * kChunkEdge, (key.at.z + 0.5) * kChunkEdge};
}

/// A chunk with one void that reaches the middle of the given faces. faces: a bit (1 << Face) for each face.
VoidComponents passageThrough(unsigned faces) {
  VoidComponents voids(1);
  for (size_t f = 0; f < 6; ++f) voids[0].faces[f] = faces >> f & 1 ? uint64_t{1} << 36 : 0;
  for (uint64_t& plane : voids[0].blocks) plane = uint64_t{1} << 36;
  return voids;
}
constexpr unsigned kLowX = 1, kHighX = 2, kLowY = 4, kHighY = 8, kLowZ = 16, kHighZ = 32;

}  // namespace

TEST_CASE("random clusters: whatever a flood fill over all samples reaches is reached") {
  size_t reachable = 0, reached_too = 0, out_of_reach = 0, missed = 0;
  for (uint32_t seed = 1; seed <= rounds(12); ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    Cluster cluster(3);
    const double noise = std::array{0.0, 0.005, 0.01, 0.05}[seed % 4];
    const std::vector<Int3> places = digTubes(cluster, random, 4 + static_cast<int>(random() % 20), noise);
    const std::map<ChunkKey, VoidComponents> chunks = cluster.allVoids();
    for (const Int3 from : {places[0], places[1], places[2], places[3]}) {
      const Place viewer = placeBy(from);
      const std::vector<ReachedChunk> reached = reachedFrom(viewer, 1e5, lookupIn(chunks));
      const std::set<ChunkKey> expected = cluster.floodFill(from);
      for (const auto& known : chunks) {
        const ChunkKey& key = known.first;
        const std::optional<uint32_t> steps = stepsTo(reached, key);
        if (expected.contains(key)) {
          reachable += 1;
          missed += !steps;
          const auto apart = [&](int axis) { return std::abs(key.at[axis] - from[axis] / 32); };
          if (steps) CHECK(*steps >= static_cast<uint32_t>(apart(0) + apart(1) + apart(2)));
        } else if (noise < 0.02) {  // in rock full of holes, a chunk has more voids than the library distinguishes
          (steps ? reached_too : out_of_reach) += 1;
        }
      }
    }
  }
  WARN(reachable << " chunks reachable, " << missed << " missed, " << reached_too << " of "
                 << reached_too + out_of_reach << " others reached too");
  CHECK(missed == 0);
  CHECK(reachable > 20);
  CHECK(out_of_reach > 2 * reached_too);
}

TEST_CASE("steps follow the passage, and a chunk that is not known yet ends it") {
  // A passage along x that turns to z and comes back along x, separated from its first part by rock.
  std::map<ChunkKey, VoidComponents> chunks;
  for (int32_t x = 0; x < 4; ++x) {
    chunks[{0, {x, 0, 0}}] = passageThrough((x > 0 ? kLowX : 0) | (x < 3 ? kHighX : kHighZ));
    chunks[{0, {x, 0, 1}}] = passageThrough((x > 0 ? kLowX : 0) | (x < 3 ? kHighX : kLowZ));
  }
  const Place viewer = middleOf({0, {0, 0, 0}});
  const auto steps = [&](const ChunkKey& key) {
    return stepsTo(reachedFrom(viewer, 9 * kChunkEdge, lookupIn(chunks)), key);
  };
  CHECK(steps({0, {0, 0, 0}}) == 0u);
  CHECK(steps({0, {3, 0, 0}}) == 3u);
  CHECK(steps({0, {3, 0, 1}}) == 4u);
  CHECK(steps({0, {0, 0, 1}}) == 7u);
  CHECK_FALSE(steps({0, {0, 0, -1}}));
  CHECK(reachedFrom(viewer, 9 * kChunkEdge, lookupIn(chunks)).size() == 8);

  const VoidComponents hidden = chunks[{0, {2, 0, 0}}];
  chunks.erase({0, {2, 0, 0}});
  CHECK(steps({0, {2, 0, 0}}) == 2u);
  CHECK_FALSE(steps({0, {3, 0, 0}}));
  // If the passage is closed on the near side of a known chunk, the chunk is drawn, but no chunk behind it is reached.
  chunks[{0, {2, 0, 0}}] = passageThrough(kHighX);
  CHECK(steps({0, {2, 0, 0}}) == 2u);
  CHECK_FALSE(steps({0, {3, 0, 0}}));
  chunks[{0, {2, 0, 0}}] = hidden;
  CHECK(steps({0, {3, 0, 0}}) == 3u);

  // Two voids in one chunk are separate places, so they are no shortcut between the two ends of a longer passage.
  chunks[{0, {0, 0, 1}}] = passageThrough(kHighX | kHighZ);
  chunks[{0, {0, 0, 0}}] = passageThrough(kHighX | kLowY);
  chunks[{0, {0, -1, 0}}] = passageThrough(kHighY | kHighZ);
  chunks[{0, {0, -1, 1}}] = passageThrough(kLowZ | kHighY);
  VoidComponents both = passageThrough(kLowY);
  both.push_back(chunks[{0, {0, 0, 1}}][0]);
  chunks[{0, {0, 0, 1}}] = both;
  CHECK(steps({0, {0, 0, 1}}) == 3u);
  CHECK(steps({0, {0, 0, 2}}) == 8u);
}

TEST_CASE("the ball ends what is reached, several viewers share it, and the world's place does not matter") {
  const VoidComponents all = voidOfUniform(false);
  const auto open = [&](const ChunkKey&) { return &all; };
  const std::vector<Place> viewers{middleOf({0, {0, 0, 0}}), middleOf({0, {5, 1, 0}})};
  const double radius = 3.2 * kChunkEdge;
  const std::vector<ReachedChunk> reached = reachedChunks(viewers, radius, kFineCell, open);
  CHECK(std::is_sorted(reached.begin(), reached.end()));
  size_t inside = 0;
  for (int32_t x = -8; x < 14; ++x) {
    for (int32_t y = -8; y < 10; ++y) {
      for (int32_t z = -8; z < 9; ++z) {
        const ChunkKey key{0, {x, y, z}};
        uint32_t expected = 1000;
        const auto steps = [&](Int3 from) {
          return static_cast<uint32_t>(std::abs(x - from.x) + std::abs(y - from.y) + std::abs(z - from.z));
        };
        if (distanceToChunk(viewers[0], key, kFineCell) <= radius) expected = steps({0, 0, 0});
        if (distanceToChunk(viewers[1], key, kFineCell) <= radius) expected = std::min(expected, steps({5, 1, 0}));
        inside += expected < 1000;
        CHECK(stepsTo(reached, key).value_or(1000) == expected);
      }
    }
  }
  CHECK(reached.size() == inside);
  CHECK(reachedChunks({}, radius, kFineCell, open).empty());

  std::mt19937 random(3);
  Cluster cluster(3);
  const Place here = placeBy(digTubes(cluster, random, 9, 0.05)[2]);
  const std::map<ChunkKey, VoidComponents> chunks = cluster.allVoids();
  const std::vector<ReachedChunk> near = reachedFrom(here, 2 * kChunkEdge, lookupIn(chunks));
  CHECK(near.size() > 5);
  const Int3 far{250'000, -250'000, 249'999};
  Place there{};
  for (size_t i = 0; i < 3; ++i) there[i] = here[i] + far[static_cast<int>(i)] * kChunkEdge;
  std::vector<ReachedChunk> moved = reachedFrom(there, 2 * kChunkEdge, [&](const ChunkKey& key) {
    return lookupIn(chunks)({0, {key.at.x - far.x, key.at.y - far.y, key.at.z - far.z}});
  });
  for (ReachedChunk& chunk : moved) chunk.key = neighbourOf(chunk.key, -far.x, -far.y, -far.z);
  CHECK(moved == near);
}

TEST_CASE("a viewer in rock sees through it, and at the world's end what there is of the world") {
  const VoidComponents rock = voidOfUniform(true), sealed = [] {
    VoidComponents voids(1);
    voids[0].blocks[7] = 1;
    return voids;
  }();
  for (const VoidComponents* around : {&rock, &sealed}) {
    const Place viewer = middleOf({0, {2, 2, 2}});
    const auto reached = reachedFrom(viewer, kChunkEdge, [&](const ChunkKey&) { return around; });
    CHECK(reached.size() == 27);
    CHECK(stepsTo(reached, {0, {3, 3, 3}}) == 3u);
  }
  // From inside the sealed void, no other chunk is reached.
  const Place inside{2.02 * kChunkEdge, 2.02 * kChunkEdge, 2.98 * kChunkEdge};
  CHECK(reachedFrom(inside, kChunkEdge, [&](const ChunkKey&) { return &sealed; }).size() == 1);

  const Place end{2147483647.0, 0.0, -2147483648.0};
  const auto reached = reachedFrom(end, 3 * kChunkEdge, [&](const ChunkKey&) { return &rock; });
  CHECK(reached.size() > 10);
  for (const ReachedChunk& chunk : reached) {
    CHECK((chunk.key.at.x + 1) * kChunkEdge <= 2147483647.0);
    CHECK(chunk.key.at.z * kChunkEdge >= -2147483648.0);
  }
}

TEST_CASE("around a spawn anchor of the cave a share of what is near lies behind rock") {
  const WorldField world(settingsOf(yardstick("cave.sgm"), kFineCell), std::pmr::get_default_resource());
  const auto anchors = world.anchors({{0, 0, 0}, {2 * 192 * 1024, 2 * 192 * 1024, 2 * 192 * 1024}});
  REQUIRE(anchors);
  REQUIRE(anchors->size() > 4);
  constexpr double kRadius = 24 * 1024;
  for (size_t i = 0; i < 4; ++i) {
    const Int3 at = (*anchors)[i].frame.origin;
    const Place viewer{static_cast<double>(at.x), static_cast<double>(at.y), static_cast<double>(at.z)};
    const auto keys = chunksOfRegion(world, IntBox{at, at}.grown(static_cast<int32_t>(kRadius)), 0, 10'000);
    REQUIRE(keys);
    std::vector<ChunkRequest> requests;
    for (const ChunkKey& key : *keys) {
      if (distanceToChunk(viewer, key, kFineCell) > kRadius) continue;
      requests.push_back({key});
      requests.back().signs = true;
    }
    std::map<ChunkKey, VoidComponents> voids;
    std::set<ChunkKey> drawn;
    size_t bytes = 0;
    for (const PlacedChunk& chunk : meshAll(world, requests, 2)) {
      bytes += voids.emplace(chunk.key, voidsOf(chunk.mesh)).first->second.size() * sizeof(VoidComponent);
      if (!chunk.mesh.body.indices.empty()) drawn.insert(chunk.key);
    }
    const std::vector<ReachedChunk> reached = reachedFrom(viewer, kRadius, lookupIn(voids));
    size_t drawn_reached = 0;
    for (const ReachedChunk& chunk : reached) drawn_reached += drawn.contains(chunk.key);
    WARN("within 24 m: " << reached.size() << " of " << voids.size() << " chunks reached, " << drawn_reached << " of "
                         << drawn.size() << " with a surface; " << bytes << " bytes of voids");
    CHECK(stepsTo(reached, {0, {at.x >> 13, at.y >> 13, at.z >> 13}}) == 0u);
    CHECK(drawn_reached > 0);
    CHECK(reached.size() < voids.size());

    // If chunks become known only when they are reached, the result is the same.
    std::map<ChunkKey, VoidComponents> known;
    std::vector<ReachedChunk> so_far;
    for (size_t before = 1; known.size() != before;) {
      before = known.size();
      so_far = reachedFrom(viewer, kRadius, lookupIn(known));
      for (const ReachedChunk& chunk : so_far) known.emplace(chunk.key, voids.at(chunk.key));
    }
    CHECK(so_far == reached);
  }
}

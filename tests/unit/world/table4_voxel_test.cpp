// Tests the claims of the row Voxel in the paper's Table 4, with samples/grammars/table4/voxel.sgm: an automaton in
// grammar cells with an exact halo, its controls, edited voxels, meshes without holes.

#include <algorithm>
#include <array>
#include <random>

#include "edits_support.h"
#include "field/evaluate.h"
#include "mesh/check.h"
#include "rounds.h"
#include "seed.h"
#include "stream/plan/frame.h"
#include "world_support.h"

using namespace sgm;

namespace {

constexpr uint32_t kMaze = 0, kNet = 1;  // indices of the two layers

struct Setting {
  const char* name;
  double value;
};

WorldField voxelCave(const std::string& text, uint64_t seed, std::initializer_list<Setting> settings = {}) {
  WorldFieldSettings s = settingsOf(text, 512, seed);
  for (const Setting& one : settings) REQUIRE(s.parameters.set(*s.program, one.name, one.value));
  return {std::move(s), std::pmr::get_default_resource()};
}

/// Samples of a cube with `edge` places along each axis, one metre apart, x fastest: whether each place is rock.
class Voxels {
 public:
  Voxels(const WorldField& world, uint32_t layer, Int3 low, int edge)
      : edge_(edge), rock_(static_cast<size_t>(edge * edge * edge)) {
    // Samples are taken in blocks, so that each block's program has only the shapes nearby.
    constexpr int kBlock = 16;
    for (int z = 0; z < edge; z += kBlock)
      for (int y = 0; y < edge; y += kBlock)
        for (int x = 0; x < edge; x += kBlock) sample(world, layer, low, {x, y, z}, kBlock);
  }

  bool inside(Int3 p) const { return std::min({p.x, p.y, p.z}) >= 0 && std::max({p.x, p.y, p.z}) < edge_; }
  bool rock(Int3 p) const { return rock_[index(p)] != 0; }
  size_t index(Int3 p) const { return static_cast<size_t>((p.z * edge_ + p.y) * edge_ + p.x); }
  int edge() const { return edge_; }
  double share() const {
    return static_cast<double>(std::count(rock_.begin(), rock_.end(), 1)) / static_cast<double>(rock_.size());
  }

  /// Two shares: of the voxels that differ from all six neighbours, and of the pairs of neighbours that differ from
  /// each other.
  std::array<double, 2> roughness() const {
    size_t alone = 0, apart = 0, all = 0;
    for (int z = 1; z + 1 < edge_; ++z)
      for (int y = 1; y + 1 < edge_; ++y)
        for (int x = 1; x + 1 < edge_; ++x, ++all) {
          size_t other = 0;
          for (const Int3 step : kSteps) other += rock({x + step.x, y + step.y, z + step.z}) != rock({x, y, z});
          alone += other == 6;
          apart += other;
        }
    return {static_cast<double>(alone) / static_cast<double>(all),
            static_cast<double>(apart) / static_cast<double>(6 * all)};
  }

  /// The air that can be reached from a place by steps between neighbouring voxels.
  std::vector<uint8_t> reached(Int3 from) const {
    std::vector<uint8_t> out(rock_.size());
    std::vector<Int3> open{from};
    out[index(from)] = 1;
    while (!open.empty()) {
      const Int3 at = open.back();
      open.pop_back();
      for (const Int3 step : kSteps) {
        const Int3 next = saturatingAdd(at, step);
        if (!inside(next) || rock(next) || out[index(next)] != 0) continue;
        out[index(next)] = 1;
        open.push_back(next);
      }
    }
    return out;
  }

 private:
  void sample(const WorldField& world, uint32_t layer, Int3 low, Int3 from, int block) {
    std::array<std::vector<int32_t>, 3> at;
    std::vector<size_t> to;
    IntBox box;
    for (int i = 0; i < block * block * block; ++i) {
      const Int3 p{from.x + i % block, from.y + i / block % block, from.z + i / block / block};
      if (!inside(p)) continue;
      const Int3 place = saturatingAdd(low, {p.x * kUnitsPerMetre, p.y * kUnitsPerMetre, p.z * kUnitsPerMetre});
      box = box.joined({place, place});
      for (int axis = 0; axis < 3; ++axis) at[static_cast<size_t>(axis)].push_back(place[axis]);
      to.push_back(index(p));
    }
    const auto program = world.compileBelow(layer, box);
    REQUIRE(program);
    std::vector<int32_t> q(to.size());
    EvalScratch scratch;
    scalarKernels().samples((*program)->view(), {at[0].data(), at[1].data(), at[2].data(), q.size()}, scratch,
                            q.data());
    for (size_t i = 0; i < q.size(); ++i) rock_[to[i]] = q[i] < 0;
  }

  static constexpr std::array<Int3, 6> kSteps{{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};
  int edge_;
  std::vector<uint8_t> rock_;
};

ContentHash meshesHash(const std::pmr::vector<PlacedChunk>& chunks) {
  std::vector<PlacedPart> parts;
  for (const PlacedChunk& chunk : chunks) appendParts(chunk, parts);
  return hashParts(parts);
}

MeshReport reportOf(const std::pmr::vector<PlacedChunk>& chunks) {
  std::vector<PlacedPart> placed;
  std::vector<const MeshPart*> parts;
  for (const PlacedChunk& chunk : chunks) appendParts(chunk, placed);
  for (const PlacedPart& part : placed) parts.push_back(part.mesh);
  return checkParts(parts);
}

}  // namespace

TEST_CASE("Voxel: the same caves, to the bit, however the world is cut into cells", "[table4]") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  const std::string cave = sample("table4/voxel.sgm");
  const auto with = [&](int metres) {
    return replaced(cave, "layer maze cell 32m", "layer maze cell " + std::to_string(metres) + "m");
  };
  for (unsigned round = 0; round < rounds(2); ++round) {
    const uint64_t world_seed = random();
    const double rock = 0.44 + 0.01 * within(random, 0, 12), count = within(random, 0, 6),
                 radius = within(random, 1, 2);
    const Int3 far{within(random, -9000, 9000), within(random, -100, 100), within(random, -9000, 9000)};
    // The mesh is made with cells of half a voxel to four voxels.
    std::vector<ChunkRequest> requests;
    for (uint8_t level = 0; level < 4; ++level)
      requests.push_back({{level, {far.x >> level, far.y >> level, far.z >> level}}});
    const auto hashAt = [&](int metres) {
      const WorldField world =
          voxelCave(with(metres), world_seed, {{"rock", rock}, {"rounds", count}, {"radius", radius}});
      return meshesHash(meshAll(world, requests, 2));
    };
    const ContentHash expected = hashAt(32);
    for (const int metres : {64, 23, 12 + within(random, 0, 40)}) {
      CAPTURE(world_seed, rock, count, radius, far.x, far.y, far.z, metres);
      CHECK(hashAt(metres) == expected);
    }
  }
}

TEST_CASE("Voxel: the automaton does what its controls say", "[table4]") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  const std::string cave = sample("table4/voxel.sgm");
  const auto voxels = [&](std::initializer_list<Setting> settings) {
    return Voxels(voxelCave(cave, seed, settings), kMaze, {-17 * 1024, 5 * 1024, 0}, 48);
  };
  double before = 0;
  for (const double rock : {0.42, 0.46, 0.5, 0.54, 0.58}) {
    const double share = voxels({{"rock", rock}}).share();
    CAPTURE(rock, share);
    CHECK(share > before);
    before = share;
  }
  before = 1;
  for (const double threshold : {0.42, 0.5, 0.58}) {
    const double share = voxels({{"threshold", threshold}}).share();
    CAPTURE(threshold, share);
    CHECK(share < before);
    before = share;
  }
  // If the automaton runs no rounds, voxels are random, so one voxel in 64 differs from all six neighbours.
  const auto chance = voxels({{"rounds", 0}}).roughness();
  CHECK(std::abs(chance[0] - 1.0 / 64) < 0.004);
  CHECK(std::abs(chance[1] - 0.5) < 0.02);
  const auto once = voxels({{"rounds", 1}}).roughness(), often = voxels({{"rounds", 4}}).roughness();
  CHECK(once[0] < chance[0] / 4);
  CHECK(often[0] < chance[0] / 100);
  CHECK(once[1] < chance[1]);
  CHECK(often[1] < once[1]);
  CHECK(voxels({{"rounds", 4}, {"radius", 2}}).roughness()[1] < 0.8 * often[1]);
}

TEST_CASE("Voxel: from each hall there is a way to each other", "[table4]") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  const WorldField world = voxelCave(sample("table4/voxel.sgm"), seed);
  // The box contains two cells of the net along each axis, which links connect, and a margin for the bends of links.
  const Int3 low{-16 * 1024, -16 * 1024, -16 * 1024};
  const Voxels cave(world, kNet, low, 160);
  std::vector<Int3> halls;
  for (int32_t k = 0; k < 8; ++k) {
    const auto cell = world.cell(kNet, {k & 1, k >> 1 & 1, k >> 2});
    REQUIRE(cell);
    for (const Anchor& anchor : (*cell)->chunk.anchors) {
      const Int3 at = saturatingSub(anchor.frame.origin, low);
      halls.push_back({at.x / 1024, at.y / 1024, at.z / 1024});
    }
  }
  REQUIRE(halls.size() == 8);
  const std::vector<uint8_t> reached = cave.reached(halls[0]);
  for (const Int3 hall : halls) {
    REQUIRE_FALSE(cave.rock(hall));
    CHECK(reached[cave.index(hall)] != 0);
  }
}

TEST_CASE("Voxel: caves that are dug and filled have no holes, nor where levels meet", "[table4]") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  const WorldField world = voxelCave(sample("table4/voxel.sgm"), seed);
  Octree tree(2, 512);
  const int32_t edge = kChunkCells * 512;
  tree.split({3, {0, 0, 0}});
  tree.split({2, {1, 1, 1}});
  tree.split({1, {2, 2, 2}});
  refineToRules(tree);
  const std::vector<ChunkRequest> requests = frameRequests(tree);
  EditLog log({1});
  const Int3 corner{5 * edge, 5 * edge, 5 * edge};
  for (int i = 0; i < 40; ++i) REQUIRE(log.add(randomBrush(random, IntBox{corner, corner}.grown(20'000), 3000)));
  // Changes one voxel from rock to air, and another voxel from air to rock.
  const Voxels voxels(world, kNet, corner, 12);
  std::array<std::optional<Int3>, 2> edited;
  for (int i = 0; i < 12 * 12 * 12; ++i) {
    const Int3 at{i % 12, i / 12 % 12, i / 144};
    edited[voxels.rock(at) ? 1 : 0] = saturatingAdd(corner, {at.x * 1024, at.y * 1024, at.z * 1024});
  }
  for (const bool rock : {false, true}) {
    if (!edited[rock ? 1 : 0]) continue;
    Brush brush;
    brush.shape = Brush::Shape::box;
    brush.from = *edited[rock ? 1 : 0];
    brush.half = {512, 512, 512};
    brush.cut = rock;
    REQUIRE(log.add(brush));
  }
  const auto snapshot = log.snapshot();
  const std::pmr::vector<PlacedChunk> plain = meshAll(world, requests, 2),
                                      dug = meshAll(world, requests, 2, snapshot.get());
  for (const auto* chunks : {&plain, &dug}) {
    const MeshReport report = reportOf(*chunks);
    INFO(describe(report));
    CHECK(report.closed());
    CHECK(report.triangles > 10'000);
  }
  CHECK_FALSE(meshesHash(plain) == meshesHash(dug));
  for (const bool rock : {false, true}) {
    if (!edited[rock ? 1 : 0]) continue;
    const Int3 at = *edited[rock ? 1 : 0];
    const auto program = world.compile({at, at}, 0, snapshot.get());
    REQUIRE(program);
    int32_t q = 0;
    EvalScratch scratch;
    scalarKernels().samples((*program)->view(), {&at.x, &at.y, &at.z, 1}, scratch, &q);
    CHECK((q < 0) == !rock);
  }
}

TEST_CASE("Voxel: in a layer without height the automaton is that of the paper, in two dimensions", "[table4]") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  const WorldField world = voxelCave(
      "sgm 1; units m; domain infinite axes xz;\nlayer map cell 16m reach 1m { start Map; }\n"
      "rule Map { meet { ca(1m, fill 45%, threshold 5/9); at(8m, 1.5m, 8m) box(40m, 3m, 40m); } }\n",
      seed);
  const Voxels map(world, 0, {-24 * 1024, -8 * 1024, -24 * 1024}, 48);
  size_t rock = 0;
  for (int z = 0; z < 48; ++z)
    for (int x = 0; x < 48; ++x) {
      // The walls extend from y = 0 to y = 3 m, and index 0 lies at y = -8 m. So indices 9 and 10 lie at the height of
      // the walls, 7 below and 12 above.
      const bool wall = map.rock({x, 9, z});
      CHECK(wall == map.rock({x, 10, z}));
      CHECK_FALSE(map.rock({x, 7, z}));
      CHECK_FALSE(map.rock({x, 12, z}));
      rock += wall;
    }
  CHECK(rock > 48 * 48 / 20);
  CHECK(rock < 48 * 48 * 9 / 10);
  const std::pmr::vector<PlacedChunk> chunks = meshAll(world, frameRequests([] {
                                                         Octree tree(1, 512);
                                                         tree.split({2, {0, 0, 0}});
                                                         tree.split({1, {0, 0, 0}});
                                                         refineToRules(tree);
                                                         return tree;
                                                       }()),
                                                       2);
  const MeshReport report = reportOf(chunks);
  INFO(describe(report));
  CHECK(report.closed());
  CHECK(report.triangles > 1000);
}

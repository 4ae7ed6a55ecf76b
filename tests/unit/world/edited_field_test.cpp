// Tests the field with brushes: what is solid, the order of brushes, the levels, and that meshes stay closed.

#include <algorithm>
#include <cmath>
#include <cstring>

#include "backend/open/open_backend.h"
#include "catch.h"
#include "edits_support.h"
#include "field/prune.h"
#include "field/reference.h"
#include "mesh/check.h"
#include "rounds.h"
#include "stream/plan/frame.h"
#include "world_support.h"

using namespace sgm;

namespace {

// A layer without shapes. It completes a grammar that consists of nothing but its domain.
const std::string kNothing = "layer none cell 64m reach 1m { start None; }\nrule None { }\n";
const std::string kEmpty = "sgm 1; units m;\ndomain infinite empty;\n" + kNothing;
const std::string kSolid = "sgm 1; units m;\ndomain infinite solid;\n" + kNothing;

using Points3 = std::vector<Int3>;

struct Values {
  std::vector<int32_t> q;
  std::vector<float> value, x, y, z;
  std::vector<uint32_t> label;
};

Values valuesOf(const ProgramView& program, const Points3& places) {
  std::vector<int32_t> x, y, z;
  for (Int3 p : places) {
    x.push_back(p.x);
    y.push_back(p.y);
    z.push_back(p.z);
  }
  const size_t n = places.size();
  Values v{std::vector<int32_t>(n), std::vector<float>(n), std::vector<float>(n),
           std::vector<float>(n),   std::vector<float>(n), std::vector<uint32_t>(n)};
  EvalScratch scratch;
  const Points points{x.data(), y.data(), z.data(), n};
  scalarKernels().samples(program, points, scratch, v.q.data());
  scalarKernels().attributes(program, points, scratch,
                             {v.value.data(), v.x.data(), v.y.data(), v.z.data(), nullptr, nullptr, v.label.data()});
  return v;
}

bool sameBits(const Values& a, const Values& b) {
  const auto same = [](const auto& u, const auto& v) {
    return u.size() == v.size() && std::memcmp(u.data(), v.data(), u.size() * sizeof u[0]) == 0;
  };
  return same(a.q, b.q) && same(a.value, b.value) && same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z) &&
         same(a.label, b.label);
}

std::shared_ptr<const FieldProgram> compiled(const WorldField& world, const IntBox& box, int level,
                                             const EditSnapshot* edits) {
  const Result<std::shared_ptr<const FieldProgram>> program = world.compile(box, level, edits);
  REQUIRE(program);
  return *program;
}

WorldField worldOf(const std::string& text, int32_t cell = 256) {
  return {settingsOf(text, cell, 3), std::pmr::get_default_resource()};
}

Values at(const WorldField& world, const EditLog& log, const Points3& places, int level = 0) {
  IntBox box;
  for (Int3 p : places) box = box.joined({p, p});
  return valuesOf(compiled(world, box, level, log.snapshot().get())->view(), places);
}

Brush sphere(Int3 centre, int32_t radius, bool cut, int32_t smooth = 0, uint16_t material = 0) {
  Brush b;
  b.from = centre;
  b.radius = radius;
  b.cut = cut;
  b.smooth = smooth;
  b.material = material;
  return b;
}

// The brush's distance function in double precision.
double distanceTo(const Brush& b, Int3 p) {
  const double x = p.x - b.from.x, y = p.y - b.from.y, z = p.z - b.from.z;
  if (b.shape == Brush::Shape::sphere) return std::hypot(x, y, z) - b.radius;
  if (b.shape == Brush::Shape::capsule) {
    const double ax = b.to.x - b.from.x, ay = b.to.y - b.from.y, az = b.to.z - b.from.z;
    const double square = ax * ax + ay * ay + az * az;
    const double t = square > 0 ? std::clamp((x * ax + y * ay + z * az) / square, 0.0, 1.0) : 0.0;
    return std::hypot(x - t * ax, y - t * ay, z - t * az) - b.radius;
  }
  // Rotates the position by the conjugate quaternion: v + 2 w (u x v) + 2 u x (u x v), where u is the negated vector
  // part.
  double q[4], length = 0;
  for (size_t i = 0; i < 4; ++i) length += double{b.turn[i]} * double{b.turn[i]};
  for (size_t i = 0; i < 4; ++i) q[i] = double{b.turn[i]} / std::sqrt(length);
  const double ux = -q[0], uy = -q[1], uz = -q[2], w = q[3];
  const double cx = uy * z - uz * y, cy = uz * x - ux * z, cz = ux * y - uy * x;
  const double lx = x + 2 * (w * cx + uy * cz - uz * cy), ly = y + 2 * (w * cy + uz * cx - ux * cz),
               lz = z + 2 * (w * cz + ux * cy - uy * cx);
  const double ox = std::abs(lx) - b.half.x, oy = std::abs(ly) - b.half.y, oz = std::abs(lz) - b.half.z;
  return std::hypot(std::max(ox, 0.0), std::max(oy, 0.0), std::max(oz, 0.0)) + std::min(std::max({ox, oy, oz}), 0.0);
}

std::vector<const MeshPart*> partsOf(const std::pmr::vector<PlacedChunk>& chunks) {
  std::vector<PlacedPart> placed;
  for (const PlacedChunk& chunk : chunks) appendParts(chunk, placed);
  std::vector<const MeshPart*> parts;
  for (const PlacedPart& part : placed) parts.push_back(part.mesh);
  return parts;
}

std::pmr::vector<PlacedChunk> meshEdited(const WorldField& world, const std::vector<ChunkRequest>& requests,
                                         const EditSnapshot* edits) {
  const auto jobs = *makeThreadPool(2);
  Result<std::unique_ptr<Backend>> backend = makeBackend({}, *jobs, world.memory());
  REQUIRE(backend);
  Result<std::pmr::vector<PlacedChunk>> chunks = meshChunks(world, **backend, *jobs, requests, {}, edits);
  REQUIRE(chunks);
  return std::move(*chunks);
}

}  // namespace

TEST_CASE("a brush is solid or void inside, of its material, and nothing far away", "[edits]") {
  size_t inside = 0;
  for (uint32_t seed = 1; seed <= rounds(200); ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    // Every second seed tests positions far from the origin. Positions are integers, so they are as exact there as near
    // the origin.
    const int32_t far = seed % 2 ? 0 : 2'000'000'000;
    const IntBox around = IntBox{{far, -far, far}, {far, -far, far}}.grown(3000);
    Brush brush = randomBrush(random, around, 4000);
    brush.smooth = 0;
    brush.radius += 200;
    brush.half = saturatingAdd(brush.half, {200, 200, 200});
    const WorldField world = worldOf(brush.cut ? kSolid : kEmpty);
    EditLog log({1});
    REQUIRE(log.add(brush));
    Points3 places;
    for (int i = 0; i < 60; ++i) places.push_back(randomPlace(random, around.grown(i % 2 ? 8000 : 500)));
    const Values v = at(world, log, places);
    const IntBox reach = brushBounds(brush).grown(influenceMargin(256));
    for (size_t i = 0; i < places.size(); ++i) {
      const double d = distanceTo(brush, places[i]);
      const double expected = brush.cut ? -d : d;
      CAPTURE(places[i].x, places[i].y, places[i].z, d);
      if (!reach.contains(places[i])) {
        CHECK(std::abs(v.value[i]) == kFar);
        continue;
      }
      CHECK(std::abs(double{v.value[i]} - expected) < 0.1 + 1e-5 * std::abs(d));
      inside += d < 0;
      if (!brush.cut) CHECK(v.label[i] == makeLabel(brush.material, brush.tag));
    }
  }
  CHECK(inside > 2 * rounds(200));
}

TEST_CASE("later brushes lie above earlier ones, and an undo brings every bit back", "[edits]") {
  const WorldField world = worldOf(yardstick("cave.sgm"), 512);
  const IntBox hall = IntBox{{96 * 1024, 96 * 1024, 96 * 1024}, {96 * 1024, 96 * 1024, 96 * 1024}}.grown(12'000);
  std::mt19937 random(5);
  Points3 places;
  for (int i = 0; i < 4000; ++i) places.push_back(randomPlace(random, hall));
  EditLog log({1});
  const Values untouched = valuesOf(compiled(world, hall, 0, nullptr)->view(), places);
  CHECK(sameBits(untouched, valuesOf(compiled(world, hall, 0, log.snapshot().get())->view(), places)));
  std::vector<EditId> laid;
  std::vector<Values> stages{untouched};
  size_t changed = 0;
  for (int i = 0; i < 12; ++i) {
    laid.push_back(log.add(randomBrush(random, hall, 6000))->id);
    stages.push_back(valuesOf(compiled(world, hall, 0, log.snapshot().get())->view(), places));
    changed += !sameBits(stages[stages.size() - 2], stages.back());
  }
  CHECK(changed >= 6);
  for (size_t i = laid.size(); i-- > 0;) {
    REQUIRE(log.undo(laid[i]));
    CHECK(sameBits(stages[i], valuesOf(compiled(world, hall, 0, log.snapshot().get())->view(), places)));
  }

  // A place that is dug and then filled is solid; a place that is filled and then dug is void.
  for (const bool cut_last : {false, true}) {
    EditLog order({1});
    const Int3 middle{96 * 1024, 96 * 1024, 96 * 1024};
    REQUIRE(order.add(sphere(middle, 2000, !cut_last, 0, 2)));
    REQUIRE(order.add(sphere(middle, 2000, cut_last, 0, 3)));
    const Values v = at(world, order, {middle});
    CHECK((v.q[0] < 0) == !cut_last);
    CHECK((v.label[0] & 0xFFFF) == 3);
  }
}

TEST_CASE("a smooth brush is the round union with what is there, as wide as it says and no wider", "[edits]") {
  const WorldField world = worldOf(kEmpty);
  const int32_t k = 800;  // the influence boxes of both brushes contain all tested places
  for (const bool cut : {false, true}) {
    CAPTURE(cut);
    // Cutting the brush from the ground gives the negated field of adding the brush to the ground's complement. So one
    // formula gives the expected values of both cases.
    const Brush ground = sphere({0, -20'000, 0}, 20'000, false), brush = sphere({0, 600, 0}, 1000, cut, k);
    EditLog log({1}), below({1});
    REQUIRE(below.add(ground));
    REQUIRE(log.add(ground));
    REQUIRE(log.add(brush));
    std::mt19937 random(2);
    Points3 places;
    for (int i = 0; i < 3000; ++i) places.push_back(randomPlace(random, {{-2200, -1500, -2200}, {2200, 500, 2200}}));
    const Values with = at(world, log, places), without = at(world, below, places);
    size_t blended = 0, untouched = 0;
    for (size_t i = 0; i < places.size(); ++i) {
      const double f = distanceTo(ground, places[i]) * (cut ? -1 : 1), g = distanceTo(brush, places[i]);
      const double u = std::max(k - f, 0.0), v = std::max(k - g, 0.0);
      const double expected = (u > 0 && v > 0 ? k - std::hypot(u, v) : std::min(f, g)) * (cut ? -1 : 1);
      CHECK(std::abs(double{with.value[i]} - expected) < 0.1);
      CHECK((cut ? with.value[i] >= without.value[i] : with.value[i] <= without.value[i]));
      blended += u > 0 && v > 0;
      if (g > k + 1 && g > f + 1) {
        untouched += with.value[i] == without.value[i] && with.q[i] == without.q[i];
      } else {
        ++untouched;
      }
    }
    CHECK(blended > 300);
    CHECK(untouched == places.size());
  }
}

TEST_CASE("the field under brushes does not depend on which box asks, nor on pruning", "[edits]") {
  const WorldField world = worldOf(yardstick("cave.sgm"), 512);
  const Int3 middle{96 * 1024, 96 * 1024, 96 * 1024};
  const IntBox hall = IntBox{middle, middle}.grown(24'000);
  size_t dropped = 0, all = 0, sampled = 0;
  for (uint32_t seed = 1; seed <= rounds(6); ++seed) {
    std::mt19937 random(seed);
    EditLog log({1});
    for (int i = 0; i < 80; ++i) REQUIRE(log.add(randomBrush(random, hall, i % 5 == 0 ? 12'000 : 2500)));
    const auto edits = log.snapshot();
    for (int round = 0; round < 12; ++round) {
      CAPTURE(seed, round);
      const int level = round % 3;
      const Int3 corner = randomPlace(random, hall);
      const IntBox box = IntBox{corner, corner}.grown(1 << within(random, 8, 13));
      Points3 places;
      for (int i = 0; i < 300; ++i) places.push_back(randomPlace(random, box));
      const auto own = compiled(world, box, level, edits.get());
      const auto wide = compiled(world, hall.grown(9000), level, edits.get());
      const Values expected = valuesOf(wide->view(), places);
      CHECK(own->groups.size() <= wide->groups.size());
      CHECK(sameBits(expected, valuesOf(own->view(), places)));
      PruneScratch scratch;
      PrunedProgram pruned;
      prune(wide->view(), box, scratch, pruned);
      for (size_t i = 0; i < places.size(); ++i) {
        CHECK((double{expected.value[i]} >= pruned.field.lo && double{expected.value[i]} <= pruned.field.hi));
        CHECK(std::abs(referenceField(wide->view(), places[i]) - double{expected.value[i]}) <=
              1 + 1e-4 * std::abs(double{expected.value[i]}));
      }
      all += own->groups.size();
      if (pruned.solid() || pruned.empty()) {
        for (int32_t q : expected.q) CHECK((q < 0) == pruned.solid());
        dropped += own->groups.size();
        continue;
      }
      ++sampled;
      dropped += own->groups.size() - pruned.groups.size();
      CHECK(sameBits(expected, valuesOf(pruned.view(), places)));
    }
  }
  INFO(dropped << " of " << all << " groups pruned, " << sampled << " boxes sampled");
  CHECK(sampled >= 3 * rounds(6));
  CHECK(dropped * 4 > all);
}

TEST_CASE("a brush shows at every level whose cells are no wider than it is thick", "[edits]") {
  const WorldField world = worldOf(kEmpty, 256);
  Brush plate;
  plate.shape = Brush::Shape::box;
  plate.half = {4000, 512, 4000};
  EditLog log({1});
  REQUIRE(log.add(plate));
  for (int level = 0; level < 5; ++level) {
    CAPTURE(level);
    CHECK((at(world, log, {{0, 0, 0}}, level).q[0] < 0) == (world.cellAt(level) <= 1024));
  }
}

TEST_CASE("edited frames of several levels are closed, across every border", "[edits]") {
  // Coarse levels omit drips, octaves of noise and small brushes, so the levels' fields differ.
  const Int3 middle{96 * 1024, 96 * 1024, 96 * 1024};
  const WorldField world(settingsOf(yardstick("cave.sgm"), 128, 3), std::pmr::get_default_resource());
  for (uint32_t seed = 1; seed <= rounds(2); ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    Octree tree(3, 128);
    const int32_t edge = kChunkCells * 128 << 3;
    const Int3 top{middle.x / edge, middle.y / edge, middle.z / edge};
    tree.split({4, {top.x >> 1, top.y >> 1, top.z >> 1}});
    tree.split({3, top});
    tree.split({2, {2 * top.x + 1, 2 * top.y, 2 * top.z}});
    tree.split({1, {4 * top.x + 2, 4 * top.y + 1, 4 * top.z}});
    refineToRules(tree);
    // The edits lie around corners of chunks, where borders and seams of several levels meet.
    EditLog log({1});
    for (int i = 0; i < 60; ++i) {
      const int32_t step = kChunkCells * 128;
      Int3 corner;
      for (int axis = 0; axis < 3; ++axis) corner[axis] = top[axis] * edge + step * within(random, 0, 8);
      REQUIRE(log.add(randomBrush(random, IntBox{corner, corner}.grown(600), i % 6 == 0 ? 6000 : 900)));
    }
    const std::vector<ChunkRequest> requests = frameRequests(tree);
    const std::pmr::vector<PlacedChunk> before = meshEdited(world, requests, nullptr);
    const std::pmr::vector<PlacedChunk> after = meshEdited(world, requests, log.snapshot().get());
    const MeshReport report = checkParts(partsOf(after));
    INFO(describe(report));
    CHECK(report.closed());
    size_t bodies = 0, seams = 0, untouched = 0;
    for (size_t i = 0; i < after.size(); ++i) {
      const ChunkGrid& grid = after[i].grid;
      IntBox box{grid.origin, grid.origin};
      for (int axis = 0; axis < 3; ++axis) box.hi[axis] += kChunkCells * grid.cell;
      bool seams_differ = false;
      for (size_t f = 0; f < after[i].mesh.seams.size(); ++f) {
        seams_differ = seams_differ || after[i].mesh.seams[f].hash != before[i].mesh.seams[f].hash;
      }
      const bool body_differs = after[i].mesh.body.hash != before[i].mesh.body.hash;
      bool touched = false;
      for (const EditOperation& o : log.operations()) {
        touched = touched || editReach(brushBounds(o.brush), grid.cell).meets(box);
      }
      CHECK((touched || (!seams_differ && !body_differs)));
      bodies += body_differs;
      seams += seams_differ;
      untouched += !touched;
    }
    INFO(bodies << " bodies and " << seams << " chunks' seams differ, " << untouched << " of " << after.size()
                << " chunks untouched");
    CHECK(bodies > 10);
    CHECK(seams > 3);
    CHECK(untouched > 10);
  }
}

// Tests voids and paths by comparison with a flood fill of all samples at once.

#include <limits>
#include <random>

#include "caves.h"
#include "rounds.h"

using namespace sgm;

namespace {

class Random {
 public:
  explicit Random(uint32_t seed) : random_(seed) {}
  int below(int n) { return static_cast<int>(random_() % static_cast<uint32_t>(n)); }
  double real(double lo, double hi) { return lo + (hi - lo) * static_cast<double>(random_() >> 8) / 16777216.0; }
  bool chance(double p) { return real(0, 1) < p; }
  Int3 in(const IntBox& box) {
    Int3 p;
    for (int axis = 0; axis < 3; ++axis) p[axis] = box.lo[axis] + below(box.hi[axis] - box.lo[axis] + 1);
    return p;
  }

 private:
  std::mt19937 random_;
};

/// Fills the cave with random void samples. Their density is near the percolation threshold, at which the samples begin
/// to connect, so that voids cross each border very often.
void strew(Cave& cave, Random& random) {
  const double share = random.real(0.08, 0.3);
  for (size_t i = 0; i < cave.lattice.samples(); ++i) cave.lattice.set(cave.lattice.sampleAt(i), !random.chance(share));
}

/// Digs tubes of many widths between random places.
void digTubes(Cave& cave, Random& random) {
  const int tubes = 2 + random.below(8);
  for (int i = 0; i < tubes; ++i) {
    const Int3 a = random.in(cave.region()), b = random.in(cave.region());
    const double radius = random.real(0, 5);
    for (int t = 0; t <= 60; ++t) {
      const auto at = [&](int lo, int hi) { return lo + (hi - lo) * t / 60; };
      digBall(cave, {at(a.x, b.x), at(a.y, b.y), at(a.z, b.z)}, radius);
    }
  }
}

/// Digs threads one sample wide along diagonals of faces, which are connected, and sometimes of cells, which are not.
void spinThreads(Cave& cave, Random& random) {
  const int threads = 1 + random.below(4);
  for (int i = 0; i < threads; ++i) {
    Int3 at = random.in(cave.region());
    for (int t = 0; t < 400; ++t) {
      cave.lattice.set(at, false);
      Int3 step = joiningSteps()[static_cast<size_t>(random.below(18))];
      if (random.chance(0.01)) step = {random.below(2) * 2 - 1, random.below(2) * 2 - 1, random.below(2) * 2 - 1};
      const Int3 to{at.x + step.x, at.y + step.y, at.z + step.z};
      if (cave.region().contains(to)) at = to;
    }
  }
}

/// Builds walls across the region, each with a gap of one sample at alternating ends, so that the path winds through
/// all chunks. Some gaps are missing.
void buildMaze(Cave& cave, Random& random) {
  for (size_t i = 0; i < cave.lattice.samples(); ++i) {
    const Int3 p = cave.lattice.sampleAt(i);
    cave.lattice.set(p, !cave.region().contains(p));
  }
  const int apart = 2 + random.below(7), axis = random.below(3), across = (axis + 1 + random.below(2)) % 3;
  const Int3 end = cave.region().hi;
  bool high = false;
  for (int wall = apart; wall < end[axis]; wall += apart, high = !high) {
    const bool open = !random.chance(0.05);
    const int other = 3 - axis - across, at = random.below(end[other] + 1);
    for (int a = 0; a <= end[across]; ++a)
      for (int b = 0; b <= end[other]; ++b) {
        Int3 p;
        p[axis] = wall, p[across] = a, p[other] = b;
        if (!(open && a == (high ? end[across] : 0) && b == at)) cave.lattice.set(p, true);
      }
  }
}

constexpr uint32_t kTubes = 1;

Cave randomCave(uint32_t kind, Random& random) {
  const std::array<Int3, 6> sizes{{{1, 1, 1}, {2, 1, 1}, {1, 2, 1}, {1, 1, 2}, {2, 2, 1}, {1, 2, 2}}};
  Cave cave(sizes[static_cast<size_t>(random.below(6))]);
  switch (kind % 4) {
    case 0:
      strew(cave, random);
      break;
    case kTubes:
      digTubes(cave, random);
      break;
    case 2:
      spinThreads(cave, random);
      break;
    default:
      buildMaze(cave, random);
  }
  return cave;
}

/// Returns a random void sample. Sometimes, or if there is no void sample, returns an arbitrary sample instead.
Int3 someSample(Random& random, const Cave& cave, const FloodedVoids& flooded) {
  const Int3 any = random.in(cave.region());
  if (random.chance(0.03)) return any;
  for (size_t i = 0, start = cave.lattice.index(any); i < cave.lattice.samples(); ++i) {
    const Int3 p = cave.lattice.sampleAt((start + i) % cave.lattice.samples());
    if (flooded.open(p)) return p;
  }
  return any;
}

/// Counts of the situations that have occurred in the random tests. They prove that the tests cover each situation.
struct Seen {
  size_t found = 0, apart = 0, narrow = 0, rock = 0;
  double walked = 0, shortest = 0;
};

/// Compares one query of a cave with a flood fill.
void compare(const SignField& field, const Cave& cave, Random& random, double radius, Seen& seen) {
  const FloodedVoids flooded(cave.lattice, cave.region(), radius);
  const Int3 from = someSample(random, cave, flooded), to = someSample(random, cave, flooded);
  CAPTURE(radius, from.x, from.y, from.z, to.x, to.y, to.z);
  const VoidAnswer answer = answered(field, questionOf(cave, from, to, radius, false, field.cell));
  CHECK(answer.voids == flooded.voids());
  REQUIRE(answer.way);
  const VoidWay& way = *answer.way;
  if (cave.lattice.solid(from) || cave.lattice.solid(to)) {
    // If an end lies in rock, the search starts at one of the void samples around it, so the results are not compared.
    ++seen.rock;
    return;
  }
  CHECK((way.verdict == WayVerdict::found) == flooded.joined(from, to));
  CHECK((way.verdict == WayVerdict::from_too_narrow) == !flooded.open(from));
  CHECK((way.verdict == WayVerdict::to_too_narrow) == (flooded.open(from) && !flooded.open(to)));
  CHECK((way.from_samples == flooded.samplesOf(from) && way.to_samples == flooded.samplesOf(to)));
  seen.narrow += !flooded.open(from) || !flooded.open(to);
  if (way.verdict != WayVerdict::found) {
    seen.apart += way.verdict == WayVerdict::apart;
    CHECK(way.places.empty());
    return;
  }
  ++seen.found;
  CHECK(isWay(way, flooded, from, to, field.cell));
  const double shortest = flooded.shortest(from, to) * field.cell;
  CHECK(way.length >= shortest * (1 - 1e-9));
  // With a single chunk, the search has no choice between chunks. Step costs are whole numbers, with an error of 5 in
  // 100,000.
  if (cave.chunks == Int3{1, 1, 1}) CHECK(way.length <= shortest * 1.0001);
  seen.walked += way.length;
  seen.shortest += shortest;
}

}  // namespace

TEST_CASE("random caves: voids and verdicts are those of a flood of all samples, and ways hold") {
  Seen seen;
  for (uint32_t seed = 1; seed <= rounds(800); ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const Cave cave = randomCave(seed, random);
    // Scattered void samples and thin tubes are one sample wide, so that agents which are larger than a sample do not
    // fit in.
    const int widths = seed % 2 == 0 && random.chance(0.9) ? 2 : 5;
    const double radius = std::array{0.0, 0.9, 1.0, 1.5, 2.3}[static_cast<size_t>(random.below(widths))];
    compare(cave.lattice.field(kCell), cave, random, radius, seen);
  }
  WARN(seen.found << " ways, on average " << seen.walked / seen.shortest << " times the shortest; " << seen.apart
                  << " apart, " << seen.narrow << " too narrow, " << seen.rock << " in rock");
  CHECK(seen.found * 6 > rounds(800));
  CHECK(seen.apart * 20 > rounds(800));
  CHECK(seen.walked < 1.5 * seen.shortest);
}

TEST_CASE("caves of grammars: voids and verdicts are those of a flood of all samples, and ways hold") {
  const std::string halls = yardstick("cave.sgm"), holes =
                                                       "sgm 1; domain infinite solid; layer main cell 32m reach 8m { "
                                                       "start Holes; } rule Holes { cut { scatter poisson(4.5m) { "
                                                       "sphere(3m); } } }";
  Seen seen;
  for (uint32_t seed = 1; seed <= rounds(200); ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const bool is_hall = seed % 8 == 0;
    const WorldField world(settingsOf(is_hall ? halls : holes, 1024, seed), std::pmr::get_default_resource());
    Int3 first = random.in({{-9, -9, -9}, {9, 9, 9}});
    if (is_hall) {
      // Most of the cave's world is rock, so the region is chosen around a place in a chamber.
      const auto anchors = world.anchors({{0, 0, 0}, {192 * 1024, 192 * 1024, 192 * 1024}});
      REQUIRE(anchors);
      REQUIRE(!anchors->empty());
      const Int3 at = (*anchors)[static_cast<size_t>(random.below(static_cast<int>(anchors->size())))].frame.origin;
      first = {(at.x >> 15) - random.below(2), at.y >> 15, (at.z >> 15) - random.below(2)};
    }
    const Cave cave(world, {2, 1, 2}, first);
    compare(signField(queryField(world)), cave, random, random.below(4) * 0.5, seen);
  }
  WARN(seen.found << " ways, on average " << seen.walked / seen.shortest << " times the shortest; " << seen.apart
                  << " apart, " << seen.narrow << " too narrow, " << seen.rock << " in rock");
  CHECK(seen.found * 10 > rounds(200));
  CHECK(seen.apart * 20 > rounds(200));
}

TEST_CASE("the widest agent's radius parts those that pass from those that do not") {
  size_t passed = 0, none = 0, wide = 0;
  for (uint32_t seed = 1; seed <= rounds(60); ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const Cave cave = randomCave(seed % 2 == 0 ? kTubes : seed, random);
    const FloodedVoids any(cave.lattice, cave.region(), 0);
    // Most places in a tube are near its wall, where only small agents fit.
    const FloodedVoids roomy(cave.lattice, cave.region(), 1.5);
    const FloodedVoids& chosen = seed % 2 == 0 ? roomy : any;
    const Int3 from = someSample(random, cave, chosen), to = someSample(random, cave, chosen);
    if (!any.open(from) || !any.open(to)) continue;
    const SignField field = cave.lattice.field(kCell);
    const VoidWay asked = *answered(field, questionOf(cave, from, to, random.real(0, 6), true)).way;
    const double widest = asked.widest / kCell;
    if (widest == 0) {
      ++none;
      CHECK_FALSE(any.joined(from, to));
      continue;
    }
    REQUIRE(widest < kBeyond);
    CHECK(widest <= std::min(asked.from_clearance, asked.to_clearance) / kCell);
    ++passed;
    wide += widest > 1.5;
    // The flood fill and the search round squared distances differently.
    CHECK(FloodedVoids(cave.lattice, cave.region(), widest * (1 - 1e-9)).joined(from, to));
    CHECK_FALSE(FloodedVoids(cave.lattice, cave.region(), widest * (1 + 1e-9)).joined(from, to));
    CHECK(answered(field, questionOf(cave, from, to, std::nextafter(widest, 0))).way->verdict == WayVerdict::found);
    CHECK(answered(field, questionOf(cave, from, to, widest)).way->verdict != WayVerdict::found);
    // The answer does not depend on earlier queries.
    for (const double radius : {0.0, widest / 2, 30.0})
      CHECK(answered(field, questionOf(cave, from, to, radius, true)).way->widest == asked.widest);
  }
  WARN(passed << " pairs of places have a way, " << none << " have none; " << wide << " ways are wider than a sample");
  CHECK((passed > 0 && none > 0 && wide > 0));
}

TEST_CASE("the widest agent's radius itself is too wide by the last bit, for every distance between samples",
          "[costly]") {
  // The offset from the place to the nearest solid sample is (a, b, c); tests odd cell sizes, too.
  size_t rounded_down = 0;
  for (const int32_t cell : {256, 333}) {
    for (int a = 1; a <= 5; ++a) {
      for (int b = 0; b <= a; ++b) {
        for (int c = 0; c <= b; ++c) {
          CAPTURE(cell, a, b, c);
          Cave cave({1, 1, 1});
          digBall(cave, {16, 16, 16}, 12);
          cave.lattice.set({16 + a, 16 + b, 16 + c}, true);
          const SignField field = cave.lattice.field(cell);
          VoidQuestion question = questionOf(cave, {16, 16, 16}, {16, 16, 16}, 0, true, cell);
          const VoidWay asked = *answered(field, question).way;
          CHECK(asked.widest == asked.from_clearance);
          question.ends->widest = false;
          question.radius = asked.widest;
          CHECK(answered(field, question).way->verdict == WayVerdict::from_too_narrow);
          question.radius = std::nextafter(asked.widest, 0);
          CHECK(answered(field, question).way->verdict == WayVerdict::found);
          const double square = a * a + b * b + c * c, root = std::sqrt(square);
          CHECK(asked.widest == Approx(root * cell).epsilon(1e-15));
          rounded_down += root * root < square;
        }
      }
    }
  }
  CHECK(rounded_down > 2 * 5);
}

TEST_CASE("a hall wide enough has its agent told exactly, up to 32 cells") {
  Cave cave({2, 2, 2});
  for (const double radius : {17.0, 31.0}) {
    CAPTURE(radius);
    digBall(cave, {32, 32, 32}, radius);
    const VoidWay way =
        *answered(cave.lattice.field(kCell), questionOf(cave, {32, 32, 32}, {32, 33, 32}, 16, true)).way;
    // Compares with the distance to the nearest of all solid samples: a smaller agent fits at both ends.
    double nearest = 1e9;
    for (size_t i = 0; i < cave.lattice.samples(); ++i) {
      const Int3 p = cave.lattice.sampleAt(i);
      if (!cave.lattice.solid(p)) continue;
      for (const int y : {32, 33}) nearest = std::min(nearest, std::hypot(p.x - 32, p.y - y, p.z - 32));
    }
    CHECK(way.widest == Approx(nearest * kCell).epsilon(1e-12));
    CHECK((way.verdict == WayVerdict::found) == (nearest > 16));
  }
  SignField open;
  open.cell = kCell;
  open.signs = [](Int3) -> Result<ChunkSigns> { return ChunkSigns{}; };
  const VoidWay way = *answered(open, questionOf(cave, {1, 2, 3}, {60, 50, 40}, 31.9, true)).way;
  CHECK(way.verdict == WayVerdict::found);
  CHECK(way.widest == 32.0 * kCell);
  CHECK(way.from_clearance == 32.0 * kCell);
}

TEST_CASE("a way for a radius is one for all that are smaller", "[costly]") {
  size_t changed = 0;
  for (uint32_t seed = 1; seed <= rounds(40); ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const Cave cave = randomCave(kTubes, random);
    const FloodedVoids any(cave.lattice, cave.region(), 0);
    const Int3 from = someSample(random, cave, any), to = someSample(random, cave, any);
    bool before = true;
    for (const double radius : {0.0, 0.5, 1.0, 1.3, 1.6, 2.0, 2.5, 3.0, 4.0, 5.0}) {
      CAPTURE(radius);
      const bool now =
          answered(cave.lattice.field(kCell), questionOf(cave, from, to, radius)).way->verdict == WayVerdict::found;
      CHECK((before || !now));
      changed += before && !now && radius > 0;
      before = now;
    }
  }
  CHECK(changed > 0);
}

TEST_CASE("a way that winds through every chunk of a spiral is walked to its end") {
  // Walls half a chunk apart, with gaps at alternating ends.
  Cave cave({3, 3, 1});
  for (size_t i = 0; i < cave.lattice.samples(); ++i) {
    const Int3 p = cave.lattice.sampleAt(i);
    const bool wall = p.x % 12 == 11 && p.y != (p.x / 12 % 2 == 0 ? 96 : 0);
    cave.lattice.set(p, !cave.region().contains(p) || wall || p.z != 16);
  }
  const SignField field = cave.lattice.field(kCell);
  const FloodedVoids flooded(cave.lattice, cave.region(), 0);
  const VoidAnswer answer = answered(field, questionOf(cave, {0, 0, 16}, {96, 96, 16}, 0, true), 2);
  REQUIRE(answer.way->verdict == WayVerdict::found);
  CHECK(isWay(*answer.way, flooded, {0, 0, 16}, {96, 96, 16}, kCell));
  CHECK(answer.way->length > 8 * 96.0 * kCell);
  CHECK(answer.way->length < 1.05 * flooded.shortest({0, 0, 16}, {96, 96, 16}) * kCell);
  CHECK(answer.way->widest == kCell);
  CHECK(answer.chunks == 9);
  CHECK(answer.voids.size() == 1);
}

TEST_CASE("any number of threads answers the same", "[threads]") {
  for (uint32_t seed = 1; seed <= rounds(10); ++seed) {
    CAPTURE(seed);
    Random random(seed);
    Cave cave({3, 2, 2});
    if (seed % 2 == 0) {
      digTubes(cave, random);
    } else {
      strew(cave, random);
    }
    const FloodedVoids any(cave.lattice, cave.region(), 0);
    const VoidQuestion question =
        questionOf(cave, someSample(random, cave, any), someSample(random, cave, any), seed % 3 * 0.6, true);
    const VoidAnswer one = answered(cave.lattice.field(kCell), question, 1);
    for (const unsigned threads : {2u, 3u, 8u}) {
      const VoidAnswer other = answered(cave.lattice.field(kCell), question, threads);
      CHECK(other.voids == one.voids);
      CHECK(other.way->verdict == one.way->verdict);
      CHECK(other.way->places == one.way->places);
      CHECK((other.way->length == one.way->length && other.way->widest == one.way->widest));
    }
  }
}

TEST_CASE("places stand for the nearest void sample of the eight around them") {
  Cave cave({1, 1, 1});
  digBall(cave, {16, 16, 16}, 6);
  const SignField field = cave.lattice.field(kCell);
  VoidQuestion question = questionOf(cave, {16, 16, 16}, {16, 16, 16}, 0);
  question.ends->from = {16.4 * kCell, 15.6 * kCell, 16.0 * kCell};
  // This place is nearer to the rock at sample 23 than to the rock at sample 22.
  question.ends->to = {16.0 * kCell, 22.6 * kCell, 16.0 * kCell};
  VoidAnswer answer = answered(field, question);
  REQUIRE(answer.way->verdict == WayVerdict::found);
  CHECK(answer.way->places.size() == 7);
  CHECK(answer.way->places.back() == Int3{16 * kCell, 22 * kCell, 16 * kCell});
  CHECK(answer.way->from_clearance > 6.0 * kCell);
  CHECK(answer.way->to_clearance == 1.0 * kCell);
  question.radius = kCell;
  CHECK(answered(field, question).way->verdict == WayVerdict::to_too_narrow);
  std::swap(question.ends->from, question.ends->to);
  CHECK(answered(field, question).way->verdict == WayVerdict::from_too_narrow);
  question.ends->from = {16.0 * kCell, 24.5 * kCell, 16.0 * kCell};
  answer = answered(field, question);
  CHECK(answer.way->verdict == WayVerdict::from_in_rock);
  CHECK((answer.way->from_clearance == 0 && answer.way->widest == 0));
  std::swap(question.ends->from, question.ends->to);
  question.ends->widest = true;
  CHECK(answered(field, question).way->verdict == WayVerdict::to_in_rock);
  question.ends.reset();
  answer = answered(field, question);
  CHECK_FALSE(answer.way);
  REQUIRE(answer.voids.size() == 1);
  CHECK(answer.voids[0].sealed);
  CHECK(answer.sample == 0.125);
  CHECK((answer.extent == IntBox{{0, 0, 0}, {32 * kCell, 32 * kCell, 32 * kCell}}));
}

#include "derive/layout/automaton.h"

#include <random>

#include "derive_fixture.h"
#include "rounds.h"
#include "seed.h"

using namespace sgm;

namespace {

int32_t between(std::mt19937& random, int32_t low, int32_t high) {
  return std::uniform_int_distribution<int32_t>(low, high)(random);
}

Automaton anyAutomaton(std::mt19937& random) {
  Automaton a;
  a.seed = random();
  for (size_t axis = 0; axis < 3; ++axis) a.axes[axis] = random() % 4 != 0;
  a.fill = 0.01 * between(random, 30, 70);
  a.rounds = between(random, 0, 4);
  a.radius = between(random, 1, 2);
  int32_t neighbours = 1;
  for (const bool axis : a.axes) neighbours *= axis ? 2 * a.radius + 1 : 1;
  a.least = between(random, neighbours / 3, 2 * neighbours / 3 + 1);
  return a;
}

VoxelBox anyBox(std::mt19937& random, const Automaton& automaton, int32_t most) {
  VoxelBox box{{0, 0, 0}, {1, 1, 1}};
  for (int axis = 0; axis < 3; ++axis) {
    if (!automaton.axes[static_cast<size_t>(axis)]) continue;
    box.first[axis] = between(random, 0, 3) == 0 ? between(random, -2'000'000, 2'000'000) : between(random, -20, 20);
    box.count[axis] = between(random, 1, most);
  }
  return box;
}

size_t indexIn(const VoxelBox& box, Int3 at) {
  return (static_cast<size_t>(at.z) * static_cast<size_t>(box.count.y) + static_cast<size_t>(at.y)) *
             static_cast<size_t>(box.count.x) +
         static_cast<size_t>(at.x);
}

/// Calls visit with every place in the box.
template <class Visit>
void forAll(const VoxelBox& box, Visit visit) {
  Int3 at;
  for (at.z = 0; at.z < box.count.z; ++at.z)
    for (at.y = 0; at.y < box.count.y; ++at.y)
      for (at.x = 0; at.x < box.count.x; ++at.x) visit(at);
}

/// Computes the automaton by the plain algorithm: round by round and neighbour by neighbour, in a box much larger than
/// necessary, outside of which nothing is solid.
std::vector<uint8_t> straightforward(const Automaton& automaton, const VoxelBox& box) {
  VoxelBox large = box;
  Int3 margin;
  for (int axis = 0; axis < 3; ++axis) {
    if (automaton.axes[static_cast<size_t>(axis)]) margin[axis] = automaton.halo() + 2;
    large.first[axis] -= margin[axis];
    large.count[axis] += 2 * margin[axis];
  }
  Automaton start = automaton;
  start.rounds = 0;
  std::vector<uint8_t> state = runAutomaton(start, large);
  for (int32_t round = 0; round < automaton.rounds; ++round) {
    const std::vector<uint8_t> before = state;
    forAll(large, [&](Int3 at) {
      int32_t solid = 0;
      const auto reach = [&](int axis) { return automaton.axes[static_cast<size_t>(axis)] ? automaton.radius : 0; };
      for (int32_t z = at.z - reach(2); z <= at.z + reach(2); ++z)
        for (int32_t y = at.y - reach(1); y <= at.y + reach(1); ++y)
          for (int32_t x = at.x - reach(0); x <= at.x + reach(0); ++x) {
            const bool inside =
                x >= 0 && y >= 0 && z >= 0 && x < large.count.x && y < large.count.y && z < large.count.z;
            if (inside) solid += before[indexIn(large, {x, y, z})];
          }
      state[indexIn(large, at)] = solid >= automaton.least;
    });
  }
  std::vector<uint8_t> out;
  forAll(box, [&](Int3 at) {
    out.push_back(state[indexIn(large, {at.x + margin.x, at.y + margin.y, at.z + margin.z})]);
  });
  return out;
}

}  // namespace

TEST_CASE("an automaton in a box is part of the one over the whole world") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  size_t solid = 0, all = 0;
  // Every build tests at least 150 boxes, because shares of the voxels are checked below. With only a dozen boxes, a
  // few large ones would have most of the voxels, and might be all rock or all air.
  const unsigned boxes = std::max(rounds(150), 150u);
  for (unsigned round = 0; round < boxes; ++round) {
    const Automaton automaton = anyAutomaton(random);
    const VoxelBox box = anyBox(random, automaton, 9);
    CAPTURE(round, automaton.rounds, automaton.radius, automaton.least);
    const std::vector<uint8_t> found = runAutomaton(automaton, box);
    CHECK(found == straightforward(automaton, box));
    solid += static_cast<size_t>(std::count(found.begin(), found.end(), 1));
    all += found.size();
  }
  CHECK(solid > all / 10);
  CHECK(solid < all - all / 10);
}

TEST_CASE("as many voxels start solid as are asked for, and each side of a box draws anew") {
  for (const double fill : {0.0, 0.1, 0.5, 0.8, 1.0}) {
    Automaton automaton;
    automaton.fill = fill;
    automaton.rounds = 0;
    const std::vector<uint8_t> found = runAutomaton(automaton, {{-20, 7, 1000}, {40, 40, 40}});
    const auto solid = static_cast<double>(std::count(found.begin(), found.end(), 1));
    CHECK(std::abs(solid / 64000 - fill) < 0.012);
    if (fill != 0.5) continue;
    std::array<int, 3> alike{};
    const auto at = [&](int x, int y, int z) { return found[static_cast<size_t>((z * 40 + y) * 40 + x)]; };
    for (int z = 0; z < 39; ++z)
      for (int y = 0; y < 39; ++y)
        for (int x = 0; x < 39; ++x) {
          alike[0] += at(x, y, z) == at(x + 1, y, z);
          alike[1] += at(x, y, z) == at(x, y + 1, z);
          alike[2] += at(x, y, z) == at(x, y, z + 1);
        }
    for (const int count : alike) CHECK(std::abs(count / 59319.0 - 0.5) < 0.02);
  }
}

namespace {

std::string layered(double cell, const std::string& axes, const std::string& arguments) {
  return "sgm 1; units m; domain infinite" + axes + ";\nlayer caves cell " + std::to_string(cell) +
         "m reach 4m { start Cave; }\nrule Cave { meet { ca(" + arguments + "); at(0m, 20m, 0m) box(1000m); } }\n";
}

bool solidAt(const GrammarChunk& chunk, const VoxelBlock& b, Int3 index) {
  VoxelBox box{b.first, {std::max(b.count.x, 1), std::max(b.count.y, 1), std::max(b.count.z, 1)}};
  const size_t i = indexIn(box, saturatingSub(index, b.first));
  return (chunk.voxels[b.first_word + i / 64] >> (i % 64) & 1) != 0;
}

}  // namespace

TEST_CASE("cells share the voxels between them, and hold all that decide about theirs") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  for (unsigned round = 0; round < rounds(12); ++round) {
    const bool flat = random() % 3 == 0;
    const double edge = 0.5 + 0.3 * between(random, 0, 4), cell = 5 + between(random, 0, 19);
    const std::string arguments = std::to_string(edge) + "m, fill " + std::to_string(35 + random() % 30) +
                                  "%, rounds " + std::to_string(random() % 4) + ", radius " +
                                  std::to_string(1 + random() % 2) + ", salt " + std::to_string(random() % 9);
    CAPTURE(round, arguments, cell, flat);
    const auto program = compiled(layered(cell, flat ? " axes xz" : "", arguments));
    const Int3 home{between(random, -40'000, 40'000), flat ? 0 : between(random, -3, 3), between(random, -3, 3)};
    const GrammarChunk a = derived(*program, home, seed);
    REQUIRE(a.blocks.size() == 1);
    const VoxelBlock& mine = a.blocks[0];
    const IntBox own = cellBox(program->layers[0], home);
    for (int axis = 0; axis < 3; ++axis) {
      if (flat && axis == 1) {
        CHECK(mine.count[axis] == 0);
        continue;
      }
      CHECK((int64_t{mine.first[axis]} + kVoxelMargin) * mine.edge <= own.lo[axis]);
      CHECK((int64_t{mine.first[axis]} + mine.count[axis] - 1 - kVoxelMargin) * mine.edge > own.hi[axis]);
    }
    Int3 next = home;
    ++next[flat ? 2 : between(random, 0, 2)];
    const GrammarChunk b = derived(*program, next, seed);
    REQUIRE(b.blocks.size() == 1);
    const VoxelBlock& theirs = b.blocks[0];
    size_t common = 0, differ = 0;
    forAll({mine.first, {std::max(mine.count.x, 1), std::max(mine.count.y, 1), std::max(mine.count.z, 1)}},
           [&](Int3 at) {
             const Int3 index = saturatingAdd(mine.first, at);
             for (int axis = 0; axis < 3; ++axis) {
               if (theirs.count[axis] == 0) continue;
               if (index[axis] < theirs.first[axis] || index[axis] >= theirs.first[axis] + theirs.count[axis]) return;
             }
             ++common;
             differ += solidAt(a, mine, index) != solidAt(b, theirs, index);
           });
    CHECK(common > 500);
    CHECK(differ == 0);
  }
}

TEST_CASE("a salt makes another automaton, and another rule the same") {
  const auto blockOf = [](const std::string& rules) { return derivedRules("rule Main { Cave; }\n" + rules).voxels; };
  const auto plain = blockOf("rule Cave { ca(2m); }");
  CHECK(plain == blockOf("rule Cave { Other; } rule Other { mat clay; ca(2m, rounds 4, salt 0); }"));
  CHECK(plain != blockOf("rule Cave { ca(2m, salt 1); }"));
}

TEST_CASE("an automaton whose arguments come out wrong is left out with a note") {
  const auto noteOf = [](const std::string& arguments) {
    const GrammarChunk chunk = derivedRules(
        "param small = 1cm in 1cm..2m; param large = 70m in 1m..200m;\n"
        "param count = 9 in 0..200; param below = -1 in -1..1;\n"
        "rule Main { ca(" +
        arguments + "); }");
    CHECK(chunk.shapes.size() == (chunk.notes.empty() ? 1u : 0u));
    return chunk.notes.empty() ? std::string() : chunk.notes[0].message;
  };
  const std::string wide =
      "a cell of the layer is from 1 to 64 voxels of `ca` wide: here a voxel has from 1 m to 64 m; ";
  CHECK(noteOf("2m, fill count/10, rounds count, threshold count/10") == "");
  CHECK(noteOf("small") == wide + "it is left out");
  CHECK(noteOf("large") == wide + "it is left out");
  CHECK(noteOf("2m, fill count") == "the fill of `ca` is from 0% to 100%: such as fill 45%; it is left out");
  CHECK(noteOf("2m, rounds 2*count") == "`ca` has from 0 to 16 rounds: such as rounds 4; it is left out");
  CHECK(noteOf("2m, threshold below") ==
        "the threshold of `ca` is from 0% to 100%: such as threshold 50%; it is left out");
  CHECK(noteOf("2m, radius count") ==
        "the radius of `ca` is a number, from 1 to 4 voxels: such as radius 1; it is left out");
  CHECK(noteOf("2m, rounds count, radius 2") ==
        "rounds times radius of `ca` is at most 16: so many voxels around each cell are computed with it; it is left "
        "out");
}

TEST_CASE("translation moves voxels, and the hash tells them apart") {
  const auto program = compiled(layered(16, "", "1m"));
  GrammarChunk chunk = derived(*program, {1, 2, -3});
  const uint64_t hash = hashChunk(chunk);
  const Int3 by{1000, -2000, 3000};
  const Int3 anchor = chunk.blocks[0].anchor, centre = chunk.shapes[0].frame.origin;
  translate(chunk, by);
  CHECK(chunk.blocks[0].anchor == saturatingAdd(anchor, by));
  CHECK(chunk.shapes[0].frame.origin == saturatingAdd(centre, by));
  CHECK(hashChunk(chunk) != hash);
  translate(chunk, {-1000, 2000, -3000});
  CHECK(hashChunk(chunk) == hash);
  chunk.voxels[3] ^= 16;
  CHECK(hashChunk(chunk) != hash);
}

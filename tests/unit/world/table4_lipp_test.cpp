// Tests the claims of the row Lipp in the paper's Table 4, with the sample that represents it: local edits of single
// parts stay in place when rules and parameters change, and are reported if their part no longer exists. The sample's
// own `expect` statements test that it is closed and connected.

#include <algorithm>
#include <cmath>
#include <random>

#include "field/evaluate.h"
#include "rounds.h"
#include "seed.h"
#include "world_support.h"

using namespace sgm;

namespace {

constexpr double kGroundFloor = 4.6, kAtticFloor = 1.4, kEndPier = 0.6;
constexpr IntBox kEverywhere{{-60 * 1024, -80 * 1024, -60 * 1024}, {60 * 1024, 80 * 1024, 60 * 1024}};

struct Palace {
  double floors = 3, wide = 26, deep = 14, bay = 3, round = 0.2;

  double height() const { return 6 + 4 * floors; }
  double storey() const { return (height() - kGroundFloor - kAtticFloor) / floors; }
  int bays() const { return static_cast<int>(std::floor((wide - 2 * kEndPier) / bay + 0.5)); }
  double bayAt(int bay_index) const {
    return -0.5 * wide + kEndPier + (bay_index + 0.5) * (wide - 2 * kEndPier) / bays();
  }
  double storeyAt(double index) const { return -0.5 * height() + kGroundFloor + (index + 0.5) * storey(); }
};

/// Changes the base grammar at random, but only parts of it that the edits do not address.
std::string editedElsewhere(std::string text, std::mt19937& random) {
  const auto chance = [&] { return random() % 2 == 0; };
  if (chance()) text = replaced(text, "rule Pier {", "rule Chimney { box(1m, 3m, 1m); }\nrule Pier {");
  if (chance()) text = replaced(text, "{ Body; Plinth; }", "{ Plinth; Body; }");
  if (chance())
    text = replaced(text, "rule Bay(h) weight round", "rule Bay(h) weight 0.3 { Pier; }\nrule Bay(h) weight round");
  if (chance())
    text = replaced(text, "rule Storey { Core;", "rule Storey { let a = rand(0m, 1m); Core; at(y a) box(0.5m);");
  if (chance()) text = replaced(text, "side: Facade(2.3m); top: Cornice;", "top: Cornice; side: Facade(2.3m);");
  if (chance())
    text =
        replaced(text, "rule Pier { facade.Wall; }", "rule Pier { at(z -0.2m) size(z 0.4m) box(scope); mat granite; }");
  if (chance()) {
    for (const char* use : {"Quoin; } }\nrule Storey", "Quoin; } }\nrule Attic"})
      text = replaced(text, use, "Corner" + std::string(use).substr(5));
    text = replaced(text, "rule Quoin", "rule Corner");
  }
  return text;
}

WorldField worldOf(const std::string& text, const Palace& palace, uint64_t seed) {
  WorldFieldSettings settings = settingsOf(text, 128, seed);
  for (const auto& [name, value] : {std::pair{"floors", palace.floors},
                                    {"wide", palace.wide},
                                    {"deep", palace.deep},
                                    {"bay", palace.bay},
                                    {"round", palace.round}})
    REQUIRE(settings.parameters.set(*settings.program, name, value));
  return {std::move(settings), std::pmr::get_default_resource()};
}

bool isSolid(const WorldField& world, double x, double y, double z) {
  const auto units = [](double metres) { return static_cast<int32_t>(std::lround(metres * kUnitsPerMetre)); };
  const Int3 p{units(x), units(y), units(z)};
  const auto program = world.compile({p, p}, 0);
  REQUIRE(program);
  int32_t q = 0;
  EvalScratch scratch;
  scalarKernels().samples((*program)->view(), {&p.x, &p.y, &p.z, 1}, scratch, &q);
  return q < 0;
}

/// Returns the grammar's text up to the edits, which are at its end.
std::string lippWithoutEdits(const std::string& text) { return text.substr(0, text.find("// The gate:")); }

}  // namespace

TEST_CASE("Lipp: edits of parts hold where they are while rules and parameters are edited", "[table4]") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  for (unsigned round = 0; round < rounds(24); ++round) {
    const Palace palace{3 + std::floor(5 * unit(random)), 24 + 30 * unit(random), 10 + 20 * unit(random),
                        2.5 + 0.5 * unit(random), unit(random)};
    const std::string text = editedElsewhere(sample("table4/lipp.sgm"), random);
    CAPTURE(palace.floors, palace.wide, palace.deep, palace.bay, palace.round, text);
    const WorldField world = worldOf(text, palace, random()), plain = worldOf(lippWithoutEdits(text), palace, random());

    auto balconies = world.instances(ruleNamed(*world.settings().program, "Balcony"), kEverywhere, 100);
    REQUIRE(balconies);
    REQUIRE(balconies->size() == 2);
    std::sort(balconies->begin(), balconies->end(),
              [](const RuleInstance& a, const RuleInstance& b) { return a.origin.y < b.origin.y; });
    CHECK(metres((*balconies)[0].origin.x) == Approx(palace.bayAt(3)).margin(0.002));
    CHECK(metres((*balconies)[0].origin.y) == Approx(palace.storeyAt(0)).margin(0.002));
    CHECK(metres((*balconies)[1].origin.x) == Approx(0).margin(0.002));
    CHECK(metres((*balconies)[1].origin.y) == Approx(palace.storeyAt(1)).margin(0.002));
    for (const RuleInstance& one : *balconies) CHECK(metres(one.origin.z) == Approx(0.5 * palace.deep).margin(0.002));

    // In the wall, every bay has a window; only the edited parts differ from the building without edits.
    const double wall = 0.5 * palace.deep - 0.1, gate = -0.5 * palace.height() + 1.2;
    CHECK_FALSE(isSolid(world, palace.bayAt(3) - 1, gate, wall));
    CHECK(isSolid(plain, palace.bayAt(3) - 1, gate, wall));
    CHECK(isSolid(world, palace.bayAt(0), palace.storeyAt(0), wall));
    CHECK(isSolid(world, palace.bayAt(6), palace.storeyAt(2), wall));
    CHECK_FALSE(isSolid(world, palace.bayAt(6), palace.storeyAt(0) + 0.4, wall));
  }
}

TEST_CASE("Lipp: whose part is gone is told, and the others hold", "[table4]") {
  Palace low;
  low.floors = 1;
  std::vector<std::string> told;
  WorldFieldSettings settings = settingsOf(sample("table4/lipp.sgm"), 128);
  REQUIRE(settings.parameters.set(*settings.program, "floors", low.floors));
  settings.on_notes = [&](const GrammarChunk& chunk) {
    for (const DeriveNote& note : chunk.notes) told.push_back(note.path + ": " + note.message);
  };
  const WorldField world{std::move(settings), std::pmr::get_default_resource()};
  const auto balconies = world.instances(ruleNamed(*world.settings().program, "Balcony"), kEverywhere, 100);
  REQUIRE(balconies);
  CHECK(balconies->size() == 1);
  REQUIRE(world.compile({{0, 0, 0}, {1, 1, 1}}, 0));
  const std::vector<std::string> expected(
      2, "Palace/Body[0]: this override finds nothing: there is only one `Storey` here");
  CHECK(told == expected);
}

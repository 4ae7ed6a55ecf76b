// Tests the results of the statements `report` and `expect`.

#include <cmath>

#include "metrics_fixture.h"

using namespace sgm;
using namespace sgm::test;

namespace {

double valueOf(const Outcome& outcome) {
  REQUIRE_FALSE(outcome.error);
  REQUIRE(outcome.measured.size() == 1);
  REQUIRE(outcome.measured[0].value);
  return *outcome.measured[0].value;
}

/// A grammar with stones in cells of 8 m, each with a different number of spheres; a coarser layer around them adds
/// nothing.
std::string stones(const std::string& statements) {
  return "sgm 1; domain infinite axes xz; layer fine cell 8m reach 4m { start Plot; } "
         "layer wide cell 16m reach 1m { start Nothing; }\n"
         "rule Nothing { }\n"
         "rule Plot { at(4m, 0m, 4m) Stone; anchor spot; }\n"
         "rule Stone { sphere(1.5m); when_far(); }\n"
         "rule when_far weight 1 { at(0m, 3m, 0m) sphere(1m); }\n"
         "rule when_far weight 1 { }\n" +
         statements;
}

}  // namespace

TEST_CASE("measures of a finite world", "[metrics]") {
  const World world(
      "sgm 1; start A; rule A { sphere(3m); at(8m, 0m, 0m) torus(2m, 0.8m); anchor spawn; }\n"
      "report watertight; report components; report components(solid); report components(air); report volume;\n"
      "report area; report triangles; report genus; report anchors;");
  const Evaluation found = world.evaluated();
  const std::vector<Outcome>& o = found.outcomes;
  const double pi = 3.14159265358979323846;
  CHECK(valueOf(o[0]) == 1);
  CHECK(valueOf(o[1]) == 2);
  CHECK(valueOf(o[2]) == 2);
  CHECK(valueOf(o[3]) == 1);
  CHECK(std::fabs(valueOf(o[4]) - (36 * pi + 2 * pi * pi * 2 * 0.64)) < 8);
  CHECK(std::fabs(valueOf(o[5]) - (36 * pi + 4 * pi * pi * 2 * 0.8)) < 12);
  CHECK(valueOf(o[6]) > 100);
  CHECK(valueOf(o[7]) == 1);
  CHECK(valueOf(o[8]) == 1);
  for (const Outcome& outcome : o) {
    CHECK(outcome.holds());
    CHECK(outcome.cell == kMetre / 2);
    CHECK(outcome.region == o[0].region);
  }
  CHECK(found.notes.empty());
}

TEST_CASE("comparisons, ranges, units", "[metrics]") {
  const World world(
      "sgm 1; start A; rule A { at(-4m, 0m, 0m) box(2m); at(4m, 0m, 0m) box(2m); }\n"
      "expect components == 2; expect components != 2; expect components < 2; expect components <= 2;\n"
      "expect components > 2; expect components >= 2; expect components in 1..2; expect components in 3..9;\n"
      "expect volume in 1m3..100m3; expect volume < 0.001m3; expect watertight; expect genus == 0;");
  const Evaluation found = world.evaluated();
  const std::vector<bool> wanted{true, false, false, true, false, true, true, false, true, false, true, true};
  REQUIRE(found.outcomes.size() == wanted.size());
  for (size_t i = 0; i < wanted.size(); ++i) {
    INFO("statement " << i);
    CHECK(found.outcomes[i].holds() == wanted[i]);
  }
}

TEST_CASE("what cannot be measured does not hold", "[metrics]") {
  const World world(
      "sgm 1; domain infinite; layer l cell 16m reach 16m { start A; }\n"
      "rule A { at(8m, 8m, 8m) capsule((-16m, 0m, 0m), (16m, 0m, 0m), 2m); }\n"
      "expect genus == 0; expect watertight; report genus;");
  const Evaluation found = world.evaluated();
  CHECK_FALSE(found.outcomes[0].holds());
  CHECK_FALSE(found.outcomes[0].measured[0].value);
  CHECK(found.outcomes[0].measured[0].why == "the region's border cuts the surface");
  CHECK(found.outcomes[1].holds());
  CHECK(found.outcomes[2].holds());
}

TEST_CASE("blocks are cells of the coarsest layer, and what the layers reach", "[metrics]") {
  const auto program = compiled(stones("report anchors in block(2);"));
  const Result<IntBox> block = blockRegion(*program, 2);
  REQUIRE(block);
  CHECK(block->lo.x == 0);
  CHECK(block->hi.x == 32 * kMetre);
  CHECK(block->hi.z == 32 * kMetre);
  CHECK(block->lo.y <= -3 * kMetre / 2);
  CHECK(block->lo.y >= -2 * kMetre);
  CHECK(block->hi.y > 4 * kMetre);
  CHECK(block->hi.y < 5 * kMetre);

  const auto ball = compiled("sgm 1; start A; rule A { sphere(3m); } report volume in block(1);");
  const Result<IntBox> bound = blockRegion(*ball, 1);
  REQUIRE(bound);
  CHECK(bound->lo.x <= -3 * kMetre);
  CHECK(bound->lo.x > -4 * kMetre);

  const auto far = compiled("sgm 1; domain infinite; layer l cell 100km reach 1m { start A; } rule A { }");
  const Result<IntBox> beyond = blockRegion(*far, 64);
  REQUIRE_FALSE(beyond);
  CHECK(beyond.error().code == Code::limit);
}

TEST_CASE("regions: the statement's, then the caller's, then the world's", "[metrics]") {
  const auto endless = compiled(stones("report anchors; report anchors in block(2);"));
  const IntBox given{{0, 0, 0}, {kMetre, kMetre, kMetre}};
  const auto regionOfStatement = [&](const Program& p, size_t i, std::optional<IntBox> g) {
    const Result<IntBox> region = regionOf(p, p.expectations[i], g);
    REQUIRE(region);
    return *region;
  };
  CHECK(regionOfStatement(*endless, 0, given) == given);
  CHECK(regionOfStatement(*endless, 0, std::nullopt) == *blockRegion(*endless, 1));
  CHECK(regionOfStatement(*endless, 1, given) == *blockRegion(*endless, 2));
  const auto finite = compiled("sgm 1; domain finite box(8m, 8m, 8m); start A; rule A { sphere(1m); } report volume;");
  CHECK(regionOfStatement(*finite, 0, std::nullopt) == finite->domain.box);
  CHECK(regionOfStatement(*finite, 0, given) == given);
}

TEST_CASE("cells are doubled until the chunks are few enough", "[metrics]") {
  const auto cube = [](int32_t metres) { return IntBox{{}, {metres * kMetre, metres * kMetre, metres * kMetre}}; };
  const IntBox small = cube(16), large = cube(640);
  CHECK(*cellFor({&small, 1}, 1) == kMetre / 2);
  CHECK(*cellFor({&large, 1}, 64000) == kMetre / 2);
  CHECK(*cellFor({&large, 1}, 63999) == kMetre);
  const std::vector<IntBox> many(9, small);
  CHECK(*cellFor(many, 9) == kMetre / 2);
  CHECK_FALSE(cellFor(many, 8));
  CHECK(*cellFor({}, 1) == kMetre / 2);
  const World world("sgm 1; start A; rule A { sphere(30m); } expect volume > 1m3; expect volume < 1m3 per A;");
  ExpectationSettings settings = world.settings();
  settings.max_chunks = 10;
  for (const Outcome& outcome : world.evaluated(settings).outcomes) {
    CHECK(outcome.cell > kMetre / 2);
    CHECK(outcome.chunks <= 10);
  }
  settings.cell = kMetre / 8;
  for (const Outcome& outcome : world.evaluated(settings).outcomes) {
    REQUIRE(outcome.error);
    CHECK(outcome.error->code == Code::limit);
    CHECK_FALSE(outcome.holds());
  }
}

TEST_CASE("per rule: each use by itself, also inside a cut", "[metrics]") {
  const World world(
      "sgm 1; domain infinite solid; layer l cell 32m reach 8m { start A; }\n"
      "rule A { cut { at(8m, 8m, 8m) B(2m); at(20m, 8m, 8m) B(3m); at(20m, 20m, 20m) sphere(1m); } }\n"
      "rule B(r) { sphere(r); anchor spot; }\n"
      "expect components == 1 per B; report volume per B; expect volume in 30m3..40m3 per B; expect genus == 0 per B;\n"
      "expect anchors == 1 per B; expect components(air) == 1 per B; report volume per A; expect watertight per B;");
  const Evaluation found = world.evaluated();
  const std::vector<Outcome>& o = found.outcomes;
  for (size_t i : {0u, 1u, 3u, 4u, 5u, 7u}) {
    INFO("statement " << i);
    CHECK(o[i].holds());
    CHECK(o[i].measured.size() == 2);
  }
  CHECK_FALSE(o[2].holds());
  CHECK(o[2].measured[0].holds);
  CHECK_FALSE(o[2].measured[1].holds);
  CHECK(o[2].measured[1].path == "l(0, 0, 0)/A/B[1]");
  CHECK(o[2].measured[1].origin == Int3{20 * kMetre, 8 * kMetre, 8 * kMetre});
  const double pi = 3.14159265358979323846;
  CHECK(std::fabs(*o[1].measured[0].value - 4 * pi * 8 / 3) < 3);
  CHECK(std::fabs(*o[1].measured[1].value - 36 * pi) < 6);
  REQUIRE(o[6].measured.size() == 1);
  CHECK(std::fabs(*o[6].measured[0].value - 4 * pi * 36 / 3) < 9);
}

TEST_CASE("per rule: only uses whose frames stand in the region, none at all, empty ones, boundless ones",
          "[metrics]") {
  const World world(
      stones("report volume in block(1) per Stone; expect components in 1..2 in block(3) per Stone;\n"
             "expect components == 9 per Unused; expect volume == 0m3 per Nothing; expect genus == 0 per "
             "Nothing;\nrule Unused { sphere(1m); }"));
  const Evaluation found = world.evaluated();
  CHECK(found.outcomes[0].measured.size() == 4);
  CHECK(found.outcomes[1].measured.size() == 36);
  CHECK(found.outcomes[1].holds());
  CHECK(found.outcomes[2].measured.empty());
  CHECK(found.outcomes[2].holds());
  CHECK(found.outcomes[3].measured.size() == 1);
  CHECK(found.outcomes[3].holds());
  CHECK(found.outcomes[4].holds());

  const World half(
      "sgm 1; start A; rule A { meet { sphere(3m); Half; } } rule Half { halfspace(below 0m); }\n"
      "expect volume > 0m3 per Half; report volume per Half;");
  const Evaluation boundless = half.evaluated();
  REQUIRE(boundless.outcomes[0].measured.size() == 1);
  CHECK_FALSE(boundless.outcomes[0].holds());
  CHECK(boundless.outcomes[0].measured[0].why == "one of its shapes is unbounded");
  CHECK(boundless.outcomes[1].holds());
}

TEST_CASE("seeds and threads: the same world says the same", "[metrics]") {
  const World world(stones("report components in block(4); report volume in block(4) per Stone;"));
  std::vector<double> components;
  for (uint64_t seed = 0; seed < 4; ++seed) {
    const Evaluation first = world.evaluated(seed), second = world.evaluated(seed);
    components.push_back(valueOf(first.outcomes[0]));
    CHECK(valueOf(second.outcomes[0]) == components.back());
    REQUIRE(first.outcomes[1].measured.size() == second.outcomes[1].measured.size());
    for (size_t i = 0; i < first.outcomes[1].measured.size(); ++i) {
      CHECK(first.outcomes[1].measured[i].value == second.outcomes[1].measured[i].value);
    }
  }
  CHECK(std::adjacent_find(components.begin(), components.end(), std::not_equal_to<>()) != components.end());
}

TEST_CASE("a cancelled evaluation is an error, not an outcome", "[metrics]") {
  const World world("sgm 1; start A; rule A { sphere(3m); } expect watertight;");
  const Result<Evaluation> stopped =
      evaluateExpectations(world.settings(), world.backend(), world.jobs(), std::pmr::get_default_resource(),
                           [](uint64_t, uint64_t) { return false; });
  REQUIRE_FALSE(stopped);
  CHECK(stopped.error().code == Code::cancelled);
}

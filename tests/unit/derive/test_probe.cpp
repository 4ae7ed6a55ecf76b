#include <random>

#include "derive_fixture.h"
#include "rounds.h"
#include "seed.h"

using namespace sgm;

TEST_CASE("a probe finds the first solid unit") {
  for (int32_t height : {1, 2, 255, 256, 257, 1000, 4095, 4096}) {
    CAPTURE(height);
    REQUIRE(Ceiling(height).probe(0, {5, 0, 5}, {0, 1, 0}, 4096) == height);
  }
  CHECK_FALSE(Ceiling(4097).probe(0, {5, 0, 5}, {0, 1, 0}, 4096));
  CHECK_FALSE(Ceiling(0).probe(0, {5, 0, 5}, {0, 1, 0}, 4096));
  CHECK_FALSE(Ceiling(10).probe(0, {5, 0, 5}, {0, -1, 0}, 4096));
  CHECK_FALSE(Ceiling(10).probe(0, {5, 0, 5}, {0, 1, 0}, 0));
}

TEST_CASE("a slanted probe ends at the surface") {
  const auto t = Ceiling(1000).probe(0, {0, 0, 0}, {0.6, 0.8, 0}, 4096);
  REQUIRE(t);
  REQUIRE(probePoint({0, 0, 0}, {0.6, 0.8, 0}, *t).y == 1000);
}

namespace {

/// A lower layer that is void between two heights.
class Opening : public LowerLayers {
 public:
  Opening(int32_t floor, int32_t ceiling) : floor_(floor), ceiling_(ceiling) {}
  bool solid(uint32_t, Int3 p) const override { return p.y <= floor_ || p.y >= ceiling_; }

 private:
  int32_t floor_, ceiling_;
};

std::string gapProgram(const char* way, const std::string& scale, const std::string& within) {
  const bool up = std::string_view(way) == "up";
  return "sgm 1; domain infinite solid;\nlayer net cell 64m reach 8m { start Net; }\n"
         "layer drip cell 64m reach 64m uses net { start Drip; }\nrule Net { }\n"
         "rule Drip { at(32m, 32m, 32m) scale(" +
         scale + ") scatter 1 on disc(0m) probe " + way + " 9m of net gap h within " + within + " { Mark(h, " +
         (up ? "-1" : "1") +
         "); } }\n"
         "rule Mark(h, way) { anchor spawn; at(0m, way*h, 0m) { anchor loot; } }\n";
}

}  // namespace

TEST_CASE("a gap is as long as the open behind a point, and where that is too long there is no point") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  std::uniform_int_distribution<int32_t> away(1, 6 * 1024);
  for (unsigned round = 0; round < rounds(60); ++round) {
    const int32_t middle = 32 * 1024, floor = middle - away(random), ceiling = middle + away(random);
    const bool up = random() % 2 == 0, enlarged = random() % 2 == 0;
    const int within = 1 + static_cast<int>(random() % 14);
    CAPTURE(floor, ceiling, up, enlarged, within);
    const auto program = compiled(
        gapProgram(up ? "up" : "down", enlarged ? "2" : "1", std::to_string(within) + (enlarged ? "m/2" : "m")));
    const GrammarChunk chunk = derived(*program, {}, 7, 1, Opening(floor, ceiling));
    if (std::abs(ceiling - floor - within * 1024) <= 2) continue;
    if (ceiling - floor > within * 1024) {
      CHECK(chunk.anchors.empty());
      continue;
    }
    REQUIRE(chunk.anchors.size() == 2);
    const int32_t there = chunk.anchors[0].frame.origin.y, back = chunk.anchors[1].frame.origin.y;
    CHECK(there == (up ? ceiling : floor));
    CHECK(std::abs((up ? there - back : back - there) - (ceiling - floor)) <= 2);
  }
}

TEST_CASE("a gap decides about its point") {
  const std::string text = gapProgram("up", "1", "9m");
  const auto with = [&](const std::string& when) {
    std::string out = text;
    out.replace(out.find("{ Mark"), 0, "when " + when + " ");
    return derived(*compiled(out), {}, 7, 1, Opening(30 * 1024, 36 * 1024)).anchors.size();
  };
  CHECK(with("h > 5.9m") == 2);
  CHECK(with("h > 6.1m") == 0);
}

TEST_CASE("where the point itself finds nothing there is no gap") {
  const auto program = compiled(gapProgram("up", "1", "3m"));
  CHECK(derived(*program, {}, 7, 1, Opening(0, 60 * 1024)).anchors.empty());
  CHECK(derived(*program, {}, 7, 1, Opening(40 * 1024, 60 * 1024)).anchors.empty());
}

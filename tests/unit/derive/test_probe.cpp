#include "derive_fixture.h"

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

// Tests queries of lower layers during derivation: the proof that a ball is entirely solid or entirely open, and the
// layer, ball and content that a grammar's query asks for.

#include <cmath>
#include <random>

#include "derive_fixture.h"
#include "rounds.h"
#include "seed.h"

using namespace sgm;

namespace {

double distance(Int3 a, Int3 b) {
  const double x = double{1} * a.x - b.x, y = double{1} * a.y - b.y, z = double{1} * a.z - b.z;
  return std::sqrt(x * x + y * y + z * z);
}

Int3 around(std::mt19937& random, Int3 p, int32_t most) {
  std::uniform_int_distribution<int32_t> by(-most, most);
  return saturatingAdd(p, {by(random), by(random), by(random)});
}

/// A field that is rock everywhere except in a sphere (`hollow`), or only in the sphere. Like the bounds of real
/// fields, its bounds are not tight: a box near the surface may be unknown. slack: their error, in diagonals of the
/// box.
class OneSphere {
 public:
  OneSphere(Int3 centre, double radius, bool hollow, double slack)
      : centre_(centre), radius_(radius), hollow_(hollow), slack_(slack) {}

  bool solid(Int3 p) const { return (distance(p, centre_) < radius_) != hollow_; }
  BoxContent content(const IntBox& box) const {
    if (box.lo == box.hi) return solid(box.lo) ? BoxContent::solid : BoxContent::open;
    Int3 nearest, farthest;
    for (int axis = 0; axis < 3; ++axis) {
      nearest[axis] = std::clamp(centre_[axis], box.lo[axis], box.hi[axis]);
      const bool low = int64_t{centre_[axis]} - box.lo[axis] > int64_t{box.hi[axis]} - centre_[axis];
      farthest[axis] = low ? box.lo[axis] : box.hi[axis];
    }
    const double slack = slack_ * distance(box.lo, box.hi);
    if (distance(nearest, centre_) > radius_ + slack) return hollow_ ? BoxContent::solid : BoxContent::open;
    if (distance(farthest, centre_) < radius_ - slack) return hollow_ ? BoxContent::open : BoxContent::solid;
    return BoxContent::unknown;
  }

 private:
  Int3 centre_;
  double radius_;
  bool hollow_;
  double slack_;
};

/// Stands for the lower layers: records the queries, and answers each of them with yes.
class Asked final : public LowerLayers {
 public:
  explicit Asked(uint32_t pieces = 1) : pieces_(pieces) {}
  bool solid(uint32_t, Int3) const override { return false; }
  BallProof prove(uint32_t layer, const Ball& ball, BoxContent wanted) const override {
    layers.push_back(layer);
    balls.push_back(ball);
    contents.push_back(wanted);
    return {true, pieces_};
  }

  mutable std::vector<uint32_t> layers;
  mutable std::vector<Ball> balls;
  mutable std::vector<BoxContent> contents;

 private:
  uint32_t pieces_;
};

std::shared_ptr<const Program> asking(const std::string& rules) {
  return compiled(
      "sgm 1; domain infinite solid; param wide = 1m in 0m..2m;\n"
      "layer other cell 64m reach 8m { start Other; } layer net cell 64m reach 8m { start Net; }\n"
      "layer drip cell 64m reach 64m uses net { start D; }\nrule Other { } rule Net { }\n" +
      rules);
}

uint32_t layerOf(const Program& program, std::string_view name) {
  for (uint32_t l = 0; l < program.layers.size(); ++l) {
    if (program.text(program.layers[l].name) == name) return l;
  }
  FAIL("no such layer");
  return 0;
}

size_t anchorsOf(const std::string& rules, const LowerLayers& lower) {
  const auto program = asking(rules);
  return derived(*program, {}, 7, layerOf(*program, "drip"), lower).anchors.size();
}

}  // namespace

TEST_CASE("a ball proven to hold one thing holds nothing else, and away from the surface it is decided") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  size_t proven = 0, decided = 0;
  for (unsigned round = 0; round < rounds(600); ++round) {
    const Int3 middle = round % 3 == 0 ? Int3{2'147'000'000, -2'147'000'000, 5} : Int3{7, -9, 100'000};
    const double radius = 1 + static_cast<double>(random() % 8000), slack = 0.5 * static_cast<double>(random() % 3);
    const bool hollow = random() % 2 == 0;
    const OneSphere world(middle, radius, hollow, slack);
    const Ball ball{around(random, middle, 8000), static_cast<int32_t>(random() % 5 == 0 ? 0 : random() % 4000)};
    const auto content = [&](const IntBox& box) { return world.content(box); };
    CAPTURE(round, radius, ball.centre.x, ball.centre.y, ball.centre.z, ball.radius, hollow, slack);
    const bool open = proveBall(ball, BoxContent::open, content).holds;
    const bool solid = proveBall(ball, BoxContent::solid, content).holds;
    CHECK_FALSE((open && solid));
    if (open || solid) {
      ++proven;
      size_t wrong = 0;
      for (int k = 0; k < 200; ++k) {
        const Int3 p = around(random, ball.centre, ball.radius);
        wrong += distance(p, ball.centre) <= ball.radius && world.solid(p) != solid;
      }
      CHECK(wrong == 0);
    }
    // The smallest pieces of the proof have an edge of 1/32 of the ball's radius, so their diagonal is less than 0.06
    // radii. They may extend beyond the ball by a diagonal, and their bounds are off by `slack` diagonals.
    const double gap = std::abs(distance(ball.centre, middle) - radius) - ball.radius;
    if (gap > (1 + slack) * 0.06 * ball.radius + 2) {
      ++decided;
      CHECK((open || solid));
    } else if (gap < -2) {
      CHECK_FALSE((open || solid));
    }
  }
  CHECK(proven > 0);
  CHECK(decided > 0);
}

TEST_CASE("one position of something else is never missed") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  for (unsigned round = 0; round < rounds(200); ++round) {
    const Ball ball{around(random, {5, -7, 11}, 100'000), 1 + static_cast<int32_t>(random() % 10'000)};
    Int3 odd = around(random, ball.centre, ball.radius);
    while (distance(odd, ball.centre) > ball.radius) odd = around(random, ball.centre, ball.radius);
    CAPTURE(ball.radius, odd.x, odd.y, odd.z);
    const auto content = [&](const IntBox& box) {
      if (box.lo == box.hi) return box.lo == odd ? BoxContent::solid : BoxContent::open;
      return box.contains(odd) ? BoxContent::unknown : BoxContent::open;
    };
    CHECK_FALSE(proveBall(ball, BoxContent::open, content).holds);
  }
}

TEST_CASE("a proof costs no more than it may, and what costs more is not proven") {
  // Here the content is known only for single positions; for all larger boxes it is unknown.
  const auto single = [](const IntBox& box) { return box.lo == box.hi ? BoxContent::open : BoxContent::unknown; };
  const BallProof large = proveBall({{}, 5000}, BoxContent::open, single);
  CHECK_FALSE(large.holds);
  CHECK(large.pieces <= kMaxBallPieces + 1);
  CHECK(proveBall({{}, 3}, BoxContent::open, single).holds);
  CHECK(proveBall({{}, 0}, BoxContent::open, single).pieces == 1);
  CHECK_FALSE(proveBall({{}, 0}, BoxContent::solid, single).holds);
  CHECK_FALSE(proveBall({{}, -1}, BoxContent::open, single).holds);
}

TEST_CASE("a ball at the end of the world ends there") {
  const Int3 corner{std::numeric_limits<int32_t>::max(), std::numeric_limits<int32_t>::min(), 0};
  const auto open = [](const IntBox& box) {
    return box.lo.x > box.hi.x || box.empty() ? BoxContent::solid : BoxContent::open;
  };
  CHECK(proveBall({corner, std::numeric_limits<int32_t>::max()}, BoxContent::open, open).holds);
}

TEST_CASE("where nothing is known of boxes, positions decide") {
  const Ceiling rock(100);
  CHECK(rock.prove(0, {{5, 99, 5}, 0}, BoxContent::open).holds);
  CHECK(rock.prove(0, {{5, 100, 5}, 0}, BoxContent::solid).holds);
  CHECK_FALSE(rock.prove(0, {{5, 100, 5}, 0}, BoxContent::open).holds);
  CHECK(rock.prove(0, {{5, 97, 5}, 2}, BoxContent::open).holds);
  CHECK_FALSE(rock.prove(0, {{5, 98, 5}, 2}, BoxContent::open).holds);
}

TEST_CASE("a query asks about the scope's own place, in its own lengths") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  for (unsigned round = 0; round < rounds(60); ++round) {
    const int x = static_cast<int>(random() % 8), angle = static_cast<int>(random() % 360);
    const std::string scale = random() % 2 == 0 ? "0.5" : "2";
    const double factor = scale == "2" ? 2 : 0.5;
    const bool mirrored = random() % 2 == 0, inside = random() % 2 == 0;
    const std::string place = "at(32m, 32m, 32m) scale(" + scale + ") " + (mirrored ? "mirror(x) " : "") +
                              "rot((1m, 2m, -1m), " + std::to_string(angle) + "deg) at(" + std::to_string(x) +
                              "m, 1m, 0m) ";
    CAPTURE(place);
    const Asked lower;
    const auto program = asking("rule D { " + place + "Ask; } rule Ask when query " + (inside ? "inside" : "clear") +
                                " (wide + 0.5m) of net { anchor spawn; }");
    const GrammarChunk chunk = derived(*program, {}, 7, layerOf(*program, "drip"), lower);
    REQUIRE(lower.balls.size() == 1);
    REQUIRE(chunk.anchors.size() == 1);
    CHECK(lower.layers[0] == layerOf(*program, "net"));
    CHECK(lower.contents[0] == (inside ? BoxContent::solid : BoxContent::open));
    CHECK(lower.balls[0].centre == chunk.anchors[0].frame.origin);
    CHECK(lower.balls[0].radius == static_cast<int32_t>(1.5 * factor * 1024));
  }
}

TEST_CASE("without a radius a query asks about one position") {
  const Asked lower;
  CHECK(anchorsOf("rule D when query clear of net { anchor spawn; }", lower) == 1);
  REQUIRE(lower.balls.size() == 1);
  CHECK(lower.balls[0].radius == 0);
}

TEST_CASE("in loops and point sets every place asks for itself") {
  const Asked lower;
  CHECK(anchorsOf("rule D { at(8m, 8m, 8m) for i in 0..4 { at(i*2m, 0m, 0m) Ask; } }\n"
                  "rule Ask when query clear 1m of net { anchor spawn; }",
                  lower) == 4);
  REQUIRE(lower.balls.size() == 4);
  for (int32_t i = 0; i < 4; ++i)
    CHECK(lower.balls[static_cast<size_t>(i)].centre == Int3{(8 + 2 * i) * 1024, 8192, 8192});

  const Asked points;
  const auto program = asking("rule D { scatter poisson(9m) when query clear 1m of net { anchor spawn; } }");
  const GrammarChunk chunk = derived(*program, {}, 7, layerOf(*program, "drip"), points);
  REQUIRE(chunk.anchors.size() > 10);
  REQUIRE(points.balls.size() == chunk.anchors.size());
  for (size_t i = 0; i < points.balls.size(); ++i) CHECK(points.balls[i].centre == chunk.anchors[i].frame.origin);
}

TEST_CASE("answers are conditions like others") {
  // The lower layer is open below a height of 32 m, and rock above it.
  const Ceiling rock(32 * 1024);
  const auto holds = [&](const std::string& height, const std::string& condition) {
    return anchorsOf("rule D { at(1m, " + height + ", 1m) Ask; } rule Ask when " + condition + " { anchor spawn; }",
                     rock) == 1;
  };
  CHECK(holds("31m", "query clear of net"));
  CHECK_FALSE(holds("31m", "query inside of net"));
  CHECK(holds("31m", "not query inside of net"));
  CHECK(holds("32m", "query inside of net and not query clear of net"));
  CHECK(holds("33m", "query clear of net or query inside of net"));
  CHECK(holds("33m", "(if query inside of net then 2m else 1m) > 1.5m"));
  CHECK_FALSE(holds("31m", "(if query inside of net then 2m else 1m) > 1.5m"));
}

TEST_CASE("a negative radius counts as none, and is noted") {
  const Asked lower;
  const auto program = asking("rule D when query clear (wide - 2m) of net { anchor spawn; }");
  const GrammarChunk chunk = derived(*program, {}, 7, layerOf(*program, "drip"), lower);
  REQUIRE(lower.balls.size() == 1);
  CHECK(lower.balls[0].radius == 0);
  REQUIRE(chunk.notes.size() == 1);
  CHECK(chunk.notes[0].message ==
        "the radius of a query is 0m or more; this one counts as 0m: bound it, such as max(r, 0m)");
}

TEST_CASE("what a query costs counts as steps") {
  const Asked dear(1000);
  const auto program =
      asking("rule D { for i in 0..100 { at(1m, 1m, 1m) Ask; } } rule Ask when query clear 1m of net { }");
  DeriveLimits limits;
  limits.steps = 50'000;
  const Result<GrammarChunk> chunk =
      deriveCell(*program, ParameterValues::defaults(*program), 7, layerOf(*program, "drip"), {}, dear, limits);
  REQUIRE_FALSE(chunk);
  CHECK(chunk.error().code == Code::limit);
  limits.steps = 200'000;
  CHECK(deriveCell(*program, ParameterValues::defaults(*program), 7, layerOf(*program, "drip"), {}, dear, limits));
}

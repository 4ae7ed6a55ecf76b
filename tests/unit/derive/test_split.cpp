// Tests splits of scopes: the parts fill the scope, and have the places that the language defines.

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>

#include "base/math.h"
#include "derive/frame.h"
#include "derive/layout/split_layout.h"
#include "derive_fixture.h"
#include "rounds.h"
#include "seed.h"

using namespace sgm;

namespace {

constexpr double kOneUnit = 1024;

struct Box {
  Vec3 low, high;  ///< metres from the grammar cell's corner
  double volume() const { return (high.x - low.x) * (high.y - low.y) * (high.z - low.z); }
};

/// The boxes of a derived cell, whose frames are rotated by multiples of 90 degrees only.
std::vector<Box> boxesOf(const GrammarChunk& chunk) {
  std::vector<Box> boxes;
  for (const Shape& shape : chunk.shapes) {
    if (shape.kind != ShapeKind::box) continue;
    Box box;
    for (int axis = 0; axis < 3; ++axis) {
      double half = 0;
      for (size_t row = 0; row < 3; ++row)
        half += std::fabs(double{shape.frame.rows[3 * row + static_cast<size_t>(axis)]}) * double{shape.size[row]};
      box.low[axis] = (shape.frame.origin[axis] - half) / kOneUnit;
      box.high[axis] = (shape.frame.origin[axis] + half) / kOneUnit;
    }
    boxes.push_back(box);
  }
  return boxes;
}

double overlap(const Box& a, const Box& b) {
  double volume = 1;
  for (int axis = 0; axis < 3; ++axis)
    volume *= std::max(0.0, std::min(a.high[axis], b.high[axis]) - std::max(a.low[axis], b.low[axis]));
  return volume;
}

}  // namespace

TEST_CASE("parts of a split lie one after another, and fill it where one of them is flexible", "[split]") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  for (unsigned round = 0; round < rounds(2000); ++round) {
    const double length = std::exp(6 * unit(random) - 2);
    std::vector<SplitSize> parts(1 + random() % 6);
    const size_t first = random() % (parts.size() + 1), last = first + random() % (parts.size() + 1 - first);
    bool flexible = false;
    double rigid = 0, wanted = 0, group_rigid = 0, group_wanted = 0;
    for (size_t i = 0; i < parts.size(); ++i) {
      parts[i] = {unit(random) * 3, random() % 2 == 0, i >= first && i < last};
      if (random() % 12 == 0) parts[i].size = 0;
      double& rigid_sum = parts[i].repeated ? group_rigid : rigid;
      double& wanted_sum = parts[i].repeated ? group_wanted : wanted;
      (parts[i].flexible ? wanted_sum : rigid_sum) += parts[i].size;
    }
    const SplitLayout layout = layOut(length, parts, 1'000'000);
    REQUIRE(!layout.too_many);
    CHECK(layout.cut_off == (rigid > length + 1e-9));
    // The number of repetitions follows the documented formula.
    double count = 0;
    if (group_rigid + group_wanted > 0) {
      const double fits = (length - rigid - wanted) / (group_rigid + group_wanted);
      count = group_wanted > 0 ? std::max(1.0, std::floor(fits + 0.5)) : std::floor(fits + 1e-9);
      while (count > 0 && group_rigid > 0 && rigid + count * group_rigid > length + 1e-9) --count;
      count = std::max(count, 0.0);
    }
    CHECK(layout.repetitions == count);
    double at = 0, stretch = -1;
    std::map<uint32_t, uint32_t> copies;
    for (const SplitPlace& place : layout.places) {
      const SplitSize& part = parts[place.part];
      REQUIRE(place.size > 0);
      REQUIRE(std::fabs(place.middle - 0.5 * place.size - at) < 1e-9);
      at += place.size;
      REQUIRE(at <= length + 1e-8);
      REQUIRE(place.repetition == (part.repeated ? copies[place.part] : 0));
      ++copies[place.part];
      flexible = flexible || part.flexible;
      if (!part.flexible && !layout.cut_off) REQUIRE(place.size == Approx(part.size).margin(1e-8));
      if (!part.flexible) continue;
      if (stretch >= 0) REQUIRE(place.size == Approx(stretch * part.size).margin(1e-8));
      stretch = place.size / part.size;
    }
    for (const auto& [part, times] : copies) CHECK(times == (parts[part].repeated ? count : 1));
    if (flexible || layout.cut_off) CHECK(at == Approx(length).margin(1e-8));
  }
}

TEST_CASE("a split fills its scope with boxes that overlap by their seams alone, however it is nested and turned",
          "[split]") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  const char* axes[] = {"x", "y", "z"};
  for (unsigned round = 0; round < rounds(60); ++round) {
    const auto metresOf = [&](double least, double most) {
      // All sizes, also of nested splits, are whole numbers of units, so that nothing is rounded.
      return std::to_string(least + std::floor((most - least) * static_cast<double>(random() % 16)) / 16) + "m";
    };
    const std::string a = axes[random() % 3], b = axes[random() % 3];
    const std::string text = "rule Main { at(20m, 20m, 20m) rot(y, " + std::to_string(90 * (random() % 4)) +
                             "deg) size(" + metresOf(6, 20) + ", " + metresOf(6, 20) + ", " + metresOf(6, 20) +
                             ") A; }\nrule A { split " + a + " { " + metresOf(0.5, 1) + ": B; { ~" + metresOf(0.7, 3) +
                             ": B; " + metresOf(0.1, 0.4) + ": L; }* 10%: B; ~1m: L; } }\nrule B { split " + b +
                             " { ~1m: L; 25%: L; { ~0.5m: L; }* } }\nrule L { box(scope); }\n";
    CAPTURE(text);
    const std::string whole = text.substr(0, text.find(") A;")) + ") box(scope); }";
    const Box scope = boxesOf(derivedRules(whole)).at(0);
    const std::vector<Box> boxes = boxesOf(derivedRules(text));
    REQUIRE(boxes.size() > 6);
    double volume = 0;
    for (const Box& box : boxes) {
      volume += box.volume();
      for (int axis = 0; axis < 3; ++axis) {
        REQUIRE(box.low[axis] >= scope.low[axis] - 1 / kOneUnit);
        REQUIRE(box.high[axis] <= scope.high[axis] + 1 / kOneUnit);
      }
    }
    CHECK(volume >= scope.volume());
    CHECK(volume < 1.15 * scope.volume());
    for (size_t i = 0; i < boxes.size(); ++i)
      for (size_t j = 0; j < i; ++j)
        // Allowed overlap: two units on each side, and half a unit of rounding of each box.
        REQUIRE(overlap(boxes[i], boxes[j]) <= 5 / kOneUnit * std::min(boxes[i].volume(), boxes[j].volume()) / 0.02);
  }
}

TEST_CASE("faces of a box point outwards and cover it", "[split]") {
  // Thin plates are moved away from the faces by 1 m along the faces' z axis: the plates' positions show whether z
  // points outwards.
  const auto plates = [](const std::string& part) {
    return boxesOf(derivedRules("rule Main { at(20m, 20m, 20m) size(8m, 6m, 4m) comp { " + part +
                                ": at(z 1m) size(z 0.5m) box(scope); } }"));
  };
  const auto is = [](const Box& box, Vec3 middle, Vec3 edges) {
    bool good = true;
    for (int axis = 0; axis < 3; ++axis) {
      good = good && std::fabs(0.5 * (box.low[axis] + box.high[axis]) - 20 - middle[axis]) < 1e-6;
      good = good && std::fabs(box.high[axis] - box.low[axis] - edges[axis]) < 1e-6;
    }
    return good;
  };
  CHECK(is(plates("front").at(0), {0, 0, 3}, {8, 6, 0.5}));
  CHECK(is(plates("back").at(0), {0, 0, -3}, {8, 6, 0.5}));
  CHECK(is(plates("right").at(0), {5, 0, 0}, {0.5, 6, 4}));
  CHECK(is(plates("left").at(0), {-5, 0, 0}, {0.5, 6, 4}));
  CHECK(is(plates("top").at(0), {0, 4, 0}, {8, 0.5, 4}));
  CHECK(is(plates("bottom").at(0), {0, -4, 0}, {8, 0.5, 4}));
  CHECK(plates("side").size() == 4);
  // If a face is named separately, `side` no longer includes it.
  const GrammarChunk named = derivedRules(
      "rule Main { size(8m, 6m, 4m) comp { side: size(z 1m) box(scope); front: size(z 2m) box(scope); } }");
  CHECK(boxesOf(named).size() == 4);
  // As seen from outside, x of a face's scope points right and y up, so that each mark is in the upper right corner.
  const auto marks = boxesOf(derivedRules(
      "rule Main { at(20m, 20m, 20m) size(8m, 6m, 4m) comp { side: at(0.5*scope.x, 0.5*scope.y, 0m) box(1m); } }"));
  REQUIRE(marks.size() == 4);
  CHECK(is(marks[0], {4, 3, 2}, {1, 1, 1}));
  CHECK(is(marks[1], {4, 3, -2}, {1, 1, 1}));
  CHECK(is(marks[2], {-4, 3, -2}, {1, 1, 1}));
  CHECK(is(marks[3], {-4, 3, 2}, {1, 1, 1}));
  // In the scopes of the vertical edges, y points up, and x and z point out of the box.
  const auto edges = boxesOf(derivedRules(
      "rule Main { at(20m, 20m, 20m) size(8m, 6m, 4m) comp { edges: at(1m, 0m, 1m) size(x 1m, z 1m) box(scope); } }"));
  REQUIRE(edges.size() == 4);
  CHECK(is(edges[0], {5, 0, 3}, {1, 6, 1}));
  CHECK(is(edges[1], {5, 0, -3}, {1, 6, 1}));
  CHECK(is(edges[2], {-5, 0, -3}, {1, 6, 1}));
  CHECK(is(edges[3], {-5, 0, 3}, {1, 6, 1}));
  CHECK(is(boxesOf(derivedRules("rule Main { at(20m, 20m, 20m) size(8m, 6m, 4m) comp { inside: box(scope); } }")).at(0),
           {}, {8, 6, 4}));
}

TEST_CASE("each part draws for itself and has a path of its own", "[split]") {
  const std::string text =
      "sgm 1; units m; domain infinite; layer main cell 64m reach 64m { start Main; }\n"
      "rule Main { size(20m, 6m, 4m) split x { 1m: L; { ~2m: L; }* 1m: L; } }\nrule L { box(rand(0.2m, 1m)); }\n";
  const auto sizes = [](const std::vector<Box>& boxes) {
    std::vector<double> all;
    for (const Box& box : boxes) all.push_back(box.high.x - box.low.x);
    return all;
  };
  const std::vector<double> plain = sizes(boxesOf(derived(*compiled(text))));
  REQUIRE(plain.size() == 11);
  CHECK(std::set<double>(plain.begin(), plain.end()).size() == 11);
  const std::vector<double> edited = sizes(boxesOf(derived(*compiled(text + "override \"Main/L[3]\" { box(3m); }\n"))));
  REQUIRE(edited.size() == 11);
  for (size_t i = 0; i < 11; ++i) CHECK((edited[i] == plain[i]) == (i != 3));
  // A different number of copies changes neither the parts behind the copies nor the copies that remain.
  std::string longer = text;
  longer.replace(longer.find("20m, 6m"), 3, "24m");
  const std::vector<double> more = sizes(boxesOf(derived(*compiled(longer))));
  REQUIRE(more.size() == 13);
  CHECK(std::equal(plain.begin(), plain.begin() + 10, more.begin()));
  CHECK(plain.back() == more.back());
}

TEST_CASE("what cannot be split says so, with its path, and the rest appears", "[split]") {
  const auto noted = [](const std::string& body, const std::string& expected, size_t boxes) {
    CAPTURE(body);
    const GrammarChunk chunk = derivedRules("rule Main { " + body + " at(9m, 0m, 0m) box(1m); }");
    CHECK(boxesOf(chunk).size() == boxes + 1);
    const bool found = std::any_of(chunk.notes.begin(), chunk.notes.end(), [&](const DeriveNote& note) {
      return note.message.find(expected) != std::string::npos && note.path.find("Main") != std::string::npos;
    });
    for (const DeriveNote& note : chunk.notes) UNSCOPED_INFO(note.message);
    CHECK(found);
  };
  noted("size(2m, 2m, 2m) split x { 1.5m: box(scope); 1.5m: box(scope); 1m: box(scope); }", "cut off", 2);
  noted("size(x 0m) split x { ~1m: box(scope); }", "no size along x", 0);
  noted("size(4m, 2m, 2m) split x { 1m: box(scope); { 0m: box(1m); }* }", "repeated have no size", 1);
  noted("size(4m, 2m, 2m) split x { 1m - 2m: box(1m); ~1m: box(scope); }", "0m or more", 1);
  noted("size(4m, 0m, 2m) comp { front: box(1m); top: box(1m); }", "no size", 1);
  const auto program = compiled(
      "sgm 1; units m; domain infinite; layer main cell 64m reach 64m { start Main; }\n"
      "rule Main { size(60m, 1m, 1m) split x { { 0.00001m: box(1m); }* } }");
  const auto chunk = deriveCell(*program, ParameterValues::defaults(*program), 1, 0, {}, Ceiling(1 << 30));
  REQUIRE(!chunk);
  CHECK(chunk.error().message.starts_with("one split has more than a million parts (give them a larger size)"));
}

TEST_CASE("lines of splits go to snap planes, however their scopes lie, and no farther than is said", "[split]") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  // Returns the tops of the floors of these wings. The wings are at various heights, and some of them are rotated or
  // upside down.
  const auto tops = [](const std::string& snap, const std::string& wings) {
    const std::vector<Box> boxes =
        boxesOf(derivedRules("rule Main { at(20m, 20m, 20m) size(10m, 20m, 10m) " + snap + " { " + wings +
                             " } }\nrule Wing { split y snap 0.6m { { ~3m: size(y scope.y - 0.5m) box(scope); }* } }"));
    std::vector<double> lines;
    for (const Box& box : boxes) lines.push_back(box.high.y + 0.25 - 10);
    return lines;
  };
  int snapped = 0, all = 0;
  // Every build tests at least 300 wings, because the share of snapped floors is checked below. The floors of one wing
  // often snap together. So with only twenty wings, this share would be below a fifth in one run of thirty.
  const unsigned wings = std::max(rounds(300), 300u);
  for (unsigned round = 0; round < wings; ++round) {
    const std::string low = std::to_string(-4 + 3 * unit(random)), tall = std::to_string(8 + 4 * unit(random));
    const std::string turn = random() % 3 == 0 ? "" : random() % 2 == 0 ? "rot(y, 35deg) " : "rot(x, 180deg) ";
    const std::string wing = "at(3m, " + low + "m, 0m) " + turn + "size(4m, " + tall + "m, 4m) Wing;";
    CAPTURE(wing);
    const std::vector<double> free = tops("", wing), held = tops("snap y 3.2m from 0.7m", wing);
    REQUIRE(free.size() == held.size());
    const double top = *std::max_element(free.begin(), free.end()) - 0.01;
    for (size_t i = 0; i < free.size(); ++i) {
      if (free[i] > top) continue;
      const double from = (free[i] - 0.7) / 3.2, nearest = (std::floor(from + 0.5) - from) * 3.2;
      ++all;
      // Skips a distance so near to the snapping distance that rounding decides.
      if (std::fabs(std::fabs(nearest) - 0.6) < 0.005) continue;
      const bool near = std::fabs(nearest) < 0.6;
      snapped += near;
      CHECK(held[i] == Approx(free[i] + (near ? nearest : 0)).margin(0.006));
    }
  }
  CAPTURE(all);
  CHECK(snapped > all / 5);
  CHECK(snapped < all * 4 / 5);
  // Snap planes along another axis, or in a block that does not contain the wing, have no effect on the wing.
  const std::string plain = "size(4m, 10m, 4m) Wing;";
  CHECK(tops("snap x 4.2m", plain) == tops("", plain));
  CHECK(tops("", "snap y 4.2m { } " + plain) == tops("", plain));
  CHECK(tops("snap y 4.2m", plain) != tops("", plain));
  // If snap planes are nested, the innermost apply.
  CHECK(tops("snap y 4.2m snap y 4.2m", plain) == tops("snap y 4.2m", plain));
}

TEST_CASE("a line that snaps leaves the parts on both sides a size", "[split]") {
  const auto boxes = boxesOf(derivedRules(
      "rule Main { at(20m, 20m, 20m) size(8m, 2m, 2m) snap x 4m split x snap 9m { { 1m: box(scope); }* } }"));
  REQUIRE(boxes.size() == 8);
  double volume = 0;
  for (const Box& box : boxes) {
    CHECK(box.high.x > box.low.x);
    volume += box.volume();
  }
  CHECK(volume == Approx(32).epsilon(0.01));
}

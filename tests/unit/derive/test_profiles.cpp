// Tests footprints, extrusions of footprints, and roofs.

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "base/math.h"
#include "derive/layout/plan.h"
#include "derive_fixture.h"
#include "rounds.h"
#include "seed.h"

using namespace sgm;

namespace {

constexpr double kUnit = 1.0 / kUnitsPerMetre;

std::string decimal(double value) { return std::to_string(value); }

double random01(std::mt19937& random) { return std::uniform_real_distribution<double>(0, 1)(random); }

/// All shapes of one kind, in the order of derivation.
std::vector<Shape> shapesOf(const GrammarChunk& chunk, ShapeKind kind) {
  std::vector<Shape> out;
  for (const Shape& s : chunk.shapes)
    if (s.kind == kind) out.push_back(s);
  return out;
}

/// World coordinates, in metres, of the corners of an upright prism, in order from x towards z.
std::vector<PlanCorner> outlineOf(const GrammarChunk& chunk, const Shape& prism) {
  std::vector<PlanCorner> out;
  for (uint32_t i = prism.point_count; i-- > 0;) {
    const Int3 p = chunk.points[prism.first_point + i];
    out.push_back({(prism.frame.origin.x + p.x) * kUnit, (prism.frame.origin.z + p.z) * kUnit});
  }
  return out;
}

/// Whether a point lies inside a convex outline, and not too near to the outline's edges.
bool holds(const std::vector<PlanCorner>& outline, PlanCorner p) {
  for (size_t i = 0; i < outline.size(); ++i) {
    const PlanCorner a = outline[i], b = outline[(i + 1) % outline.size()];
    if ((b.x - a.x) * (p.z - a.z) - (b.z - a.z) * (p.x - a.x) <= 1e-4) return false;
  }
  return true;
}

PlanCorner middleOf(const std::vector<PlanCorner>& outline) {
  PlanCorner sum;
  for (const PlanCorner& c : outline) sum = {sum.x + c.x, sum.z + c.z};
  const double n = static_cast<double>(outline.size());
  return {sum.x / n, sum.z / n};
}

/// Whether two pieces overlap, tested at points in the triangles from the first piece's middle to its corners.
bool overlap(const std::vector<PlanCorner>& a, const std::vector<PlanCorner>& b) {
  const PlanCorner m = middleOf(a);
  for (size_t i = 0; i < a.size(); ++i)
    for (double out = 0.02; out < 1; out += 0.02)
      for (double along = 0.05; along < 1; along += 0.1) {
        const PlanCorner c = a[i], d = a[(i + 1) % a.size()];
        const PlanCorner e{c.x + along * (d.x - c.x), c.z + along * (d.z - c.z)};
        const PlanCorner p{m.x + out * (e.x - m.x), m.z + out * (e.z - m.z)};
        if (holds(a, p) && holds(b, p)) return true;
      }
  return false;
}

/// The normal of a roof's half-space, which points out of the solid.
Vec3 normalOf(const Shape& halfspace) {
  return {double{halfspace.frame.rows[3]}, double{halfspace.frame.rows[4]}, double{halfspace.frame.rows[5]}};
}

std::string firstNote(const std::string& rules) {
  const GrammarChunk chunk = derivedRules(rules);
  CHECK(chunk.groups.empty());
  REQUIRE(chunk.notes.size() == 1);
  return chunk.notes[0].message;
}

}  // namespace

TEST_CASE("merged plans hang together, and every piece is a draw of its own", "[derive][profiles]") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  for (unsigned round = 0; round < rounds(60); ++round) {
    const int count = 2 + static_cast<int>(random() % 9);
    const bool rect = random() % 2 == 0;
    const std::string outline = rect ? "rect(rand(1m, 18m), rand(1m, 14m))" : "regular(rand(3, 9), rand(1m, 9m))";
    const GrammarChunk chunk = derivedRules(
        "rule Main { footprint merge " + std::to_string(count) + " " + outline + " as plan; extrude 5m of plan; }", {},
        random());
    CAPTURE(outline, count);
    const std::vector<Shape> pieces = shapesOf(chunk, ShapeKind::prism);
    REQUIRE(pieces.size() == static_cast<size_t>(count));
    REQUIRE(chunk.notes.empty());
    const std::vector<PlanCorner> first = outlineOf(chunk, pieces[0]);
    // Compares whole outlines, because single corners of two pieces may be rounded to the same unit.
    std::set<std::vector<std::pair<double, double>>> outlines;
    for (const Shape& piece : pieces) {
      const std::vector<PlanCorner> corners = outlineOf(chunk, piece);
      REQUIRE(overlap(corners, first));
      std::vector<std::pair<double, double>> places;
      for (const PlanCorner& c : corners) places.emplace_back(c.x, c.z);
      outlines.insert(places);
    }
    CHECK(outlines.size() == pieces.size());
  }
}

TEST_CASE("an extrusion is as high as it says, from y = 0 up", "[derive][profiles]") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  for (unsigned round = 0; round < rounds(40); ++round) {
    const double height = 0.1 + 40 * random01(random), scale = 0.5 + random01(random);
    CAPTURE(height, scale);
    const GrammarChunk chunk =
        derivedRules("rule Main { scale(" + decimal(scale) + ") { footprint rect(8m, 6m) as plan; extrude " +
                     decimal(height) + "m of plan { at(0m, 0.5*scope.y, 0m) anchor top; } } }");
    const std::vector<Shape> solids = shapesOf(chunk, ShapeKind::prism);
    REQUIRE(solids.size() == 1);
    const double half = double{solids[0].size[0]}, middle = solids[0].frame.origin.y;
    CHECK(std::fabs(2 * half - height * scale * kUnitsPerMetre) < 0.01 + 1e-6 * half);
    CHECK(std::fabs(middle - half) <= 0.51);
    // The scope of the block is the bounding box of the piece.
    REQUIRE(chunk.anchors.size() == 1);
    // Two values are rounded to whole units separately: the scope's middle and half of its height. `half` is also
    // rounded to a float.
    CHECK(std::fabs(chunk.anchors[0].frame.origin.y - 2 * half) <= 1.01);
  }
}

TEST_CASE("a block is derived for each piece, and cuts from its own alone", "[derive][profiles]") {
  const GrammarChunk chunk = derivedRules(
      "rule Main { footprint merge 4 rect(rand(5m, 9m), rand(5m, 9m)) as plan;\n"
      "extrude rand(3m, 9m) of plan { cut { box(1m); } mat brick; } }");
  const std::vector<Shape> pieces = shapesOf(chunk, ShapeKind::prism), cuts = shapesOf(chunk, ShapeKind::subtract),
                           boxes = shapesOf(chunk, ShapeKind::box);
  REQUIRE((pieces.size() == 4 && cuts.size() == 4 && boxes.size() == 4));
  CHECK(chunk.groups.size() == 4);
  std::set<float> heights;
  for (size_t i = 0; i < 4; ++i) {
    heights.insert(pieces[i].size[0]);
    CHECK(boxes[i].frame.origin == pieces[i].frame.origin);
    CHECK(cuts[i].child_count == 2);
    CHECK(pieces[i].material == 1);
  }
  CHECK(heights.size() == 4);
}

TEST_CASE("a plan is handed to rules, and stands in the scope in which it is used", "[derive][profiles]") {
  const std::string use = "extrude 3m of plan; at(0m, 3m, 0m) roof hip(30deg) of plan;";
  const std::string plan = "footprint merge 3 rect(rand(5m, 9m), 6m) as plan; ";
  const GrammarChunk here = derivedRules("rule Main { " + plan + "at(9m, 0m, 0m) { " + use + " } }"),
                     there = derivedRules("rule Main { " + plan + "at(9m, 0m, 0m) Use(plan); } rule Use(plan) { " +
                                          use + " }");
  REQUIRE(here.shapes.size() == there.shapes.size());
  for (size_t i = 0; i < here.shapes.size(); ++i) {
    CHECK(here.shapes[i].kind == there.shapes[i].kind);
    CHECK(here.shapes[i].frame == there.shapes[i].frame);
    CHECK(here.shapes[i].size == there.shapes[i].size);
  }
  CHECK(here.points == there.points);
  CHECK(shapesOf(here, ShapeKind::prism)[0].frame.origin.x == 9 * kUnitsPerMetre);
}

TEST_CASE("an override by tag takes the place of all that an extrusion makes", "[derive][profiles]") {
  const std::string tower =
      "rule Main { footprint merge 3 rect(rand(5m, 9m), 6m) as plan;\n"
      "extrude rand(5m, 9m) of plan { tag \"wing\"; cut { box(1m); } } }\n";
  const GrammarChunk plain = derivedRules(tower), same = derivedRules(tower + "override tag \"wing\" { inner; }"),
                     other = derivedRules(tower + "override tag \"wing\" { sphere(2m); }");
  REQUIRE(plain.shapes.size() == 9);
  REQUIRE(same.shapes.size() == 9);
  for (size_t i = 0; i < 9; ++i) CHECK(plain.shapes[i].frame == same.shapes[i].frame);
  REQUIRE(other.shapes.size() == 1);
  CHECK(other.shapes[0].kind == ShapeKind::sphere);
}

TEST_CASE("outlines grow by the margin on every side", "[derive][profiles]") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  for (unsigned round = 0; round < rounds(100); ++round) {
    PlanPiece piece = random() % 2 == 0 ? rectPiece(1 + 9 * random01(random), 1 + 9 * random01(random))
                                        : regularPiece(3 + static_cast<int>(random() % 9), 1 + 9 * random01(random));
    const double margin = 2 * random01(random);
    REQUIRE(isConvex(piece));
    const std::vector<PlanCorner> grown = grownOutline(piece, margin);
    for (size_t i = 0; i < grown.size(); ++i) {
      const size_t next = (i + 1) % grown.size();
      const PlanCorner a = piece.corners[i], b = piece.corners[next];
      const double edge = std::hypot(b.x - a.x, b.z - a.z);
      for (const PlanCorner p : {grown[i], grown[next]}) {
        const double out = ((b.z - a.z) * (p.x - a.x) - (b.x - a.x) * (p.z - a.z)) / edge;
        REQUIRE(std::fabs(out - margin) < 1e-9);
      }
    }
  }
  const std::vector<PlanCorner> needle =
      grownOutline(polygonPiece(std::vector<PlanCorner>{{0, 0}, {20, 0.1}, {0, 1}}), 1);
  double farthest = 0;
  for (const PlanCorner& c : needle) farthest = std::max(farthest, c.x);
  CHECK(farthest < 10 + 2.001);
  CHECK(farthest > 10 + 1.9);
  CHECK(!isConvex(polygonPiece(std::vector<PlanCorner>{{0, 0}, {6, 0}, {6, 2}, {2, 2}, {2, 6}, {0, 6}})));
}

TEST_CASE("polygons whose edges cross are known, however they are turned", "[derive][profiles]") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  for (unsigned round = 0; round < rounds(200); ++round) {
    // A star-shaped polygon around the origin is simple; on a circle, swapping two corners always makes edges cross.
    const size_t count = 5 + random() % 12;
    std::vector<PlanCorner> corners;
    for (size_t i = 0; i < count; ++i) {
      const double angle = 2 * kPi * (static_cast<double>(i) + 0.5 * random01(random)) / static_cast<double>(count);
      const double radius = 2 + 3 * random01(random);
      corners.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    const size_t first = random() % count, other = (first + 2 + random() % (count - 4)) % count;
    CAPTURE(round, count, first, other);
    CHECK(isSimple(polygonPiece(corners)));
    std::reverse(corners.begin(), corners.end());
    CHECK(isSimple(polygonPiece(corners)));
    for (PlanCorner& c : corners) {
      const double radius = std::hypot(c.x, c.z);
      c = {c.x / radius, c.z / radius};
    }
    CHECK(isSimple(polygonPiece(corners)));
    std::swap(corners[first], corners[other]);
    CHECK(!isSimple(polygonPiece(corners)));
  }
  // An edge of length 0, and a corner that touches another edge, are not crossings.
  CHECK(isSimple(polygonPiece(std::vector<PlanCorner>{{0, 0}, {6, 0}, {6, 0}, {6, 2}, {0, 2}})));
  CHECK(isSimple(polygonPiece(std::vector<PlanCorner>{{0, 0}, {6, 0}, {6, 4}, {3, 0}, {0, 4}})));
  CHECK(!isSimple(polygonPiece(std::vector<PlanCorner>{{0, 0}, {2, 1}, {6, 3}})));
}

TEST_CASE("a roof over a plan and what is extruded from it are one, wherever samples lie", "[derive][profiles]") {
  for (const char* roof : {"hip(30deg)", "gable(30deg)", "flat(1m)"}) {
    INFO(roof);
    const GrammarChunk chunk =
        derivedRules("rule Main { footprint rect(8m, 6m) as plan; extrude 3m of plan; at(0m, 3m, 0m) roof " +
                     std::string(roof) + " of plan; }");
    REQUIRE(chunk.groups.size() == 2);
    CHECK(chunk.groups[1].bounds.lo.y < 3 * kUnitsPerMetre - 1);
  }
}

TEST_CASE("roofs slope at their pitch, hips on every side and gables along the ridge", "[derive][profiles]") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  for (unsigned round = 0; round < rounds(60); ++round) {
    // The edge lengths are rounded as in the grammar's text: otherwise, digits that the text lacks could decide which
    // edge is longer.
    const auto edge = [&] { return std::stod(decimal(2 + 12 * random01(random))); };
    const double pitch = 5 + 75 * random01(random), x = edge(), z = edge();
    const int corners = 3 + static_cast<int>(random() % 9);
    struct Case {
      std::string over;
      size_t slopes;
    };
    const std::string box = "size(" + decimal(x) + "m, 0m, " + decimal(z) + "m) ",
                      angle = "(" + decimal(pitch) + "deg)";
    const Case cases[] = {
        {box + "roof hip" + angle + ";", 4},
        {box + "roof gable" + angle + ";", 2},
        {"footprint regular(" + std::to_string(corners) + ", 6m) as plan; roof hip" + angle + " of plan;",
         static_cast<size_t>(corners)},
        {"footprint polygon((9m, 1m), (2m, 8m), (1m, 1m)) as plan; roof hip" + angle + " of plan;", 3},
    };
    for (const Case& one : cases) {
      CAPTURE(one.over);
      const GrammarChunk chunk = derivedRules("rule Main { rot(y, 33deg) { " + one.over + " } }");
      const std::vector<Shape> slopes = shapesOf(chunk, ShapeKind::halfspace);
      REQUIRE(chunk.groups.size() == 1);
      REQUIRE(slopes.size() == one.slopes);
      Vec3 sum;
      for (const Shape& slope : slopes) {
        const Vec3 n = normalOf(slope);
        REQUIRE(std::fabs(n.y - std::cos(pitch * kPi / 180)) < 1e-5);
        sum = sum + n;
      }
      // The slopes face all directions equally, and outwards.
      if (one.slopes != 3) CHECK(std::hypot(sum.x, sum.z) < 1e-5);
    }
    // The ridge runs along the longer side.
    const GrammarChunk gable = derivedRules("rule Main { " + box + "roof gable" + angle + "; }");
    const Vec3 n = normalOf(shapesOf(gable, ShapeKind::halfspace)[0]);
    CHECK(std::fabs(x >= z ? n.x : n.z) < 1e-6);
    const double peak = 0.5 * std::min(x, z) * std::tan(pitch * kPi / 180);
    CHECK(std::fabs(gable.groups[0].bounds.hi.y * kUnit - peak) < 0.02);
  }
  // A roof stands on the floor of a box, at any height.
  const GrammarChunk high = derivedRules("rule Main { at(0m, 10m, 0m) size(8m, 4m, 6m) roof flat(1m); }");
  CHECK(std::abs(high.groups[0].bounds.lo.y - 8 * 1024) <= 2);
  CHECK(std::abs(high.groups[0].bounds.hi.y - 9 * 1024) <= 2);
}

TEST_CASE("roofs and footprints that make no sense are left out with a word", "[derive][profiles]") {
  const auto main = [](const std::string& body) { return firstNote("rule Main { let a = rand(0, 0); " + body + " }"); };
  CHECK(main("footprint merge a rect(2m, 2m) as plan; extrude 1m of plan;") ==
        "a footprint merges 1 to 64 pieces, such as merge 3; this one is left out");
  CHECK(main("footprint regular(a, 2m) as plan; extrude 1m of plan;") ==
        "a regular polygon has 3 to 64 corners, such as regular(6, 8m); this one is left out");
  CHECK(main("footprint rect(a*1m, 2m) as plan; extrude 1m of plan;") ==
        "a size of this footprint is not positive, or larger than the world; the piece is left out: bound it, such as "
        "max(x, 1m)");
  CHECK(main("footprint rect(1m, 2m) as plan; extrude a*1m of plan;") ==
        "a size of this solid is not positive, or larger than the world; it is left out: bound it, such as max(h, 1m)");
  CHECK(main("size(0m, 1m, 1m) roof flat(1m);") ==
        "this scope's box has no size along x or z, so it gets no roof: give it one, such as size(8m, 3m, 6m)");
  CHECK(main("size(1m, 1m, 1m) roof hip(90deg*(a + 1));") ==
        "the pitch of a roof is 5deg to 80deg, such as 35deg; this one is left out");
  CHECK(main("size(1m, 1m, 1m) roof flat(1m, overhang a*1m - 1m);") ==
        "the overhang of a roof is 0m or more, such as overhang 0.5m; this one is left out");
  CHECK(main("footprint regular(4, 2m) as plan; roof gable(30deg) of plan;") ==
        "a gable stands on rectangles; this roof is left out: take `hip`");
  CHECK(main("footprint polygon((0m, 0m), (6m, 0m), (6m, 2m), (2m, 2m), (2m, 6m)) as plan; roof hip(30deg) of plan;") ==
        "a hip stands on convex outlines; this roof is left out: merge rectangles, or take `flat`");
  const std::string court =
      "footprint polygon((0m, 0m), (8m, 0m), (8m, 8m), (6m, 8m), (6m, 2m), (2m, 2m), (2m, 8m), (0m, 8m)) as plan; ";
  CHECK(main(court + "roof flat(1m, overhang 2.1m) of plan;") ==
        "this overhang grows together in a notch of the outline; the roof is left out: use a smaller overhang, or "
        "merge rectangles");
  CHECK(derivedRules("rule Main { " + court + "roof flat(1m, overhang 1.9m) of plan; }").notes.empty());
}

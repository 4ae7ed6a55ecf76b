// Tests lattices of tiles: the tiles' places, rotations and neighbours are as the language defines.

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>

#include "derive_fixture.h"
#include "rounds.h"
#include "seed.h"

using namespace sgm;

namespace {

constexpr double kUnits = 1024;

/// The places of the boxes with a material, in metres from the grammar cell's corner.
std::vector<std::pair<std::array<double, 3>, std::string>> marksOf(const Program& program, const GrammarChunk& chunk) {
  std::vector<std::pair<std::array<double, 3>, std::string>> out;
  for (const Shape& shape : chunk.shapes) {
    if (shape.kind != ShapeKind::box) continue;
    const auto& at = shape.frame.origin;
    out.push_back({{at[0] / kUnits, at[1] / kUnits, at[2] / kUnits}, std::string(program.materials[shape.material])});
  }
  return out;
}

constexpr const char* kSides[6] = {"front", "right", "back", "left", "top", "bottom"};
constexpr const char* kMarks[6] = {"z 0.5*scope.z - 0.1m", "x 0.5*scope.x - 0.1m", "z 0.1m - 0.5*scope.z",
                                   "x 0.1m - 0.5*scope.x", "y 0.5*scope.y - 0.1m", "y 0.1m - 0.5*scope.y"};

/// Random tiles. Each side that has a label also has a mark: a small box, whose material is named after the label.
std::string markedTiles(std::mt19937& random, const std::string& size, bool border) {
  const char* labels[] = {"red", "green", "blue"};
  const auto label = [&] { return labels[random() % 3]; };
  std::string out = "wfc " + size + " {";
  if (border) out += std::string(" border front ") + label() + ", top " + label() + " or " + label() + ";";
  const size_t count = 4 + random() % 6;
  for (size_t t = 0; t < count; ++t) {
    out += " t" + std::to_string(t) + " " + std::to_string(1 + random() % 5) + (random() % 2 == 0 ? " turn" : "");
    std::string body;
    for (size_t side = 0; side < 6; ++side) {
      // A side without a label may lie next to any side.
      if (random() % 12 == 0) continue;
      const std::string said = label();
      out += std::string(", ") + kSides[side] + " " + said;
      body += std::string(" at(") + kMarks[side] + ") { box(0.05m); mat " + said + "; }";
    }
    out += ": {" + body + " }";
  }
  return out + " }";
}

size_t countOf(const std::vector<std::string>& names, const std::string& name) {
  return static_cast<size_t>(std::count(names.begin(), names.end(), name));
}

/// The materials of the boxes in a derived cell, in the order of the tiles that contain the boxes.
std::vector<std::string> tilesOf(const Program& program, const GrammarChunk& chunk) {
  std::vector<std::string> out;
  for (const auto& [at, material] : marksOf(program, chunk)) out.push_back(material);
  return out;
}

std::shared_ptr<const Program> ofTiles(const std::string& rules) {
  return compiled("sgm 1; units m; domain infinite; layer main cell 64m reach 64m { start Main; }\n" + rules);
}

const std::string kMeadow =
    "rule Main { size(24m, 2m, 24m) wfc 3m { border side lawn; lawn 3, side lawn: Lawn; "
    "wall 2 turn, left wall, right wall, side lawn: Wall; corner 1 turn, left wall, front wall, side lawn: Corner; } "
    "}\n"
    "rule Lawn { box(1m); mat lawn; } rule Wall { size(z 1m) box(scope); mat wall; } rule Corner { box(1m); mat "
    "corner; "
    "}";

}  // namespace

TEST_CASE("sides that touch have a label in common, however tiles are turned and scopes lie", "[wfc]") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  unsigned filled = 0, pairs = 0, turned = 0;
  for (unsigned round = 0; round < rounds(200); ++round) {
    const bool border = random() % 2 == 0;
    const auto [scope, size, n] = std::array<std::tuple<const char*, const char*, std::array<int, 3>>, 3>{{
        {"8m, 4m, 6m", "2m", {4, 2, 3}},
        {"7m, 3m, 9m", "(2m, 3m, 4m)", {4, 1, 2}},
        {"5m, 6m, 5m", "(1m, 2m, 2.5m)", {5, 3, 2}},
    }}[random() % 3];
    const std::string text = markedTiles(random, size, border);
    const std::string full =
        "sgm 1; units m; domain infinite; layer main cell 64m reach 64m { start Main; }\nrule Main "
        "{ at(20m, 20m, 20m) size(" +
        std::string(scope) + ") " + text + " }";
    CAPTURE(round, full);
    const CompileResult result = compileGrammar(full, "test.sgm");
    if (!result.program) {
      // A label that fits no other side makes the grammar invalid.
      REQUIRE(result.diagnostics[0].code == "unknown-name");
      continue;
    }
    const GrammarChunk chunk = derived(*result.program, {}, random());
    if (!chunk.notes.empty()) {
      REQUIRE(chunk.notes.size() == 1);
      REQUIRE(chunk.shapes.empty());
      continue;
    }
    ++filled;
    const auto marks = marksOf(*result.program, chunk);
    const size_t places = static_cast<size_t>(n[0] * n[1] * n[2]);
    REQUIRE(marks.size() <= 6 * places);
    // Where two tiles meet, the marks of the two sides (the small boxes of markedTiles()) lie 0.2 m apart. Counts these
    // pairs of marks, and checks that their materials are equal.
    size_t met = 0;
    for (size_t a = 0; a < marks.size(); ++a) {
      for (size_t b = a + 1; b < marks.size(); ++b) {
        double off[3];
        for (size_t axis = 0; axis < 3; ++axis) off[axis] = std::fabs(marks[a].first[axis] - marks[b].first[axis]);
        std::sort(off, off + 3);
        if (off[1] > 0.01 || off[2] > 0.21) continue;
        REQUIRE(marks[a].second == marks[b].second);
        ++met;
      }
    }
    const int lines = (n[0] - 1) * n[1] * n[2] + n[0] * (n[1] - 1) * n[2] + n[0] * n[1] * (n[2] - 1);
    // `lines` is the number of pairs of adjacent places. A side without a label has no mark, so a pair with such a side
    // is missing in `met`. Each such side accounts for at most one missing pair.
    REQUIRE(met <= static_cast<size_t>(lines));
    REQUIRE(met + (6 * places - marks.size()) >= static_cast<size_t>(lines));
    pairs += static_cast<unsigned>(met);
    std::set<std::string> orientations;
    for (const Shape& shape : chunk.shapes) orientations.insert(std::to_string(shape.frame.rows[0]));
    turned += orientations.size() > 1;
  }
  CAPTURE(filled, pairs, turned);
  CHECK(filled > rounds(200) / 8);
  CHECK(turned > filled / 4);
}

TEST_CASE("tiles fill their scope, as many as are nearest to their size", "[wfc]") {
  for (const auto& [edge, size, count] :
       {std::tuple{"6m", "2m", 3}, std::tuple{"7m", "2m", 4}, std::tuple{"6.9m", "2m", 3}, std::tuple{"0.5m", "2m", 1},
        std::tuple{"5m", "(1m, 2m, 3m)", 5}}) {
    CAPTURE(edge, size);
    const GrammarChunk chunk =
        derivedRules("rule Main { size(" + std::string(edge) + ", 2m, 3m) wfc " + size + " { a 1: box(scope); } }");
    std::map<int32_t, double> columns;
    double low = 1e9, high = -1e9;
    for (const Shape& shape : chunk.shapes) {
      if (shape.kind != ShapeKind::box) continue;
      columns[shape.frame.origin[0]] += 1;
      low = std::min(low, shape.frame.origin[0] / kUnits - double{shape.size[0]} / kUnits);
      high = std::max(high, shape.frame.origin[0] / kUnits + double{shape.size[0]} / kUnits);
    }
    CHECK(columns.size() == static_cast<size_t>(count));
    CHECK(high - low == Approx(std::atof(edge)).margin(2 / kUnits));
  }
}

TEST_CASE("a face of a box takes tiles, too", "[wfc]") {
  const GrammarChunk chunk = derivedRules(
      "rule Main { size(8m, 6m, 4m) comp { side: wfc 2m { border bottom ground, top sky; door 1, bottom ground, top "
      "storey: size(z 0.5m) box(scope); window 2, bottom storey, top storey or sky: size(z 0.5m) box(scope); } } }");
  CHECK(chunk.notes.empty());
  size_t boxes = 0;
  for (const Shape& shape : chunk.shapes) boxes += shape.kind == ShapeKind::box;
  CHECK(boxes == 2 * 3 * (4 + 2));
}

TEST_CASE("a lattice is the same wherever and whenever it is derived, and another by another seed", "[wfc]") {
  const auto program = ofTiles(kMeadow);
  const GrammarChunk first = derived(*program, {}, 3);
  CHECK(hashChunk(first) == hashChunk(derived(*program, {}, 3)));
  std::set<std::vector<std::string>> seen;
  for (uint64_t seed = 0; seed < 20; ++seed) {
    const GrammarChunk chunk = derived(*program, {}, seed);
    REQUIRE(chunk.notes.empty());
    seen.insert(tilesOf(*program, chunk));
  }
  CHECK(seen.size() > 10);
  // Different cells have different tiles, and a cell's tiles do not depend on the order in which cells are derived.
  const GrammarChunk there = derived(*program, {5, 0, -3}, 3);
  CHECK(tilesOf(*program, there) != tilesOf(*program, first));
  CHECK(hashChunk(derived(*program, {5, 0, -3}, 3)) == hashChunk(there));
}

TEST_CASE("walls run on from tile to tile, and their ends meet", "[wfc]") {
  // The walls in this meadow form closed loops, so the number of their corner tiles is even, and at least four
  // if there are walls.
  const auto program = ofTiles(kMeadow);
  unsigned walls = 0;
  for (uint64_t seed = 0; seed < 30; ++seed) {
    const auto names = tilesOf(*program, derived(*program, {}, seed));
    CAPTURE(seed);
    CHECK(names.size() == 64);
    const size_t corners = countOf(names, "corner");
    CHECK(corners % 2 == 0);
    if (countOf(names, "wall") > 0) CHECK(corners >= 4);
    walls += countOf(names, "wall") > 0;
  }
  CHECK(walls > 5);
}

TEST_CASE("an override by path changes one tile, in the place and turn that it has", "[wfc]") {
  const auto plain = ofTiles(kMeadow),
             edited = ofTiles(kMeadow + "\noverride \"Main/Wall[1]\" { box(0.5m); mat gate; }");
  for (uint64_t seed = 0; seed < 20; ++seed) {
    const auto before = marksOf(*plain, derived(*plain, {}, seed)),
               after = marksOf(*edited, derived(*edited, {}, seed));
    REQUIRE(before.size() == after.size());
    size_t walls = 0, changed = 0;
    for (size_t i = 0; i < before.size(); ++i) {
      walls += before[i].second == "wall";
      if (before[i].second == after[i].second) continue;
      ++changed;
      CHECK(after[i].second == "gate");
      CHECK(walls == 2);
      CHECK(before[i].first == after[i].first);
    }
    CHECK(changed == (countOf(tilesOf(*plain, derived(*plain, {}, seed)), "wall") > 1 ? 1u : 0u));
  }
}

TEST_CASE("an override by tag changes what stands in a tile, wherever that stands", "[wfc]") {
  const std::string meadow = std::string(kMeadow).replace(kMeadow.find("Wall {"), 6, "Wall { tag \"wall\";");
  const auto plain = ofTiles(kMeadow), edited = ofTiles(meadow + "\noverride tag \"wall\" { box(0.5m); mat gate; }");
  unsigned walls = 0;
  for (uint64_t seed = 0; seed < 20; ++seed) {
    std::vector<std::string> before = tilesOf(*plain, derived(*plain, {}, seed));
    walls += static_cast<unsigned>(countOf(before, "wall"));
    std::replace(before.begin(), before.end(), std::string("wall"), std::string("gate"));
    CHECK(tilesOf(*edited, derived(*edited, {}, seed)) == before);
  }
  CHECK(walls > 0);
}

TEST_CASE("what is searched for in vain leaves the tiles beside it as they are", "[wfc]") {
  const std::string field =
      "rule Field { size(20m, 1m, 20m) wfc 1m { a 1: { box(0.5m); mat a; } b 1: { box(0.5m); mat b; } } }";
  // The search ends without a solution, and without a proof that there is none.
  const std::string vain =
      "rule Vain { size(9m, 1m, 9m) wfc 1m { border side edge; half 1 turn, front pair, side edge: box(scope); } }";
  const auto alone = ofTiles("rule Main { repeat 0 Vain; Field; }" + vain + field);
  const auto beside = ofTiles("rule Main { repeat 12 Vain; Field; }" + vain + field);
  DeriveLimits few;
  few.steps = 100'000;
  const auto tiles = [&](const Program& program) {
    const auto chunk = deriveCell(program, {}, 7, 0, {}, Ceiling(0), few);
    INFO((chunk ? std::string() : chunk.error().message));
    REQUIRE(chunk);
    return tilesOf(program, *chunk);
  };
  CHECK(tiles(*alone).size() == 400);
  CHECK(tiles(*beside) == tiles(*alone));
}

TEST_CASE("as many tiles as there may be are found where they fit easily", "[wfc]") {
  const GrammarChunk chunk = derivedRules(
      "rule Main { size(32m, 32m, 32m) wfc 1m { none 9, side lawn, top lawn, bottom lawn: { } wall 1 turn, left wall, "
      "right wall, side lawn, top lawn, bottom lawn: { } } }");
  CHECK(chunk.notes.empty());
}

TEST_CASE("each tile draws for itself", "[wfc]") {
  const auto program =
      ofTiles("rule Main { size(8m, 2m, 8m) wfc 2m { a 1: A; } }\nrule A { sphere(rand(0.2m, 0.9m)); }");
  std::set<float> radii;
  const GrammarChunk chunk = derived(*program);
  for (const Shape& shape : chunk.shapes)
    if (shape.kind == ShapeKind::sphere) radii.insert(shape.size[0]);
  CHECK(radii.size() == 16);
}

TEST_CASE("what meets others than its own kind stands beside those alone", "[wfc]") {
  // The arrows must be placed head to tail, so all arrows of a line have one direction.
  const auto arrows = ofTiles(
      "rule Main { size(24m, 1m, 2m) wfc 2m { arrow 1 turn, left tail meets head, right head meets tail, front flank, "
      "back flank: at(x 0.5m) { box(0.5m); mat mark; } } }");
  std::set<int> ways;
  for (uint64_t seed = 0; seed < 20; ++seed) {
    std::vector<double> at;
    for (const auto& mark : marksOf(*arrows, derived(*arrows, {}, seed))) at.push_back(mark.first[0]);
    std::sort(at.begin(), at.end());
    REQUIRE(at.size() == 12);
    for (size_t i = 1; i < at.size(); ++i) CHECK(at[i] - at[i - 1] == Approx(2).margin(0.01));
    ways.insert(at[0] > -11);
  }
  CHECK(ways.size() == 2);
  // A tower may stand only beside walls, a wall beside walls and towers. So no two towers stand side by side.
  const auto towers = ofTiles(
      "rule Main { size(16m, 2m, 16m) wfc 2m { tower 9, side post meets wall: { box(1m); mat tower; } wall 1, side "
      "wall "
      "meets wall or post: { box(1m); mat wall; } } }");
  for (uint64_t seed = 0; seed < 10; ++seed) {
    const auto marks = marksOf(*towers, derived(*towers, {}, seed));
    REQUIRE(marks.size() == 64);
    CHECK(countOf(tilesOf(*towers, derived(*towers, {}, seed)), "tower") > 10);
    for (size_t a = 0; a < marks.size(); ++a)
      for (size_t b = 0; b < a; ++b) {
        const double off =
            std::fabs(marks[a].first[0] - marks[b].first[0]) + std::fabs(marks[a].first[2] - marks[b].first[2]);
        if (off < 2.1) CHECK((marks[a].second == "wall" || marks[b].second == "wall"));
      }
  }
}

TEST_CASE("parameters weigh tiles", "[wfc]") {
  const std::string text =
      "sgm 1; units m; param lawns = 1 in 0..9; domain infinite; layer main cell 64m reach 64m { start Main; }\n"
      "rule Main { size(20m, 2m, 20m) wfc 2m { lawn lawns: { box(1m); mat lawn; } tree 1: { box(1m); mat tree; } } }";
  const auto program = compiled(text);
  CHECK(countOf(tilesOf(*program, derived(*program)), "lawn") > 30);
  CHECK(countOf(tilesOf(*program, derived(*program)), "tree") > 30);
  const auto none = compiled(std::string(text).replace(text.find("= 1 in"), 3, "= 0"));
  CHECK(countOf(tilesOf(*none, derived(*none)), "tree") == 100);
}

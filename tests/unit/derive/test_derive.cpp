#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <thread>

#include "derive/bounds.h"
#include "derive_fixture.h"

using namespace sgm;

namespace {

const Shape& rootOf(const GrammarChunk& chunk, size_t group) { return chunk.shapes[chunk.groups.at(group).root]; }

/// The end points of the capsules of all passages, in order along each passage.
std::vector<Int3> corners(const GrammarChunk& chunk) {
  std::vector<Int3> ends;
  for (const Shape& s : chunk.shapes) {
    if (s.kind != ShapeKind::capsule) continue;
    const Int3 to = saturatingAdd(s.frame.origin, {static_cast<int32_t>(s.size[1]), static_cast<int32_t>(s.size[2]),
                                                   static_cast<int32_t>(s.size[3])});
    ends.push_back(s.frame.origin);
    ends.push_back(to);
  }
  return ends;
}

}  // namespace

TEST_CASE("a cell derives to the same chunk, however often, in any order, on any thread", "[threads]") {
  const auto program = compiled(kCave);
  std::vector<Int3> cells;
  for (int i = 0; i < 18; ++i) cells.push_back({i % 3 - 1, (i / 3) % 3 - 1, i / 9});
  std::map<Int3, uint64_t> hashes;
  for (const Int3& cell : cells) hashes[cell] = hashChunk(derived(*program, cell));
  std::set<uint64_t> different;
  for (const auto& [cell, hash] : hashes) different.insert(hash);
  CHECK(different.size() == cells.size());
  std::mt19937 random(3);
  std::shuffle(cells.begin(), cells.end(), random);
  std::vector<uint64_t> again(cells.size());
  std::vector<std::thread> threads;
  for (size_t t = 0; t < 4; ++t) {
    threads.emplace_back([&, t] {
      for (size_t i = t; i < cells.size(); i += 4) {
        auto chunk = deriveCell(*program, ParameterValues::defaults(*program), 7, 0, cells[i], Ceiling(1 << 30));
        again[i] = chunk ? hashChunk(*chunk) : 0;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (size_t i = 0; i < cells.size(); ++i) CHECK(again[i] == hashes[cells[i]]);
  CHECK(hashChunk(derived(*program, {}, 8)) != hashes[Int3{}]);
}

TEST_CASE("the cave's first cell is what it always was") {
  const auto program = compiled(kCave);
  const GrammarChunk chunk = derived(*program);
  CHECK(chunk.notes.empty());
  CHECK(hashChunk(chunk) == 0xb8192e541f97b5d5u);
}

TEST_CASE("expressions stand in the order in which they are written, whatever the compiler") {
  const auto chunk = derivedRules(
      "rule Main { displace max(0.1m*fractal(3m), 0.1m*fractal(5m)) amp 0.2m { sphere(2m); } "
      "displace 1m*mix(fractal(2m), fractal(4m), p.z/9m) amp 0.2m { sphere(2m); } }");
  REQUIRE(chunk.noises.size() == 4);
  CHECK(chunk.noises[0].period == 3072);
  CHECK(chunk.noises[1].period == 5120);
  CHECK(chunk.noises[2].period == 2048);
  CHECK(chunk.noises[3].period == 4096);
}

TEST_CASE("the cave: all groups cut, bounds hold the chunk's reach, one anchor in its own cell") {
  const auto program = compiled(kCave);
  for (int i = 0; i < 27; ++i) {
    const Int3 cell{i % 3 - 1, (i / 3) % 3 - 1, i / 9 - 1};
    const GrammarChunk chunk = derived(*program, cell);
    CAPTURE(cell.x, cell.y, cell.z);
    CHECK(chunk.notes.empty());
    REQUIRE(chunk.anchors.size() == 1);
    CHECK(cellBox(program->layers[0], cell).contains(chunk.anchors[0].frame.origin));
    CHECK(chunk.groups.size() >= 1);
    for (const Group& g : chunk.groups) {
      CHECK(g.cut);
      CHECK(cellLimit(*program, 0, cell).contains(g.bounds));
      CHECK(g.bounds == levelBounds(chunk, g.root, 0));
    }
  }
}

TEST_CASE("a passage ends where the other cell has its chamber") {
  const auto program = compiled(kCave);
  int passages = 0;
  std::map<Int3, Int3> hubs;
  for (int i = 0; i < 64; ++i) {
    const Int3 cell{i % 4, (i / 4) % 4, i / 16};
    hubs[cell] = derived(*program, cell).anchors.at(0).frame.origin;
  }
  for (const auto& [cell, hub] : hubs) {
    const std::vector<Int3> ends = corners(derived(*program, cell));
    for (size_t i = 0; i + 1 < ends.size(); ++i) {
      // Each passage starts at this cell's hub. So the corner before a hub is the end of the previous passage, which is
      // the hub of another cell.
      const bool first = ends[i] == hub;
      if (!first || i == 0) continue;
      bool found = false;
      for (const auto& [other, at] : hubs) found = found || at == ends[i - 1];
      const bool at_border = cell.x == 3 || cell.y == 3 || cell.z == 3;
      CHECK((found || at_border));
      passages += found ? 1 : 0;
    }
  }
  CHECK(passages > 5);
}

TEST_CASE("draws follow the path: what one statement draws does not move the others") {
  const std::string_view head = "sgm 1; units m; domain infinite; layer main cell 64m reach 64m { start Main; } ";
  const std::string_view tail = "rule Ball(r) { at(rand(0m, 9m), 0m, 0m) sphere(r); }";
  const auto text = [&](std::string_view body) { return std::string(head) + std::string(body) + std::string(tail); };
  const GrammarChunk one = derived(*compiled(text("rule Main { Ball(rand(1m, 2m)); Ball(rand(1m, 2m)); }")));
  const GrammarChunk two = derived(*compiled(text("rule Main { Ball(rand(1m, 2m)); Ball(rand(1m, 2m)); Ball(3m); }")));
  REQUIRE(one.groups.size() == 2);
  REQUIRE(two.groups.size() == 3);
  for (size_t i = 0; i < 2; ++i) {
    CHECK(one.groups[i].key == two.groups[i].key);
    CHECK(rootOf(one, i).size[0] == rootOf(two, i).size[0]);
    CHECK(rootOf(one, i).frame.origin == rootOf(two, i).frame.origin);
  }
  CHECK(rootOf(one, 0).size[0] != rootOf(one, 1).size[0]);
  CHECK(rootOf(one, 0).frame.origin != rootOf(one, 1).frame.origin);
}

TEST_CASE("loop copies draw apart, and a longer loop keeps the first copies") {
  const auto three = derivedRules("rule Main { repeat 3 at(4m, 0m, 0m) sphere(rand(1m, 2m)); }");
  const auto five = derivedRules("rule Main { repeat 5 at(4m, 0m, 0m) sphere(rand(1m, 2m)); }");
  REQUIRE(three.groups.size() == 3);
  REQUIRE(five.groups.size() == 5);
  CHECK(rootOf(three, 0).frame.origin == Int3{});
  CHECK(rootOf(three, 2).frame.origin == Int3{8192, 0, 0});
  for (size_t i = 0; i < 3; ++i) CHECK(rootOf(three, i).size[0] == rootOf(five, i).size[0]);
  CHECK(rootOf(three, 0).size[0] != rootOf(three, 1).size[0]);
}

TEST_CASE("cut takes away from what precedes in its block, at layer level from the world") {
  const auto world = derivedRules("rule Main { sphere(3m); cut { sphere(2m); box(1m); } sphere(1m); }");
  REQUIRE(world.groups.size() == 4);
  CHECK(std::count_if(world.groups.begin(), world.groups.end(), [](const Group& g) { return g.cut; }) == 2);

  const auto nested =
      derivedRules("rule Main { A(); } rule A { sphere(3m); box(2m); cut { sphere(2m); } sphere(1m); }");
  REQUIRE(nested.groups.size() == 2);
  CHECK(rootOf(nested, 0).kind == ShapeKind::subtract);
  CHECK(rootOf(nested, 0).child_count == 2);
  CHECK(nested.shapes[nested.children[rootOf(nested, 0).first_child]].kind == ShapeKind::unite);
  CHECK(rootOf(nested, 1).kind == ShapeKind::sphere);

  const auto round = derivedRules("rule Main { A(); } rule A { box(4m); cut smooth 1m sphere(2m); }");
  REQUIRE(round.groups.size() == 1);
  CHECK(rootOf(round, 0).kind == ShapeKind::subtract_smooth);
  CHECK(rootOf(round, 0).amount == 1024.0f);
}

TEST_CASE("unions flatten into groups; smooth unions, meets and sums are one group each") {
  CHECK(derivedRules("rule Main { union { sphere(1m); box(1m); } }").groups.size() == 2);
  const auto smooth =
      derivedRules("rule Main { union smooth 0.5m { sphere(1m); box(1m); A(); } } rule A { sphere(2m); box(3m); }");
  REQUIRE(smooth.groups.size() == 1);
  CHECK(rootOf(smooth, 0).child_count == 4);
  const auto meet =
      derivedRules("rule Main { meet { sphere(2m); A(); halfspace(below 1m); } } rule A { box(3m); box(2m, 9m, 2m); }");
  REQUIRE(meet.groups.size() == 1);
  CHECK(rootOf(meet, 0).child_count == 3);
  CHECK(meet.groups[0].bounds.hi.y <= 1026);
  const auto sum = derivedRules("rule Main { sum { blob(2m); at(1m, 0m, 0m) blob(1m); } }");
  REQUIRE(sum.groups.size() == 1);
  CHECK(rootOf(sum, 0).kind == ShapeKind::sum);
  CHECK(sum.shapes[0].inner_radius == 2048.0f);
}

TEST_CASE("a morph is one node between its ends, and only an end at them") {
  const auto at = [](std::string_view t) {
    return derivedRules("rule Main { morph(sphere(2m), box(3m), " + std::string(t) + "); }");
  };
  CHECK(at("0").shapes.size() == 1);
  CHECK(rootOf(at("0"), 0).kind == ShapeKind::sphere);
  CHECK(rootOf(at("1"), 0).kind == ShapeKind::box);
  CHECK(rootOf(at("0.25"), 0).kind == ShapeKind::morph);
  CHECK(rootOf(at("0.25"), 0).amount == 0.25f);
  const auto field = at("smoothstep(0m, 9m, p.y)");
  CHECK(rootOf(field, 0).expr != kNone);
  CHECK(field.exprs[rootOf(field, 0).expr].op == ExprOp::smoothstep);
}

TEST_CASE("a morph by power is one superquadric") {
  const auto fixed = derivedRules("rule Main { morph(sphere(2m), box(4m), 0.5) power; }");
  REQUIRE(fixed.shapes.size() == 1);
  CHECK(fixed.shapes[0].kind == ShapeKind::superquadric);
  CHECK(fixed.shapes[0].size[3] == Approx(2 / 0.55));
  const auto varying = derivedRules("rule Main { morph(box(4m, 2m, 6m), ellipsoid(2m, 3m, 4m), p.y/9m) power; }");
  REQUIRE(varying.shapes.size() == 1);
  CHECK(varying.shapes[0].kind == ShapeKind::morph_power);
  CHECK(varying.shapes[0].size[1] == 3072.0f);
  CHECK(varying.shapes[0].size[4] == 1024.0f);
  const auto apart = derivedRules(
      "rule Main { morph(superq((1m, 1m, 1m), 0.5), superq((2m, 2m, 2m), 0.5), p.y/9m) power; sphere(1m); }");
  CHECK(apart.groups.size() == 1);
  REQUIRE(apart.notes.size() == 1);
  CHECK(apart.notes[0].path == "main(0, 0, 0)/Main");
  CHECK(apart.notes[0].line == 2);
}

TEST_CASE("transforms compose: quarter turns are exact, scale goes into sizes") {
  const auto turned =
      derivedRules("rule Main { at(1m, 2m, 3m) rot(y, 90deg) at(0m, 0m, 2m) scale(2) box(1m, 2m, 3m); }");
  REQUIRE(turned.shapes.size() == 1);
  const Shape& s = turned.shapes[0];
  CHECK(s.frame.origin == Int3{3072, 2048, 3072});
  CHECK(s.frame.rows == std::array<float, 9>{0, 0, -1, 0, 1, 0, 1, 0, 0});
  CHECK(s.size[0] == 1024.0f);
  CHECK(s.size[2] == 3072.0f);
  const auto mirrored = derivedRules("rule Main { mirror(x) at(1m, 0m, 0m) truncone(2m, 1m, 2m); }");
  CHECK(mirrored.shapes.at(0).frame.origin.x == -1024);
  CHECK(mirrored.shapes.at(0).frame.rows[0] == -1.0f);
}

TEST_CASE("materials and tags hold for their block and what it calls") {
  const auto chunk = derivedRules(
      "rule Main { sphere(1m); { box(1m); mat brick; tag \"wall\"; A(); } } rule A { box(2m); { box(3m); mat glass; } "
      "}");
  REQUIRE(chunk.groups.size() == 4);
  CHECK(rootOf(chunk, 0).material == 0);
  CHECK(rootOf(chunk, 1).material != 0);
  CHECK(rootOf(chunk, 2).material == rootOf(chunk, 1).material);
  CHECK(rootOf(chunk, 3).material != rootOf(chunk, 1).material);
  CHECK(rootOf(chunk, 3).tag == rootOf(chunk, 1).tag);
  CHECK(rootOf(chunk, 1).tag != 0);
}

TEST_CASE("sine and cosine stay between -1 and 1, whatever the angle") {
  const GrammarChunk chunk =
      derivedRules("rule Main { sphere(2m + 1m*sin(10000000rad)); sphere(2m + 1m*cos(-10000000rad)); }");
  REQUIRE(chunk.groups.size() == 2);
  CHECK(rootOf(chunk, 0).size[0] == 2048);
  CHECK(rootOf(chunk, 1).size[0] == 2048);
}

TEST_CASE("detail and lod limit the levels of what they hold") {
  const auto chunk = derivedRules(
      "rule Main { detail 0.5m { sphere(1m); detail 0.25m box(1m); } M(); }"
      "rule M lod 4m { box(5m); } rule M { sphere(5m); }");
  REQUIRE(chunk.groups.size() == 4);
  CHECK(rootOf(chunk, 0).detail == 512);
  CHECK(rootOf(chunk, 1).detail == 256);
  CHECK(rootOf(chunk, 2).kind == ShapeKind::sphere);
  CHECK(rootOf(chunk, 2).detail == 4095);
  CHECK(rootOf(chunk, 3).kind == ShapeKind::box);
  CHECK(rootOf(chunk, 3).coarsest == 4096);
}

TEST_CASE("fields: world and local coordinates, parameters, and u along a tube") {
  const auto chunk = derivedRules(
      "field wave(a) = a*q.y/1m + p.x*0.1;"
      "rule Main { at(0m, 5m, 0m) scale(2) displace wave(0.1m) amp 0.5m { tube((0m, 0m, 0m), (9m, 0m, 0m), 1m); } "
      "at(0m, 20m, 0m) displace 0.5m*u { tube((0m, 0m, 0m), (9m, 0m, 0m), 1m, bend 1m); } }");
  CHECK(chunk.notes.empty());
  REQUIRE(chunk.groups.size() == 2);
  CHECK(rootOf(chunk, 0).kind == ShapeKind::displace);
  bool anchored = false, swept = false;
  for (const Expr& e : chunk.exprs) {
    anchored = anchored || (e.op == ExprOp::coordinate && e.anchor == Int3{0, 5120, 0} && e.row[1] == 0.5f);
    swept = swept || (e.op == ExprOp::sweep && e.point_count >= 9 && chunk.points[e.first_point].y == 20480);
  }
  CHECK(anchored);
  CHECK(swept);
}

TEST_CASE("points on a shell, with recursion to a depth") {
  const auto chunk = derivedRules(
      "rule Main { at(32m, 32m, 32m) Puff(8m, 2); }"
      "rule Puff(r, n) when n > 0 { sphere(r); scatter 5 on shell(r, up 60%) Puff(0.4*r, n - 1); }"
      "rule Puff(r, n) else { sphere(r); }");
  CHECK(chunk.groups.size() == 1 + 5 + 25);
  std::set<uint64_t> keys;
  for (const Group& g : chunk.groups) keys.insert(g.key.value);
  CHECK(keys.size() == 31);
}

TEST_CASE("drips hang where the probe meets rock") {
  const auto program = compiled(kCave);
  const int32_t ceiling = 12 * 1024;
  const GrammarChunk chunk = derived(*program, {}, 7, 1, Ceiling(ceiling));
  CHECK(chunk.notes.empty());
  CHECK(chunk.groups.size() > 5);
  for (const Group& g : chunk.groups) {
    CHECK(chunk.shapes[g.root].frame.origin.y == ceiling);
    CHECK(chunk.shapes[g.root].detail > 0);
    CHECK(chunk.shapes[g.root].material != 0);
  }
  CHECK(derived(*program, {}, 7, 1, Ceiling(100 * 1024)).groups.empty());
}

TEST_CASE("a shape beyond its reach, or without a bound, is left out whole, and said") {
  const auto program = compiled(
      "sgm 1; units m; domain infinite; layer main cell 64m reach 64m { start Main; }\n"
      "rule Main { A(); A(); }\nrule A { at(0m, 30m, 0m) {\n  sphere(9m); sphere(2m); } }");
  Program narrow = *program;
  narrow.layers[0].reach = 1024 * 5;
  const GrammarChunk chunk = derived(narrow);
  CHECK(chunk.groups.size() == 2);
  REQUIRE(chunk.notes.size() == 2);
  CHECK(chunk.notes[0].path == "main(0, 0, 0)/Main/A[0]");
  CHECK(chunk.notes[1].path == "main(0, 0, 0)/Main/A[1]");
  CHECK(chunk.notes[0].line == 4);
  CHECK(chunk.notes[0].column == 3);
  CHECK(chunk.notes[0].message.find("4.00 m") != std::string::npos);
  CHECK(chunk.shapes.size() == 2);
}

TEST_CASE("shapes with a size of nothing are left out, and said") {
  const auto chunk = derivedRules("rule Main { sphere(rand(-2m, -1m)); box(1m); }");
  CHECK(chunk.groups.size() == 1);
  REQUIRE(chunk.notes.size() == 1);
  CHECK(chunk.notes[0].message.find("not positive") != std::string::npos);
}

TEST_CASE("caps fail the cell with the place and the path") {
  const auto program = compiled(
      "sgm 1; units m; domain infinite; layer main cell 64m reach 64m { start Main; }\n"
      "rule Main { repeat 1000 Leaf(); }\nrule Leaf { sphere(1m); }");
  const auto failing = [&](const DeriveLimits& limits) {
    const auto chunk = deriveCell(*program, ParameterValues::defaults(*program), 7, 0, {}, Ceiling(0), limits);
    REQUIRE_FALSE(chunk);
    CHECK(chunk.error().code == Code::limit);
    return chunk.error();
  };
  DeriveLimits shapes;
  shapes.shapes = 10;
  CHECK(failing(shapes).message ==
        "one cell has more than 10 shapes (derive fewer, or make the cells smaller), in main(0, 0, 0)/Main/Leaf[10]");
  CHECK(failing(shapes).line == 3);
  DeriveLimits steps;
  steps.steps = 100;
  CHECK(failing(steps).message.find("100 steps (derive less, or make the cells smaller), in main(0, 0, 0)/Main") !=
        std::string::npos);
  DeriveLimits depth;
  depth.depth = 1;
  CHECK(failing(depth).message ==
        "rules are nested more than 1 deep (give them a smaller `depth`), in main(0, 0, 0)/Main");
  DeriveLimits bytes;
  bytes.bytes = 1000;
  CHECK(failing(bytes).code == Code::limit);
  DeriveLimits nesting;
  nesting.nesting = 3;
  CHECK(failing(nesting).message.find("nested too deep") != std::string::npos);
}

TEST_CASE("arguments that fit no grammar are refused") {
  const auto program = compiled(kCave);
  const auto values = ParameterValues::defaults(*program);
  CHECK(deriveCell(*program, values, 7, 9, {}, Ceiling(0)).error().code == Code::invalid_argument);
  CHECK(deriveCell(*program, {}, 7, 0, {}, Ceiling(0)).error().code == Code::invalid_argument);
  CHECK(deriveCell(*program, values, 7, 0, {1 << 28, 0, 0}, Ceiling(0)).error().code == Code::invalid_argument);
}

TEST_CASE("parameters are checked against their range") {
  const auto program = compiled(kCave);
  auto values = ParameterValues::defaults(*program);
  CHECK(values.values.at(0) == 0.3);
  CHECK(values.set(*program, "boxy", 1.0));
  CHECK_FALSE(values.set(*program, "boxy", 1.5));
  CHECK_FALSE(values.set(*program, "bxy", 0.5));
  CHECK(values.values.at(0) == 1.0);
  const auto square = deriveCell(*program, values, 7, 0, {}, Ceiling(1 << 30));
  REQUIRE(square);
  CHECK(hashChunk(*square) != hashChunk(derived(*program)));
}

TEST_CASE("a finite grammar derives once, around the origin") {
  const auto program = compiled("sgm 1; units m; start Main; rule Main { at(0m, 3m, 0m) box(4m); anchor door; }");
  const GrammarChunk chunk = derived(*program);
  CHECK(chunk.notes.empty());
  REQUIRE(chunk.groups.size() == 1);
  CHECK(rootOf(chunk, 0).frame.origin == Int3{0, 3072, 0});
  CHECK(chunk.anchors.size() == 1);
  CHECK_FALSE(deriveCell(*program, {}, 7, 0, {1, 0, 0}, Ceiling(0)));
}

TEST_CASE("a cell far out is the cell at the origin, moved") {
  // Random draws depend on the cell's key, so the two cells are compared with rules that draw nothing.
  const std::string_view rules =
      "rule Main { at(1.3m, 2.7m, 3.1m) rot((1, 2, 3), 33deg) displace 0.1m*q.x/1m amp 0.2m { box(2m); } }";
  const GrammarChunk far = derivedRules(rules, {30000, -30000, 20000});
  GrammarChunk near = derivedRules(rules);
  translate(near, {30000 * 65536, -30000 * 65536, 20000 * 65536});
  near.cell = far.cell;
  near.groups[0].key = far.groups[0].key;
  CHECK(hashChunk(near) == hashChunk(far));
}

// Tests the notes about parts of a grammar that are so thin that a mesh may miss them.

#include "chunk/thin_parts.h"
#include "world/world_support.h"

using namespace sgm;

namespace {

constexpr int32_t kCell = 123;  // 12 cm, in units of 1/1024 m

/// The thin parts as text, such as "Pane 41 312; cut Bay 20 1": rule, thickness in units, number of uses.
std::string thinIn(const std::string& rules, int32_t cell = kCell, int level = 0,
                   const std::string& domain = "domain finite box(60m); start Main;") {
  const WorldField world(
      settingsOf("sgm 1; import \"std/rock.sgm\" as rock; field waves = rock.fbm(9m, 1m);\n" + domain + "\n" + rules,
                 cell),
      std::pmr::new_delete_resource());
  const IntBox box{{-30 * 1024, -30 * 1024, -30 * 1024}, {30 * 1024, 30 * 1024, 30 * 1024}};
  const Result<std::vector<ThinPart>> parts = thinParts(world, box, level);
  INFO((parts ? "" : parts.error().message));
  REQUIRE(parts);
  std::string out;
  for (const ThinPart& part : *parts)
    out += (out.empty() ? "" : "; ") + std::string(part.cut ? "cut " : "") + part.rule + " " +
           std::to_string(part.thickness) + (part.is_about ? " about " : " ") + std::to_string(part.uses);
  return out;
}

}  // namespace

TEST_CASE("every kind of shape has a thickness", "[thin]") {
  const std::string main = "rule Main { ";
  CHECK(thinIn(main + "box(2m, 4cm, 2m); }") == "Main 41 1");
  CHECK(thinIn(main + "rot(y, 30deg) rot(x, 20deg) box(2m, 3m, 4cm); }") == "Main 41 1");
  CHECK(thinIn(main + "sphere(2cm); }") == "Main 41 1");
  CHECK(thinIn(main + "cylinder(2cm, 3m); }") == "Main 41 1");
  CHECK(thinIn(main + "cylinder(3m, 4cm); }") == "Main 41 1");
  CHECK(thinIn(main + "truncone(3m, top 0m, bottom 2cm); }") == "Main 41 1");
  CHECK(thinIn(main + "capsule((0m, 0m, 0m), (2m, 1m, 3m), 2cm); }") == "Main 41 1");
  CHECK(thinIn(main + "torus(2m, 2cm); }") == "Main 41 1");
  CHECK(thinIn(main + "ellipsoid(2m, 2cm, 1m); }") == "Main 41 1");
  CHECK(thinIn(main + "superq((2m, 2cm, 1m), 0.5); }") == "Main 41 1");
  CHECK(thinIn(main + "tube((0m, 0m, 0m), (3m, 0m, 0m), 2cm, bend 1m); }") == "Main 41 1");
  CHECK(thinIn(main + "beam((0m, 0m, 0m), (3m, 0m, 0m), 2cm); }") == "Main 43 1");
  CHECK(thinIn(main + "prism(4cm, (0m, 0m), (2m, 0m), (0m, 2m)); }") == "Main 41 1");
  CHECK(thinIn(main + "prism(2m, (0m, 0m), (2m, 0m), (2m, 4cm), (0m, 4cm)); }") == "Main 41 1");
  CHECK(thinIn(main + "meet { box(2m, 4cm, 2m); halfspace(below 1m); } }") == "Main 41 1");
  CHECK(thinIn(main + "displace 1cm*waves/1m { box(2m, 4cm, 2m); } }") == "Main 41 1");
  CHECK(thinIn(main + "morph(box(2m, 4cm, 2m), box(2m, 2cm, 2m), 0.5); }") == "Main 41 1");
  // Parts as thick as a cell or thicker are not reported.
  CHECK(thinIn(main + "box(2m, 13cm, 2m); morph(box(2m, 4cm, 2m), box(1m), 0.5); sum { blob(1m); blob(2cm); } }") ==
        "");
}

TEST_CASE("a rule is told once, with its uses and its thinnest part", "[thin]") {
  const std::string panes =
      "rule Main { repeat 7 at(2m, 0m, 0m) Pane(4cm); at(0m, 5m, 0m) Pane(2cm); at(0m, -5m, 0m) box(1m); }\n"
      "rule Pane(d) { box(1m, 1m, d); at(0m, 0m, 1m) box(1m, 1m, 2*d); }";
  CHECK(thinIn(panes) == "Pane 21 8");
  CHECK(thinIn(panes, 10) == "");
  // The limit is the cell size of the level that is meshed.
  CHECK(thinIn(panes, 10, 4) == "Pane 21 8");
  CHECK(thinIn("rule Main { repeat 3 at(2m, 0m, 0m) { Bar; Pole; } }\nrule Bar { at(0m, 1m, 0m) box(5cm, 5cm, 2m); }\n"
               "rule Pole { cylinder(3cm, 1m); }") == "Bar 52 3; Pole 62 3");
}

TEST_CASE("in many cells of a layer parts are counted by their shapes", "[thin]") {
  const std::string cells = "domain infinite; layer l cell 12m reach 6m { start Main; }";
  CHECK(thinIn("rule Main { at(5m, 5m, 5m) Pane; }\nrule Pane { box(1m, 1m, 4cm); }", kCell, 0, cells) ==
        "Pane 41 about 125");
  // If a use of a rule has several thin shapes, or if two statements have shapes of the same size, every cell is
  // derived, and the count is exact. It includes 25 uses that belong to neighbouring cells and lie only partly in the
  // box.
  CHECK(thinIn("rule Main { at(5m, 5m, 5m) Pane; }\nrule Pane { box(1m, 1m, 4cm); at(2m, 0m, 0m) box(1m, 1m, 4cm); }",
               kCell, 0, cells) == "Pane 41 150");
  CHECK(thinIn("rule Main { at(5m, 5m, 5m) Pane; }\nrule Pane { repeat 3 at(0m, 0m, 1m) box(1m, 1m, 4cm); }", kCell, 0,
               cells) == "Pane 41 150");
}

TEST_CASE("what a level leaves out is not missed", "[thin]") {
  CHECK(thinIn("rule Main { box(1m); detail 5cm { at(3m, 0m, 0m) box(1m, 4cm, 1m); } }") == "");
  CHECK(thinIn("rule Main { box(1m); detail 20cm { at(3m, 0m, 0m) box(1m, 4cm, 1m); } }") == "Main 41 1");
}

TEST_CASE("what lies on something or in it shows with that", "[thin]") {
  // These thin parts are not reported: a slab on a wall, a pipe in the ground, a slab within a block.
  CHECK(thinIn("rule Main { box(4m); at(0m, 2m, 0m) box(3m, 4cm, 3m); }") == "");
  CHECK(thinIn("rule Main { box(9m); at(0m, 4.5m, 0m) cylinder(2cm, 6cm); }") == "");
  CHECK(thinIn("rule Main { box(9m); box(2m, 4cm, 2m); }") == "");
  // These thin parts are reported: a part that extends from its support by more than half of its length, and parts that
  // only touch other thin parts.
  CHECK(thinIn("rule Main { box(4m); at(4m, 0m, 0m) box(5m, 4cm, 1m); }") == "Main 41 1");
  CHECK(thinIn("rule Main { repeat 9 at(0m, 0m, 9cm) box(3m, 1m, 3cm); }") == "Main 31 1");
  // A part that is cut away completely is not reported.
  CHECK(thinIn("rule Main { union { box(3m, 4cm, 3m); cut { box(9m); } } box(1m); }") == "");
}

TEST_CASE("a thin cut is missed as well", "[thin]") {
  CHECK(thinIn("rule Main { box(4m); cut { box(9m, 4cm, 3m); } }") == "cut Main 41 1");
  // A thin cut at the face of a solid removes little, so it is not reported.
  CHECK(thinIn("rule Main { box(4m); cut { at(0m, 2m, 0m) box(9m, 4cm, 9m); } }") == "");
  CHECK(thinIn("rule Main { cut { box(9m, 4cm, 3m); } }", kCell, 0, "domain finite solid box(60m); start Main;") ==
        "cut Main 41 1");
}

// Tests the notes of derivation, word for word: each names the path, and the rest of the cell is derived.

#include <limits>
#include <tuple>

#include "derive_fixture.h"

using namespace sgm;

namespace {

struct NoteCase {
  const char* message;
  const char* place;    ///< beginning of the path of the element that the note concerns
  const char* faulty;   ///< a statement that causes a note
  const char* instead;  ///< must have the same result as `faulty`; empty: `faulty` must derive nothing
};

const NoteCase kNotes[] = {
    {"a size of this shape is not positive, or larger than the world; the shape is left out: bound it, such as max(r, "
     "0.1m)",
     "", "sphere(rand(-2m, -1m));", ""},
    {"this box has an edge of 0, as the scope of a face has; it is left out: give it a depth, such as size(z 0.2m) "
     "box(scope)",
     "box", "size(2m, 2m, 0m) box(scope);", ""},
    {"a cone needs a radius above 0 at one end; this one is left out", "", "truncone(2m, 0m, 0m);", ""},
    {"a prism needs three corners that lie apart; this one is left out", "",
     "prism(2m, (0m, 0m), (1m, 0m), (1m, 0m), (0m, 0m));", ""},
    {"a tube or a beam needs a radius above 0 and a bend of 0 or more; this one is left out", "",
     "tube((0m, 0m, 0m), (4m, 0m, 0m), rand(-2m, -1m));", ""},
    {"a tube or a beam needs a radius above 0 and a bend of 0 or more; this one is left out", "",
     "beam((0m, 0m, 0m), (4m, 0m, 0m), 1m, bend rand(-2m, -1m));", ""},
    {"a tube or a beam needs ends that lie apart; this one is left out", "", "tube((1m, 0m, 0m), (1m, 0m, 0m), 1m);",
     ""},
    {"morph by power cannot change the radii so much for so little change of squareness; use lerp here", "",
     "morph(superq((1m, 1m, 1m), 0.5), superq((2m, 2m, 2m), 0.5), p.y/9m) power;", ""},
    {"a turn needs an axis longer than 0 and an angle within a million radians; this one is left out", "",
     "rot((0, 0, 0), 9deg) box(2m);", "rot(y, 0deg) box(2m);"},
    {"a turn needs an axis longer than 0 and an angle within a million radians; this one is left out", "",
     "rot(y, 2000000rad) box(2m);", "rot(y, 0deg) box(2m);"},
    {"a scale must be positive; it is left out", "", "scale(rand(-2, -1)) box(2m);", "scale(rand(1, 1)) box(2m);"},
    {"the distance between points must be positive; there are no points", "",
     "scatter poisson(rand(-2m, -1m)) { sphere(1m); }", ""},
    {"the distance between points must be positive; there are no points", "",
     "scatter poisson(rand(-2m, -1m)) on disc(4m) { sphere(1m); }", ""},
    {"an anchor must lie in the cell that derives it, which alone owns it; this one is left out", "anchor",
     "at(0m, -20m, 0m) anchor spawn;", ""},
    {"u is 0: nothing is swept around this field; use it on a tube or a beam", "u amp",
     "displace 0.2m*u amp 1m { sphere(2m); }", "displace 0.2m*0 amp 1m { sphere(2m); }"},
    {"a smooth radius must be smaller than the world; this edge is left sharp", "union",
     "meet { box(4m); union smooth rand(1000km, 1001km) { sphere(1m); box(2m); } }",
     "meet { box(4m); union smooth rand(0m, 0m) { sphere(1m); box(2m); } }"},
    {"a sum is of shapes with an inner radius, and a half-space has none; this one is left out: cut or meet the sum "
     "with it",
     "halfspace", "meet { box(4m); sum { blob(1m); halfspace(below 0m); } }",
     "meet { box(4m); sum { blob(1m); cylinder(0m, 0m); } }"},
    {"this scope has no size along y, so it is not split: give it one, such as size(y 3m)", "split",
     "size(4m, 0m, 4m) split y { ~1m: sphere(1m); }", ""},
    {"snap planes are 1cm or more apart, such as snap y 3.2m; these are left out", "snap",
     "snap y rand(-2m, -1m) box(2m);", "snap y rand(1m, 1m) box(2m);"},
    {"the size of a part is 0m or more, such as 2m; this one is left out", "rand",
     "size(4m, 4m, 4m) split x { rand(-2m, -1m): box(9m); }", ""},
    {"the parts that are repeated have no size; they are left out: give one of them a size, such as 2m", "{ 0m",
     "size(4m, 4m, 4m) split x { { 0m: box(9m); }* }", ""},
    {"the parts are longer than the scope; the rest is cut off: write a size that may shrink as ~2m", "split",
     "size(4m, 4m, 4m) split x { 9m: box(2m); }", "size(4m, 4m, 4m) split x { 4m: box(2m); }"},
    {"the snap reach of a split is 0m or more, such as snap 0.5m; none snap here", "rand",
     "size(4m, 4m, 4m) snap x 3m split x snap rand(-2m, -1m) { ~1m: box(2m); ~1m: box(3m); }",
     "size(4m, 4m, 4m) snap x 3m split x snap rand(0m, 0m) { ~1m: box(2m); ~1m: box(3m); }"},
    {"the edges of this polygon cross, or hold no area; it is left out: give its corners in order around it", "polygon",
     "{ footprint polygon((0m, 0m), (4m, 4m), (4m, 0m), (0m, 4m)) as plan; extrude 2m of plan; }", ""},
    {"the edges of this polygon cross, or hold no area; it is left out: give its corners in order around it", "polygon",
     "{ footprint polygon((0m, 0m), (4m, 4m), (8m, 8m)) as plan; extrude 2m of plan; }", ""},
    {"this part of the scope's box has no size; it is left out: give the box one, such as size(4m, 3m, 4m)", "front",
     "size(4m, 0m, 4m) comp { front: sphere(1m); }", ""},
    {"this scope's box has no size, or one of more than 1 km, so it gets no rooms: give it one, such as size(12m, 3m, "
     "9m)",
     "treemap", "size(4m, 0m, 4m) treemap { a 4: { } }", ""},
    {"this floor has no room for these rooms between their walls; the treemap is left out: use fewer rooms, thinner "
     "walls or a larger scope",
     "treemap", "size(4m, 4m, 4m) treemap(wall 3m) { a 4: { } }", ""},
    {"the area of a room is a millionth to a million, such as `living 28`; this one is left out", "b rand",
     "size(9m, 4m, 9m) treemap { a 4: { } b rand(-2, -1): { } }", "size(9m, 4m, 9m) treemap { a 4: { } }"},
    {"the area of a room is a millionth to a million, such as `living 28`; this one is left out", "b rand",
     "size(9m, 4m, 9m) treemap { a 4: { } b rand(1/1e9, 1/1e9): { } }", "size(9m, 4m, 9m) treemap { a 4: { } }"},
    {"no wall of `b` is wide enough for a door, so nothing leads into it: use a narrower door, or a larger room", "b 4",
     "size(12m, 4m, 4m) treemap(door 5m) { a 4: { } b 4: { } }",
     "size(12m, 4m, 4m) treemap(door 5m) { a 4: { } b 4: { } }"},
    {"`a` and `c` share no wall wide enough for this door, so it is left out: use a narrower door, or other areas of "
     "rooms",
     "link a c",
     "size(12m, 4m, 4m) treemap { a 4: { } b 2: { } c 2: { } link a b by door; link b c by door; link a c by door; }",
     "size(12m, 4m, 4m) treemap { a 4: { } b 2: { } c 2: { } link a b by door; link b c by door; }"},
    {"`a` and `b` share no wall wide enough for this door, so it is left out: use a narrower door, or other areas of "
     "rooms",
     "link", "size(9m, 4m, 7m) treemap { a 4: { } b 4: { } link a b by door(8m); }",
     "size(9m, 4m, 7m) treemap { a 4: { } b 4: { } }"},
    {"no outer wall of these rooms is wide enough for the entrance, so nothing leads in: use a narrower door, or a "
     "larger scope",
     "treemap", "size(9m, 4m, 7m) treemap(door 10m) { a 4: { } }", "size(9m, 4m, 7m) treemap(door 10m) { a 4: { } }"},
    {"a door is 0.1m to 100m wide, such as door 0.9m; the default is used", "rand",
     "size(9m, 4m, 7m) treemap(door rand(-2m, -1m)) { a 4: { } b 4: { } }",
     "size(9m, 4m, 7m) treemap(door rand(0.9m, 0.9m)) { a 4: { } b 4: { } }"},
    {"these tiles cannot fill the (3, 1, 1) places of this scope, and it is left empty: place (2, 0, 0) would "
     "need a tile with `a` on its right and `a` on its left; add one, or join labels of a side with `or`",
     "wfc",
     "size(9m, 3m, 3m) wfc 3m { border left a, right a; a 1, left a, right b: box(scope); b 1, left b, right a: "
     "box(scope); }",
     ""},
    // The sides `front` and `back` of all tiles fit here, so the message does not suggest changing them.
    {"these tiles cannot fill the (3, 1, 1) places of this scope, and it is left empty: place (2, 0, 0) would "
     "need a tile with `a` on its right and `a` on its left; add one, or join labels of a side with `or`",
     "wfc",
     "size(9m, 3m, 3m) wfc 3m { border left a, right a, front c, back c; a 1, left a, right b, front c, back c: "
     "box(scope); b 1, left b, right a, front c, back c: box(scope); }",
     ""},
    {"no way was found to fill the (9, 1, 9) places of this scope, and it is left empty: place (6, 0, 1) would need a "
     "tile with `edge` on its front and `edge` on its right and `pair` on its back and `pair` on its left; add one, or "
     "join labels of a side with `or`",
     "wfc", "size(9m, 1m, 9m) wfc 1m { border side edge; half 1 turn, front pair, side edge: box(scope); }", ""},
    {"a tile is 1cm or more along each axis, such as wfc 2m; these are left out", "wfc",
     "size(9m, 1m, 9m) wfc (1m, rand(-2m, -1m), 1m) { a 1: box(scope); }", ""},
    {"this scope's box has no size, so it gets no tiles: give it one, such as size(12m, 3m, 12m)", "wfc",
     "size(0m, 0m, 0m) wfc 1m { a 1: box(2m); }", ""},
    {"this scope has room for more than 32768 tiles; they are left out: use larger tiles, or a smaller scope", "wfc",
     "size(33m, 32m, 32m) wfc 1m { a 1: { } }", ""},
    {"the weight of a tile is 0 to a million, such as `wall 3`; this one is 0", "b rand",
     "size(9m, 1m, 9m) wfc 9m { a 1: box(scope); b rand(-2, -1): box(3m); }",
     "size(9m, 1m, 9m) wfc 9m { a 1: box(scope); }"},
    {"no tile of this wfc has a weight above 0, and its scope is left empty: give one a weight", "wfc",
     "size(9m, 1m, 9m) wfc 9m { a 0: box(scope); }", ""},
};

/// A grammar whose rule Faulty, on line 3, has this statement as its body. Before and after Faulty, Main uses a rule
/// without faults.
std::string around(std::string_view statement) {
  return "rule Main { at(9m, 9m, 9m) { Sound; Faulty; Sound; } }\nrule Faulty { " + std::string(statement) +
         " }\nrule Sound { sphere(rand(1m, 2m)); anchor spawn; }";
}

}  // namespace

TEST_CASE("a note says what is wrong, where and on which path, and the rest of the cell appears", "[notes]") {
  for (const NoteCase& c : kNotes) {
    INFO(c.faulty);
    const GrammarChunk chunk = derivedRules(around(c.faulty));
    REQUIRE(chunk.notes.size() == 1);
    CHECK(chunk.notes[0].message == c.message);
    CHECK(chunk.notes[0].path == "main(0, 0, 0)/Main/Faulty[0]");
    CHECK(chunk.notes[0].line == 3);
    CHECK(chunk.notes[0].column == 15 + static_cast<int>(std::string_view(c.faulty).find(c.place)));
    GrammarChunk without = derivedRules(around(c.instead));
    CHECK(without.groups.size() >= 2);
    CHECK(without.anchors.size() == 2);
    CHECK(hashChunk(chunk) == hashChunk(without));
  }
}

TEST_CASE("a morph or a meet of what was left out is left out whole, and both are said", "[notes]") {
  const std::string nothing = "; the shape is left out: bound it, such as max(r, 0.1m)";
  for (const auto& [statement, message, place] :
       {std::tuple{"morph(sphere(rand(-2m, -1m)), box(2m), 0.5);",
                   "one end of this morph is missing or was left out, so the whole morph is left out: let both give "
                   "shapes",
                   15},
        std::tuple{"meet { box(2m); sphere(rand(-2m, -1m)); }",
                   "one operand of this meet is missing or was left out, so the whole meet is left out: let each give "
                   "a shape",
                   31}}) {
    const GrammarChunk chunk = derivedRules(around(statement));
    REQUIRE(chunk.notes.size() == 2);
    CHECK(chunk.notes[0].message == "a size of this shape is not positive, or larger than the world" + nothing);
    CHECK(chunk.notes[1].message == message);
    CHECK(chunk.notes[1].path == "main(0, 0, 0)/Main/Faulty[0]");
    CHECK(chunk.notes[1].line == 3);
    CHECK(chunk.notes[1].column == place);
    CHECK(hashChunk(chunk) == hashChunk(derivedRules(around(""))));
  }
}

TEST_CASE("points that begin inside what they look for are noted, but in rock", "[notes]") {
  const auto notesOf = [](const std::string& domain, int32_t ceiling, const std::string& way) {
    const auto program =
        compiled("sgm 1; domain " + domain +
                 ";\nlayer ground cell 64m reach 8m { start Ground; }\nlayer trees cell 64m reach 40m uses "
                 "ground { start Trees; }\nrule Ground { at(9m, 9m, 9m) sphere(1m); }\nrule Trees { "
                 "at(32m, 0m, 32m) scatter 40 on box(9m, 20m, 9m) probe " +
                 way + " 9m of ground sphere(1m); }");
    std::string out;
    for (const DeriveNote& note : derived(*program, {}, 7, 1, Ceiling(ceiling)).notes)
      out += std::to_string(note.line) + ":" + std::to_string(note.column) + " " + note.message;
    return out;
  };
  const std::string all =
      "5:31 all points of this scatter begin inside `ground`, and are left out: let them begin in the open, such as "
      "after at(0m, -50m, 0m), and probe farther";
  CHECK(notesOf("infinite", -64 * 1024, "up") == all);
  CHECK(notesOf("infinite", -64 * 1024, "down") ==
        "5:31 all points of this scatter begin inside `ground`, and are left out: let them begin in the open, such as "
        "after at(0m, 50m, 0m), and probe farther");
  CHECK(notesOf("infinite", -5 * 1024, "up") ==
        "5:31 most points of this scatter begin inside `ground`, and are left out: let them begin in the open, such as "
        "after at(0m, -50m, 0m), and probe farther");
  CHECK(notesOf("infinite", 64 * 1024, "up") == "");
  CHECK(notesOf("infinite", 5 * 1024, "up") == "");
  // No note: in a solid domain, a scatter looks for caves, so most of its points begin in rock.
  CHECK(notesOf("infinite solid", -64 * 1024, "up") == "");
}

TEST_CASE("tiles that no search has the time for are left out alone, and it is said", "[notes]") {
  const auto program = compiled(
      "sgm 1; domain infinite; layer main cell 64m reach 64m { start Main; }\n"
      "rule Main { sphere(1m); size(9m, 1m, 9m) wfc 1m { a 1: box(scope); } sphere(2m); }");
  DeriveLimits few;
  few.steps = 600;
  const auto chunk = deriveCell(*program, {}, 7, 0, {}, Ceiling(0), few);
  REQUIRE(chunk);
  CHECK(chunk->shapes.size() == 2);
  REQUIRE(chunk->notes.size() == 1);
  CHECK(chunk->notes[0].message ==
        "to fill the (9, 1, 9) places of this scope takes too long, and it is left empty: use larger tiles, or a "
        "smaller scope");
}

TEST_CASE("notes beyond the limit are counted", "[notes]") {
  const GrammarChunk chunk =
      derivedRules("rule Main { repeat 70 Faulty; sphere(1m); } rule Faulty { truncone(2m, 0m, 0m); }");
  CHECK(chunk.groups.size() == 1);
  REQUIRE(chunk.notes.size() == 65);
  CHECK(chunk.notes[63].path == "main(0, 0, 0)/Main/Faulty[63]");
  CHECK(chunk.notes[64].message == "6 more notes on this cell are left out");
  CHECK(chunk.notes[64].path == "main(0, 0, 0)/Main");
}

namespace {

Error failure(std::string_view rules, const DeriveLimits& limits) {
  const auto program =
      compiled("sgm 1; domain infinite; layer main cell 64m reach 64m { start Main; }\n" + std::string(rules));
  const auto chunk = deriveCell(*program, ParameterValues::defaults(*program), 7, 0, {}, Ceiling(0), limits);
  REQUIRE_FALSE(chunk);
  CHECK(chunk.error().code == Code::limit);
  return chunk.error();
}

}  // namespace

TEST_CASE("a cell that is too much says what, on which path, and what to do", "[notes]") {
  const auto message = [](std::string_view rules, auto change) {
    DeriveLimits limits;
    change(limits);
    return failure(rules, limits).message;
  };
  const std::string path = ", in main(0, 0, 0)/Main";
  const std::string_view many = "rule Main { repeat 1000 Leaf; } rule Leaf { sphere(1m); anchor spawn; }";
  CHECK(message(many, [](DeriveLimits& l) {
          l.steps = 100;
        }).starts_with("deriving one cell takes more than 100 steps (derive less, or make the cells smaller)" + path));
  CHECK(message(many, [](DeriveLimits& l) { l.depth = 1; }) ==
        "rules are nested more than 1 deep (give them a smaller `depth`)" + path);
  CHECK(message(many, [](DeriveLimits& l) { l.shapes = 10; }) ==
        "one cell has more than 10 shapes (derive fewer, or make the cells smaller)" + path + "/Leaf[10]");
  CHECK(message(many, [](DeriveLimits& l) {
          l.bytes = 3000;
        }).starts_with("one cell takes more than 0 MiB (derive less, or make the cells smaller)" + path));
  CHECK(message("rule Main { repeat 11 Leaf; } rule Leaf { anchor spawn; }", [](DeriveLimits& l) { l.shapes = 10; }) ==
        "one cell has more than 10 anchors (derive fewer, or make the cells smaller)" + path + "/Leaf[10]");
  const std::string deep = "expressions and statements are nested too deep (let fewer rules call each other)" + path;
  CHECK(message("rule Main { { { { sphere(1m); } } } }", [](DeriveLimits& l) { l.nesting = 4; }) == deep);
  CHECK(message("rule Main { sphere(1m + (1m + (1m + (1m + 1m)))); }", [](DeriveLimits& l) { l.nesting = 4; }) == deep);
  CHECK(message("rule Main { scatter poisson(1cm) { sphere(1m); } }", [](DeriveLimits&) {}) ==
        "one cell has more points than can be derived (take a larger distance in poisson())" + path);
  CHECK(message("rule Main { scatter 2000000 on disc(4m) { sphere(1m); } }", [](DeriveLimits&) {}) ==
        "one scatter has more than a million points (take fewer, or a larger distance)" + path);
}

TEST_CASE("arguments that fit no grammar are refused in words", "[notes]") {
  const auto program = compiled(
      "sgm 1; param width = 2m in 1m..3m; param count = 4 in 1..9; param wet = 60% in 0%..100%; domain infinite;\n"
      "layer main cell 64m reach 64m { start Main; } rule Main { repeat count Leaf; } rule Leaf { sphere(width); }");
  auto values = ParameterValues::defaults(*program);
  const auto refused = [&](const ParameterValues& parameters, uint32_t layer, Int3 cell) {
    return deriveCell(*program, parameters, 7, layer, cell, Ceiling(0)).error().message;
  };
  CHECK(refused(values, 9, {}) == "the grammar has no layer 9; it has 1");
  CHECK(refused({}, 0, {}) == "the parameter values belong to another grammar; use the defaults of this one");
  CHECK(refused(values, 0, {1 << 28, 0, 0}) == "the cell lies beyond the end of the world");
  const auto whole = compiled("sgm 1; start Main; rule Main { sphere(1m); }");
  CHECK(deriveCell(*whole, {}, 7, 0, {1, 0, 0}, Ceiling(0)).error().message ==
        "a grammar without layers has only the cell 0 0 0");

  CHECK(deriveInstances(*program, values, 7, 0, {}, 9, Ceiling(0)).error().message ==
        "the grammar has no rule 9; it has 2");

  CHECK(values.set(*program, "widht", 2).error().message ==
        "the grammar has no parameter widht; it has width, count, wet");
  CHECK(values.set(*program, "width", std::numeric_limits<double>::quiet_NaN()).error().message ==
        "parameter width must be a finite number");
  CHECK(values.set(*program, "count", 2.5).error().message == "parameter count must be a whole number, not 2.5");
  CHECK(values.set(*program, "count", 12).error().message == "parameter count must lie in 1..9, not be 12");
  CHECK(values.set(*program, "wet", 60).error().message == "parameter wet must lie in 0..1, not be 60: 60 % is 0.6");
}

TEST_CASE("uses within uses have a limit together", "[notes]") {
  const auto program = compiled(
      "sgm 1; domain infinite; layer main cell 64m reach 64m { start Main; } rule Main { Nest(3); }\n"
      "rule Nest(n) when n > 0 { repeat 3 sphere(1m); Nest(n - 1); } rule Nest(n) else { }");
  DeriveLimits few;
  few.shapes = 9;
  REQUIRE(deriveCell(*program, {}, 7, 0, {}, Ceiling(0), few));
  const auto uses = deriveInstances(*program, {}, 7, 0, {}, 1, Ceiling(0), few);
  REQUIRE_FALSE(uses);
  CHECK(uses.error().message ==
        "the uses of `Nest` in one cell have more than 9 shapes together; ask for a smaller rule");
}

TEST_CASE("what goes wrong in an imported file names that file", "[notes]") {
  const std::string head =
      "sgm 1; import \"std/mine.sgm\" as mine; domain infinite; layer main cell 64m reach 64m { start Main; }\n";
  const auto program = compiled(head + "rule Main { mine.Log(1m, rand(-2m, -1m)); }");
  const GrammarChunk chunk = derived(*program);
  REQUIRE_FALSE(chunk.notes.empty());
  CHECK(chunk.notes[0].path == "main(0, 0, 0)/Main/mine.Log[0]");
  CHECK(chunk.notes[0].message.ends_with(" (std/mine.sgm)"));
  DeriveLimits none;
  none.shapes = 0;
  const auto sound = compiled(head + "rule Main { mine.Log(1m, 1m); }");
  CHECK(deriveCell(*sound, {}, 7, 0, {}, Ceiling(0), none).error().message ==
        "one cell has more than 0 shapes (derive fewer, or make the cells smaller), in main(0, 0, 0)/Main/mine.Log[0] "
        "(std/mine.sgm)");
}

TEST_CASE("an override that finds nothing is counted where notes are full", "[notes]") {
  const auto program = compiled(
      "sgm 1; domain infinite; layer main cell 64m reach 64m { start Main; } rule Main { Leaf; truncone(2m, 0m, 0m); "
      "}\n"
      "rule Leaf { sphere(1m); } override \"main(0, 0, 0)/Main/Leaf[1]\" { }");
  for (const uint32_t limit : {0u, 1u, 2u}) {
    DeriveLimits few;
    few.notes = limit;
    const auto chunk = deriveCell(*program, {}, 7, 0, {}, Ceiling(0), few);
    REQUIRE(chunk);
    CHECK(chunk->groups.size() == 1);
    REQUIRE(chunk->notes.size() == (limit == 0 ? 1 : 2));
    const std::string last = limit == 0   ? "2 more notes on this cell are left out"
                             : limit == 1 ? "1 more note on this cell is left out"
                                          : "this override finds nothing: there is only one `Leaf` here";
    CHECK(chunk->notes.back().message == last);
    CHECK(chunk->notes.back().path == "main(0, 0, 0)/Main");
  }
}

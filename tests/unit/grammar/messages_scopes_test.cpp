// Tests messages about parts of scopes, rooms, tiles, footprints, extrusions and roofs, word for word.

#include <array>

#include "messages.h"

using namespace sgm::test;

namespace {

const MessageCase kParts[] = {
    {"3:7 syntax: expected x, y or z to split along, found `q`", "split q { 2m: Part; }"},
    {"3:9 syntax: expected `{`, found `2m`", "split x 2m: Part;"},
    {"3:14 syntax: expected `:` and what stands in this part, found `Part`", "split x { 2m Part; }"},
    {"3:15 syntax: expected a block or a statement for `this part`, found `}`", "split x { 2m: }"},
    {"3:11 value-range: a part cannot be more than 100% of the scope | write a length, such as 2m, or a share, such as "
     "25%",
     "split x { 2: Part; }"},
    {"3:12 unit-mismatch: a flexible size is a length, and this is a ratio | multiply it by 1m to make a length of it",
     "split x { ~50%: Part; }"},
    {"3:3 syntax: this split has no parts | such as `split x { ~1m: Wall; }`", "{ split x { } Part; }"},
    {"3:11 syntax: this repeated group has no parts | such as `{ ~2m: Bay; }*`", "split x { { }* 1m: Part; }"},
    {"3:3 syntax: this comp names no part of the box | such as `comp { side: Wall; }`", "{ comp { } Part; }"},
    {"3:14 value-range: the snap reach of a split is 0m or more | such as snap 0.5m",
     "split x snap -1m { ~1m: Part; }"},
    {"3:12 unit-mismatch: a flexible size is a length, and this is a ratio | write `2m`", "split x { ~2: Part; }"},
    {"3:11 unit-mismatch: the size of a part is a length, and this is an angle | such as 2m",
     "split x { 2deg: Part; }"},
    {"3:11 stage: the size of a part is decided when shapes are derived, and `p` is known at sample time only | fields "
     "serve displace, warp and the t of morph",
     "split x { p.x: Part; }"},
    {"3:25 syntax: expected `*` after the parts that are repeated, found `1m`", "split x { { 2m: Part; } 1m: Part; }"},
    {"3:13 syntax: a repeated group holds no other group | split its parts once more instead",
     "split x { { { 2m: Part; }* }* }"},
    {"3:26 duplicate: this split has a second repeated group | put its parts into the first one, or split a part once "
     "more",
     "split x { { 2m: Part; }* { 1m: Part; }* }"},
    {"3:14 syntax: expected an expression, found `{`", "split x snap { 2m: Part; }"},
    {"3:14 unit-mismatch: the snap reach of a split is a length, and this is a ratio | write `2m`",
     "split x snap 2 { 2m: Part; }"},
    {"3:6 syntax: expected x, y or z that the planes stand across, found `w`", "snap w 3m Part;"},
    {"3:10 syntax: expected a block or a statement for `snap`, found `;`", "snap y 3m;"},
    {"3:8 unit-mismatch: the distance of snap planes is a length, and this is a ratio | write `3m`", "snap y 3 Part;"},
    {"3:8 value-range: snap planes are 1cm or more apart | such as snap y 3.2m", "snap y 0m Part;"},
    {"3:16 unit-mismatch: the place of the first snap plane is a length, and this is a ratio | write `2m`",
     "snap y 3m from 2 Part;"},
    {"3:8 unknown-name: a box has no part `fornt` | did you mean `front`?", "comp { fornt: Part; }"},
    {"3:8 unknown-name: a box has no part `chimney` | it has front, back, left, right, side, top, bottom, edges, "
     "inside",
     "comp { chimney: Part; }"},
    {"3:8 syntax: expected a part of the box such as `front:`, found `2m`", "comp { 2m: Part; }"},
    {"3:19 duplicate: `top` stands twice in this comp | put both into one block after it",
     "comp { top: Part; top: Part; }"},
    {"3:13 syntax: expected a block or a statement for `this part`, found `}`", "comp { top: }"},
    {"3:12 syntax: expected `:`, found `Part`", "comp { top Part; }"},
};

const MessageCase kProfiles[] = {
    {"3:19 syntax: expected `rect`, `regular` or `polygon`, found `box`", "footprint merge 3 box(2m, 3m) as plan;"},
    {"3:24 syntax: expected `as`, found `plan`", "footprint rect(2m, 3m) plan;"},
    {"3:26 syntax: expected the name of a plan, found `;`", "footprint rect(2m, 3m) as;"},
    {"3:17 unit-mismatch: the number of pieces is a ratio, and this is a length | divide it by a length to make a "
     "ratio of it",
     "footprint merge 2m rect(2m, 3m) as plan;"},
    {"3:17 value-range: a footprint merges 1 to 64 pieces | such as merge 3",
     "footprint merge 65 rect(2m, 3m) as plan;"},
    {"3:16 unit-mismatch: an edge of a footprint is a length, and this is a ratio | write `2m`",
     "footprint rect(2, 3m) as plan;"},
    {"3:11 argument-count: `rect` needs 2 arguments | it is `rect(x, z)`", "footprint rect(2m) as plan;"},
    {"3:19 unit-mismatch: the number of corners is a ratio, and this is a length | divide it by a length to make a "
     "ratio of it",
     "footprint regular(5m, 3m) as plan;"},
    {"3:19 value-range: a regular polygon has 3 to 64 corners | such as regular(6, 8m)",
     "footprint regular(2, 3m) as plan;"},
    {"3:22 unit-mismatch: the radius of a footprint is a length, and this is a ratio | write `3m`",
     "footprint regular(5, 3) as plan;"},
    {"3:11 argument-count: a polygon has 3 to 64 corners | such as polygon((0m, 0m), (8m, 0m), (8m, 6m))",
     "footprint polygon((2m, 0m), (0m, 2m)) as plan;"},
    {"3:27 unit-mismatch: a corner of a footprint is a pair of lengths, and this is a pair of ratios | such as (1m, "
     "2m)\n3:35 unit-mismatch: a corner of a footprint is a pair of lengths, and this is a pair of ratios | such as "
     "(1m, 2m)",
     "footprint polygon((0, 0), (2, 0), (0, 2)) as plan;"},
    {"3:19 argument-name: the corners of a polygon have no names | such as polygon((0m, 0m), (8m, 0m), (8m, 6m))",
     "footprint polygon(a = (2m, 0m), (0m, 2m), (1m, 3m)) as plan;"},
    {"3:19 wrong-use: `merge` takes rectangles and regular polygons only | give the polygon the corners of the whole "
     "outline, or merge `rect` or `regular`",
     "footprint merge 2 polygon((2m, 0m), (0m, 2m), (1m, 3m)) as plan;"},
    {"3:12 syntax: expected `of`, found `plan`", "extrude 2m plan;"},
    {"3:14 syntax: expected the name of a plan, found `;`", "extrude 2m of;"},
    {"3:15 syntax: expected the name of a plan, found `3m`", "extrude 2m of 3m;"},
    {"3:15 unknown-name: there is no plan `plan` here | write `footprint rect(12m, 8m) as plan;` before it in the rule",
     "extrude 2m of plan;"},
    {"3:15 unknown-name: there is no plan `plan` here | it is known after its footprint: put that first",
     "extrude 2m of plan; footprint rect(2m, 3m) as plan;"},
    {"3:54 unknown-name: there is no plan `plan` here | it is known in the block of its footprint: put that into a "
     "block "
     "around both",
     "{ footprint rect(2m, 3m) as plan; } roof flat(1m) of plan;"},
    {"3:47 unknown-name: there is no plan `plan` here | did you mean `plam`?",
     "footprint rect(2m, 3m) as plam; extrude 2m of plan;"},
    {"3:54 syntax: expected `;` or a block, found `sphere`",
     "{ footprint rect(2m, 3m) as plan; extrude 2m of plan sphere(1m); }"},
    {"3:43 unit-mismatch: the height of an extrusion is a length, and this is a ratio | write `2m`",
     "{ footprint rect(2m, 3m) as plan; extrude 2 of plan; }"},
    {"3:32 type-mismatch: `of` names a plan, and this is a length | such as `footprint rect(12m, 8m) as plan;` before "
     "it in the rule",
     "{ let wide = 2m; extrude 2m of wide; }"},
    {"3:6 syntax: expected `flat`, `gable` or `hip`, found `dome`", "roof dome(2m);"},
    {"3:11 unit-mismatch: the height of a flat roof is a length, and this is an angle | such as 2m",
     "roof flat(30deg);"},
    {"3:10 unit-mismatch: the pitch of a roof is an angle, and this is a length | such as 30deg", "roof hip(2m);"},
    {"3:10 value-range: the pitch of a roof is 5deg to 80deg | such as 35deg", "roof hip(2deg);"},
    {"3:28 unit-mismatch: the overhang of a roof is a length, and this is a ratio | write `2m`",
     "roof gable(30deg, overhang 2);"},
    {"3:30 value-range: the overhang of a roof is 0m or more | such as overhang 0.5m",
     "roof gable(30deg, overhang = -1m);"},
    {"3:19 syntax: expected the name of a plan, found `;`", "roof hip(30deg) of;"},
    {"3:42 type-mismatch: `r` of `sphere` is a length, and this is a plan | such as 2m",
     "{ footprint rect(2m, 3m) as plan; sphere(plan); }"},
    {"3:7 wrong-use: a sum has leaves only: spheres, blobs and other primitives | cut, displace or warp the sum as a "
     "whole",
     "sum { roof flat(1m); }"},
    {"3:35 duplicate: `plan` is declared twice in this rule | rename one of them",
     "{ footprint rect(2m, 3m) as plan; footprint rect(2m, 3m) as plan; extrude 2m of plan; }"},
};

const MessageCase kRooms[] = {
    {"3:9 syntax: expected `{`, found `wall`", "treemap wall { a 4: Part; }"},
    {"3:12 syntax: expected the area of the room, such as `living 28:`, found `:`", "treemap { a: Part; }"},
    {"3:15 syntax: expected `:` and what stands in this room, found `Part`", "treemap { a 4 Part; }"},
    {"3:16 syntax: expected a block or a statement for `this room`, found `}`", "treemap { a 4: }"},
    {"3:11 syntax: expected the name of a room, found `4`", "treemap { 4: Part; }"},
    {"3:11 reserved-word: `let` is a word of the language and cannot be the name of a room | choose another name, such "
     "as `let_`",
     "treemap { let 4: Part; }"},
    {"3:1 argument-count: a treemap has 1 to 32 rooms | such as `living 28: Room;`", "treemap { }"},
    {"3:22 duplicate: this treemap has a second room `a` | give each room a name of its own",
     "treemap { a 4: Part; a 5: Part; }"},
    {"3:13 unit-mismatch: the area of a room is a ratio, and this is a length | divide it by a length to make a ratio "
     "of it",
     "treemap { a 4m: Part; }"},
    {"3:13 value-range: the area of a room is a millionth to a million | such as `living 28`",
     "treemap { a 1/1e9: Part; }"},
    {"3:14 value-range: the walls of a treemap are 1cm to 5m thick | such as wall 0.2m",
     "treemap(wall 0m) { a 4: Part; }"},
    {"3:14 unit-mismatch: the thickness of walls is a length, and this is a ratio | write `2m`",
     "treemap(wall 2) { a 4: Part; }"},
    {"3:14 value-range: a door is 0.1m to 100m wide | such as door 0.9m", "treemap(door 10km) { a 4: Part; }"},
    {"3:14 unit-mismatch: the width of doors is a length, and this is an angle | such as 2m",
     "treemap(door 30deg) { a 4: Part; }"},
    {"3:16 value-range: a door is 0.1m to 100m high | such as height 2.1m", "treemap(height 1cm) { a 4: Part; }"},
    {"3:16 unit-mismatch: the height of doors is a length, and this is a ratio | write `2m`",
     "treemap(height 2) { a 4: Part; }"},
    {"3:20 value-range: a corridor is 0.1m to 100m wide | such as corridor 1.2m",
     "treemap(corridor = 0m) { a 4: Part; }"},
    {"3:18 unit-mismatch: the width of a corridor is a length, and this is a ratio | write `2m`",
     "treemap(corridor 2) { a 4: Part; }"},
    {"3:9 argument-name: `treemap` has no parameter `walls` | it is `treemap(wall, door, height, corridor)`",
     "treemap(walls 0.2m) { a 4: Part; }"},
    {"3:38 duplicate: `corridor` stands twice in this treemap | put both into one block after it",
     "treemap { a 4: Part; corridor: Part; corridor: Part; }"},
    {"3:36 duplicate: `facade` stands twice in this treemap | put both into one block after it",
     "treemap { a 4: Part; facade: Part; facade: Part; }"},
    {"3:36 unknown-name: this treemap has no room `bahth` | did you mean `bath`?",
     "treemap { a 4: Part; bath 4: Part; link a bahth by door; }"},
    {"3:22 unknown-name: this treemap has no room `kitchen` | name two of its rooms",
     "treemap { a 4: Part; link a kitchen by door; }"},
    {"3:22 wrong-use: a door leads from one room to another | name two rooms",
     "treemap { a 4: Part; link a a by door; }"},
    {"3:51 duplicate: `b` and `a` are linked twice | keep one door between two rooms, as wide as the widest of these",
     "treemap { a 4: Part; b 4: Part; link a b by door; link b a by door(2m); }"},
    {"3:29 syntax: expected the name of a room, found `by`", "treemap { a 4: Part; link a by door; }"},
    {"3:26 syntax: expected the name of a room, found `;`", "treemap { a 4: Part; link; }"},
    {"3:41 syntax: expected `by`, found `;`", "treemap { a 4: Part; b 4: Part; link a b; }"},
    {"3:50 unit-mismatch: the width of a door is a length, and this is a ratio | write `2m`",
     "treemap { a 4: Part; b 4: Part; link a b by door(2); }"},
    {"3:56 unit-mismatch: the height of a door is a length, and this is a ratio | write `2m`",
     "treemap { a 4: Part; b 4: Part; link a b by door(0.9m, 2); }"},
    {"3:50 value-range: a door is 0.1m to 100m wide | such as door 0.9m",
     "treemap { a 4: Part; b 4: Part; link a b by door(0m); }"},
    {"3:45 syntax: expected `door`, found `window`", "treemap { a 4: Part; b 4: Part; link a b by window; }"},
    {"3:36 warning idle-cut: nothing stands before this cut in its block | a cut takes from what its own block has "
     "added before it",
     "treemap { a 4: cut Part; facade: { cut Part; } }"},
    {"3:1 syntax: expected a statement, found `link`", "link a b by door;"},
};

const MessageCase kTiles[] = {
    {"3:5 syntax: expected the size of a tile, such as `wfc 2m`, found `{`", "wfc { a 1: Part; }"},
    {"3:8 syntax: expected `{`, found `Part`", "wfc 2m Part;"},
    {"3:11 syntax: expected the weight of the tile, such as `wall 3`, found `:`", "wfc 2m { a: Part; }"},
    {"3:11 syntax: expected the weight of the tile, such as `wall 3`, found `,`", "wfc 2m { a, side b: Part; }"},
    {"3:14 syntax: expected `:` and what stands in this tile, found `Part`", "wfc 2m { a 1 Part; }"},
    {"3:15 syntax: expected a block or a statement for `this tile`, found `}`", "wfc 2m { a 1: }"},
    {"3:10 syntax: expected the name of a tile, found `4`", "wfc 2m { 4: Part; }"},
    {"3:10 reserved-word: `let` is a word of the language and cannot be the name of a tile | choose another name, such "
     "as `let_`",
     "wfc 2m { let 4: Part; }"},
    {"3:15 syntax: expected a side and its label, such as `left wall`, found `Part`", "wfc 2m { a 1, Part: Part; }"},
    {"3:15 unknown-name: a tile has no side `lfet` | did you mean `left`?", "wfc 2m { a 1, lfet b: Part; }"},
    {"3:15 unknown-name: a tile has no side `chimney` | it has front, back, left, right, side, top, bottom",
     "wfc 2m { a 1, chimney b: Part; }"},
    {"3:19 syntax: expected the label of a side, found `:`", "wfc 2m { a 1, left: Part; }"},
    {"3:30 syntax: expected the label of a side, found `:`", "wfc 2m { a 1, left plug meets: Part; }"},
    {"3:15 unknown-name: nothing has `hole` to meet the left of `a` | give it to the right of a tile, or to the "
     "border, and let it meet `plug`\n3:37 unknown-name: nothing has `hole` to meet the right of `a` | give it to the "
     "left of a tile, or to the border",
     "wfc 2m { a 1, left plug meets hole, right hole: Part; }"},
    {"3:17 unknown-name: no tile has `hole` on its right, as this border requires | give a tile that label there, and "
     "let it meet `plug`",
     "wfc 2m { border right plug meets hole; a 1, right hole: Part; }"},
    {"3:23 duplicate: `left` stands twice here | join labels with `or`: `left wall or gate`",
     "wfc 2m { a 1, left b, left c: Part; }"},
    {"3:20 reserved-word: `cut` is a word of the language and cannot be the label of a side | choose another name, "
     "such as `cut_`",
     "wfc 2m { a 1, left cut: Part; }"},
    {"3:23 syntax: expected `;`, found `:`", "wfc 2m { border left b: Part; }"},
    {"3:25 duplicate: this wfc has a second border | put its sides into the first one, with a `,` between them",
     "wfc 2m { border left b; border right b; a 1, side b: Part; }"},
    {"3:21 duplicate: this wfc has a second tile `a` | give each tile a name of its own",
     "wfc 2m { a 1: Part; a 2: Part; }"},
    {"3:1 argument-count: a wfc has 1 to 64 tiles | such as `wall 3 turn, left brick, right brick: Wall;`",
     "wfc 2m { }"},
    {"3:5 unit-mismatch: the size of a tile is a length, and this is a ratio | write `2m`", "wfc 2 { a 1: Part; }"},
    {"3:5 unit-mismatch: the size of a tile is a point, and this is a vector of ratios | such as (1m, 2m, 3m)",
     "wfc (2, 3, 4) { a 1: Part; }"},
    {"3:5 value-range: a tile is 1cm or more along each axis | such as wfc 2m", "wfc 1mm { a 1: Part; }"},
    {"3:10 value-range: a tile is 1cm or more along each axis | such as wfc 2m", "wfc (2m, 0m, 2m) { a 1: Part; }"},
    {"3:12 unit-mismatch: the weight of a tile is a ratio, and this is a length | divide it by a length to make a "
     "ratio of it",
     "wfc 2m { a 1m: Part; }"},
    {"3:12 value-range: the weight of a tile is 0 to a million | such as `wall 3`", "wfc 2m { a -1: Part; }"},
    {"3:15 unknown-name: nothing has `brick` to meet the left of `a` | did you mean `brik`?\n3:27 unknown-name: "
     "nothing has `brik` to meet the right of `a` | did you mean `brick`?",
     "wfc 2m { a 1, left brick, right brik: Part; }"},
    {"3:17 unknown-name: no tile has `wood` on its left, as this border requires | give a tile that label there\n3:33 "
     "unknown-name: nothing has `stone` to meet the left of `a` | give it to the right of a tile, or to the border",
     "wfc 2m { border side wood; a 1, left stone, right wood: Part; }"},
    {"3:17 unknown-name: no tile has `sky` on its top, as this border requires | give a tile that label there",
     "wfc 2m { border top sky; a 1, side b, top c: Part; }"},
    {"3:8 syntax: expected `;`, found `left`", "border left b;"},
};

const MessageCase kOpen[] = {
    {"1:24 syntax: this block is not closed | a `}` is missing\n1:34 syntax: these parts are not closed | a `}` is "
     "missing",
     "sgm 1; start A; rule A { split x { 2m: sphere(2m);"},
    {"1:24 syntax: this block is not closed | a `}` is missing\n1:34 syntax: these parts are not closed | a `}` is "
     "missing\n1:36 syntax: these parts are not closed | a `}` is missing",
     "sgm 1; start A; rule A { split x { { 2m: sphere(2m);"},
};

const Around kInScope{"sgm 1; start A;\nrule A { size(4m, 4m, 4m) {\n", "\n} }\nrule Part { box(1m); }"};

const Around kInRule{kInScope.before, "\n} }"};

}  // namespace

TEST_CASE("messages: parts of scopes", "[grammar][messages]") {
  checkMessages(kParts, kInScope);
  checkMessages(kOpen);
}

TEST_CASE("messages: footprints, extrusions and roofs", "[grammar][messages]") { checkMessages(kProfiles, kInRule); }

TEST_CASE("messages: tiles of lattices", "[grammar][messages]") { checkMessages(kTiles, kInScope); }

TEST_CASE("messages: rooms of treemaps", "[grammar][messages]") { checkMessages(kRooms, kInScope); }

TEST_CASE("messages: more tiles and labels than there may be", "[grammar][messages]") {
  const auto diagnosed = [](int tiles, int labels) {
    std::string text = kInScope.before + "wfc 2m {";
    for (int i = 0; i < tiles; ++i) text += " t" + std::to_string(i) + " 1, side any: Part;";
    text += " all 1, side any";
    for (int i = 1; i < labels; ++i) text += " or l" + std::to_string(i);
    return sgm::test::inWords(sgm::test::compileText(text + ": Part; }" + kInScope.after));
  };
  CHECK(diagnosed(63, 63).empty());
  CHECK(diagnosed(64, 63) ==
        "3:1 argument-count: a wfc has 1 to 64 tiles | such as `wall 3 turn, left brick, right brick: Wall;`");
  std::string kinds = kInScope.before + "wfc 2m { border side l0 or l1;";
  for (int i = 0; i < 65; ++i) {
    const std::string one = "l" + std::to_string(i % 8), other = "l" + std::to_string(8 + i / 8);
    if (i % 4 == 0) kinds += " t" + std::to_string(i) + " 1 turn";
    kinds += std::string(", ") + std::array{"front", "right", "back", "left"}[static_cast<size_t>(i % 4)] + " " + one +
             " or " + other;
    if (i % 4 == 3 || i == 64) kinds += ": Part;";
  }
  CHECK(sgm::test::inWords(sgm::test::compileText(kinds + " }" + kInScope.after)) ==
        "3:1 argument-count: a wfc has at most 64 kinds of sides: of labels and what they meet | give sides that meet "
        "the same ones the same labels");
  CHECK(diagnosed(1, 64) ==
        "3:1 argument-count: the sides of a wfc have at most 63 labels | give sides that meet the same ones one label");
}

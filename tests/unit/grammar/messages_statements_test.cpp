// Tests messages about wrong statements and expressions, word for word.

#include "messages.h"

using namespace sgm::test;

namespace {

const MessageCase kStatements[] = {
    {"2:21 syntax: expected `;`, found `}`", "sphere(2m)"},
    {"2:10 syntax: `uinon` does not start a statement | did you mean `union`?", "uinon { sphere(2m); }"},
    {"2:21 syntax: a call takes no block | end the call with `;`", "shpere(2m) { }"},
    {"2:10 syntax: expected a shape, a rule or a statement, found `3`", "3;"},
    {"2:10 syntax: expected a statement, found `and`", "and;"},
    {"2:21 syntax: a call takes no block | end the call with `;`", "sphere(2m) { box(1m); }"},
    {"2:15 syntax: expected a block or a statement for `union`, found `;`", "union;"},
    {"2:25 syntax: expected a block or a statement for `union`, found `;`", "union smooth 2m;"},
    {"2:24 syntax: expected a block or a statement for `at`, found `;`", "at(1m, 2m, 3m);"},
    {"2:21 syntax: expected a block or a statement for `displace`, found `;`", "displace 2m;"},
    {"2:18 syntax: expected a block or a statement for `repeat`, found `;`", "repeat 3;"},
    {"2:23 syntax: expected a block or a statement for `for`, found `;`", "for i in 0..3;"},
    {"2:31 syntax: expected a block or a statement for `scatter`, found `;`", "scatter 3 on disc(2m);"},
    {"2:19 syntax: expected a block or a statement for `detail`, found `;`", "detail 2m;"},
    {"2:14 syntax: a sum is smooth by itself | its width follows the radii of its leaves",
     "sum smooth 2m { blob(1m); }"},
    {"2:16 syntax: expected a shape or a rule, found `3`", "morph(3, sphere(1m), 0.5);"},
    {"2:35 syntax: expected `,` and how far to morph, 0 to 1, found `)`", "morph(sphere(1m), box(1m));"},
    {"2:16 syntax: expected `(`, found `sphere`", "morph sphere;"},
    {"2:19 syntax: expected `;`, found `}`", "mat rock"},
    {"2:27 syntax: expected a block or a statement for `warp`, found `;`", "warp (0m, 1m, 0m);"},
    {"2:18 syntax: expected a block or a statement for `scale`, found `;`", "scale(2);"},
    {"2:14 syntax: expected a block or a statement for `meet`, found `;`", "meet;"},
    {"2:13 syntax: expected a block or a statement for `cut`, found `;`", "cut;"},
    {"2:14 syntax: expected the name of a loop variable, found `3`", "for 3 in 0..3 { }"},
    {"2:16 syntax: expected `in`, found `0`", "for i 0..3 { }"},
    {"2:20 syntax: expected `on` and where to scatter, such as `on disc(5m)`, found `{`", "scatter 3 { }"},
    {"2:23 syntax: expected `shell`, `box` or `disc`, found `ring`", "scatter 3 on ring(2m) { }"},
    {"2:38 syntax: expected `up` or `down`, found `left`", "scatter 3 on disc(2m) probe left 2m of a { }"},
    {"2:44 syntax: expected `of`, found `a`", "scatter 3 on disc(2m) probe up 2m a { }"},
    {"2:47 syntax: expected the name of a layer, found `3`", "scatter 3 on disc(2m) probe up 2m of 3 { }"},
    {"2:53 syntax: expected the name of the open length behind a point, found `3`",
     "scatter 3 on disc(2m) probe up 2m of a gap 3 { }"},
    {"2:32 syntax: expected `probe up` or `probe down` before the gap, found `gap`",
     "scatter 3 on disc(2m) gap h within 2m sphere(1m);"},
    {"2:15 syntax: a let with parameters stands outside of rules | move it to the top of the file", "let a(r) = 2m;"},
    {"2:14 syntax: expected a name, found `3`", "let 3 = 2m;"},
    {"2:14 syntax: expected the name of a material, found `3`", "mat 3;"},
    {"2:14 syntax: expected a text in quotes, found `3`", "tag 3;"},
    {"2:17 syntax: expected the kind of an anchor, found `3`", "anchor 3;"},
    {"2:10 wrong-use: `inner` stands in overrides only | it derives the block that an override replaces", "inner;"},
    {"2:20 duplicate: this block has a second `mat` | it holds for the whole block; open another block for the other",
     "mat rock; mat clay;"},
    {"2:19 duplicate: this block has a second `tag` | it holds for the whole block; open another block for the other",
     "tag \"a\"; tag \"b\";"},
    {"2:10 wrong-use: `a` would have no value where this detail is left out | declare it before the detail, or within "
     "a block of the detail, with what uses it",
     "detail 0.3m let a = 4m; box(a);"},
    {"2:10 wrong-use: `a` would have no value where this detail is left out | declare it before the detail, or within "
     "a block of the detail, with what uses it",
     "detail 0.3m at(x 1m) field a = p.x; displace a amp 1m { box(2m); }"},
    {"2:43 wrong-use: `a` would have no value where this detail is left out | declare it before the detail, or within "
     "a block of the detail, with what uses it",
     "detail 2m at(x 1m) { } detail 2m detail 1m footprint rect(2m, 3m) as a;"},
    {"", "detail 0.3m { let a = 4m; box(a); footprint rect(a, a) as b; extrude 2m of b; }"},
    {"2:17 syntax: a vector has three parts, a pair two | such as (1m, 2m, 3m)", "sphere((1m, 2m, 3m, 4m));"},
    {"2:17 syntax: `union` starts a statement and gives no value | a value is a number, a name or a function such as "
     "max(a, b)",
     "sphere(union(2m));"},
    {"2:17 syntax: expected an expression, found `repeat`", "sphere(repeat);"},
    {"2:17 syntax: expected an expression, found `;`", "sphere(;"},
    {"2:19 syntax: expected `)` or `,`, found `;`", "sphere(2m;"},
    {"2:22 syntax: expected a name after the point, found `)`", "sphere(cell.);"},
    {"2:26 syntax: expected `then`, found `than` | did you mean `then`?", "sphere(if 1 < 2 than 3m else 4m);"},
    {"2:26 syntax: expected `)` or `,`, found `=` | `=` names a value only in let, param and field; compare with `==`",
     "sphere(1m == 2m = 3m);"},
    {"2:20 syntax: comparisons do not chain | join two comparisons with `and`", "let a = 1 < 2 < 3;"},
    {"2:10 not-available: `set` is not available in sgm 1 of this version | the word is reserved for a later version",
     "set x { 2m: A; }"},
    {"2:17 not-available: `set` is not available in sgm 1 of this version | the word is reserved for a later version",
     "sphere(set);"},
    {"2:10 syntax: expected a statement, found `rule` | close the block before it with `}`", "rule B { }"},
};

}  // namespace

TEST_CASE("messages: what a statement or an expression lacks", "[grammar][messages]") {
  checkMessages(kStatements, {"sgm 1; start A;\nrule A { ", " }"});
}

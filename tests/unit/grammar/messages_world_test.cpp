// Tests messages about domains, layers, expectations, reach and overrides, word for word.

#include "messages.h"

using namespace sgm::test;

namespace {

const MessageCase kDomains[] = {
    {"1:1 no-start: nothing says where derivation starts | add `start Rule;` or a layer", "sgm 1; rule A { }"},
    {"1:25 domain: an infinite domain is derived by layers | add `layer name cell 100m reach 50m { start Rule; }`",
     "sgm 1; domain infinite; start A; rule A { }"},
    {"1:8 no-start: a grammar starts at the top or in its layers, not both | remove this start, or the layers\n1:23 "
     "domain: layers need an infinite domain or one with a box | write `domain infinite;` or `domain finite box(...)`",
     "sgm 1; start A; layer a cell 8m reach 4m { start A; } rule A { }"},
    {"1:25 no-start: a grammar starts at the top or in its layers, not both | remove this start, or the layers\n1:25 "
     "domain: an infinite domain is derived by layers | add `layer name cell 100m reach 50m { start Rule; }`",
     "sgm 1; domain infinite; start A; layer a cell 8m reach 4m { start A; } rule A { }"},
    {"1:14 domain: layers need an infinite domain or one with a box | write `domain infinite;` or `domain finite "
     "box(...)`",
     "sgm 1; layer a cell 8m reach 4m { start A; } rule A { }"},
    {"1:26 value-range: an edge of the domain is from 2 units to 2097 km long | such as box(200m)",
     "sgm 1; domain finite box(0m); start A; rule A { }"},
    {"1:26 unit-mismatch: an edge of the domain is a length, and this is a ratio | write `2m`",
     "sgm 1; domain finite box(2); start A; rule A { }"},
    {"1:8 argument-count: `box` needs 3 arguments | it is `box(x, y, z)`",
     "sgm 1; domain finite box(2m, 3m); start A; rule A { }"},
    {"1:42 value-range: the edge of a density is from one unit to 16 km wide | such as edge 20m",
     "sgm 1; domain finite output density edge 0m; start A; rule A { }"},
    {"1:42 unit-mismatch: the edge of a density is a length, and this is a ratio | write `2m`",
     "sgm 1; domain finite output density edge 2; start A; rule A { }"},
    {"1:38 value-range: a cell is from one unit to 1048 km long | such as cell 32m",
     "sgm 1; domain infinite; layer a cell 0m reach 4m { start A; } rule A { }"},
    {"1:47 value-range: a reach is from 0 to 1048 km long | such as reach 8m",
     "sgm 1; domain infinite; layer a cell 8m reach -4m { start A; } rule A { }"},
    {"1:38 unit-mismatch: the cell of a layer is a length, and this is a ratio | write `8m`",
     "sgm 1; domain infinite; layer a cell 8 reach 4m { start A; } rule A { }"},
    {"1:47 unit-mismatch: the reach of a layer is a length, and this is a ratio | write `4m`",
     "sgm 1; domain infinite; layer a cell 8m reach 4 { start A; } rule A { }"},
    {"1:57 value-range: a detail is from one unit to 1048 km long | such as detail 4m",
     "sgm 1; domain infinite; layer a cell 8m reach 4m detail 0m { start A; } rule A { }"},
    {"1:57 unit-mismatch: the detail of a layer is a length, and this is a ratio | write `2m`",
     "sgm 1; domain infinite; layer a cell 8m reach 4m detail 2 { start A; } rule A { }"},
    {"1:47 reach-too-large: the reach is more than 4 cells | make the cell at least 20 m long",
     "sgm 1; domain infinite; layer a cell 8m reach 80m { start A; } rule A { }"},
    {"1:38 whole-units: the cell of a layer is a whole number of units of 1/1024 m | the nearest is 0m",
     "sgm 1; domain infinite; layer a cell 0.0001m reach 0m { start A; } rule A { }"},
    {"1:52 not-constant: the cell of a layer must be a constant | use numbers, arithmetic and lets without parameters",
     "sgm 1; param a = 8m; domain infinite; layer a cell a reach 4m { start A; } rule A { }"},
    {"1:69 duplicate: layer `a` is declared twice | give it another name",
     "sgm 1; domain infinite; layer a cell 8m reach 4m { start A; } layer a cell 8m reach 4m { start A; } rule A { }"},
    {"1:95 unknown-name: unknown layer `nte` | did you mean `net`?",
     "sgm 1; domain infinite; layer net cell 8m reach 4m { start A; } layer b cell 8m reach 4m uses nte { start A; } "
     "rule A { }"},
    {"1:55 unknown-name: unknown layer `rock` | name a layer of this file",
     "sgm 1; domain infinite; layer a cell 8m reach 4m uses rock { start A; } rule A { }"},
    {"1:55 layer-cycle: layer `a` uses itself | a layer reads lower layers only",
     "sgm 1; domain infinite; layer a cell 8m reach 4m uses a { start A; } rule A { }"},
    {"1:55 layer-cycle: layers `a` and `b` use each other in a circle | a layer reads lower layers only",
     "sgm 1; domain infinite; layer a cell 8m reach 1m uses b { start A; } layer b cell 8m reach 1m uses a { start A; "
     "} rule A { }"},
    {"2:47 layer-uses: layer `b` probes `a` and does not use it | write `uses a` in its head",
     "sgm 1; domain infinite; layer a cell 8m reach 4m { start B; } layer b cell 8m reach 4m { start A; }\nrule A { "
     "scatter poisson(1m) probe down 2m of a { sphere(1m); } } rule B { sphere(1m); }"},
    {"2:45 unknown-name: unknown layer `nte` | did you mean `net`?",
     "sgm 1; domain infinite; layer net cell 8m reach 4m { start B; } layer b cell 8m reach 4m uses net { start A; "
     "}\nrule A { scatter poisson(1m) probe up 2m of nte { sphere(1m); } } rule B { sphere(1m); }"},
};

const MessageCase kExpectations[] = {
    {"2:1 wrong-use: `watertight` holds or not; it is not compared | write `watertight;` alone",
     "expect watertight == 1;"},
    {"2:1 wrong-use: `watertight` holds or not; it is not compared | write `watertight;` alone",
     "expect watertight in 0..1;"},
    {"2:1 syntax: an `expect` of a number needs something to compare with | such as == 1 or in 1..10",
     "expect volume;"},
    {"2:1 wrong-use: only `components` takes `air` or `solid` | leave the parentheses out",
     "expect volume(air) > 1m3;"},
    {"2:31 value-range: the size of a piece is 0m3 or more | such as components(solid above 2m3)",
     "expect components(solid above -2m3) == 1;"},
    {"2:31 unit-mismatch: the size of a piece is a volume, and this is a length | such as 2m3",
     "expect components(solid above 2m) == 1;"},
    {"2:22 unit-mismatch: the value to compare with is a ratio, and this is a length | divide it by a length to make a "
     "ratio of it",
     "expect components == 1m;"},
    {"2:22 unit-mismatch: the low end of a range is a ratio, and this is a length | divide it by a length to make a "
     "ratio of it",
     "expect components in 1m..2;"},
    {"2:25 unit-mismatch: the high end of a range is a ratio, and this is a length | divide it by a length to make a "
     "ratio of it",
     "expect components in 1..2m;"},
    {"2:1 unknown-name: unknown rule `B` | name a rule of this file", "expect volume > 1m3 per B;"},
    {"2:1 unknown-name: unknown rule `a` | did you mean `A`?", "expect volume > 1m3 per a;"},
};

const MessageCase kCells[] = {
    {"2:10 reach: cannot prove reach: `halfspace` may extend without bound from its cell, layer `a` declares reach 4 m "
     "| meet it with a box, or cut a shape with it",
     "rule A { halfspace(below 2m); }"},
    {"2:10 reach: cannot prove reach: `sphere` may extend 6 m from its cell, layer `a` declares reach 4 m | raise "
     "reach to 6 m or make the shape smaller",
     "rule A { sphere(6m); }"},
    {"2:10 warning reach-maybe: `sphere` may extend 6 m from its cell, layer `a` declares reach 4 m | shapes that go "
     "farther are left out whole",
     "rule A { sphere(rand(1m, 6m)); }"},
    {"2:19 reach: cannot prove reach: the shape that this displaces may extend without bound from its cell, layer `a` "
     "declares reach 4 m | bound what it depends on: a parameter's range, clamp(), or `amp` of displace and warp",
     "rule A { displace p.y { sphere(1m); } }"},
    {"2:34 reach: cannot prove reach: the shape that this displaces may extend without bound from its cell, layer `a` "
     "declares reach 4 m | bound what it depends on: a parameter's range, clamp(), or `amp` of displace and warp",
     "rule A { at(0m, 9m, 0m) displace q.y/9 { sphere(1m); } }"},
    {"2:10 warning morph-disjoint: the two shapes of this morph lie apart, and may vanish half way | let them overlap",
     "rule A { morph({ sphere(1m); }, { at(9m, 0m, 0m) sphere(1m); }, 0.5); }"},
    {"2:44 warning idle-cut: nothing stands before this cut in its block | a cut takes from what its own block has "
     "added before it",
     "rule A { B; } rule B { union { let r = 1m; cut { sphere(r); } } }"},
    {"2:39 unit-mismatch: the length of a probe is a length, and this is a ratio | write `2m`\n2:44 layer-uses: layer "
     "`a` probes itself | a layer reads lower layers only: derive what it asks about in a layer of its own",
     "rule A { scatter poisson(1m) probe up 2 of a { sphere(1m); } }"},
    {"2:45 layer-uses: layer `a` probes itself | a layer reads lower layers only: derive what it asks about in a layer "
     "of its own\n2:60 unit-mismatch: the limit of a gap is a length, and this is a ratio | write `2m`",
     "rule A { scatter poisson(1m) probe up 2m of a gap h within 2 { sphere(h); } }"},
    {"2:25 wrong-use: `ca` fills its layer's cell and cannot be placed elsewhere | take it out of at, rot, scale, "
     "mirror, repeat and scatter",
     "rule A { at(1m, 0m, 0m) ca(1m); }"},
    {"2:13 value-range: a cell of the layer is from 1 to 64 voxels of `ca` wide | here a voxel has from 0.2 m to 8 m",
     "rule A { ca(12cm); }"},
    {"2:13 value-range: a cell of the layer is from 1 to 64 voxels of `ca` wide | here a voxel has from 0.2 m to 8 m",
     "rule A { ca(9m); }"},
    {"2:22 value-range: the fill of `ca` is from 0% to 100% | such as fill 45%", "rule A { ca(1m, fill 45); }"},
    {"2:24 value-range: `ca` has from 0 to 16 rounds | such as rounds 4", "rule A { ca(1m, rounds 17); }"},
    {"2:27 value-range: the threshold of `ca` is from 0% to 100% | such as threshold 50%",
     "rule A { ca(1m, threshold 5); }"},
    {"2:24 value-range: the radius of `ca` is a number, from 1 to 4 voxels | such as radius 1",
     "rule A { ca(1m, radius 5); }"},
    {"2:24 value-range: rounds times radius of `ca` is at most 16 | so many voxels around each cell are computed with "
     "it",
     "rule A { ca(1m, rounds 6, radius 3); }"},
    {"2:34 value-range: the `step` of a branch is a length above 0 | such as step 6m",
     "rule A { for s in branch(3, step 0m, turn 9deg) { sphere(1m); } }"},
    {"2:43 value-range: the `turn` of a branch is 0deg to 90deg | such as turn 25deg",
     "rule A { for s in branch(3, step 1m, turn 91deg) { sphere(1m); } }"},
    {"2:55 value-range: the `fork` of a branch is 0% to 100% | such as fork 20%",
     "rule A { for s in branch(3, step 1m, turn 90deg, fork 20) { sphere(1m); } }"},
    {"2:26 value-range: a branch takes 0 to 4096 steps | raise `step` instead",
     "rule A { for s in branch(4097, step 1cm, turn 9deg) { sphere(1m); } }"},
    {"2:19 reach: cannot prove reach: the shape that this displaces may extend without bound from its cell, layer `a` "
     "declares reach 4 m | give the smallest radius of the displaced shape a lower bound, such as max(r, 1m)",
     "rule A { displace 0.1m*fractal(2m) { ellipsoid(rand(0m, 1m), 1m, 1m); } }"},
    {"2:19 reach: cannot prove reach: the shape that this displaces may extend without bound from its cell, layer `a` "
     "declares reach 4 m | displace by less than 0.25 m: a sum's field is no larger far away",
     "rule A { displace 3m*fractal(2m) { sum { blob(1m); } } }"},
    {"2:19 reach: cannot prove reach: the shape that this displaces may extend without bound from its cell, layer `a` "
     "declares reach 4 m | a sum can be displaced only where its largest shape is sure to have some size: displace the "
     "shapes in it",
     "rule A { displace 3m*fractal(2m) { sum { blob(rand(0m, 1m)); } } }"},
};

const MessageCase kOverrides[] = {
    {"2:10 syntax: expected a derivation path in quotes, or `tag`, found `B`",
     "override B { }\nrule A { B; B; } rule B { tag \"t\"; sphere(1m); }"},
    {"2:11 syntax: expected the name of a rule in this path | such as \"net(0, 0, -1)/Node/Chamber[0]\", as messages "
     "print it",
     "override \"\" { }\nrule A { B; B; } rule B { tag \"t\"; sphere(1m); }"},
    {"2:13 syntax: expected the name of a rule in this path | such as \"net(0, 0, -1)/Node/Chamber[0]\", as messages "
     "print it",
     "override \"A//B\" { }\nrule A { B; B; } rule B { tag \"t\"; sphere(1m); }"},
    {"2:15 syntax: expected the number of a use, such as 0 in this path | such as \"net(0, 0, -1)/Node/Chamber[0]\", "
     "as messages print it",
     "override \"A/B[x]\" { }\nrule A { B; B; } rule B { tag \"t\"; sphere(1m); }"},
    {"2:15 syntax: expected the number of a use, such as 0 in this path | such as \"net(0, 0, -1)/Node/Chamber[0]\", "
     "as messages print it",
     "override \"A/B[4294967295]\" { }\nrule A { B; B; } rule B { tag \"t\"; sphere(1m); }"},
    {"2:10 warning parameter-names: the heads of `B` call one parameter `r` and `s` | here it is `r`, as in the first: "
     "use one name in all of them",
     "override \"A/B\" { sphere(r); }\n"
     "rule A { B(1m); } rule B(r) weight 1 { sphere(r); } rule B(s) weight 1 { box(s); }"},
    {"2:10 warning idle-override: `A` derives `B` 2 times at most: `B[2]` is never derived | the last is `B[1]`",
     "override \"A/B[2]\" { }\nrule A { B; cut { at(1m, 0m, 0m) B; } } rule B { sphere(1m); }"},
    {"2:10 warning idle-override: `A` derives `B` once at most: `B[4]` is never derived | the last is `B[0]`",
     "override \"A/B[4]/C\" { }\nrule A weight 1 { B; } rule A weight 2 { B; } rule B { C; } rule C { sphere(1m); }"},
    {"2:10 warning idle-override: `A` derives `B` 3 times at most: `B[3]` is never derived | the last is `B[2]`",
     "override \"A/B[3]\" { }\n"
     "rule A { size(2m, 2m, 2m) { split x { ~1m: B; 25%: B; } comp { front: B; } } } rule B { sphere(1m); }"},
    {"2:10 warning idle-override: `A` derives `B` 8 times at most: `B[8]` is never derived | the last is `B[7]`",
     "override \"A/B[8]\" { }\n"
     "rule A { size(2m, 2m, 2m) comp { side: split x { ~1m: B; } edges: B; } } rule B { sphere(1m); }"},
    {"2:10 warning idle-override: `A` derives `B` once at most: `B[1]` is never derived | the last is `B[0]`",
     "override \"A/B[1]\" { }\nrule A { size(4m, 2m, 4m) treemap { a 4: B; } } rule B { sphere(1m); }"},
    {"", "override \"A/B[9]\" { }\nrule A { size(2m, 2m, 2m) split x { { 1m: B; }* } } rule B { sphere(1m); }"},
    {"", "override \"A/B[9]\" { }\nrule A { size(2m, 2m, 2m) treemap { a 4: { } facade: B; } } rule B { sphere(1m); }"},
    {"2:10 warning idle-override: `A` derives `B` once at most: `B[1]` is never derived | the last is `B[0]`",
     "override \"A/B[1]\" { }\noverride \"A\" { inner; sphere(2m); }\nrule A { B; } rule B { sphere(1m); }"},
    {"",
     "override \"A/B[1]\" { }\noverride tag \"t\" { inner; inner; }\n"
     "rule A { { tag \"t\"; B; } } rule B { sphere(1m); }"},
    {"", "override \"A/B[3]\" { }\nrule A { repeat 3 at(1m, 0m, 0m) { B; } B; } rule B { sphere(1m); }"},
    {"", "override \"A/B[1]\" { }\noverride \"A\" { inner; inner; }\nrule A { B; } rule B { sphere(1m); }"},
    {"2:16 syntax: expected `]` in this path | such as \"net(0, 0, -1)/Node/Chamber[0]\", as messages print it",
     "override \"A/B[0\" { }\nrule A { B; B; } rule B { tag \"t\"; sphere(1m); }"},
    {"2:14 syntax: expected `/` between two steps, or the end of the path in this path | such as \"net(0, 0, "
     "-1)/Node/Chamber[0]\", as messages print it",
     "override \"A/B \" { }\nrule A { B; B; } rule B { tag \"t\"; sphere(1m); }"},
    {"2:17 syntax: expected the three whole numbers of a cell, such as (0, 0, -1) in this path | such as \"net(0, 0, "
     "-1)/Node/Chamber[0]\", as messages print it",
     "override \"a(1, 2)/A\" { }\nrule A { B; B; } rule B { tag \"t\"; sphere(1m); }"},
    {"2:21 syntax: expected `/` and a rule after the cell in this path | such as \"net(0, 0, -1)/Node/Chamber[0]\", as "
     "messages print it",
     "override \"a(1, 2, 3)A\" { }\nrule A { B; B; } rule B { tag \"t\"; sphere(1m); }"},
    {"2:11 syntax: a start has no number | write `A`",
     "override \"A[0]/B\" { }\nrule A { B; B; } rule B { tag \"t\"; sphere(1m); }"},
    {"2:11 unknown-name: unknown layer `roc` | name a layer of this file",
     "override \"roc(0, 0, 0)/A\" { }\nrule A { B; B; } rule B { tag \"t\"; sphere(1m); }"},
    {"2:12 value-range: this cell lies beyond the end of the world | the world ends at 2097 km",
     "override \"a(0, 300000000, 0)/A\" { }\nrule A { B; B; } rule B { tag \"t\"; sphere(1m); }"},
    {"2:11 unknown-name: no layer starts with `B` | it derives A",
     "override \"B\" { }\nrule A { B; B; } rule B { tag \"t\"; sphere(1m); }"},
    {"2:22 unknown-name: this layer does not start with `B` | it derives A",
     "override \"a(0, 0, 0)/B\" { }\nrule A { B; B; } rule B { tag \"t\"; sphere(1m); }"},
    {"2:13 unknown-name: `A` derives no `Bb` | did you mean `B`?",
     "override \"A/Bb\" { }\nrule A { B; B; } rule B { tag \"t\"; sphere(1m); }"},
    {"2:13 unknown-name: `A` derives no `override` | edit the block of that override",
     "override \"A/override/B[0]\" { }\nrule A { B; B; } rule B { tag \"t\"; sphere(1m); }"},
    {"2:13 unknown-name: `A` derives no `x.Cave` | it derives B",
     "override \"A/x.Cave\" { }\nrule A { B; B; } rule B { tag \"t\"; sphere(1m); }"},
    {"2:14 unknown-name: nothing here has the tag \"stone\" | write `tag` and this text in the block that it replaces",
     "override tag \"stone\" { }\nrule A { B; B; } rule B { tag \"t\"; sphere(1m); }"},
    {"2:14 unknown-name: nothing here has the tag \"kitchn\" | did you mean `kitchen`?",
     "override tag \"kitchn\" { }\nrule A { size(3m, 3m, 3m) treemap { kitchen 3: { } } }"},
    {"2:10 syntax: \"tag:t\" is not a path of rules | write `override tag \"t\"` for the blocks with that tag",
     "override \"tag:t\" { }\nrule A { B; B; } rule B { tag \"t\"; sphere(1m); }"},
    {"2:10 syntax: \"t\" is not a path of rules | write `override tag \"t\"` for the blocks with that tag",
     "override \"t\" { }\nrule A { B; B; } rule B { tag \"t\"; sphere(1m); }"},
    {"", "override tag \"hall\" { cut sphere(1m); }\nrule A { size(3m, 3m, 3m) treemap { hall 3: sphere(1m); } }"},
    {"2:36 duplicate: this path or tag already has an override, which this one leaves out | derive it with `inner;`, "
     "or remove one of them | note: the first is at test.sgm:2:10",
     "override \"A/B\" { inner; } override \"A/B\" { }\nrule A { B; B; } rule B { tag \"t\"; sphere(1m); }"},
    {"2:35 duplicate: this path or tag already has an override, which this one leaves out | derive it with `inner;`, "
     "or remove one of them | note: the first is at test.sgm:2:14",
     "override tag \"t\" { } override tag \"t\" { }\nrule A { B; B; } rule B { tag \"t\"; sphere(1m); }"},
    {"2:10 reach: cannot prove reach: the shape of this override may extend 9 m from its cell, layer `a` declares "
     "reach 4 m | raise reach to 9 m or make the shape smaller",
     "override \"A/B\" { sphere(9m); }\nrule A { B; B; } rule B { tag \"t\"; sphere(1m); }"},
    {"2:18 warning idle-cut: nothing stands before this cut in its block | a cut takes from what its own block has "
     "added before it",
     "override \"A/B\" { cut { sphere(1m); } }\nrule A { B; B; } rule B { tag \"t\"; sphere(1m); }"},
    {"2:10 too-deep: rules may be nested at most 64 deep | write a path of 64 rules at most",
     "override "
     "\"A/A/A/A/A/A/A/A/A/A/A/A/A/A/A/A/A/A/A/A/A/A/A/A/A/A/A/A/A/A/A/A/A/A/A/A/A/A/A/A/A/A/A/A/A/A/A/A/A/A/A/A/A/A/A/"
     "A/A/A/A/A/A/A/A/A/A\" { }\nrule A { A; }"},
};

// Valid grammars that probably contain a mistake, about which the compiler warns; and similar grammars without a
// warning.
const MessageCase kIdle[] = {
    {"2:7 warning unused-value: nothing uses the parameter `n` | it changes nothing: use it, or remove it",
     "param n = 3 in 1..5;\nrule A { sphere(1m); }"},
    {"2:5 warning unused-value: nothing uses the let `n` | use it, or remove it", "let n = 3;\nrule A { sphere(1m); }"},
    {"2:7 warning unused-value: nothing uses the field `f` | use it, or remove it",
     "field f = p.y;\nrule A { sphere(1m); }"},
    {"2:26 warning unused-value: nothing uses the import `rock` | use it, or remove it",
     "import \"std/rock.sgm\" as rock;\nrule A { sphere(1m); }"},
    {"2:10 warning unused-value: nothing uses the let `b` | use it, or remove it",
     "rule A { let b = 2m; let c = 1m; sphere(c); }\n"
     "rule B(b) { sphere(b); } override \"A\" { inner; let b = 2m; B(b); }"},
    {"2:60 warning near-name: the material `bric` is spelt almost like `brick`, which is used as well | did you mean "
     "`brick`?",
     "rule A { { sphere(1m); mat brick; } at(x 1m) { sphere(1m); mat bric; } }"},
    {"2:24 warning near-name: the material `birck` is spelt almost like `brick`, which is used as well | did you mean "
     "`brick`?",
     "rule A { { sphere(1m); mat birck; } { box(1m); mat brick; } { box(2m); mat brick; } }"},
    {"",
     "rule A { { sphere(1m); mat glass; } { box(1m); mat grass; } { box(2m); mat wall1; } { box(2m); mat wall2; } }"},
    {"", "rule A { { sphere(1m); mat clay; } { box(1m); mat clays1; } { box(1m); mat tin; } { box(2m); mat tine; } }"},
    {"2:43 warning flat-scope: the scope of a face has no depth, so this box is left out | give it one: `size(z 0.2m) "
     "box(scope)`",
     "rule A { size(2m, 2m, 2m) comp { front: { box(scope); } edges: box(scope); } }"},
    {"", "rule A { size(2m, 2m, 2m) comp { front: size(z 0.2m) box(scope); inside: box(scope); } }"},
    {"", "param n = 3 in 1..5;\nlet a = n; let b = 2; rule A { let c = a; repeat c sphere(1m*b); }"},
    {"", "import \"std/rock.sgm\" as rock;\nrule A { displace rock.fbm(period 5m, amp 0.1m) { sphere(1m); } }"},
    {"3:16 warning idle-head: this head of `B` never applies: its guard never holds | this holds for all parameters "
     "within their ranges: correct the guard, or remove the head",
     "param n = 3 in 1..5; rule A { B(n); B(4); }\nrule B(k) when k > 5 { sphere(1m); } rule B(k) else { box(1m); }"},
    {"3:38 warning idle-head: this head of `B` never applies: another one's guard always holds | this holds for all "
     "parameters within their ranges: correct the guard, or remove the head",
     "param n = 3 in 1..5; rule A { B(n); B(4); }\nrule B(k) when k > 0 { sphere(1m); } rule B(k) else { box(1m); }"},
    {"", "param n = 3 in 1..5; rule A { B(n); }\nrule B(k) when k > 4 { sphere(1m); } rule B(k) else { box(1m); }"},
    {"3:53 warning guards: this guard of `B` and an earlier one can both hold | one of their heads is drawn then: let "
     "one exclude the other, or give both a `weight` if that is meant | note: the earlier one is at test.sgm:3:16",
     "param n = 3 in 1..5; rule A { B(n); }\n"
     "rule B(k) when k > 2 { sphere(1m); } rule B(j) when 3 <= j { box(1m); } rule B(k) else { }"},
    {"3:54 warning guards: this guard of `B` and an earlier one can both hold | one of their heads is drawn then: let "
     "one exclude the other, or give both a `weight` if that is meant | note: the earlier one is at test.sgm:3:13",
     "rule A { size(3m, 3m, 3m) B; size(1m, 1m, 1m) B; }\n"
     "rule B when scope.x < 2m { sphere(1m); } rule B when scope.x > 150cm { box(1m); }"},
    // The parameter is a whole number, so the guards cover all of its values: there is none between 2 and 3.
    {"",
     "param n = 3 in 1..5; rule A { B(n); }\nrule B(k) when k < 3 { sphere(1m); } rule B(k) when k > 2 { box(1m); }"},
    {"",
     "rule A { for i in 0..4 { let j = 2*i - 1; B(j); } }\n"
     "rule B(k) when k < 1 { box(1m); } rule B(k) when k > 0 { B(k - 1); }"},
    {"3:53 warning guards: this guard of `B` and an earlier one can both hold | one of their heads is drawn then: let "
     "one exclude the other, or give both a `weight` if that is meant | note: the earlier one is at test.sgm:3:16",
     "rule A { for i in 0..4 { B(i); B(i/2); } }\n"
     "rule B(k) when k < 3 { sphere(1m); } rule B(k) when k > 2 { box(1m); }"},
    {"",
     "param n = 3 in 1..5; rule A { B(n); }\nrule B(k) when k > 3 { sphere(1m); } rule B(k) when k <= 3 { box(1m); }"},
    {"",
     "param n = 3 in 1..5; rule A { B(n, n); }\n"
     "rule B(k, j) when k > 3 { sphere(1m); } rule B(k, j) when j <= 3 { box(1m); }"},
    {"",
     "param n = 3 in 1..5; rule A { B(n); }\n"
     "rule B(k) when k > 3 weight 1 { sphere(1m); } rule B(k) when k > 2 weight 2 { box(1m); }"},
};

const MessageCase kWholes[] = {
    {"1:83 value-range: a cell of the layer is from 1 to 64 voxels of `ca` wide | make the layer's cells larger",
     "sgm 1; domain infinite; layer a cell 0.0078125m reach 0m { start A; } rule A { ca(1m); }"},
    {"1:8 no-start: nothing is derived here that could be edited | put overrides into the file with the layers, or "
     "with the start",
     "sgm 1; override \"A\" { } let b = 2;"},
    {"2:15 value-range: `main` has no cells along y | its number is 0 there",
     "sgm 1; start A;\noverride \"main(0, 1, 0)/A\" { }\nrule A { sphere(1m); }"},
    {"1:26 wrong-use: `ca` fills the cells of a layer, and this start has no cells | put it into a layer: `layer caves "
     "cell 32m reach 1m { start ...; }`",
     "sgm 1; start A; rule A { ca(1m); }"},
    {"2:24 wrong-use: `inner` derives a cut of the domain here, and cannot be inside another shape | put `inner` into "
     "the override's own block, under transforms, loops and `detail` only",
     "sgm 1; domain infinite; layer a cell 8m reach 4m { start A; }\noverride \"A\" { union { inner; } }\nrule A { cut "
     "{ sphere(1m); } }"},
    {"1:26 reach: cannot prove reach: `halfspace` may extend without bound | meet it with a box, or cut a "
     "shape with it",
     "sgm 1; start A; rule A { halfspace(below 2m); }"},
    {"1:49 reach: cannot prove reach: `sphere` may extend 7 m beyond the domain's box | write `box(18m, 18m, "
     "18m)`, or make the shape smaller",
     "sgm 1; domain finite box(4m); start A; rule A { sphere(9m); }"},
    {"1:58 reach: cannot prove reach: the shape that this displaces may extend without bound beyond the domain's box | "
     "bound what it depends on: a parameter's range, clamp(), or `amp` of displace and warp",
     "sgm 1; domain finite box(4m); start A; rule A { displace 1m*p.x/1m { sphere(1m); } }"},
    {"1:35 reach: cannot prove reach: the shape that this displaces may extend without bound | bound what it depends "
     "on: a parameter's range, clamp(), or `amp` of displace and warp",
     "sgm 1; start A; rule A { displace 1m*p.x/1m { sphere(1m); } }"},
    {"1:35 reach: cannot prove reach: the shape that this displaces may extend without bound | displace by less than "
     "0.25 m: a sum's field is no larger far away",
     "sgm 1; start A; rule A { displace 3m*fractal(2m) { sum { blob(1m); } } }"},
    {"1:35 reach: cannot prove reach: the shape that this displaces may extend without bound | a sum can be displaced "
     "only where its largest shape is sure to have some size: displace the shapes in it",
     "sgm 1; start A; rule A { displace 3m*fractal(2m) { sum { blob(rand(0m, 1m)); } } }"},
};

}  // namespace

TEST_CASE("messages: domains and layers", "[grammar][messages]") { checkMessages(kDomains); }

TEST_CASE("messages: expectations", "[grammar][messages]") {
  checkMessages(kExpectations, {"sgm 1; start A; rule A { sphere(1m); }\n", ""});
}

TEST_CASE("messages: what a cell of a layer may hold", "[grammar][messages]") {
  checkMessages(kCells, {"sgm 1; domain infinite; layer a cell 8m reach 4m { start A; }\n", ""});
}

TEST_CASE("messages: overrides", "[grammar][messages]") {
  checkMessages(kOverrides, {"sgm 1; domain infinite; layer a cell 8m reach 4m { start A; }\n", ""});
}

TEST_CASE("messages: what is hardly meant", "[grammar][messages]") {
  checkMessages(kIdle, {"sgm 1; domain infinite; layer a cell 8m reach 4m { start A; }\n", ""});
}

TEST_CASE("messages: grammars as a whole", "[grammar][messages]") { checkMessages(kWholes); }

// Tests every diagnostic code, with the exact line and column at which it is reported.

#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "catch.h"
#include "compile_text.h"

using namespace sgm;
using namespace sgm::test;

namespace {

struct Case {
  const char* expected;  ///< expected diagnostics in the form of brief()
  const char* text;
};

// A layer that cuts voids into rock, and a layer that may query it.
#define SGM_NET                                                               \
  "sgm 1; domain infinite solid; layer net cell 32m reach 16m { start Net; }" \
  " layer drip cell 16m reach 8m uses net { start D; }\nrule Net { cut { at(cell.center) sphere(8m); } }\n"

// A layer that derives A, and a rule A that uses B twice.
#define SGM_LAYER "sgm 1; domain infinite; layer a cell 8m reach 4m { start A; }\n"
#define SGM_USED_TWICE "\nrule A { B; B; } rule B { tag \"t\"; sphere(1m); }"

const Case kCases[] = {
    // The text
    {"2:17 bad-character", "sgm 1; start A;\nrule A { sphere(#2m); }"},
    {"2:17 bad-character", "sgm 1; start A;\nrule A { sphere($); }"},
    // Bytes that are not UTF-8: Latin-1, a truncated sequence, an overlong one, a surrogate. The expected place is that
    // of the byte.
    {"2:17 bad-character",
     "sgm 1; start A; // \xC3\xA9\nrule A { } // na\xEF"
     "ve caf\xE9\n"},
    {"1:33 bad-character",
     "sgm 1; param a = 1m in 0m..2m \"d\xE9"
     "but\"; start A; rule A { sphere(a); }"},
    {"1:32 bad-character", "sgm 1; param a = 1m in 0m..2m \"\xE2\x82\"; start A; rule A { sphere(a); }"},
    {"1:32 bad-character", "sgm 1; param a = 1m in 0m..2m \"\xC0\xAF\"; start A; rule A { sphere(a); }"},
    {"1:17 bad-character", "sgm 1; start A;\t\xED\xA0\x80\nrule A { }"},
    {"2:14 bad-text", "sgm 1; start A;\nrule A { tag \"unclosed; }\n"},
    {"2:14 bad-text", "sgm 1; start A;\nrule A { tag \"a\\n\"; }\n"},
    {"2:17 bad-number", "sgm 1; start A;\nrule A { sphere(.5m); }"},
    {"2:17 number-range", "sgm 1; start A;\nrule A { sphere(3000km); }"},
    {"2:17 number-range", "sgm 1; start A;\nrule A { sphere(1e300); }"},
    {"2:17 unknown-unit", "sgm 1; start A;\nrule A { sphere(3ft); }"},
    {"1:14 unknown-unit", "sgm 1; units ft; start A; rule A { }"},
    // The syntax
    {"3:1 syntax", "sgm 1; start A;\nrule A { }\nbox(1m);"},
    {"2:21 syntax", "sgm 1; start A;\nrule A { sphere(2m) }"},
    {"2:8 syntax", "sgm 1;\nstart A\nrule A { }"},
    {"2:10 syntax", "sgm 1; start A;\nrule A { uinon { sphere(2m); } }"},
    {"2:8 syntax", "sgm 1; start A;\nrule A { sphere(2m);"},
    {"2:20 syntax", "sgm 1; start A;\nrule A { let a = 1 < 2 < 3; }"},
    {"2:10 not-available", "sgm 1; start A;\nrule A { set x { 2m: A; } sphere(2m); }"},
    {"2:16 syntax", "sgm 1; start A;\nrule A { split yz { 2m: sphere(2m); } }"},
    {"2:16 syntax", "sgm 1; start A;\nrule A { split w { 2m: sphere(2m); } }"},
    {"2:23 syntax", "sgm 1; start A;\nrule A { split x { 2m sphere(2m); } }"},
    {"2:8 syntax; 2:18 syntax", "sgm 1; start A;\nrule A { split x { 2m: sphere(2m);"},
    {"2:41 syntax",
     "sgm 1; start A;\nrule A { split x { { ~2m: sphere(2m); } 1m: sphere(1m); } } domain finite box(90m);"},
    {"2:22 syntax", "sgm 1; start A;\nrule A { split x { { { 2m: sphere(2m); }* }* } } domain finite box(90m);"},
    {"2:41 duplicate",
     "sgm 1; start A;\nrule A { split x { { 2m: sphere(2m); }* { 2m: sphere(2m); }* } } domain finite box(90m);"},
    {"2:10 syntax", "sgm 1; start A;\nrule A { split x { } sphere(2m); }"},
    {"2:20 syntax", "sgm 1; start A;\nrule A { split x { { }* 1m: sphere(2m); } } domain finite box(90m);"},
    {"2:10 syntax", "sgm 1; start A;\nrule A { comp { } sphere(2m); }"},
    {"2:23 value-range", "sgm 1; start A;\nrule A { split x snap -1m { 2m: sphere(2m); } }"},
    {"2:20 value-range", "sgm 1; start A;\nrule A { split x { 2: sphere(2m); } }"},
    {"2:21 unit-mismatch", "sgm 1; start A;\nrule A { split x { ~2: sphere(2m); } }"},
    {"2:20 unit-mismatch", "sgm 1; start A;\nrule A { split x { 2deg: sphere(2m); } }"},
    {"2:20 stage", "sgm 1; start A;\nrule A { split x { p.x: sphere(2m); } }"},
    {"2:17 unknown-name", "sgm 1; start A;\nrule A { comp { fornt: sphere(2m); } }"},
    {"2:17 syntax", "sgm 1; start A;\nrule A { comp { 2m: sphere(2m); } }"},
    {"2:34 duplicate",
     "sgm 1; start A;\nrule A { comp { top: sphere(2m); top: sphere(1m); } } domain finite box(90m);"},
    {"2:39 idle-cut", "sgm 1; start A;\nrule A { size(2m, 2m, 2m) comp { top: cut sphere(2m); side: box(1m); } }"},
    {"2:6 reserved-word", "sgm 1; start A;\nrule repeat { } rule A { }"},
    {"1:1 version", "start A; rule A { }"},
    {"1:5 version", "sgm 2; start A; rule A { }"},
    {"2:16 duplicate", "sgm 1; start A; rule A { }\nlet a = 1; let a = 2;"},
    {"1:17 duplicate", "sgm 1; start A; start A; rule A { }"},
    {"2:20 duplicate", "sgm 1; start A;\nrule A { mat rock; mat clay; }"},
    {"2:24 duplicate", "sgm 1; start A(1);\nrule A(r) { let b = r; let r = 2; }"},
    {"2:33 duplicate", "sgm 1; start A; rule A { sphere(1m); }\nexpect volume in 1m3..2m3 per A per A;"},
    {"2:27 duplicate", "sgm 1; start A; rule A { sphere(1m); }\nexpect volume in 1m3..2m3 in 3m3..4m3;"},
    {"2:19 argument-name", "sgm 1; start A;\nrule A { at(y 2m, 3m) sphere(1m); }"},
    {"2:14 value-range", "sgm 1; start A;\nrule A depth 65 -> sphere(1m) { sphere(1m); }"},
    // Cuts
    {"2:30 idle-cut", "sgm 1; start A; rule A { B; }\nrule B { union { let r = 1m; cut { sphere(r); } } }"},
    // Imports
    {"1:15 import-path", "sgm 1; import \"../a.sgm\" as a; start A; rule A { }"},
    {"1:15 import-missing", "sgm 1; import \"std/rokc.sgm\" as a; start A; rule A { }"},
    {"1:15 import-missing", "sgm 1; import \"a.sgm\" as a; start A; rule A { }"},
    // Cases of names and arguments.
    {"2:10 unknown-name", "sgm 1; start A;\nrule A { shpere(2m); }"},
    {"2:17 unknown-name", "sgm 1; start A;\nrule A { sphere(radius); }"},
    {"1:14 unknown-name", "sgm 1; start B; rule A { }"},
    {"2:19 unknown-name", "sgm 1; import \"std/rock.sgm\" as rock; start A;\nrule A { displace rock.fmb(1m, 1m) { } }"},
    {"2:8 unknown-name", "sgm 1; start A; rule A { }\nexpect watertihgt;"},
    {"2:17 unknown-member", "sgm 1; start A;\nrule A { sphere(cell.q); }"},
    {"2:10 argument-count", "sgm 1; start A;\nrule A { sphere(); }"},
    {"2:21 argument-count", "sgm 1; start A;\nrule A { sphere(2m, 3m); }"},
    {"3:1 argument-count", "sgm 1; start A(1);\nrule A(r) weight 1 { }\nrule A(r, s) weight 1 { }"},
    {"2:17 argument-name", "sgm 1; start A;\nrule A { sphere(radius 2m); }"},
    {"2:10 wrong-use", "sgm 1; let b = 2m; start A;\nrule A { b; }"},
    {"2:17 wrong-use", "sgm 1; start A; rule B { }\nrule A { sphere(B); B; }"},
    {"2:16 wrong-use", "sgm 1; start A;\nrule A { sum { cut { sphere(2m); } } }"},
    {"1:16 wrong-use", "sgm 1; let a = cell; start A; rule A { }"},
    {"1:12 shadows-builtin", "sgm 1; let sphere = 2m; start A; rule A { }"},
    {"1:27 shadows-builtin", "sgm 1; start A(1); rule A(p) { }"},
    {"1:14 unused-value", "sgm 1; param n = 3; start A; rule A { sphere(1m); }"},
    {"2:16 idle-head", "sgm 1; start A(3);\nrule A(n) when n > 5 { sphere(1m); } rule A(n) else { box(1m); }"},
    {"2:53 guards",
     "sgm 1; param n = 3 in 0..9; start A(n);\nrule A(n) when n > 5 { sphere(1m); } rule A(m) when m > 6 { box(1m); }"},
    {"2:6 unused-rule", "sgm 1; start A; rule A { }\nrule B { }"},
    // Cases of types and evaluation stages.
    {"2:17 unit-mismatch", "sgm 1; start A;\nrule A { sphere(5); }"},
    {"2:17 type-mismatch", "sgm 1; start A;\nrule A { sphere((1m, 2m, 3m)); }"},
    {"2:13 stage", "sgm 1; start A; field f = p.y;\nrule A when f > 0m { } rule A else { }"},
    {"2:17 stage", "sgm 1; start A;\nrule A { sphere(p.x); }"},
    {"2:18 stage", "sgm 1; start A;\nrule A { scatter q.x/1m on disc(2m) sphere(1m); }"},
    {"1:16 rand-key", "sgm 1; let a = rand(1, 2); start A; rule A { sphere(a*1m); }"},
    {"1:62 not-constant",
     "sgm 1; param a = 1m in 0m..2m; domain infinite; layer l cell a reach 1m { start A; } rule A { }"},
    {"1:13 value-range", "sgm 1; seed -1; start A; rule A { }"},
    {"1:18 param-range", "sgm 1; param a = 3 in 0..2; start A; rule A { }"},
    {"1:23 param-range", "sgm 1; param a = 3 in 4..2; start A; rule A { }"},
    {"1:14 param-range", "sgm 1; param a = 3 animated; start A; rule A { }"},
    {"2:12 argument-range", "sgm 1; start A; rule B(r in 1m..9m) { sphere(r); }\nrule A { B(0m); }"},
    {"1:38 unit-mismatch", "sgm 1; expect components(solid above 2m) == 1; start A; rule A { sphere(1m); }"},
    {"1:38 value-range", "sgm 1; expect components(solid above -2m3) == 1; start A; rule A { sphere(1m); }"},
    {"1:37 syntax", "sgm 1; expect components(solid above) == 1; start A; rule A { sphere(1m); }"},
    {"2:20 divide-by-zero", "sgm 1; start A;\nrule A { sphere(2m/0); }"},
    // Branches
    {"2:34 value-range", "sgm 1; start A;\nrule A { for s in branch(3, step 0m, turn 9deg) { sphere(1m); } }"},
    {"2:34 value-range", "sgm 1; start A;\nrule A { for s in branch(3, step -2m, turn 9deg) { sphere(1m); } }"},
    {"2:43 value-range", "sgm 1; start A;\nrule A { for s in branch(3, step 1m, turn 91deg) { sphere(1m); } }"},
    {"2:55 value-range",
     "sgm 1; start A;\nrule A { for s in branch(3, step 1m, turn 90deg, fork 20) { sphere(1m); } }"},
    {"2:26 value-range", "sgm 1; start A;\nrule A { for s in branch(4097, step 1cm, turn 9deg) { sphere(1m); } }"},
    {"2:34 unit-mismatch", "sgm 1; start A;\nrule A { for s in branch(3, step 2, turn 9deg) { sphere(1m); } }"},
    {"2:43 unit-mismatch", "sgm 1; start A;\nrule A { for s in branch(3, step 2m, turn 9) { sphere(1m); } }"},
    {"2:26 type-mismatch", "sgm 1; start A;\nrule A { for s in branch(cell, step 2m, turn 9deg) { sphere(1m); } }"},
    {"2:34 stage", "sgm 1; start A;\nrule A { for s in branch(3, step p.x, turn 9deg) { sphere(1m); } }"},
    {"2:10 idle-override", "sgm 1; start A;\noverride \"A/B[2]\" { }\nrule A { B; B; } rule B { sphere(1m); }"},
    {"2:10 parameter-names",
     "sgm 1; start A(1m);\noverride \"A\" { sphere(r); }\nrule A(r) weight 1 { sphere(r); } rule A(s) weight 1 { "
     "box(s); }"},
    {"2:29 argument-name", "sgm 1; start A;\nrule A { for s in branch(3, 2m, turn 9deg) { sphere(1m); } }"},
    {"2:19 argument-count", "sgm 1; start A;\nrule A { for s in branch(3, step 2m) { sphere(1m); } }"},
    {"2:38 argument-name", "sgm 1; start A;\nrule A { for s in branch(3, step 2m, trun 9deg) { sphere(1m); } }"},
    {"2:58 unknown-member", "sgm 1; start A;\nrule A { for s in branch(3, step 2m, turn 9deg) { sphere(s.middle); } }"},
    {"2:17 unknown-member", "sgm 1; start A;\nrule A { sphere(branch(3, step 2m, turn 9deg).along*1m); }"},
    {"2:58 type-mismatch", "sgm 1; start A;\nrule A { for s in branch(3, step 2m, turn 9deg) { sphere(s); } }"},
    {"2:58 unit-mismatch", "sgm 1; start A;\nrule A { for s in branch(3, step 2m, turn 9deg) { sphere(s.depth); } }"},
    {"2:22 stage",
     "sgm 1; start A;\nrule A { for s in if p.x > 0m then branch(3, step 2m, turn 9deg) else branch(4, step 2m, turn "
     "9deg) "
     "{ sphere(1m); } }"},
    {"2:19 type-mismatch", "sgm 1; start A;\nrule A { for s in 3m { sphere(1m); } }"},
    {"1:16 wrong-use", "sgm 1; let a = branch(3, step 2m, turn 9deg); start A; rule A { for s in a { sphere(1m); } }"},
    // Cases of footprints and roofs.
    {"1:44 syntax", "sgm 1; start A; rule A { footprint merge 2 box(1m, 1m) as plan; }"},
    {"1:49 syntax", "sgm 1; start A; rule A { footprint rect(1m, 1m) p; }"},
    {"2:26 value-range", "sgm 1; start A;\nrule A { footprint merge 65 rect(1m, 1m) as plan; extrude 1m of plan; }"},
    {"2:28 value-range", "sgm 1; start A;\nrule A { footprint regular(2, 1m) as plan; extrude 1m of plan; }"},
    {"2:20 argument-count", "sgm 1; start A;\nrule A { footprint rect(2m) as plan; extrude 1m of plan; }"},
    {"2:20 argument-count",
     "sgm 1; start A;\nrule A { footprint polygon((2m, 0m), (0m, 2m)) as plan; extrude 1m of plan; }"},
    {"2:28 argument-name",
     "sgm 1; start A;\nrule A { footprint polygon(a = (2m, 0m), (0m, 2m), (1m, 3m)) as plan; extrude 1m of plan; }"},
    {"2:28 wrong-use",
     "sgm 1; start A;\nrule A { footprint merge 2 polygon((2m, 0m), (0m, 2m), (1m, 3m)) as plan; extrude 1m of plan; "
     "}"},
    {"2:25 unit-mismatch", "sgm 1; start A;\nrule A { footprint rect(2, 3m) as plan; extrude 1m of plan; }"},
    {"2:50 unit-mismatch", "sgm 1; start A;\nrule A { footprint rect(2m, 3m) as plan; extrude 1 of plan; }"},
    {"2:39 type-mismatch", "sgm 1; start A;\nrule A { let plan = 2m; extrude 1m of plan; }"},
    {"2:24 unknown-name", "sgm 1; start A;\nrule A { extrude 1m of plan; }"},
    {"2:15 syntax", "sgm 1; start A;\nrule A { roof shed(30deg); }"},
    {"2:10 argument-count", "sgm 1; start A;\nrule A { roof hip(); }"},
    {"2:19 value-range", "sgm 1; start A;\nrule A { roof hip(81deg); }"},
    {"2:21 value-range", "sgm 1; start A;\nrule A { roof gable(4deg); }"},
    {"2:39 value-range", "sgm 1; start A;\nrule A { roof gable(40deg, overhang = -1m); }"},
    {"2:19 unit-mismatch", "sgm 1; start A;\nrule A { roof hip(0.5); }"},
    {"2:29 unknown-name", "sgm 1; start A;\nrule A { roof hip(30deg) of plan; let plan = 1m; }"},
    {"2:16 wrong-use", "sgm 1; start A;\nrule A { sum { roof hip(30deg); } }"},
    // Structure
    {"1:27 recursive-value", "sgm 1; let a = b; let b = a; start A; rule A { sphere(a); }"},
    {"2:10 unbounded-recursion", "sgm 1; start A;\nrule A { A; }"},
    {"1:1 no-start", "sgm 1; rule A { }"},
    {"1:25 domain", "sgm 1; domain infinite; start A; rule A { }"},
    {"2:31 layer-cycle",
     "sgm 1; domain infinite;\nlayer a cell 8m reach 1m uses b { start A; } layer b cell 8m reach 1m uses a { start A; "
     "} rule A { }"},
    {"3:45 layer-uses",
     "sgm 1; domain infinite; layer a cell 8m reach 4m { start B; }\nlayer b cell 8m reach 4m { start A; }\n"
     "rule A { scatter poisson(1m) probe up 2m of a { sphere(1m); } } rule B { sphere(1m); }"},
    {"1:48 syntax", "sgm 1; start A; rule A { scatter 3 on disc(1m) gap h within 2m sphere(1m); }"},
    {"3:58 syntax",
     "sgm 1; domain infinite; layer a cell 8m reach 4m { start B; } layer b cell 8m reach 8m uses a { start A; }\n"
     "rule B { sphere(1m); }\n"
     "rule A { scatter poisson(1m) probe up 2m of a gap within 2m { sphere(1m); } }"},
    {"3:60 unit-mismatch",
     "sgm 1; domain infinite; layer a cell 8m reach 4m { start B; } layer b cell 8m reach 8m uses a { start A; }\n"
     "rule B { sphere(1m); }\n"
     "rule A { scatter poisson(1m) probe up 2m of a gap h within 2 { sphere(h); } }"},
    {"3:68 unit-mismatch",
     "sgm 1; domain infinite; layer a cell 8m reach 4m { start B; } layer b cell 8m reach 8m uses a { start A; }\n"
     "rule B { sphere(1m); }\n"
     "rule A { scatter poisson(1m) probe up 2m of a gap h within 2m when h > 1 { sphere(1m); } }"},
    // Cellular automata need grammar cells, must not be moved, rotated, scaled or scattered, and have limits.
    {"1:26 wrong-use", "sgm 1; start A; rule A { ca(1m); }"},
    {"1:49 wrong-use", "sgm 1; domain finite box(9m); start A; rule A { ca(1m); }"},
    {"2:25 wrong-use", SGM_LAYER "rule A { at(1m, 0m, 0m) ca(1m); }"},
    {"2:35 wrong-use", SGM_LAYER "rule A { scale(0.5) B; } rule B { ca(1m); }"},
    {"2:35 wrong-use", SGM_LAYER "rule A { repeat 2 rot(y, 90deg) { ca(1m); } }"},
    {"2:32 wrong-use", SGM_LAYER "rule A { scatter poisson(3m) { ca(1m); } }"},
    {"2:13 value-range", SGM_LAYER "rule A { ca(12cm); }"},
    {"2:13 value-range", SGM_LAYER "rule A { ca(9m); }"},
    {"2:22 value-range", SGM_LAYER "rule A { ca(1m, fill 45); }"},
    {"2:24 value-range", SGM_LAYER "rule A { ca(1m, rounds 17); }"},
    {"2:27 value-range", SGM_LAYER "rule A { ca(1m, threshold 5); }"},
    {"2:24 value-range", SGM_LAYER "rule A { ca(1m, radius 5); }"},
    {"2:24 value-range", SGM_LAYER "rule A { ca(1m, rounds 6, radius 3); }"},
    {"2:13 unit-mismatch", SGM_LAYER "rule A { ca(1); }"},
    // Queries
    {"3:13 unknown-name", SGM_NET "rule D when query clear 2m of nett { sphere(1m); }"},
    {"3:13 layer-uses", SGM_NET "rule D when query clear 2m of drip { sphere(1m); }"},
    {"3:25 unit-mismatch", SGM_NET "rule D when query clear 2 of net { sphere(1m); }"},
    {"3:25 type-mismatch", SGM_NET "rule D when query clear cell of net { sphere(1m); }"},
    {"3:25 stage", SGM_NET "rule D when query clear p.x of net { sphere(1m); }"},
    {"3:25 value-range", SGM_NET "rule D when query clear -2m of net { sphere(1m); }"},
    {"3:28 syntax", SGM_NET "rule D when query clear 2m net { sphere(1m); }"},
    {"3:25 syntax", SGM_NET "rule D when query clear { sphere(1m); }"},
    {"3:19 syntax", SGM_NET "rule D when query 2m of net { sphere(1m); }"},
    {"3:31 syntax", SGM_NET "rule D when query clear 2m of { sphere(1m); }"},
    {"3:10 syntax", SGM_NET "rule D { query clear of net; }"},
    {"3:6 reserved-word", SGM_NET "rule query { } rule D { }"},
    {"3:17 type-mismatch", SGM_NET "rule D { sphere(query clear of net); }"},
    {"3:9 wrong-use", SGM_NET "let f = query clear of net; rule D when f { sphere(1m); }"},
    {"3:17 stage",
     SGM_NET "field f(a) = if query clear of net then a else 0m; rule D { displace f(1m) amp 1m { sphere(1m); } }"},
    {"3:23 stage",
     SGM_NET "rule D { field f = if query clear of net then 1m else 0m; displace f amp 1m { sphere(1m); } }"},
    {"3:26 stage",
     SGM_NET "rule D { field f(a) = if query clear of net then a else 0m; displace f(1m) amp 1m { sphere(1m); } }"},
    {"3:13 reach", SGM_NET "rule D when query clear 9m of net { sphere(1m); }"},
    {"3:27 reach", SGM_NET "param r = 1m; rule D when query clear r of net { sphere(1m); }"},
    {"2:13 layer-uses",
     "sgm 1; domain infinite; layer a cell 8m reach 4m { start B; } layer b cell 8m reach 4m { start A; }\n"
     "rule A when query clear of a { sphere(1m); } rule B { sphere(1m); }"},
    {"2:37 layer-uses",
     "sgm 1; domain infinite; layer a cell 8m reach 4m { start B; } layer b cell 8m reach 4m { start A; }\n"
     "override \"b(0, 0, 0)/A\" { sphere(if query inside of a then 1m else 2m); }\n"
     "rule A { sphere(1m); } rule B { sphere(1m); }"},
    {"1:36 unknown-name", "sgm 1; start A; rule A { sphere(if query clear of net then 1m else 2m); }"},
    {"1:38 whole-units", "sgm 1; domain infinite; layer a cell 0.0001m reach 0m { start A; } rule A { }"},
    {"1:47 reach-too-large", "sgm 1; domain infinite; layer a cell 8m reach 80m { start A; } rule A { }"},
    {"1:42 value-range", "sgm 1; domain finite output density edge 0m; start A; rule A { }"},
    {"1:42 value-range", "sgm 1; domain finite output density edge 16001m; start A; rule A { }"},
    {"1:42 unit-mismatch", "sgm 1; domain finite output density edge 20; start A; rule A { }"},
    {"1:42 whole-units", "sgm 1; domain finite output density edge 0.0001m; start A; rule A { }"},
    {"1:59 not-constant", "sgm 1; param wide = 2m; domain finite output density edge 3*wide; start A; rule A { }"},
    {"1:36 syntax", "sgm 1; domain finite output density, edge 2m; start A; rule A { }"},
    {"2:10 reach", SGM_LAYER "rule A { sphere(6m); }"},
    {"2:10 reach-maybe", SGM_LAYER "rule A { sphere(rand(1m, 6m)); }"},
    {"2:10 morph-disjoint", "sgm 1; start A;\nrule A { morph({ sphere(1m); }, { at(9m, 0m, 0m) sphere(1m); }, 0.5); }"},
    // Overrides
    {"1:8 no-start", "sgm 1; override \"A\" { } let b = 2;"},
    {"2:10 syntax", SGM_LAYER "override B { }" SGM_USED_TWICE},
    {"2:11 syntax", SGM_LAYER "override \"\" { }" SGM_USED_TWICE},
    {"2:13 syntax", SGM_LAYER "override \"A//B\" { }" SGM_USED_TWICE},
    {"2:15 syntax", SGM_LAYER "override \"A/B[x]\" { }" SGM_USED_TWICE},
    {"2:16 syntax", SGM_LAYER "override \"A/B[0\" { }" SGM_USED_TWICE},
    {"2:14 syntax", SGM_LAYER "override \"A/B \" { }" SGM_USED_TWICE},
    {"2:17 syntax", SGM_LAYER "override \"a(1, 2)/A\" { }" SGM_USED_TWICE},
    {"2:21 syntax", SGM_LAYER "override \"a(1, 2, 3)A\" { }" SGM_USED_TWICE},
    {"2:11 syntax", SGM_LAYER "override \"A[0]/B\" { }" SGM_USED_TWICE},
    {"2:11 unknown-name", SGM_LAYER "override \"b(0, 0, 0)/A\" { }" SGM_USED_TWICE},
    {"2:12 value-range", SGM_LAYER "override \"a(0, 300000000, 0)/A\" { }" SGM_USED_TWICE},
    {"2:11 unknown-name", SGM_LAYER "override \"B\" { }" SGM_USED_TWICE},
    {"2:22 unknown-name", SGM_LAYER "override \"a(0, 0, 0)/B\" { }" SGM_USED_TWICE},
    {"2:13 unknown-name", SGM_LAYER "override \"A/C[2]\" { }" SGM_USED_TWICE},
    {"2:13 unknown-name", SGM_LAYER "override \"A/x.B\" { }" SGM_USED_TWICE},
    {"2:15 unknown-name", SGM_LAYER "override \"A/B/A\" { }" SGM_USED_TWICE},
    {"2:14 unknown-name", SGM_LAYER "override tag \"tt\" { }" SGM_USED_TWICE},
    {"3:10 duplicate", SGM_LAYER "override \"A/B\" { inner; }\noverride \"A/B\" { }" SGM_USED_TWICE},
    {"3:14 duplicate", SGM_LAYER "override tag \"t\" { }\noverride tag \"t\" { box(1m); }" SGM_USED_TWICE},
    {"2:25 unknown-name", SGM_LAYER "override \"A/B\" { sphere(r); }" SGM_USED_TWICE},
    {"3:10 wrong-use", SGM_LAYER "\nrule A { inner; }"},
    {"2:24 wrong-use", SGM_LAYER "override \"A\" { union { inner; } }\nrule A { cut { sphere(1m); } }"},
    {"2:28 wrong-use",
     SGM_LAYER "override tag \"t\" { union { inner; } }\nrule A { { tag \"t\"; cut { sphere(1m); } } }"},
    {"2:18 idle-cut", SGM_LAYER "override \"A/B\" { cut { sphere(1m); } }" SGM_USED_TWICE},
    {"2:10 reach", SGM_LAYER "override \"A/B\" { sphere(9m); }" SGM_USED_TWICE},
    {"2:10 reach", SGM_LAYER "override \"A/B[1]\" { sphere(9m); }" SGM_USED_TWICE},
    {"2:10 reach-maybe", SGM_LAYER "override \"A/B\" { sphere(rand(1m, 9m)); }\nrule A { B; } rule B { sphere(1m); }"},
    {"2:15 value-range", "sgm 1; start A;\noverride \"main(0, 1, 0)/A\" { }\nrule A { sphere(1m); }"},
    {"2:12 value-range",
     "sgm 1; domain infinite axes xz; layer a cell 8m reach 4m { start A; }\noverride \"a(0, 1, 0)/A\" { }\nrule A { "
     "}"},
    {"2:6 guards", "sgm 1; start A;\nrule A else { }"},
    {"2:43 flat-scope", "sgm 1; start A;\nrule A { size(2m, 2m, 2m) comp { front: { box(scope); } side: box(1m); } }"},
    {"2:48 near-name", "sgm 1; start A;\nrule A { { box(1m); mat brick; } { sphere(1m); mat bric; } }"},
};

}  // namespace

TEST_CASE("every diagnostic stands where the fault is", "[grammar][diagnostics]") {
  for (const Case& c : kCases) {
    const CompileResult result = compileText(c.text);
    INFO(c.text << "\n" << renderDiagnostics(result));
    CHECK(brief(result.diagnostics, true) == c.expected);
    for (const Diagnostic& d : result.diagnostics) CHECK(d.end_column > d.column);
  }
}

namespace {

/// Cases for the codes that are reported only with lowered limits or because of other files.
std::vector<std::pair<std::string, CompileResult>> cappedCases() {
  std::vector<std::pair<std::string, CompileResult>> out;
  auto add = [&](std::string expected, std::string_view text, auto change) {
    MapResolver resolver;
    resolver.files["domain.sgm"] = "sgm 1;\ndomain infinite;";
    resolver.files["text.glb"] = "sgm 1;";
    resolver.files["loop.sgm"] = "sgm 1;\nimport \"loop.sgm\" as me;";
    CompileOptions options;
    options.resolver = &resolver;
    change(options.limits);
    out.emplace_back(std::move(expected), compileGrammar(text, "test.sgm", options));
  };
  auto none = [](CompileLimits&) {};
  add("1:1 too-large", "sgm 1; start A; rule A { }", [](CompileLimits& l) { l.text_bytes = 10; });
  add("1:10 too-large", "sgm 1; a b c", [](CompileLimits& l) { l.nodes = 4; });
  add("1:28 too-deep", "sgm 1; start A; rule A { { { } } }", [](CompileLimits& l) { l.nesting = 3; });
  add("1:8 syntax; 1:11 syntax; 1:14 too-many-errors", "sgm 1; a; b; c; d;",
      [](CompileLimits& l) { l.diagnostics = 2; });
  add("1:15 import-limit", "sgm 1; import \"domain.sgm\" as d; start A; rule A { }",
      [](CompileLimits& l) { l.files = 1; });
  add("1:15 asset", "sgm 1; import \"text.glb\" as d; start A; rule A { }", none);
  add("2:1 import-content", "sgm 1; import \"domain.sgm\" as d; start A; rule A { }", none);
  add("2:8 import-cycle", "sgm 1; import \"loop.sgm\" as d; start A; rule A { }", none);
  return out;
}

}  // namespace

TEST_CASE("caps and imports are reported in place", "[grammar][diagnostics]") {
  for (const auto& [expected, result] : cappedCases()) {
    INFO(renderDiagnostics(result));
    CHECK(brief(result.diagnostics) == expected);
  }
}

TEST_CASE("no diagnostic code is without a test", "[grammar][diagnostics]") {
  std::ifstream file(SGM_SOURCE_DIR "/runtime/grammar/text/codes.h");
  std::stringstream text;
  text << file.rdbuf();
  std::string tested;
  for (const Case& c : kCases) tested += std::string(" ") + c.expected + " ";
  for (const auto& [expected, result] : cappedCases()) tested += " " + expected + " ";
  const std::string source = text.str();
  const std::regex code("= \"([a-z-]+)\"");
  int count = 0;
  for (std::sregex_iterator i(source.begin(), source.end(), code), end; i != end; ++i, ++count) {
    INFO((*i)[1].str());
    CHECK(std::regex_search(tested, std::regex(" " + (*i)[1].str() + "[ ;]")));
  }
  CHECK(count > 40);
}

TEST_CASE("one run reports several faults", "[grammar][diagnostics]") {
  const CompileResult syntax =
      compileText("sgm 1;\nstart A\nrule A { sphere(1m) }\nrule B { box(1m; sphere(2m); }\nlet = 3;\n");
  INFO(renderDiagnostics(syntax));
  CHECK(brief(syntax.diagnostics) == "2:8 syntax; 3:21 syntax; 4:16 syntax; 5:5 syntax");
  const CompileResult meaning = compileText(
      "sgm 1;\nstart A;\nparam a = 1m in 2m..3m;\nrule A { sphere(1); bx(2m); rot(y, 3m) sphere(1m + 2deg); }\n");
  INFO(renderDiagnostics(meaning));
  CHECK(brief(meaning.diagnostics) ==
        "3:11 param-range; 4:17 unit-mismatch; 4:21 unknown-name; 4:36 unit-mismatch; 4:47 unit-mismatch");
}

TEST_CASE("hints name what to write", "[grammar][diagnostics]") {
  auto hintOf = [](std::string_view text) {
    const CompileResult result = compileText(text);
    REQUIRE_FALSE(result.diagnostics.empty());
    return result.diagnostics[0].hint;
  };
  CHECK(hintOf("sgm 1; start A; rule A { shpere(2m); }") == "did you mean `sphere`?");
  CHECK(hintOf("sgm 1; start A; rule A { sphere(5); }") == "write `5m`");
  CHECK(hintOf("sgm 1; start A; rule A { rot(y, 90) sphere(5m); }") == "write `90deg`");
  CHECK(hintOf("sgm 1; start A; rule A { sphere(5mn); }") == "did you mean `m`?");
  CHECK(hintOf("sgm 1; start A; rule A { sphere(5m) && box(1m); }") == "write `and`");
  const auto branchHint = [&](const std::string& arguments, const std::string& body) {
    return hintOf("sgm 1; start A; rule A { for s in branch(" + arguments + ") { " + body + " } }");
  };
  CHECK(branchHint("3, step 2m, turn 9deg, fork 20", "sphere(1m);") == "such as fork 20%");
  CHECK(branchHint("3, step 2, turn 9deg", "sphere(1m);") == "write `2m`");
  CHECK(branchHint("3, step 2m, turn 9deg", "at(s.form) sphere(1m);") == "did you mean `from`?");
  CHECK(branchHint("3, step 2m, turn 9deg", "at(s.middle) sphere(1m);") == "it has from, to, along, depth");
  CHECK(hintOf("sgm 1; start A; rule A { sphere(cell.siez.x); }") == "did you mean `size`?");
  CHECK(hintOf("sgm 1; start A; rule A { sphere(cell.links); }") == "write `links()` with its arguments");
  const auto pathHint = [&](const std::string& path) {
    return hintOf("sgm 1; start A; override " + path +
                  " { } rule A { Hall; Passage; } rule Hall { tag \"hall\"; } rule " + "Passage { }");
  };
  CHECK(pathHint("\"A/Hal[2]\"") == "did you mean `Hall`?");
  CHECK(pathHint("\"A/Shaft\"") == "it derives Hall, Passage");
  CHECK(pathHint("\"Hall\"") == "it derives A");
  CHECK(pathHint("\"mian(0, 0, 0)/A\"") == "did you mean `main`?");
  CHECK(pathHint("tag \"hal\"") == "did you mean `hall`?");
  CHECK(pathHint("\"A/Hall[a]\"") == "such as \"net(0, 0, -1)/Node/Chamber[0]\", as messages print it");
  CHECK(hintOf("sgm 1; start A; rule A { scater 3 on disc(1m) { sphere(1m); } }") == "did you mean `scatter`?");
}

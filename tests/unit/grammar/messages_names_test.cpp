// Tests messages about names and arguments, word for word.

#include "messages.h"

using namespace sgm::test;

namespace {

const MessageCase kNames[] = {
    {"2:10 unknown-name: unknown name `shpere` | did you mean `sphere`?", "shpere(2m);"},
    {"2:10 unknown-name: unknown name `Vault` | add `rule Vault { ... }`", "Vault(2m);"},
    {"2:17 unknown-name: unknown name `radius` | add `let radius = ...;`, or `param radius = ...;`", "sphere(radius);"},
    {"2:17 unknown-name: unknown name `hight` | add `let hight(...) = ...;`", "sphere(hight(2m));"},
    {"2:17 unknown-member: a cell has no `q` | it has x, y, z, size, center, faces", "sphere(cell.q);"},
    {"2:17 unknown-member: a cell has no `siez` | did you mean `size`?", "sphere(cell.siez.x);"},
    {"2:17 unknown-member: a length has no `q` | only vectors, cells, faces and segments have parts",
     "sphere((2m).q);"},
    {"2:17 unknown-member: a point has no `q` | it has x, y, z", "sphere((1m, 2m, 3m).q*1m);"},
    {"2:17 unknown-member: a cell has no `links` | write `links()` with its arguments", "sphere(cell.links);"},
    {"2:17 unknown-member: a cell has no `faces()` | write it without parentheses", "sphere(cell.faces());"},
    {"2:17 unknown-member: a cell has no `middle()` | it has point() and links()", "sphere(cell.middle());"},
    {"2:17 unknown-member: a length has no `point()` | only cells and faces have functions of their own",
     "sphere((2m).point());"},
    {"2:41 unknown-member: a face has no `links()` | it has point()", "for f in cell.links() { sphere(f.links()); }"},
    {"2:41 unknown-member: a face has no `middle` | it has other, axis, center",
     "for f in cell.links() { sphere(f.middle); }"},
    {"2:19 unknown-member: a list of faces has no `other` | go through the list: for s in ...",
     "for f in cell.links().other { }"},
    {"2:10 argument-count: `sphere` needs `r` | it is `sphere(r)`", "sphere();"},
    {"2:10 argument-count: `cylinder` needs `h` | it is `cylinder(r, h)`", "cylinder(2m);"},
    {"2:21 argument-count: `sphere` takes 1 argument, not 2 | it is `sphere(r)`", "sphere(2m, 3m);"},
    {"2:17 argument-name: `sphere` has no parameter `size` | it is `sphere(r)`", "sphere(size 2m);"},
    {"2:23 argument-name: `r` is given twice | it is `sphere(r)`", "sphere(r 2m, r 2m);"},
    {"2:25 argument-name: an argument without a name follows an argument with a name | it is `cylinder(r, h)`",
     "cylinder(r 2m, 3m);"},
    {"2:29 argument-name: this argument of `branch` needs its name | write `branch(step ...)`",
     "for s in branch(3, 2m, turn 9deg) { }"},
    {"2:19 argument-count: `branch` needs `turn` | it is `branch(n, step, turn, fork)`",
     "for s in branch(3, step 2m) { }"},
    {"2:13 argument-name: `at` has no parameter `w` | it is `at(x, y, z)`", "at(w 2m) sphere(1m);"},
    {"2:17 argument-name: `x` of `at` is given twice | it is `at(x, y, z)`", "at(1m, x 2m, y 3m) sphere(1m);"},
    {"2:10 argument-count: `size` needs an argument | it is `size(x, y, z)`", "size() box(scope);"},
    {"2:25 argument-count: `at` takes at most 3 arguments | it is `at(x, y, z)`", "at(1m, 2m, 3m, 4m) sphere(1m);"},
    {"2:10 argument-count: `rot` needs 2 arguments | it is `rot(axis, angle)`", "rot(y) sphere(1m);"},
    {"2:10 argument-count: `scale` needs an argument | it is `scale(factor)`", "scale() sphere(1m);"},
    {"2:10 argument-count: `scale` takes one factor | a distance cannot be stretched unevenly; give the shape its "
     "sizes instead",
     "scale(1, 2) sphere(1m);"},
    {"2:17 type-mismatch: the axis of `mirror` is x, y or z | such as mirror(x)", "mirror(w) sphere(1m);"},
    {"2:14 type-mismatch: the axis of `rot` is x, y, z or a vector | such as rot(y, 30deg)",
     "rot(2, 9deg) sphere(1m);"},
    {"2:35 argument-name: `shell` has no parameter `down` | it is `shell(r, up)`",
     "scatter 3 on shell(r 2m, down 3) sphere(1m);"},
    {"2:10 argument-count: `disc` needs an argument | it is `disc(r)`", "scatter 3 on disc() sphere(1m);"},
    {"2:10 argument-count: `box` needs 3 arguments | it is `box(x, y, z)`", "scatter 3 on box(1m, 2m) sphere(1m);"},
    {"2:10 argument-count: `halfspace` takes either `below` or `above` | such as halfspace(below 2m)", "halfspace();"},
    {"2:10 argument-count: `halfspace` takes either `below` or `above` | such as halfspace(below 2m)",
     "halfspace(below 2m, above 3m);"},
    {"2:16 argument-name: the arguments of `prism` have no names | it is `prism(h, corner, corner, corner, ...)`",
     "prism(h 2m, (0m, 0m), (1m, 0m), (0m, 1m));"},
    {"2:10 argument-count: `prism` needs `corner` | it is `prism(h, corner, corner, corner, ...)`",
     "prism(2m, (0m, 0m), (1m, 0m));"},
    {"2:10 argument-count: a prism has 3 to 64 corners | build it from several prisms",
     "prism(2m, (0m, 0m), (0m, 0m), (0m, 0m), (0m, 0m), (0m, 0m), (0m, 0m), (0m, 0m), (0m, 0m), (0m, 0m), (0m, 0m), "
     "(0m, 0m), (0m, 0m), (0m, 0m), (0m, 0m), (0m, 0m), (0m, 0m), (0m, 0m), (0m, 0m), (0m, 0m), (0m, 0m), (0m, 0m), "
     "(0m, 0m), (0m, 0m), (0m, 0m), (0m, 0m), (0m, 0m), (0m, 0m), (0m, 0m), (0m, 0m), (0m, 0m), (0m, 0m), (0m, 0m), "
     "(0m, 0m), (0m, 0m), (0m, 0m), (0m, 0m), (0m, 0m), (0m, 0m), (0m, 0m), (0m, 0m), (0m, 0m), (0m, 0m), (0m, 0m), "
     "(0m, 0m), (0m, 0m), (0m, 0m), (0m, 0m), (0m, 0m), (0m, 0m), (0m, 0m), (0m, 0m), (0m, 0m), (0m, 0m), (0m, 0m), "
     "(0m, 0m), (0m, 0m), (0m, 0m), (0m, 0m), (0m, 0m), (0m, 0m), (0m, 0m), (0m, 0m), (0m, 0m), (0m, 0m), (0m, 0m));"},
    {"2:22 duplicate: `a` is declared twice in this rule | rename one of them", "let a = 2m; let a = 3m;"},
    {"2:10 shadows-builtin: `p` is a value of the language | choose another name, such as `p_`", "let p = 2m;"},
    {"2:10 shadows-builtin: `cell` is a value of the language | choose another name, such as `cell_`",
     "for cell in 0..3 { }"},
    {"2:10 wrong-use: `B` is not a shape | write a shape such as sphere(2m), or a rule", "A.B();"},
    {"2:10 unknown-name: nothing is imported as `Tunnel` here | add `import \"Tunnel.sgm\" as Tunnel;`",
     "Tunnel.B(2m);"},
    {"2:10 unknown-name: nothing is imported as `cave` here | add `import \"std/cave.sgm\" as cave;`",
     "cave.Hall(3m);"},
    {"2:19 unknown-name: nothing is imported as `noise` here | add `import \"std/noise.sgm\" as noise;`",
     "displace noise.fbm(period 1m, amp 1m) { sphere(2m); }"},
    {"2:14 unknown-name: the axis of `rot` is x, y, z or a vector, and `w` is none of these | such as rot(y, 30deg)",
     "rot(w, 30deg) sphere(1m);"},
    {"2:10 wrong-use: `point` is not a shape | write a shape such as sphere(2m), or a rule", "cell.point();"},
    {"2:10 wrong-use: `sqrt` gives a value and is not a shape | write a shape such as sphere(2m), or a rule",
     "sqrt(2);"},
    {"2:17 wrong-use: `A` is a shape and has no value | write it as a statement of its own", "sphere(A);"},
    {"2:17 wrong-use: `sphere` is a shape and has no value | write it as a statement of its own",
     "sphere(sphere(2m)); "},
    {"2:17 wrong-use: `box` is a shape and has no value | write it as a statement of its own", "sphere(box*2m);"},
    {"2:17 wrong-use: `sqrt` is a function and needs arguments | write `sqrt(...)`", "sphere(sqrt);"},
    {"2:17 wrong-use: `max` is a function and needs arguments | write `max(...)`", "sphere(max*2m);"},
    {"2:22 wrong-use: `max` is a function and needs arguments | write `max(...)`", "sphere(2m + max);"},
    {"2:17 unknown-name: unknown name `p` | add `let p(...) = ...;`", "sphere(p(2m));"},
    {"2:337 too-large: the call has more than 80 arguments | split them among several shapes",
     "sphere(1m, 1m, 1m, 1m, 1m, 1m, 1m, 1m, 1m, 1m, 1m, 1m, 1m, 1m, 1m, 1m, 1m, 1m, 1m, 1m, 1m, 1m, 1m, 1m, 1m, 1m, "
     "1m, 1m, 1m, 1m, 1m, 1m, 1m, 1m, 1m, 1m, 1m, 1m, 1m, 1m, 1m, 1m, 1m, 1m, 1m, 1m, 1m, 1m, 1m, 1m, 1m, 1m, 1m, 1m, "
     "1m, 1m, 1m, 1m, 1m, 1m, 1m, 1m, 1m, 1m, 1m, 1m, 1m, 1m, 1m, 1m, 1m, 1m, 1m, 1m, 1m, 1m, 1m, 1m, 1m, 1m, 1m, "
     "1m);"},
};

const MessageCase kDeclarations[] = {
    {"1:12 shadows-builtin: `sphere` is built in and cannot be declared again | choose another name, such as `sphere_`",
     "sgm 1; let sphere = 2m; start A; rule A { }"},
    {"1:12 shadows-builtin: `u` is a value of the language | choose another name, such as `u_`",
     "sgm 1; let u = 2m; start A; rule A { }"},
    {"1:23 duplicate: `a` is declared twice | rename one of them | note: the first is at test.sgm:1:12",
     "sgm 1; let a = 1; let a = 2; start A; rule A { }"},
    {"1:27 shadows-builtin: `p` is a value of the language | choose another name, such as `p_`",
     "sgm 1; start A(1); rule A(p) { }"},
    {"1:28 not-constant: a default is made of numbers alone | such as r = 2m or r = 3*0.5m",
     "sgm 1; start A; rule A(r = cell) { }"},
    {"3:1 argument-count: `A` has 1 parameter in its first head and 2 in this one | the heads of a rule have the same "
     "parameters | note: the first is at test.sgm:2:1",
     "sgm 1; start A(1);\nrule A(r) weight 1 { }\nrule A(r, s) weight 1 { }"},
    {"1:32 argument-name: this is `wide` minus something | to give `wide` a value below 0, write `wide = -...`",
     "sgm 1; start A; rule A { B(3m, wide -2m); } rule B(r, wide = 2m) { box(r + wide); }"},
    {"1:22 guards: `A` has an `else` and no `when` | add a head with `when`, or leave `else` out",
     "sgm 1; start A; rule A else { }"},
    {"1:33 warning unused-rule: nothing derives `B` | call it in a rule, or remove it",
     "sgm 1; start A; rule A { } rule B { }"},
    {"1:14 unknown-name: unknown name `B` | add `rule B { ... }`", "sgm 1; start B; rule A { }"},
    {"1:47 wrong-use: `a` is a parameter and takes no arguments | write `a`",
     "sgm 1; param a = 2m; start A; rule A { sphere(a(3)); }"},
    {"1:40 wrong-use: `a` gives a value and is not a shape | write a shape such as sphere(2m), or a rule",
     "sgm 1; param a = 2m; start A; rule A { a; }"},
    {"1:36 wrong-use: `B` is a shape and has no value | write it as a statement of its own",
     "sgm 1; start A; rule A { B; sphere(B()); } rule B { }"},
    {"1:66 unknown-name: `rock` has no `fmb` | did you mean `fbm`?",
     "sgm 1; import \"std/rock.sgm\" as rock; start A; rule A { displace rock.fmb(1m, 1m) { } }"},
    {"1:68 unknown-name: `noise` has no `granite` | it has value, fbm, billow, ridged, swirl, part",
     "sgm 1; import \"std/noise.sgm\" as noise; start A; rule A { displace noise.granite(1m) { } }"},
    {"1:64 wrong-use: `rock` is an import | name something of it: rock.name",
     "sgm 1; import \"std/rock.sgm\" as rock; start A; rule A { sphere(rock); }"},
    {"1:57 wrong-use: `rock` is an import | name something of it: rock.name",
     "sgm 1; import \"std/rock.sgm\" as rock; start A; rule A { rock; }"},
    {"1:15 import-missing: the standard library has no `std/rokc.sgm` | did you mean `std/rock.sgm`?",
     "sgm 1; import \"std/rokc.sgm\" as a; start A; rule A { }"},
    {"1:15 import-missing: the standard library has no `std/marble.sgm` | it has std/cave.sgm, std/cloud.sgm, "
     "std/facade.sgm, std/fort.sgm, std/gothic.sgm, std/karst.sgm, std/mine.sgm, std/noise.sgm, std/plant.sgm, "
     "std/rock.sgm, std/street.sgm, std/timber.sgm",
     "sgm 1; import \"std/marble.sgm\" as a; start A; rule A { }"},
    {"1:15 import-missing: cannot import `a.sgm`: there is no folder to read from | only the standard library can be "
     "imported here: \"std/rock.sgm\"",
     "sgm 1; import \"a.sgm\" as a; start A; rule A { }"},
    {"1:15 import-path: the import has no path | imports are relative: \"std/rock.sgm\", \"parts/arch.sgm\"",
     "sgm 1; import \"\" as a;"},
    {"1:15 import-path: an import is a relative path with forward slashes | imports are relative: \"std/rock.sgm\", "
     "\"parts/arch.sgm\"",
     "sgm 1; import \"/a.sgm\" as a;"},
    {"1:15 import-path: an import may not leave the folder of the root file | imports are relative: \"std/rock.sgm\", "
     "\"parts/arch.sgm\"",
     "sgm 1; import \"../a.sgm\" as a;"},
    {"1:15 import-path: the path has a character that is not allowed | imports are relative: \"std/rock.sgm\", "
     "\"parts/arch.sgm\"",
     "sgm 1; import \"a?.sgm\" as a;"},
    {"1:15 import-path: a part of the path is not a name | imports are relative: \"std/rock.sgm\", \"parts/arch.sgm\"",
     "sgm 1; import \"a//b.sgm\" as a;"},
    {"1:15 import-path: an import ends in .sgm, or an asset in .glb | imports are relative: \"std/rock.sgm\", "
     "\"parts/arch.sgm\"",
     "sgm 1; import \"a.txt\" as a;"},
    {"1:15 import-path: the path is too long | imports are relative: \"std/rock.sgm\", \"parts/arch.sgm\"",
     "sgm 1; import "
     "\"aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa"
     "aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa"
     "aaaaaaaaaaaaaaaaaaaaaaaaaaaa.sgm\" as a;"},
    {"1:16 rand-key: outside of rules `rand` needs a key | a cell, a face, a segment or a number: rand(c, a, b)",
     "sgm 1; let a = rand(1, 2); start A; rule A { sphere(a*1m); }"},
    {"1:16 rand-key: outside of rules `chance` needs a key | a cell, a face, a segment or a number: chance(c, p)",
     "sgm 1; let a = chance(0.5); start A; rule A { }"},
    {"1:16 wrong-use: `branch` is known inside rules only | it draws by its place in the derivation",
     "sgm 1; let a = branch(3, step 2m, turn 9deg); start A; rule A { for s in a { } }"},
    {"1:16 wrong-use: `cell` is known inside rules only | pass it to a let as an argument",
     "sgm 1; let a = cell; start A; rule A { }"},
    {"1:27 recursive-value: `a` is defined by itself | only rules may call themselves",
     "sgm 1; let a = b; let b = a; start A; rule A { sphere(a); }"},
    {"1:26 unbounded-recursion: `A` may call itself without end | bound it: `rule A ... depth 8 -> Leaf`, `minsize 1m "
     "-> Leaf`, or a guard `when n > 0` with n - 1",
     "sgm 1; start A; rule A { A; }"},
    {"1:40 unbounded-recursion: `B` and `A` may call each other without end | bound it: `rule A ... depth 8 -> Leaf` | "
     "note: only `depth` bounds rules that call each other",
     "sgm 1; start A; rule A { B; } rule B { A; }"},
    {"1:35 unbounded-recursion: `A` may call itself without end | bound it: `rule A ... depth 8 -> Leaf`, `minsize 1m "
     "-> Leaf`, or a guard `when n > 0` with n - 1 | note: the call after `->` must not lead back",
     "sgm 1; start A; rule A depth 4 -> A { A; }"},
    {"1:109 unknown-name: there is no plan `plan` here | pass the plan of another rule as an argument: `rule "
     "Name(plan) { ... }` and `Name(plan);`",
     "sgm 1; start A; rule A { footprint rect(2m, 3m) as plan; extrude 1m of plan; B; } rule B { roof flat(1m) of "
     "plan; }"},
    {"1:58 unbounded-recursion: `A` may call itself without end | `minsize` ends it where `r` becomes smaller with "
     "each "
     "call, such as 0.7*r; else bound it by `depth 8 -> Leaf`",
     "sgm 1; start A(2m); rule A(r) minsize 1m -> sphere(1m) { A(r); }"},
    {"1:51 unbounded-recursion: `A` may call itself without end | `minsize` ends it where the scope becomes smaller "
     "with each call: put it into a part of a split, or after `size` or `scale(0.7)`; else bound it by `depth 8 -> "
     "Leaf`",
     "sgm 1; start A; rule A minsize 1m -> sphere(1m) { A; }"},
};

}  // namespace

TEST_CASE("messages: names and arguments in rules", "[grammar][messages]") {
  checkMessages(kNames, {"sgm 1; start A;\nrule A { ", " }"});
}

TEST_CASE("messages: names at the top of the file", "[grammar][messages]") { checkMessages(kDeclarations); }

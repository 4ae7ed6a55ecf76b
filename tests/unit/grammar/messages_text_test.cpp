// Tests messages about wrong texts and declarations, word for word.

#include "messages.h"

using namespace sgm::test;

namespace {

const MessageCase kTexts[] = {
    {"2:17 bad-character: this character has no place here | names consist of the letters a to z, digits and `_`",
     "sgm 1; start A;\nrule A { sphere($); }"},
    {"2:20 bad-character: this character has no place here | write `and`",
     "sgm 1; start A;\nrule A { sphere(2m && 3m); }"},
    {"2:20 bad-character: this character has no place here | write `or`",
     "sgm 1; start A;\nrule A { sphere(2m | 3m); }"},
    {"2:13 bad-character: this character has no place here | write `not`", "sgm 1; start A;\nrule A when !b { }"},
    {"1:8 bad-character: this character has no place here | comments start with //", "sgm 1; # old"},
    {"1:15 bad-character: this character has no place here | texts stand in double quotes\n1:21 bad-character: this "
     "character has no place here | texts stand in double quotes",
     "sgm 1; import 'a.sgm' as a;"},
    {"1:20 bad-character: this byte is not UTF-8 | save the file as UTF-8",
     "sgm 1; start A; // \xFF"
     "\nrule A { }"},
    {"2:14 bad-text: this text has no closing quote | close it with \"",
     "sgm 1; start A;\nrule A { tag \"unclosed; }\n"},
    {"2:14 bad-text: a backslash stands before a quote or a backslash only | write `\\\\` for a backslash",
     "sgm 1; start A;\nrule A { tag \"a\\n\"; }"},
    {"2:14 bad-text: a text has no control characters | write a space", "sgm 1; start A;\nrule A { tag \"a\tb\"; }"},
    {"2:17 bad-number: a number starts with a digit | write 0.5m", "sgm 1; start A;\nrule A { sphere(.5m); }"},
    {"2:17 number-range: this number is too large | the world ends at 2097 km",
     "sgm 1; start A;\nrule A { sphere(3000km); }"},
    {"2:17 number-range: this number is too large | write at most 1e9", "sgm 1; start A;\nrule A { sphere(1e300); }"},
    {"1:16 number-range: this number is too large | write at most 1e18", "sgm 1; let a = 2e12km3;"},
    {"2:17 unknown-unit: unknown unit `furlongs` | units are m, cm, mm, km, m2, m3, deg, rad and %",
     "sgm 1; start A;\nrule A { sphere(3furlongs); }"},
    {"2:17 unknown-unit: unknown unit `mn` | did you mean `m`?", "sgm 1; start A;\nrule A { sphere(5mn); }"},
    {"1:14 unknown-unit: unknown unit of length `ft` | units are m, cm, mm and km",
     "sgm 1; units ft; start A; rule A { }"},
    {"1:14 syntax: expected a unit of length, found `3`", "sgm 1; units 3;"},
    {"1:1 version: a grammar starts with the version of its language | write `sgm 1;` first", "start A; rule A { }"},
    {"1:5 version: this is version 1 of the language, not 2 | write `sgm 1;`", "sgm 2; start A;"},
    {"1:4 syntax: expected the version number 1, found `;`", "sgm; start A; rule A { }"},
    {"1:15 syntax: expected `;`, found the end of the text", "sgm 1; start A"},
    {"2:1 syntax: expected a declaration, found `sphere` | shapes stand in rules: rule Name { ... }",
     "sgm 1;\nsphere(2m);"},
    {"2:1 syntax: expected a declaration, found `strat` | did you mean `start`?", "sgm 1;\nstrat A;"},
    {"1:28 syntax: this `}` has no `{` | remove it", "sgm 1; start A; rule A { } }"},
    {"1:24 syntax: this block is not closed | a `}` is missing", "sgm 1; start A; rule A { sphere(2m);"},
    {"1:24 syntax: this block is not closed | a `}` is missing\n2:1 syntax: expected a statement, found `rule` | close "
     "the block before it with `}`",
     "sgm 1; start A; rule A { sphere(2m);\nrule B { }"},
    {"1:8 not-available: `set` is not available in sgm 1 of this version | the word is reserved for a later version",
     "sgm 1; set x { }"},
    {"1:22 reserved-word: `repeat` is a word of the language and cannot be the name of a rule | choose another name, "
     "such as `repeat_`",
     "sgm 1; start A; rule repeat { } rule A { }"},
    {"1:15 syntax: expected the path of a file in quotes, found `3`", "sgm 1; import 3 as a;"},
    {"1:23 syntax: expected `as`, found `a`", "sgm 1; import \"a.sgm\" a;"},
    {"1:26 syntax: expected the name of an import, found `3`", "sgm 1; import \"a.sgm\" as 3;"},
    {"1:14 syntax: expected the name of a parameter, found `3`", "sgm 1; param 3 = 2;"},
    {"1:20 syntax: expected `;`, found `3`", "sgm 1; param a = 2 3;"},
    {"1:24 syntax: expected `..`, found `;`", "sgm 1; param a = 2 in 3;"},
    {"1:12 syntax: expected a name, found `3`", "sgm 1; let 3 = 2;"},
    {"1:14 syntax: expected the name of a field, found `3`", "sgm 1; field 3 = 2;"},
    {"1:14 syntax: expected the name of a rule, found `3`", "sgm 1; start 3;"},
    {"1:13 syntax: expected the name of a rule, found `3`", "sgm 1; rule 3 { }"},
    {"1:15 syntax: expected the name of a parameter, found `3`", "sgm 1; rule A(3) { }"},
    {"1:14 syntax: expected `{`, or `when`, `else`, `weight`, `depth`, `minsize` or `lod`, found `;`",
     "sgm 1; rule A;"},
    {"1:19 syntax: expected a declaration, found `;`\n1:30 duplicate: `units` is declared twice | remove one of them",
     "sgm 1; rule A { } ; units m; units m;"},
    {"1:16 duplicate: `seed` is declared twice | remove one of them", "sgm 1; seed 1; seed 2;"},
    {"1:17 duplicate: `start` is declared twice | call both rules in one, and start that",
     "sgm 1; start A; start A; rule A { }"},
    {"1:23 duplicate: `domain` is declared twice | remove one of them",
     "sgm 1; domain finite; domain finite; start A; rule A { }"},
    {"1:64 too-large: this has more than 16 parameters | a vector holds three numbers in one",
     "sgm 1; rule A(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, q1, q2) { }"},
};

const MessageCase kHeads[] = {
    {"2:19 duplicate: a head has one `when`, or `else` | join conditions with `and`; `else` stands in a head of its "
     "own",
     "rule B when 1 < 2 when 2 < 3 { }"},
    {"2:19 duplicate: a head has one `when`, or `else` | join conditions with `and`; `else` stands in a head of its "
     "own",
     "rule B when 1 < 2 else { }"},
    {"2:17 duplicate: this head has a second `weight` | remove one of them", "rule B weight 1 weight 2 { }"},
    {"2:16 syntax: expected `->` and what to derive instead, found `{`", "rule B depth 4 { }"},
    {"2:19 syntax: expected a shape or a rule to derive instead, found `{`", "rule B depth 4 -> { }"},
    {"2:19 syntax: expected `->` and what to derive instead, found `{`", "rule B minsize 4m { }"},
    {"2:22 syntax: expected a shape or a rule to derive instead, found `3`", "rule B minsize 4m -> 3 { }"},
    {"2:12 syntax: lod takes the edge of the smallest cells that use this head | such as `lod 2m`",
     "rule B lod far { }"},
    {"2:11 syntax: expected `:`, found `{`", "morphic B { }"},
    {"2:27 syntax: expected a shape or a rule, found `3`", "morphic B : sphere(1m) -> 3 by 0.5;"},
    {"2:35 syntax: expected `by`, found `at`", "morphic B : sphere(1m) -> box(1m) at 0.5;"},
    {"2:9 duplicate: `A` is declared twice | a morphic rule has one head and no alternatives",
     "morphic A : sphere(1m) -> box(1m) by 0.5;"},
    {"2:10 syntax: expected a derivation path in quotes, or `tag`, found `{`", "override { }"},
    {"2:14 syntax: expected a tag in quotes, found `{`", "override tag { }"},
    {"2:7 syntax: expected `finite` or `infinite`, found `;`", "domain;"},
    {"2:8 syntax: expected `finite` or `infinite`, found `big`", "domain big;"},
    {"2:21 syntax: expected axes such as xz | write the axes along which there are cells", "domain infinite axes;"},
    {"2:22 syntax: expected axes such as xz | write the axes along which there are cells", "domain infinite axes xx;"},
    {"2:15 domain: a finite domain has no axes | write `domain infinite axes ...`", "domain finite axes xz;"},
    {"2:21 duplicate: the domain has a second `solid` or `empty` | remove one of them", "domain finite solid empty;"},
    {"2:21 duplicate: the domain has a second `solid` or `empty` | remove one of them", "domain finite empty solid;"},
    {"2:17 domain: an infinite domain has no box | write `domain finite box(...)`", "domain infinite box(9m);"},
    {"2:23 duplicate: the domain has a second `box` | remove one of them", "domain finite box(9m) box(9m);"},
    {"2:15 syntax: expected `solid`, `empty`, `axes`, `box`, `output` or `;`, found `tall`", "domain finite tall;"},
    {"2:21 syntax: expected `density`, found `;`", "domain finite output;"},
    {"2:7 syntax: expected the name of a layer, found `3`", "layer 3 cell 8m;"},
    {"2:8 syntax: expected `cell`, found `;`", "layer b;"},
    {"2:16 syntax: expected `reach`, found `;`", "layer b cell 8m;"},
    {"2:25 syntax: expected `{`, found `;`", "layer b cell 8m reach 4m;"},
    {"2:31 syntax: expected the name of a layer, found `3`", "layer b cell 8m reach 4m uses 3 { start A; }"},
    {"2:28 syntax: expected `start`, found `A`\n2:31 syntax: this `}` has no `{` | remove it",
     "layer b cell 8m reach 4m { A; }"},
    {"2:34 syntax: expected the name of a rule, found `3`\n2:37 syntax: this `}` has no `{` | remove it",
     "layer b cell 8m reach 4m { start 3; }"},
    {"2:8 unknown-name: unknown measure `watertihgt` | did you mean `watertight`?", "expect watertihgt;"},
    {"2:8 unknown-name: unknown measure `beauty` | measures are watertight, components, volume, area, triangles, genus "
     "and anchors",
     "expect beauty;"},
    {"2:19 syntax: expected `air` or `solid`, found `water`", "expect components(water) == 1;"},
    {"2:30 syntax: expected an expression, found `)`", "expect components(solid above) == 1;"},
    {"2:33 duplicate: this stands here twice | remove one of them", "expect volume in 1m3..2m3 per A per A;"},
    {"2:21 syntax: expected `..`, found `;`", "expect volume in 1m3;"},
    {"2:32 syntax: expected `(`, found `;`", "expect components == 1 in block;"},
    {"2:33 value-range: a block has 1 to 64 cells along an edge | such as block(8)",
     "expect components == 1 in block(65);"},
    {"2:28 syntax: expected the name of a rule, found `3`", "expect components == 1 per 3;"},
};

}  // namespace

TEST_CASE("messages: what is no text of the language", "[grammar][messages]") { checkMessages(kTexts); }

TEST_CASE("messages: what a declaration lacks or has twice", "[grammar][messages]") {
  checkMessages(kHeads, {"sgm 1; start A; rule A { sphere(1m); }\n", ""});
}

// Tests, word for word, the messages for texts that contain syntax of other programming languages.

#include "messages.h"

using namespace sgm::test;

namespace {

const MessageCase kHabits[] = {
    {"2:10 syntax: `translate` does not start a statement | write `at`",
     "rule A { translate(1m, 1m, 1m) sphere(1m); }"},
    {"2:10 syntax: `rotate` does not start a statement | write `rot`", "rule A { rotate(y, 30deg) { sphere(1m); } }"},
    {"2:10 syntax: `difference` does not start a statement | write `cut`", "rule A { difference { sphere(1m); } }"},
    {"2:10 unknown-name: unknown name `Cube` | write `box`", "rule A { Cube(1m); }"},
    {"2:10 unknown-name: unknown name `cone` | write `truncone`", "rule A { cone(3m); }"},
    {"2:10 unknown-name: unknown name `noise` | write `fractal`", "rule A { noise(1m); }"},
    {"2:21 syntax: expected `;`, found `at` | a transform stands in front of its shape: `at(1m, 0m, 0m) sphere(2m);`",
     "rule A { sphere(3m) at(1m, 0m, 0m); }"},
    {"2:10 syntax: expected a statement, found `if` | give a rule alternatives: `rule A when ... { }` and `rule A else "
     "{ }`, or `weight`",
     "rule A { if chance(50%) { sphere(1m); } }"},
    {"2:19 syntax: expected `)` or `,`, found `m` | write the unit against its number, `3m`",
     "rule A { sphere(3 m); }"},
    {"2:24 syntax: expected `)` or `,`, found `..` | a range such as 1m..2m stands after `in`; a function takes both "
     "ends, `rand(1m, 2m)`",
     "rule A { sphere(rand(1m..2m)); }"},
    {"2:27 syntax: expected a text in quotes, found `fire` | write it in quotes, \"fire\"",
     "rule A { sphere(1m); tag  fire; }"},
    {"2:26 syntax: expected the name of a material, found `\"brick\"` | write it without quotes, `brick`",
     "rule A { sphere(1m); mat \"brick\"; }"},
    {"2:29 syntax: expected the kind of an anchor, found `\"camp fire\"` | names consist of the letters a to z, digits "
     "and `_`, without quotes",
     "rule A { sphere(1m); anchor \"camp fire\"; }"},
    {"2:1 bad-character: `/*` does not begin a comment | comments start with // and end with their line",
     "/* a ball\n { of ours */ rule A { sphere(1m); }"},
    {"2:12 bad-character: `/*` does not begin a comment | comments start with // and end with their line",
     "rule A { } /* a ball"},
    {"2:15 syntax: expected `flat`, `gable` or `hip`, found `gabel` | did you mean `gable`?",
     "rule A { roof gabel(30deg); }"},
    {"2:6 syntax: a seed is a whole number (0 or more) or a text, and `orchard` is a name | write it in quotes, "
     "\"orchard\"",
     "seed orchard; rule A { sphere(1m); }"},
    {"2:17 unknown-name: unknown name `random` | write `rand`", "rule A { sphere(random(1m, 2m)); }"},
};

}  // namespace

TEST_CASE("messages: habits from other languages", "[grammar][messages]") {
  checkMessages(kHabits, {"sgm 1; start A;\n", ""});
}

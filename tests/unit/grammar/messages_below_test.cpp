// Tests the messages about queries of lower layers, word for word.

#include "messages.h"

using namespace sgm::test;

namespace {

const MessageCase kQueries[] = {
    {"3:13 unknown-name: unknown layer `nett` | did you mean `net`?",
     "rule D when query clear 2m of nett { sphere(1m); }"},
    {"3:13 layer-uses: layer `drip` queries itself | a layer reads lower layers only: derive what it asks about in a "
     "layer of its own",
     "rule D when query clear 2m of drip { sphere(1m); }"},
    {"3:25 unit-mismatch: the radius of a query is a length, and this is a ratio | write `2m`",
     "rule D when query clear 2 of net { sphere(1m); }"},
    {"3:25 type-mismatch: the radius of a query is a length, and this is a cell | such as 2m",
     "rule D when query clear cell of net { sphere(1m); }"},
    {"3:25 stage: the radius of a query is decided when shapes are derived, and `p` is known at sample time only | "
     "fields serve displace, warp and the t of morph",
     "rule D when query clear p.x of net { sphere(1m); }"},
    {"3:25 value-range: the radius of a query is 0m or more | such as `query clear 2m of`",
     "rule D when query clear -2m of net { sphere(1m); }"},
    {"3:28 syntax: expected `of`, found `net`", "rule D when query clear 2m net { sphere(1m); }"},
    {"3:25 syntax: expected an expression, found `{`", "rule D when query clear { sphere(1m); }"},
    {"3:19 syntax: expected `clear` or `inside`, found `2m`", "rule D when query 2m of net { sphere(1m); }"},
    {"3:31 syntax: expected the name of a layer, found `{`", "rule D when query clear 2m of { sphere(1m); }"},
    {"3:10 syntax: expected a statement, found `query`", "rule D { query clear of net; }"},
    {"3:6 reserved-word: `query` is a word of the language and cannot be the name of a rule | choose another name, "
     "such as `query_`",
     "rule query { } rule D { }"},
    {"3:17 type-mismatch: `r` of `sphere` is a length, and this is a condition | such as 2m",
     "rule D { sphere(query clear of net); }"},
    {"3:9 wrong-use: a query is known inside rules only: it asks about the scope's place | ask in a rule, and pass the "
     "answer to a let as an argument",
     "let f = query clear of net; rule D when f { sphere(1m); }"},
    {"3:17 stage: a query is answered once, when shapes are derived, and a field is evaluated at every point | ask in "
     "the rule, `let open = query ...;`, and pass that to the field as an argument",
     "field f(a) = if query clear of net then a else 0m; rule D { displace f(1m) amp 1m { sphere(1m); } }"},
    {"3:23 stage: a query is answered once, when shapes are derived, and a field is evaluated at every point | ask in "
     "the rule, `let open = query ...;`, and pass that to the field as an argument",
     "rule D { field f = if query clear of net then 1m else 0m; displace f amp 1m { sphere(1m); } }"},
    {"3:26 stage: a query is answered once, when shapes are derived, and a field is evaluated at every point | ask in "
     "the rule, `let open = query ...;`, and pass that to the field as an argument",
     "rule D { field f(a) = if query clear of net then a else 0m; displace f(1m) amp 1m { sphere(1m); } }"},
    {"3:13 reach: cannot prove reach: this query may look 9 m from its cell, layer `drip` declares reach 8 m | raise "
     "reach to 9 m or ask nearer to the cell",
     "rule D when query clear 9m of net { sphere(1m); }"},
    {"3:27 reach: cannot prove reach: this query may look without bound from its cell, layer `drip` declares reach 8 m "
     "| bound its radius and where it stands: a parameter's range, or clamp()",
     "param r = 1m; rule D when query clear r of net { sphere(1m); }"},
};

const MessageCase kAskingLayers[] = {
    {"2:13 layer-uses: layer `b` queries `a` and does not use it | write `uses a` in its head",
     "sgm 1; domain infinite; layer a cell 8m reach 4m { start B; } layer b cell 8m reach 4m { start A; }\nrule A when "
     "query clear of a { sphere(1m); } rule B { sphere(1m); }"},
    {"2:37 layer-uses: layer `b` queries `a` and does not use it | write `uses a` in its head",
     "sgm 1; domain infinite; layer a cell 8m reach 4m { start B; } layer b cell 8m reach 4m { start A; }\noverride "
     "\"b(0, 0, 0)/A\" { sphere(if query inside of a then 1m else 2m); }\nrule A { sphere(1m); } rule B { sphere(1m); "
     "}"},
    {"1:36 unknown-name: unknown layer `net` | name a layer of this file",
     "sgm 1; start A; rule A { sphere(if query clear of net then 1m else 2m); }"},
};

}  // namespace

TEST_CASE("messages: queries of layers below", "[grammar][messages]") {
  checkMessages(kQueries, {"sgm 1; domain infinite solid; layer net cell 32m reach 16m { start Net; } layer drip cell "
                           "16m reach 8m uses net { start D; }\nrule Net { cut { at(cell.center) sphere(8m); } }\n",
                           ""});
}

TEST_CASE("messages: layers that are asked and not used", "[grammar][messages]") { checkMessages(kAskingLayers); }

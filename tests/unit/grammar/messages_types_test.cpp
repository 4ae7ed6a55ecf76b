// Tests messages about kinds, dimensions and evaluation stages of values, word for word.

#include "messages.h"

using namespace sgm::test;

namespace {

const MessageCase kTypes[] = {
    {"2:17 unit-mismatch: `r` of `sphere` is a length, and this is a ratio | write `5m`", "sphere(5);"},
    {"2:17 type-mismatch: `r` of `sphere` is a length, and this is a point | such as 2m", "sphere((1m, 2m, 3m));"},
    {"2:17 unit-mismatch: the angle of `rot` is an angle, and this is a ratio | write `90deg`",
     "rot(y, 90) sphere(5m);"},
    {"2:28 unit-mismatch: `r` of `sphere` is a length, and this is a ratio | multiply it by 1m to make a length of it",
     "let r = 2; sphere(r);"},
    {"2:29 unit-mismatch: a count is a ratio, and this is a length | divide it by a length to make a ratio of it",
     "let r = 2m; repeat r sphere(1m);"},
    {"2:28 unit-mismatch: the angle of `rot` is an angle, and this is a ratio | multiply it by 1deg or 1rad to make an "
     "angle of it",
     "let r = 2; rot(y, r) sphere(1m);"},
    {"2:17 type-mismatch: `r` of `sphere` is a length, and this is a text | such as 2m", "sphere(\"a\");"},
    {"2:14 unit-mismatch: the edge of a box is a length, and this is a ratio | write `2m`", "box(2);"},
    {"2:14 type-mismatch: the edge of a box is a length, and this is a text | such as 2m", "box(\"a\");"},
    {"2:20 type-mismatch: the size of `ellipsoid` is a point, and this is a length | such as (1m, 2m, 3m)",
     "ellipsoid(2m);"},
    {"2:39 type-mismatch: `r` of `sphere` is a length, and this is a face | such as 2m",
     "for f in cell.faces { sphere(f); }"},
    {"2:22 type-mismatch: a key is a cell, a face, a segment or a number, and this is a point | such as cell or 3",
     "sphere(rand(cell.size, 1m, 2m));"},
    {"2:22 type-mismatch: a key is a cell, a face, a segment or a number, and this is a text | such as cell or 3",
     "sphere(rand(\"a\", 1m, 2m));"},
    {"2:23 type-mismatch: a vector has numbers, and this is a text | such as (1m, 2m, 3m)", "let a = (1m, \"b\");"},
    {"2:17 unit-mismatch: a coordinate of `at` is a length, and this is a ratio | write `2m`",
     "at(1m, 2, 3m) sphere(1m);"},
    {"2:18 unit-mismatch: the parts of a vector have one dimension, and these are a length and an angle | such as (1m, "
     "2m, 3m)",
     "at((1m, 2deg, 3m)) sphere(1m);"},
    {"2:17 type-mismatch: a minus stands before a number, not a condition | write `not`", "sphere(-(1 < 2));"},
    {"2:17 type-mismatch: a minus stands before a number, not a cell | such as -2m", "sphere(-cell);"},
    {"2:22 type-mismatch: the operand of `not` is a condition, and this is a ratio | such as a < b", "let a = not 2;"},
    {"2:28 type-mismatch: each side of `and` is a condition, and this is a ratio | such as a < b",
     "let a = 1 < 2 and 3;"},
    {"2:27 type-mismatch: each side of `or` is a condition, and this is a ratio | such as a < b",
     "let a = 1 < 2 or 3;"},
    {"2:17 unit-mismatch: a length and an area cannot be added | both sides are numbers, or both vectors, of one "
     "dimension",
     "sphere(1m + 2m2);"},
    {"2:17 unit-mismatch: a length and an angle cannot be subtracted | both sides are numbers, or both vectors, of one "
     "dimension",
     "sphere(1m - 2deg);"},
    {"2:18 type-mismatch: a cell and a ratio cannot be multiplied | one side is a number, the other a number or a "
     "vector",
     "let a = cell*2;"},
    {"2:18 type-mismatch: a ratio and a point cannot be divided | a number or a vector is divided by a number",
     "let a = 1/cell.size;"},
    {"2:18 type-mismatch: a point and a point cannot be multiplied | one side is a number, the other a number or a "
     "vector",
     "let a = (1m, 2m, 3m)*(1m, 2m, 3m);"},
    {"2:18 type-mismatch: a length^6 and a volume cannot be multiplied | dimensions end at the sixth power",
     "let a = 1km3*1km3*1km3;"},
    {"2:18 type-mismatch: a cell and a cell cannot be compared | both sides are numbers of one dimension",
     "let a = cell < cell;"},
    {"2:18 unit-mismatch: a length and an angle cannot be compared | both sides are numbers of one dimension",
     "let a = 1m < 2deg;"},
    {"2:18 type-mismatch: a point and a length cannot be added | both sides are numbers, or both vectors, of one "
     "dimension",
     "let a = (1m, 2m, 3m) + 1m;"},
    {"2:20 divide-by-zero: division by zero | divide by a number other than 0", "sphere(2m/0);"},
    {"2:20 type-mismatch: the condition of `if` is a condition, and this is a ratio | such as a < b",
     "sphere(if 2 then 3m else 4m);"},
    {"2:39 unit-mismatch: `then` gives a length and `else` a ratio | write `4m`", "sphere(if 1 < 2 then 3m else 4);"},
    {"2:39 unit-mismatch: `then` gives a length and `else` an area | both give values of one kind and dimension",
     "sphere(if 1 < 2 then 3m else 4m2);"},
    {"2:39 type-mismatch: `then` gives a length and `else` a cell | both give values of one kind and dimension",
     "sphere(if 1 < 2 then 3m else cell);"},
    {"2:17 unit-mismatch: the square root of a length has no dimension | take it of an area or of a ratio",
     "sphere(sqrt(2m));"},
    {"2:19 type-mismatch: `for` goes through a range, faces or segments, and this is a length | such as 0..4, "
     "cell.links(tree 3) or branch(12, step 6m, turn 25deg)",
     "for i in 3m { }"},
    {"2:19 unit-mismatch: the start of a range is a ratio, and this is a length | divide it by a length to make a "
     "ratio of it",
     "for i in 0m..3 { }"},
    {"2:22 unit-mismatch: the end of a range is a ratio, and this is a length | divide it by a length to make a ratio "
     "of it",
     "for i in 0..3m { }"},
    {"2:29 unit-mismatch: the radius of a shell is a length, and this is a ratio | write `2m`",
     "scatter 3 on shell(2) { }"},
    {"2:36 unit-mismatch: the upper share of a shell is a ratio, and this is a length | divide it by a length to make "
     "a ratio of it",
     "scatter 3 on shell(2m, up 3m) { }"},
    {"2:28 unit-mismatch: the radius of a disc is a length, and this is a ratio | write `2m`",
     "scatter 3 on disc(2) { }"},
    {"2:27 type-mismatch: the size of a box is a point, and this is a length | such as (1m, 2m, 3m)",
     "scatter 3 on box(2m) { }"},
    {"2:31 unit-mismatch: an edge of a box is a length, and this is a ratio | write `3m`",
     "scatter 3 on box(2m, 3, 4m) { }"},
    {"2:18 unit-mismatch: a count is a ratio, and this is a length | divide it by a length to make a ratio of it",
     "scatter 3m on disc(2m) { }"},
    {"2:26 unit-mismatch: the least distance of points is a length, and this is a ratio | write `3m`",
     "scatter poisson(3) { }"},
    {"2:37 type-mismatch: the `when` of a scatter is a condition, and this is a ratio | such as a < b",
     "scatter 3 on disc(2m) when 3 { }"},
    {"2:13 type-mismatch: the vector of `at` is a point, and this is a length | such as (1m, 2m, 3m)",
     "at(2m) sphere(1m);"},
    {"2:13 unit-mismatch: a coordinate of `at` is a length, and this is a ratio | write `2m`",
     "at(2, 3m, 4m) sphere(1m);"},
    {"2:15 type-mismatch: the vector of `size` is a point, and this is a length | such as (1m, 2m, 3m)",
     "size(2m) box(scope);"},
    {"2:15 unit-mismatch: an edge of `size` is a length, and this is a ratio | write `2m`",
     "size(2, 3m, 4m) box(scope);"},
    {"2:17 unit-mismatch: the angle of `rot` is an angle, and this is a length | such as 30deg",
     "rot(y, 3m) sphere(1m);"},
    {"2:16 unit-mismatch: the factor of `scale` is a ratio, and this is a length | divide it by a length to make a "
     "ratio of it",
     "scale(2m) sphere(1m);"},
    {"2:23 unit-mismatch: the width of a smooth join is a length, and this is a ratio | write `2m`",
     "union smooth 2 { sphere(1m); }"},
    {"2:19 unit-mismatch: a displacement is a length, and this is a ratio | write `2m`",
     "displace 2 amp 3m { sphere(1m); }"},
    {"2:26 unit-mismatch: the bound of a displacement is a length, and this is a ratio | write `3m`",
     "displace 2m amp 3 { sphere(1m); }"},
    {"2:15 type-mismatch: a warp is a point, and this is a length | such as (1m, 2m, 3m)", "warp 2m { sphere(1m); }"},
    {"2:32 unit-mismatch: the bound of a warp is a length, and this is a ratio | write `3m`",
     "warp (1m, 2m, 3m) amp 3 { sphere(1m); }"},
    {"2:37 unit-mismatch: the t of a morph is a ratio, and this is a length | divide it by a length to make a ratio of "
     "it",
     "morph(sphere(1m), box(1m), 2m);"},
    {"2:17 unit-mismatch: the size of a detail is a length, and this is a ratio | write `2m`",
     "detail 2 { sphere(1m); }"},
    {"2:19 type-mismatch: a displacement is a length, and this is a cell | such as 2m",
     "displace cell { sphere(1m); }"},
    {"2:20 type-mismatch: a field gives a number or a vector, not a cell | name it with `let` instead",
     "field f = cell; sphere(1m);"},
    {"2:16 wrong-use: `power` morphs spheres, ellipsoids, superquadrics and boxes | leave `power` out for a linear "
     "morph",
     "morph({ sphere(1m); }, box(1m), 0.5) power;"},
    {"2:16 wrong-use: a sum has leaves only: spheres, blobs and other primitives | cut, displace or warp the sum as a "
     "whole",
     "sum { cut { sphere(2m); } }"},
    {"2:17 stage: `r` of `sphere` is decided when shapes are derived, and `p` is known at sample time only | fields "
     "serve displace, warp and the t of morph",
     "sphere(p.x);"},
    {"2:17 stage: `r` of `sphere` is decided when shapes are derived, and `u` is known at sample time only | fields "
     "serve displace, warp and the t of morph",
     "sphere(u*1m);"},
    {"2:18 stage: a let is decided when shapes are derived, and `p` is known at sample time only | fields serve "
     "displace, warp and the t of morph",
     "let h = p.y;"},
    {"2:18 stage: a let is decided when shapes are derived, and `fractal` is known at sample time only | fields serve "
     "displace, warp and the t of morph",
     "let r = fractal(2m); sphere(1m);"},
    {"2:14 stage: an axis is decided when shapes are derived, and `p` is known at sample time only | fields serve "
     "displace, warp and the t of morph",
     "rot(p, 9deg) sphere(1m);"},
    {"2:22 stage: the end of a range is decided when shapes are derived, and `p` is known at sample time only | fields "
     "serve displace, warp and the t of morph",
     "for i in 0..p.x/1m { }"},
    {"2:18 stage: a count is decided when shapes are derived, and `q` is known at sample time only | fields serve "
     "displace, warp and the t of morph",
     "scatter q.x/1m on disc(2m) sphere(1m);"},
    {"2:27 type-mismatch: `cell` of `cellnoise` is a cell, and this is a length | such as cell",
     "sphere(cellnoise(2m, 3m)*1m);"},
    {"2:17 unit-mismatch: `r` of `sphere` is a length, and this is an area | such as 2m\n2:21 unit-mismatch: a length "
     "and a ratio cannot be subtracted | write `3m`",
     "sphere(2m*(1m - 3));"},
    {"2:18 unit-mismatch: an area and a ratio cannot be compared | both sides are numbers of one dimension",
     "let a = 2m2 + 3m2 == 4;"},
    {"2:20 type-mismatch: `corner` of `prism` is a pair of lengths, and this is a length | such as (1m, 2m)",
     "prism(2m, 3m, (1m, 0m), (0m, 1m));"},
    {"2:18 type-mismatch: a pair of ratios and a ratio cannot be compared | both sides are numbers of one dimension",
     "let a = (1, 2) < 3;"},
    {"2:18 type-mismatch: a pair of lengths and a ratio cannot be multiplied | one side is a number, the other a "
     "number or a vector",
     "let a = (1m, 2m)*3;"},
    {"2:14 unit-mismatch: `x` of `box` is a length, and this is a ratio | write `2m`", "box(2, 3m, 4m);"},
    {"2:17 type-mismatch: `r` of `sphere` is a length, and this is a cell | such as 2m", "sphere(cell);"},
    {"2:19 type-mismatch: `for` goes through a range, faces or segments, and this is a cell | such as 0..4, "
     "cell.links(tree 3) or branch(12, step 6m, turn 25deg)",
     "for i in cell { }"},
    {"2:17 type-mismatch: a length and a list of segments cannot be multiplied | one side is a number, the other a "
     "number or a vector",
     "sphere(2m*branch(3, step 2m, turn 9deg));"},
    {"2:17 unit-mismatch: the angle of `rot` is an angle, and this is a length | such as 30deg",
     "rot(y, 2m) sphere(1m);"},
    {"2:25 unit-mismatch: `b` of `max` is a length, and this is a ratio | write `3m`", "sphere(max(2m, 3));"},
    {"2:17 type-mismatch: a count is a ratio, and this is a cell | such as 3 or 40%", "repeat cell { }"},
    {"2:31 unit-mismatch: `b` of `max` is a length^4, and this is a length | give it the dimension that it needs",
     "let a = max(2m2*2m2, 3m);"},
    {"2:22 stage: the source of `for` is decided when shapes are derived, and `p` is known at sample time only | "
     "fields serve displace, warp and the t of morph",
     "for s in if p.x > 0m then branch(3, step 2m, turn 9deg) else branch(4, step 2m, turn 9deg) { }"},
};

const MessageCase kUses[] = {
    {"1:18 wrong-use: `cell` is known inside rules only | pass it to a let as an argument\n1:18 type-mismatch: a field "
     "gives a number or a vector, not a cell | name it with `let` instead\n1:51 type-mismatch: a displacement is a "
     "length, and this is a cell | such as 2m",
     "sgm 1; field f = cell; start A; rule A { displace f { sphere(1m); } }"},
    {"1:21 type-mismatch: a field gives a number or a vector, not a cell | name it with `let` instead\n1:51 "
     "type-mismatch: a displacement is a length, and this is a cell | such as 2m",
     "sgm 1; field f(c) = c; start A; rule A { displace f(cell) { sphere(1m); } }"},
    {"1:28 type-mismatch: an argument of `B` cannot be a list of faces | rules take numbers, vectors, conditions, "
     "cells, faces and segments",
     "sgm 1; start A; rule A { B(cell.faces); } rule B(r) { }"},
    {"1:28 type-mismatch: an argument of `B` cannot be a text | rules take numbers, vectors, conditions, cells, faces "
     "and segments",
     "sgm 1; start A; rule A { B(\"a\"); } rule B(r) { }"},
    {"1:35 unit-mismatch: `r` of `B` is a length, and this is a ratio | write `3m`",
     "sgm 1; start A; rule A { B(2m); B(3); } rule B(r) { sphere(1m); }"},
    {"1:28 stage: an argument of `B` is decided when shapes are derived, and `p` is known at sample time only | fields "
     "serve displace, warp and the t of morph",
     "sgm 1; start A; rule A { B(p.x); } rule B(r) { sphere(1m); }"},
    {"1:21 stage: a let is decided when shapes are derived, and `r` is a field | fields serve displace, warp and the t "
     "of morph\n1:51 stage: an argument of `d` is decided when shapes are derived, and `p` is known at sample time "
     "only | fields serve displace, warp and the t of morph",
     "sgm 1; let d(r) = 2*r; start A; rule A { sphere(d(p.x)); }"},
    {"2:13 stage: a guard is decided when shapes are derived, and `f` is a field | fields serve displace, warp and the "
     "t of morph",
     "sgm 1; start A; field f = p.y;\nrule A when f > 0m { } rule A else { }"},
    {"1:29 type-mismatch: a guard is a condition, and this is a ratio | such as a < b",
     "sgm 1; start A; rule A when 3 { } rule A else { }"},
    {"1:31 unit-mismatch: a weight is a ratio, and this is a length | divide it by a length to make a ratio of it",
     "sgm 1; start A; rule A weight 2m { } rule A weight 1 { }"},
    {"1:30 unit-mismatch: a depth is a ratio, and this is a length | divide it by a length to make a ratio of it",
     "sgm 1; start A; rule A depth 2m -> sphere(1m) { }"},
    {"1:32 unit-mismatch: a least size is a length, and this is a ratio | write `2m`",
     "sgm 1; start A; rule A minsize 2 -> sphere(1m) { }"},
    {"1:28 unit-mismatch: a level of detail is a length, and this is a ratio | write `2m`",
     "sgm 1; start A; rule A lod 2 { } rule A { }"},
    {"1:18 type-mismatch: a parameter is a number, and this is a vector of ratios | such as param a = 2m;",
     "sgm 1; param a = (1, 2, 3); start A; rule A { }"},
    {"1:18 type-mismatch: a parameter is a number, and this is a text | such as param a = 2m;",
     "sgm 1; param a = \"b\"; start A; rule A { }"},
    {"1:27 unit-mismatch: the low end of a range is an area, and this is a length | such as 2m2\n1:31 unit-mismatch: "
     "the high end of a range is an area, and this is a length | such as 2m2",
     "sgm 1; param a = 1m*1m in 0m..2m; start A; rule A { }"},
    {"1:18 param-range: the default of `a` lies outside of its range | widen the range, or choose a default within it",
     "sgm 1; param a = 3 in 0..2; start A; rule A { }"},
    {"1:18 param-range: the default of `a` lies outside of its range | write 60%",
     "sgm 1; param a = 60 in 0%..100%; start A; rule A { }"},
    {"1:23 param-range: the range is reversed | write its low end first",
     "sgm 1; param a = 3 in 4..2; start A; rule A { }"},
    {"1:14 param-range: `a` is animated and has no range | write its range: `param a = ... in LOW..HIGH animated`",
     "sgm 1; param a = 3 animated; start A; rule A { }"},
    {"1:31 not-constant: the default of a parameter must be a constant | use numbers, arithmetic and lets without "
     "parameters",
     "sgm 1; param a = 2; param b = a; start A; rule A { }"},
    {"1:26 unit-mismatch: the high end of a range is a ratio, and this is a length | divide it by a length to make a "
     "ratio of it",
     "sgm 1; param a = 1 in 0..2m; start A; rule A { }"},
    {"1:23 unit-mismatch: the low end of a range is a ratio, and this is a length | divide it by a length to make a "
     "ratio of it",
     "sgm 1; param a = 1 in 0m..2; start A; rule A { }"},
    {"1:13 value-range: a seed is a whole number (0 or more) or a text | such as seed 7 or seed \"block-17\"",
     "sgm 1; seed -1; start A; rule A { }"},
    {"1:13 unit-mismatch: a seed is a ratio, and this is a length | divide it by a length to make a ratio of it",
     "sgm 1; seed 2m; start A; rule A { }"},
    {"1:30 warning value-range: rules may be nested at most 64 deep | a cell that goes deeper is not derived at all",
     "sgm 1; start A; rule A depth 65 -> sphere(1m) { sphere(1m); }"},
};

}  // namespace

TEST_CASE("messages: types and stages in rules", "[grammar][messages]") {
  checkMessages(kTypes, {"sgm 1; start A;\nrule A { ", " }"});
}

TEST_CASE("messages: types and stages of heads, parameters and calls", "[grammar][messages]") { checkMessages(kUses); }

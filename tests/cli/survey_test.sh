#!/usr/bin/env bash
# Tests sgm render --plan and --section: survey drawings, which need no device.
source "$(dirname "$0")/common.sh"
lake=$SOURCE/tests/bench/grammars/lake.sgm

cat >rooms.sgm <<'GRAMMAR'
sgm 1;
units m;
domain infinite axes xz solid limestone;
layer rooms cell 40m reach 1m { start Rooms; }
layer pool cell 40m reach 1m { start Pool; }
rule Rooms {
  cut {
    at(20m, 6m, 20m) box(20m, 8m, 12m);
    at(20m, -8m, 20m) box(8m, 6m, 40m);
  }
}
rule Pool { at(26m, 2.5m, 20m) { box(4m, 1m, 10m); mat water; } }
GRAMMAR
all=--region=0,-16,0:40,16,40
# has CLASS FILE: fails unless the SVG has a path of that class.
has() { grep -q "<path class=\"$1\"" "$2" || failed "$2 has no $1"; }
lacks() { ! grep -q "<path class=\"$1\"" "$2" || failed "$2 has a $1"; }

expect 0 "$SGM" render rooms.sgm $all --out plan.svg --plan --json
json 'j.width === 1600 && j.height === 1200 && j.cell === 0.5 && j.subject === "void" && !("section" in j)'
# The lower room extends beyond the region in the north and the south: the plan must show two leads (places where a
# passage continues).
json 'j.plan.leads === 2 && Math.abs(j.plan.area - (20 * 12 + 8 * 28)) < 20 && j.plan.water.join() === "3"'
json 'Math.abs(j.plan.lowest + 11) < 0.1 && j.pixels_per_metre > 5'
for class in wall water shore under open scale north text; do has $class plan.svg; done
# An extension in capitals must select the same format.
expect 0 "$SGM" render rooms.sgm $all --out PLAN.SVG --plan
cmp -s plan.svg PLAN.SVG || failed "PLAN.SVG is another drawing than plan.svg"
rm PLAN.SVG
for class in cut rock solid; do lacks $class plan.svg; done
grep -q 'aria-label="rooms.sgm - plan"' plan.svg || failed "no title"
grep -q 'aria-label="seed 0, ' plan.svg || failed "no seed"
grep -q '<title>rooms.sgm, seed 0, ' plan.svg || failed "no title of the file"
# The bytes of a drawing must not depend on the number of threads.
cp plan.svg before.svg
expect 0 "$SGM" render rooms.sgm $all --out plan.svg --plan --threads 1
cmp -s plan.svg before.svg || failed "one thread draws another plan"
out_has 'plan +[0-9]+ m2 seen from above'

expect 0 "$SGM" render rooms.sgm $all --out section.svg --section --json
json 'j.section.from[0] === j.section.to[0] || j.section.from[1] === j.section.to[1]'
json '!("plan" in j) && j.section.area > 100'
for class in wall rock guide beyond scale; do has $class section.svg; done
lacks under section.svg
expect 0 "$SGM" render rooms.sgm $all --out both.svg --plan --section=5,20:35,20 --json
json 'j.section.from.join() === "5,20" && j.section.to.join() === "35,20" && Math.abs(j.section.area - 204) < 12'
for class in wall rock cut under water; do has $class both.svg; done
grep -q "aria-label=\"A'\"" both.svg || failed "the line has no letters"
grep -q 'aria-label="rooms.sgm - plan and long section"' both.svg || failed "the title does not say both"

# As pixels, the drawing must be white with dark lines.
expect 0 "$SGM" render rooms.sgm $all --out plan.png --plan --size 640x480
read -r mean dark < <(node "$SOURCE/tests/cli/png.js" plan.png)
((mean > 600 && dark > 1000)) || failed "mean $mean, $dark dark pixels"
read -r mean dark < <(node "$SOURCE/tests/cli/png.js" plan.png 0 0 30 30)
((mean == 765 && dark == 0)) || failed "the margin is not white"

# The drawing of a lake must contain dripstone and contours. For an infinite world, the drawing must show the
# surroundings of the anchor nearest to the origin.
expect 0 "$SGM" render "$lake" --out lake.svg --plan --section --seed 3 --region=-96,-40,-96:96,40,96 --json
json 'j.plan.dripstones > 5 && j.plan.water.join() === "-5" && j.plan.contour_interval > 0 && j.plan.leads > 4'
for class in contour hachure stalactite stalagmite shore ceiling_step room; do has $class lake.svg; done
expect 0 "$SGM" render "$lake" --out nearest.svg --plan --seed 3
expect 0 "$SGM" render "$lake" --out level.svg --plan --seed 3 --level 1 --json
json 'j.level === 1 && j.cell === 1'
# For an open-air world, the plan must show the buildings.
expect 0 "$SGM" render "$SOURCE/tests/bench/grammars/building.sgm" --out house.svg --plan --section --json
json 'j.subject === "solid" && j.plan.area > 100 && j.plan.highest > 15'
for class in solid wall contour beyond; do has $class house.svg; done
lacks ceiling_step house.svg
# A level top has no contours, and the legend mentions none.
printf 'sgm 1; units m; start A; rule A { at(8m, 2m, 8m) box(12m, 4m, 8m); }\n' >level.sgm
expect 0 "$SGM" render level.sgm --out top.svg --plan --json
json 'j.plan.contour_interval === 0 && Math.abs(j.plan.highest - 4) < 0.1'
lacks contour top.svg
rm level.sgm top.svg

# Each refused call must print exactly one error message.
expect 1 "$SGM" render rooms.sgm --out wrong.svg --plan --region=1,14,1:4,18,4
one_line
err_has 'rock without a void; choose another --region'
printf 'sgm 1; units m; start A; rule A { at(8m, 8m, 8m) sphere(1m); }\n' >ball.sgm
expect 1 "$SGM" render ball.sgm --out wrong.svg --plan --region=-20,-20,-20:-10,-10,-10
one_line
err_has 'nothing stands in the region'
expect 1 "$SGM" render rooms.sgm $all --out wrong.svg --section=100,100:200,100
one_line
err_has 'the line does not meet the region'
for line in 1 1,2:3 1,2:1,2 a,b:c,d; do
  expect 2 "$SGM" render rooms.sgm $all --out wrong.svg --section=$line
  err_has "'$line' is not a line X,Z:X,Z in metres"
done
expect 2 "$SGM" render rooms.sgm --out wrong.png --plan --size 200x200
err_has 'at least 320x320'
expect 2 "$SGM" render rooms.sgm --out wrong.svg
err_has '.png files; --plan and --section write .svg too'
expect 2 "$SGM" render rooms.sgm --out wrong.pdf --plan
for other in "--camera 0,0,8:0,0,0" --wires --volume "--light sun" "--frame Rooms" "--seeds 1..2 --sheet"; do
  # shellcheck disable=SC2086
  expect 2 "$SGM" render rooms.sgm --out wrong.svg --plan $other
  err_has 'excludes'
done
expect 1 "$SGM" render "$lake" --out wrong.svg --plan --at spwan --cell 1 --seed 3
err_has "did you mean 'spawn'"
expect 1 "$SGM" render rooms.sgm $all --out wrong.svg --plan --max-chunks 1
one_line
err_has 'more than 1'
expect 1 "$SGM" render rooms.sgm --out wrong.svg --plan --region=0,-1,0:4000,1,4000 --max-chunks 999999
one_line
err_has 'at most 16777216 columns'
expect 4 "$SGM" render rooms.sgm --out nowhere/plan.svg --plan
one_line
expect 4 "$SGM" render none.sgm --out wrong.svg --plan
only ball.sgm before.svg both.svg house.svg lake.svg level.svg nearest.svg plan.png plan.svg rooms.sgm section.svg
finish

#!/usr/bin/env bash
# Tests sgm check --expect: statements that hold or fail, places of failures, seeds, statements per use of a rule, JSON.
source "$(dirname "$0")/common.sh"

cat >row.sgm <<'END'
sgm 1;
param count = 3 in 1..5;
start Row;
rule Row { repeat count at(8m, 0m, 0m) { Ball(rand(1.5m, 3m)); } }
rule Ball(r) { sphere(r); anchor spot; }
report volume;
expect components == 3;
expect watertight;  expect genus == 0;
report volume per Ball;
expect components == 1 per Ball;
END
expect 0 "$SGM" check --expect row.sgm
err_empty
out_has '^row.sgm:6:1: report: volume = [0-9.]+ m3 \('
out_has 'row.sgm:7:1: expect: components == 3: holds \(3; .* m, cells of 0.5 m, seed 0\)'
out_has 'row.sgm:8:21: expect: genus == 0: holds \(0; '
out_has 'row.sgm:9:1: report: volume per Ball = 3 uses, minimum [0-9.]+, mean [0-9.]+, maximum [0-9.]+ m3 \('
out_has 'row.sgm: ok, its 4 expectations hold$'

# For a statement that fails, the message must have its place, its line, a caret below it, and the measured value. The
# other statements must still be evaluated.
expect 1 "$SGM" check --expect row.sgm --set count=4
[[ $err == "row.sgm:7:1: error: expected components == 3, but it is 4
  expect components == 3;
  ^~~~~~~~~~~~~~~~~~~~~~~
  note: "*" m, cells of 0.5 m, seed 0" ]] || failed "the message of a failed expectation"
out_has 'row.sgm:8:1: expect: watertight: holds'
out_has 'row.sgm: 1 statement fails$'
# Without --expect, the grammar must not be derived.
expect 0 "$SGM" check row.sgm
[[ $out == 'row.sgm: ok' ]] || failed "check alone evaluates"

# The JSON must list the statements with their measured values.
expect 0 "$SGM" check --expect --json row.sgm
json 'j.ok && j.files[0].expectations.length === 6'
json 'j.files[0].expectations.map(e => e.text)[1] === "expect components == 3;" && j.files[0].expectations[1].holds === true'
json 'j.files[0].expectations.every(e => e.file === "row.sgm" && e.line > 5 && e.column > 0 && e.cell === 0.5 && e.seed === 0)'
json 'j.files[0].expectations[0].measure === "volume" && j.files[0].expectations[0].value > 40 && j.files[0].expectations[0].holds === null'
json 'j.files[0].expectations[2].value === true && j.files[0].expectations[0].region.length === 2'
json 'j.files[0].expectations[5].rule === "Ball" && j.files[0].expectations[5].count === 3 && j.files[0].expectations[5].maximum === 1'
json 'j.files[0].expectations[5].values.map(v => v.path).join() === "Row/Ball[0],Row/Ball[1],Row/Ball[2]"'
json 'j.files[0].expectations[5].values[1].at.join() === "8,0,0" && j.files[0].expectations[5].values[1].holds'
expect 1 "$SGM" check --expect --json row.sgm --set count=1
err_empty
json '!j.ok && !j.files[0].ok && j.files[0].expectations[1].value === 1 && j.files[0].expectations[1].holds === false'

# A statement "per Rule" must hold for each use of the rule; the message must name the first use for which it fails.
sed 's/^expect components == 1 per Ball;/expect volume < 60m3 per Ball;/' row.sgm >large.sgm
expect 1 "$SGM" check --expect large.sgm --seed 1 --seeds 4
err_has 'large.sgm:10:1: error: expected volume < 60m3 per Ball, but it is [0-9.]+ m3 in Row/Ball\[[0-2]\] at (0|8|16),0,0 m'
err_has 'note: [1-3] of 3 uses, minimum '
out_has 'large.sgm: fails with seeds? [1-4](, [1-4])*, of 4 from 1 on$'
expect 0 "$SGM" check --expect row.sgm --seeds 3
out_has 'seed 2\)'
out_has 'row.sgm: ok, its 4 expectations hold with 3 seeds$'

# A statement about a quantity that cannot be measured must fail with a reason; a `report` about it must not fail.
cat >bar.sgm <<'END'
sgm 1;
domain infinite;
layer l cell 16m reach 16m { start Bar; }
rule Bar { at(8m, 8m, 8m) capsule((-16m, 0m, 0m), (16m, 0m, 0m), 2m); }
report genus;
expect genus == 0 in block(1);
END
expect 1 "$SGM" check --expect bar.sgm
out_has "bar.sgm:5:1: report: genus = not measured: the region's border cuts the surface"
err_has "bar.sgm:6:1: error: expected genus == 0 in block\(1\), but it is not measured: the region's border cuts"

# The message must list the unwanted components, the smallest first. As the place of a component, it must give the
# bounding box of the component's samples.
cat >stray.sgm <<'END'
sgm 1;
domain finite box(64m);
start Main;
rule Main { sphere(9m); at(20m, 0m, 0m) sphere(2.2m); at(-20m, 4m, 0m) box(1.2m); }
expect components == 1;
END
expect 1 "$SGM" check --expect stray.sgm --cell 1
err_has 'but it is 3'
err_has 'note: the smallest are 1 m3 in -20.5,3.5,-0.5 to -19.5,4.5,0.5 m; [0-9.]+ m3 in 17.5,-2.5,-2.5 to 22.5,2.5,2.5 m; '
expect 1 "$SGM" check --expect stray.sgm --cell 1 --json
out_has '"pieces":'

# A statement about components smaller than one sample must be refused, since samples cannot show these.
sed 's/^report genus;/report components(solid above 0.01m3);/; s/^expect .*/expect components(solid above 2m3) >= 1;/' bar.sgm >small.sgm
expect 0 "$SGM" check --expect small.sgm --cell 1 --region=-16,0,0:16,16,16
out_has 'not measured: one sample stands for 1 m3, more than the volume in question: measure with smaller cells'

# `volume` must be the volume of the solid, also where the region cuts it. The paper's volume, which counts cubes, must
# be reported separately, as `cubes`.
cat >slab.sgm <<'END'
sgm 1;
start Slab;
rule Slab { box(10m, 1m, 10m); }
report volume;
expect volume in 99m3..101m3 per Slab;
END
expect 0 "$SGM" check --expect slab.sgm --cell 0.1 --json
json 'Math.abs(j.files[0].expectations[0].value - 100) < 1 && Math.abs(j.files[0].expectations[0].cubes - 100) > 5'
json 'j.files[0].expectations[1].holds && j.files[0].expectations[1].values[0].cubes > 0'
expect 0 "$SGM" check --expect slab.sgm --cell 0.1 --region=0,-3.2,-6.4:6.4,3.2,6.4 --json
json 'Math.abs(j.files[0].expectations[0].value - 50) < 0.5'

# Region and cell size of the command line must be used. If there are too many chunks, the message must give a remedy.
expect 0 "$SGM" check --expect row.sgm --region=-4,-4,-4:20,4,4 --cell 0.25
out_has 'cells of 0.25 m'
expect 1 "$SGM" check --expect row.sgm --cell 0.02 --max-chunks 100
err_has 'row.sgm:6:1: error: `volume` cannot be evaluated: this takes more than 100 chunks; make the cells larger \(cells of 0.[0-9]+ m fit\)'
expect 1 "$SGM" check --expect row.sgm --set count=99
one_line
expect 1 "$SGM" check --expect row.sgm --cell 0

# Options that control the evaluation must be refused without --expect.
for option in --seed=1 --seeds=2 --set=count=2 --region=0,0,0:1,1,1 --cell=1 --max-chunks=9; do
  expect 2 "$SGM" check row.sgm "$option"
done
expect 2 "$SGM" check --expect row.sgm --seeds 0
expect 2 "$SGM" check --expect
expect 3 "$SGM" check --expect row.sgm --backend cuda

# With several files, an error in one must not prevent the evaluation of the others.
printf 'sgm 1;\nstart R;\nrule R { sphere 3m; }\n' >syntax.sgm
expect 1 "$SGM" check --expect syntax.sgm row.sgm
out_has 'row.sgm: ok, its 4 expectations hold'
expect 4 "$SGM" check --expect none.sgm row.sgm
printf 'sgm 1;\nstart R;\nrule R { sphere(3m); }\n' >silent.sgm
expect 0 "$SGM" check --expect silent.sgm
out_has 'silent.sgm: ok, no expectation$'
finish

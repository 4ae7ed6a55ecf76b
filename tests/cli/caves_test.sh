#!/usr/bin/env bash
# Tests that every hall of a cave is connected to every other through the void, and that no piece of rock above eight
# cubic metres floats. Smaller pieces are ignored: in cells as large as these, a small stalactite may separate from its
# ceiling, and the block's border cuts off corners of rooms. Tests blocks of 4 by 4 grammar cells with one hall each, or
# of 4 by 4 by 4 if cells are also stacked. The long run tests 1,000 seeds of cave.sgm and 100 of the other samples.
source "$(dirname "$0")/common.sh"

# caves NAME SEEDS ANCHORS [SOLID]: checks the sample NAME; the long variant of this test checks SEEDS seeds of it. It
# must have at least ANCHORS anchors, and no floating rock above SOLID (default: 8) cubic metres.
caves() {
  local seeds=1 said=
  [[ ${SGM_LONG-} != 1 ]] || { seeds=$2 && said=" with $2 seeds"; }
  {
    grep -v '^expect ' "$SOURCE/samples/grammars/$1.sgm"
    echo 'expect components(air above 8m3) == 1 in block(4);'
    echo "expect components(solid above 8m3) == 1 in block(4);"
    echo "expect anchors >= $3 in block(4);"
  } >halls.sgm
  expect 0 "$SGM" check --expect halls.sgm --cell 0.5 --max-chunks 1000000 --seeds "$seeds"
  out_has "halls.sgm: ok, its 3 expectations hold$said"
}
caves cave 1000 16
caves branchwork 100 0
caves lake 100 16
caves table4/cui 100 64

# single PASSAGE VOLUME CELL: tests that a passage, cut out of rock, is a single void, ignoring those of less than VOLUME.
single() {
  cat >single.sgm <<END
sgm 1;
import "std/karst.sgm" as karst;
domain finite box(900m, 450m, 400m) solid;
rule Start { cut karst.$1; }
start Start;
expect components(air above $2) == 1;
END
  expect 0 "$SGM" check --expect single.sgm --cell "$3" --max-chunks 10000000
  out_has 'single.sgm: ok, its expectation holds'
}
# Passages far deeper than wide, in which the bores do not reach each other.
single 'Canyon((-25m, 0m, 0m), (25m, -2m, 0m), 2m, 20m)' 1m3 0.2
single 'Keyhole((-25m, 0m, 0m), (25m, -2m, 0m), 2m, 12m)' 1m3 0.2
single 'Canyon((-10m, 0m, 0m), (10m, -1m, 0m), 0.3m, 50m)' 0.2m3 0.1
single 'Keyhole((-10m, 0m, 0m), (10m, -1m, 0m), 0.3m, 40m)' 0.2m3 0.1
# Passages that are long or swing widely, near and as they are derived for cells of half a metre.
for cell in 0.3 0.5; do
  single 'Tube((-330m, 0m, 0m), (330m, -4m, 10m), 2m)' 1m3 $cell
  single 'Keyhole((-330m, 0m, 0m), (330m, -4m, 10m), 2m, 5m)' 1m3 $cell
  single 'Canyon((-330m, 0m, 0m), (330m, -4m, 10m), 2m, 8m)' 1m3 $cell
  single 'Tube((-60m, 0m, 0m), (60m, -4m, 10m), 0.6m, 60m)' 1m3 $cell
  single 'Canyon((-60m, 0m, 0m), (60m, -4m, 10m), 1m, 5m, 60m)' 1m3 $cell
done

# Negative test: the check must detect a hall that is cut off, and balls that float two metres below the ceilings.
sed -e '/karst.Passage(/d' -e '/^expect /d' "$SOURCE/samples/grammars/cave.sgm" >cut_off.sgm
echo 'expect components(air above 1m3) == 1 in block(4);' >>cut_off.sgm
expect 1 "$SGM" check --expect cut_off.sgm --cell 0.5 --max-chunks 1000000
err_has 'expected components\(air above 1m3\) == 1 in block\(4\), but it is 16'
sed -e 's/when chance(wet) karst.Dripstone(h);/when h > 6m and chance(50%) at(y -2.5m) sphere(1.5m);/' -e '/^expect /d' \
  "$SOURCE/samples/grammars/cave.sgm" >floats.sgm
echo 'expect components(solid above 8m3) == 1 in block(4);' >>floats.sgm
expect 1 "$SGM" check --expect floats.sgm --cell 0.5 --max-chunks 1000000
err_has 'expected components\(solid above 8m3\) == 1 in block\(4\), but it is [0-9]{2,}'
finish

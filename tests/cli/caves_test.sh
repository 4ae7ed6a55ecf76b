#!/usr/bin/env bash
# Tests that every hall of a cave can be reached from every other through the void, and that no piece of rock above
# eight cubic metres floats. Smaller pieces are ignored: in such large cells a small stalactite may separate from its
# ceiling, and the block's border cuts off corners of rooms beyond it. Tests level 0, blocks of 4 cells with 16 halls,
# or 64 where cells are stacked; in the long run with 1,000 seeds of cave.sgm and 100 of the others.
source "$(dirname "$0")/common.sh"

# caves NAME SEEDS HALLS: checks the sample NAME for SEEDS seeds; with HALLS other than 0, each hall must have an
# anchor.
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

# The test must detect a hall that is cut off, and balls that float two metres below the ceilings.
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

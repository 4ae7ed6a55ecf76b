#!/usr/bin/env bash
# Every hall of a cave can be reached from every other through the void, and no piece of rock above eight cubic metres
# floats: in so large cells a smaller stalactite may part from its ceiling, and the block's border cuts off nooks of a
# room beyond it, of some cubic metres. At level 0, over blocks of 4 cells, with 16 halls, 64 where cells are stacked. In
# the long run with 1,000 seeds of cave.sgm and 100 of the others.
source "$(dirname "$0")/common.sh"

# caves NAME SEEDS HALLS: the sample NAME, in which each hall has an anchor where HALLS is not 0.
caves() {
  local seeds=1 said=
  [[ ${SGM_LONG-} != 1 ]] || { seeds=$2 && said=" with $2 seeds"; }
  {
    grep -v '^expect ' "$SOURCE/samples/grammars/$1.sgm"
    echo 'expect components(air above 8m3) == 1 in block(4);'
    echo 'expect components(solid above 8m3) == 1 in block(4);'
    echo "expect anchors >= $3 in block(4);"
  } >halls.sgm
  expect 0 "$SGM" check --expect halls.sgm --cell 0.5 --max-chunks 1000000 --seeds "$seeds"
  out_has "halls.sgm: ok, its 3 expectations hold$said"
}
caves cave 1000 16
caves branchwork 100 0
caves lake 100 16
caves table4/cui 100 64

# A hall that is cut off is seen, and so are balls that float two metres below the ceilings.
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

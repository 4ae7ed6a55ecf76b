# Tests the page in a real browser during a flight: its content, its uploads, and its screenshots.
#
#   page_test.sh SGM SOURCE NODE_MODULES FOLDER_FOR_PICTURES
modules=$3 pictures=$4/page
source "$(dirname "$0")/common.sh"
need node nodejs
need /usr/bin/chromium chromium
if [[ ! -d $modules/playwright-core ]]; then
  echo "playwright-core is not there: npm install --prefix ${modules%/node_modules} playwright-core"
  [[ -z ${SGM_REQUIRE_ALL:-} ]] || exit 1
  exit 77
fi

expect 0 "$SGM" mesh "$SOURCE/samples/grammars/sphere.sgm" --out valid.glb
# Makes a mesh with holes: the cave is cut at the region's border.
expect 0 "$SGM" mesh "$SOURCE/tests/bench/grammars/cave.sgm" --seed 3 --region 96,-96,32:160,-48,96 --out open.glb
start_flight "$SOURCE/tests/bench/grammars/cave.sgm" --measure --frames 20000
checked "the page" node "$tests/page_test.mjs" "$base" "$operations" valid.glb open.glb "$pictures" "$modules"
kill "$service"
wait "$service"
finish

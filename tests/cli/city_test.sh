#!/usr/bin/env bash
# Tests a flight through an endless city and back: it must end at the very buildings where it began, bit for bit, and
# stay within its memory limits. It goes 300 m away at 60 m/s, in the long run 2 km.
source "$(dirname "$0")/common.sh"

# More frames than the path needs: on a busy machine, the last chunks are loaded after the viewer has reached the end
# and stands still.
away=300 frames=1000
[[ ${SGM_LONG-} != 1 ]] || away=2000 frames=6000
city=$SOURCE/samples/grammars/city.sgm
echo '{"points": [[0, 12, 0], [0, 12, 0.2], [0, 12, 0.5]], "loop": false}' >stand.json
echo "{\"points\": [[0, 12, 0], [0, 14, $away], [3, 12, $((away - 1))], [0, 12, 0.5]], \"loop\": false}" >back.json

hash_of() { node -e 'console.log(JSON.parse(require("fs").readFileSync(process.argv[1], "utf8")).world_hash)' .out; }
expect 0 "$SGM" fly "$city" --path stand.json --frames 400 --speed 60 --cell 0.5 --json
stood=$(hash_of)
expect 0 "$SGM" fly "$city" --path back.json --frames "$frames" --speed 60 --cell 0.5 --mesh-mb 256 --json
json "j.world_hash === '$stood'"
json 'j.commits > 20 && j.chunks_meshed > 1500'
json 'j.peak_bytes.meshes <= 256 * 2 ** 20 && j.peak_bytes.handed_over_per_frame.largest <= j.peak_bytes.handed_over_per_frame.cap'

expect 0 "$SGM" fly "$city" --path stand.json --frames 400 --speed 60 --cell 0.5 --seed 1 --json
[[ $(hash_of) != "$stood" ]] || failed 'another seed shows the same city'

expect 0 "$SGM" fly "$city" --path back.json --frames "$frames" --speed 60 --cell 0.5 --check --json
json 'j.checked && j.commits > 3 && j.open_edges === 0 && j.nonmanifold_edges === 0 && j.overlaps === 0 && j.whole_failures === 0'
finish

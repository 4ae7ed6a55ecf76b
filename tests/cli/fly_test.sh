#!/usr/bin/env bash
# Tests sgm fly: during flights with edits the surface is closed in every frame, every flight sees the same world, and
# invalid calls are refused.
source "$(dirname "$0")/common.sh"
cave=$SOURCE/tests/bench/grammars/cave.sgm

# Three flights with teleports, given as "SPEED SEED [--unpaced]". Every frame is checked: 3,000 in all, far more in
# the long run. Paced flights change more drawn chunks; in unpaced flights, more frames pass before jobs end.
frames=1000
[[ -n ${SGM_LONG:-} ]] && frames=33400
for flight in "5 1 --unpaced" "20 2" "60 3 --unpaced"; do
  read -r speed seed pace <<<"$flight"
  expect 0 "$SGM" fly "$cave" --cell 0.5 --seed "$seed" --speed "$speed" --frames "$frames" --teleports 3 --finest 16 \
    --top-level 5 --view 200 --check --edits 5 --json $pace
  json "j.frames === $frames && j.commits > 3 && j.chunks_meshed > 300"
  json 'j.open_edges === 0 && j.nonmanifold_edges === 0 && j.degenerate_triangles === 0 && j.overlaps === 0'
  json 'j.flat_triangles === 0 && j.folded_triangles === 0 && j.self_intersections === 0 && j.cuts_between_parts === 0'
  [[ -n $pace ]] || json 'j.commits > 80 && j.chunks_meshed > 1500'
  json 'j.whole_checks >= 2 && j.whole_failures === 0'
  json 'j.peak_bytes.meshes > 1e6 && j.peak_bytes.meshes < 256 * 2 ** 20 && j.peak_bytes.meshes < j.peak_bytes.runtime'
  json 'j.peak_bytes.handed_over_per_frame.largest > 0'
  json 'j.peak_bytes.handed_over_per_frame.largest <= j.peak_bytes.handed_over_per_frame.cap'
  json 'j.colliders.count > 0 && j.peak_bytes.colliders > 0 && j.time_to_walkable_ms > 0'
  json 'j.colliders.missing === 0 && j.colliders.unlike === 0 && j.colliders.stray === 0'
  json "j.digs >= Math.floor(($frames - 60) / 12) - 1 && j.digs === j.edits && j.digs_by_kind.cuts > j.digs / 2"
  json 'j.dig_frames.max <= 2 && j.dig_frames.p50 <= j.dig_frames.p99 && j.dig_ms.p50 > 0 && j.dig_ms.p99 <= j.dig_ms.max'
  json 'j.work_at_teleports.length === 3'
  # The time until stale work is cancelled is measured only in paced flights, at 60 frames a second.
  [[ -z $pace ]] || json 'j.stale_after_2_frames === null'
  [[ -n $pace ]] || json 'j.work_at_teleports.every((n) => n === 0) === (j.stale_after_2_frames === null)'
  [[ -n $pace ]] || json '!j.stale_after_2_frames || j.stale_after_2_frames.median <= j.stale_after_2_frames.worst'
done

# A flight that reaches the same place by another path, at another speed and with another number of threads must find
# the same world there.
printf '{"points": [[96, 96, 96], [110, 96, 96], [120, 96, 100]]}' >path.json
printf '{"points": [[60, 96, 140], [120, 96, 100]]}' >other.json
small=(--cell 0.5 --seed 3 --finest 12 --top-level 3 --view 60 --unpaced --json)
expect 0 "$SGM" fly "$cave" "${small[@]}" --path path.json --speed 30 --frames 120 --threads 1
hash=$(node -p 'JSON.parse(require("fs").readFileSync(process.argv[1])).world_hash' "$work/.out")
expect 0 "$SGM" fly "$cave" "${small[@]}" --path other.json --speed 200 --frames 60 --threads 3
json "j.world_hash === '$hash'"
json 'j.main_thread_ms.p50 <= j.main_thread_ms.p99 && j.main_thread_ms.p99 <= j.main_thread_ms.max'
expect 0 "$SGM" fly "$cave" "${small[@]}" --speed 20 --frames 200 --compare
json 'j.finest_meshed_by_distance > j.finest_meshed && j.finest_saved > 0.2'
expect 0 "$SGM" fly "$cave" --cell 0.5 --seed 3 --frames 30 --unpaced --top-level 3 --view 60
out_has ' [0-9]+ frames of changes, '
# A flight of one frame ends before any chunk is meshed, and must report that nothing was drawn.
expect 0 "$SGM" fly "$cave" --cell 0.5 --seed 3 --path path.json --frames 1 --top-level 3 --view 60
out_has "the flight ended before anything was drawn"
err_empty

# Measures all chunks of a cave with edits, and of a world with sharp edges: there must be no defect, and the drawn
# surface must be closed.
sound='Object.values(j.measures.made.defects).length === 13'
sound+=' && Object.values(j.measures.made.defects).every((n) => n === 0)'
sound+=' && j.measures.made.bodies >= j.measures.drawn.bodies && j.measures.drawn.bodies > 0'
sound+=' && j.measures.drawn.area > 100 && j.measures.drawn.area_vector.every((a) => Math.abs(a) < 1e-6)'
sound+=' && j.measures.measuring_seconds > 0 && j.measures.meshing_seconds > 0'
expect 0 "$SGM" fly "$cave" "${small[@]}" --speed 20 --frames 200 --edits 5 --measure
json "$sound && j.measures.made.compared > 0"
expect 0 "$SGM" fly "$SOURCE/tests/bench/grammars/building.sgm" --sharp "${small[@]}" --speed 20 --frames 200 --measure
json "$sound"
expect 0 "$SGM" fly "$cave" --cell 0.5 --seed 3 --frames 100 --unpaced --top-level 3 --view 60 --measure
out_has 'no defects'

# Tests a world with sharp edges at every level, with edits.
expect 0 "$SGM" fly "$SOURCE/tests/bench/grammars/building.sgm" --sharp --cell 0.5 --seed 3 --speed 20 --frames 1000 \
  --finest 12 --top-level 3 --view 60 --check --edits 5 --unpaced --json
json 'j.commits > 5 && j.chunks_meshed > 100 && j.digs > 2'
json 'j.open_edges === 0 && j.nonmanifold_edges === 0 && j.self_intersections === 0 && j.whole_failures === 0'
# Where noise is as fine as the cells, some cells have no valid sharp edge and keep a rounded one. The number of these
# cells must be reported.
expect 0 "$SGM" fly "$cave" --sharp --cell 0.5 --seed 3 --frames 60 --unpaced
out_has 'edges +[0-9]+ cells keep rounded edges'
expect 0 "$SGM" fly "$cave" --cell 0.5 --seed 3 --frames 60 --unpaced --json
json 'j.rounded_cells === 0 && j.chunks_meshed > 100'

# Parameters change during the flight: in every frame the surface must be closed, and all chunks must show the same
# field.
expect 0 "$SGM" fly "$cave" "${small[@]}" --speed 20 --frames 400 --check --edits 5 --animate boxy wet
json 'j.fields >= 60 && j.fields_drawn > 0 && j.fields_drawn <= j.fields && j.chunks_outdated > 0 && j.chunks_outdated < j.chunks_meshed'
json 'j.open_edges === 0 && j.nonmanifold_edges === 0 && j.overlaps === 0 && j.whole_failures === 0'
expect 1 "$SGM" fly "$cave" "${small[@]}" --frames 10 --animate boxi
err_has '--animate.*did you mean `boxy`'
expect 1 "$SGM" fly "$cave" "${small[@]}" --frames 10 --animate
err_has 'declares no animated parameter'
sed 's/param boxy = 0.3 in 0..1/param boxy = 0.3 in 0..1 animated/; s/param wet = 50% in 0%..100%/param wet = 50%/' \
  "$cave" >tide.sgm
expect 0 "$SGM" fly tide.sgm "${small[@]}" --frames 40 --animate
json 'j.fields >= 5'
expect 1 "$SGM" fly tide.sgm "${small[@]}" --frames 10 --animate wet
err_has 'no range'
rm tide.sgm

# A second flight with the same journal and the same folder of chunks must load the edits and meshed chunks of the first
# one.
kept=(--path path.json --speed 10 --frames 180 --edits 4 --journal dug)
left=(bin dug path.json other.json one.json torn.json flat.json)
if [[ ${SGM_TEST_DISK_CACHE:-1} == 1 ]]; then
  kept+=(--cache chunks)
  left+=(chunks)
else
  expect 3 "$SGM" fly "$cave" --cache chunks --frames 10
  err_has 'SGM_DISK_CACHE'
  one_line
fi
expect 0 "$SGM" fly "$cave" "${small[@]}" "${kept[@]}"
json 'j.edits === 8'
json "j.world_hash !== '$hash'"
[[ ! -d chunks ]] || json 'j.cache.misses > 100 && j.cache.damaged === 0 && j.peak_bytes.disk_cache > 1e4'
expect 0 "$SGM" fly "$cave" "${small[@]}" "${kept[@]}"
json 'j.edits === 16 && j.digs === 8'
[[ ! -d chunks ]] || json 'j.cache.hits > 100'
expect 0 "$SGM" fly "$cave" --cell 0.5 --seed 3 --path path.json --frames 120 --top-level 3 --view 60 --edits
out_has 'digs +1 '

# encoder LINE: creates a fake `ffmpeg` that runs this line of shell; $file is the output file.
encoder() {
  mkdir -p bin
  printf '#!/usr/bin/env bash\nfor word; do file=${word#file:}; done\n%s\n' "$1" >bin/ffmpeg
  chmod +x bin/ffmpeg
}
video=(--cell 1 --seed 3 --path path.json --top-level 2 --view 40 --unpaced --json --levels --video flight.mp4)
expect 3 timeout 120 env PATH="$work/none" "$SGM" fly "$cave" "${video[@]}" --frames 99999999
err_has 'ffmpeg'
one_line
expect 0 "$SGM" backends --json
if node -e 'process.exit(JSON.parse(require("fs").readFileSync(process.argv[1])).vulkan_devices.length ? 0 : 1)' "$work/.out"; then
  # CPU and Vulkan device must give the same world, and the compiled shaders must be cached. The grammar has few kinds
  # of shapes, since software Vulkan takes seconds to compile each; the world is hashed when all chunks are complete.
  {
    echo 'sgm 1; units m; domain infinite; layer l cell 16m reach 1m { start Balls; }'
    echo 'rule Balls { for x in 0..1 { for z in 0..1 { at(4m+8m*x, 8m, 4m+8m*z) sphere(2.6m); } } }'
  } >balls.sgm
  balls=(balls.sgm --cell 0.5 --finest 12 --top-level 2 --view 40 --path path.json --speed 10 --frames 30 --unpaced --json)
  expect 0 "$SGM" fly "${balls[@]}" --backend cpu
  json 'j.backend === "cpu" && j.on_device.chunks === 0'
  hash=$(node -p 'JSON.parse(require("fs").readFileSync(process.argv[1])).world_hash' "$work/.out")
  expect 0 "$SGM" fly "${balls[@]}" --backend vulkan
  json "j.world_hash === '$hash' && j.world_hash !== '0000000000000000'"
  json 'j.backend === "vulkan" && j.device !== "" && j.on_device.chunks > 0 && j.on_device.losses === 0'
  [[ $(head -c 4 .cache/sgm/pipelines/vulkan-*.cache) == SGMP ]] || failed "no pipelines are kept"
  rm balls.sgm
  encoder 'wc -c >"$file"; printf "%s " "$@" >>"$file"'
  expect 0 env PATH="$work/bin:$PATH" "$SGM" fly "$cave" "${video[@]}" --frames 3
  [[ $(<flight.mp4) == "$((2 * 640 * 360 * 4))"*' -s 640x360 -r 30 '* ]] || failed "the video is not two pictures"
  rm flight.mp4
  # Tests pictures: even the first one must not be black; the light (sun or lamp) must suit the place and stay the same.
  cat >yards.sgm <<'END'
sgm 1;
units m;
domain infinite axes xz empty;
layer ground cell 32m reach 4m { start Ground; }
layer blocks cell 32m reach 16m { start Block; }
rule Ground { at(16m, -1m, 16m) box(33m, 2m, 33m); mat slate; }
rule Block { at(16m, 6m, 16m) box(22m, 12m, 22m); mat plaster; }
END
  printf '{"points": [[0, 2, 0], [0, 3, 60]]}' >street.json
  sheet=(--cell 1 --finest 16 --top-level 2 --view 60 --speed 10 --out sheet.png --json)
  for flight in "sun 150 yards.sgm --path street.json --frames 2" "lamp 20 $cave --seed 3 --frames 2" \
    "lamp 20 $cave --seed 3 --frames 40 --teleports 1 --unpaced"; do
    read -r light least flight <<<"$flight"
    expect 0 "$SGM" fly "${sheet[@]}" --png 2 $flight
    json "j.pictures_by.$light === 2 && j.pictures_by.sun + j.pictures_by.lamp + j.pictures_by.none === 2"
    for corner in "8 8" "656 8"; do
      read -r mean _ < <(node "$SOURCE/tests/cli/png.js" sheet.png $corner 640 360)
      ((mean >= least)) || failed "the picture at $corner has a mean of $mean"
    done
  done
  expect 0 "$SGM" fly "${sheet[@]}" --png 1 yards.sgm --path street.json --frames 2 --light lamp
  json 'j.pictures_by.lamp === 1'
  expect 2 "$SGM" fly "${sheet[@]}" --png 1 yards.sgm --path street.json --frames 2 --light lamp --levels
  rm sheet.png street.json yards.sgm
  encoder 'head -c 1000000 >"$file"; echo "first words" >&2; echo "no room for a film" >&2; exit 7'
  expect 4 timeout 120 env PATH="$work/bin:$PATH" "$SGM" fly "$cave" "${video[@]}" --frames 99999999
  err_has 'status 7: no room for a film'
  one_line
  # Tests an encoder that reads all pictures and then fails, and an encoder that writes no file.
  encoder 'cat >"$file"; exit 7'
  expect 4 env PATH="$work/bin:$PATH" "$SGM" fly "$cave" "${video[@]}" --frames 1
  encoder 'cat >/dev/null'
  expect 4 env PATH="$work/bin:$PATH" "$SGM" fly "$cave" "${video[@]}" --frames 1
  one_line
else
  [[ -z ${SGM_REQUIRE_ALL:-} ]] || failed "a Vulkan device is required here"
  echo "no Vulkan device: videos are left out"
  encoder 'cat >"$file"'
  expect 3 env PATH="$work/bin:$PATH" "$SGM" fly "$cave" "${video[@]}" --frames 3
  one_line
fi

# Errors must be reported in one line, and leave no files.
printf '{"points": [[0, 0, 0]]}' >one.json
printf '{"points": ' >torn.json
printf '{"points": [[0, 0, 0], [1, 2]]}' >flat.json
for path in one torn flat missing; do
  run "$SGM" fly "$cave" --path "$path.json" --frames 10
  [[ $status == 1 || $status == 4 ]] || failed "status 1 or 4 expected"
  one_line
done
expect 4 "$SGM" fly "$cave" --path nowhere.json --frames 10
err_has 'cannot read nowhere.json: no such file'
expect 2 "$SGM" fly "$cave" --path path.json --teleports 2
err_has 'usage'
expect 2 "$SGM" fly "$cave" --frames 0
expect 2 "$SGM" fly "$cave" --out sheet.png
# On a full disk, simulated by a limit on file sizes, the flight must end normally and report what was not saved.
full=(--path path.json --speed 10 --frames 120 --edits 60 --journal full)
expect 4 bash -c 'set -o pipefail; trap "" XFSZ; (ulimit -f 1; exec "$@") | cat' - "$SGM" fly "$cave" "${small[@]}" "${full[@]}"
json 'j.edits > 20'
err_has "sgm: error: journal '.*full': File too large; ([0-9]+) edits are not saved$"
(($(grep -c 'edits are not saved' <<<"$err") >= 1)) || failed 'it is told at the end, and before if the flight goes on'
unkept=${BASH_REMATCH[1]} edits=$(sed -n 's/.*"edits": \([0-9]*\),.*/\1/p' <<<"$out" | head -n 1)
((unkept > 0 && unkept < edits)) || failed "$unkept of $edits edits not kept"
rm full
expect 1 "$SGM" fly "$cave" --mesh-mb 1 --frames 10
err_has 'mesh_bytes'
expect 2 "$SGM" fly "$cave" --edits 61
expect 2 "$SGM" fly "$cave" --video flight.avi
expect 2 "$SGM" fly "$cave" --compare --journal dug
# An output file that cannot be written must be reported before the flight.
unwritable=("--png 2 --out nowhere/flight.png" "--video nowhere/flight.mp4" "--journal nowhere/dug")
[[ ${SGM_TEST_DISK_CACHE:-1} == 1 ]] && unwritable+=("--cache path.json")
for wrong in "${unwritable[@]}"; do
  expect 4 timeout 120 env PATH="$work/bin:$PATH" "$SGM" fly "$cave" --frames 99999999 --unpaced $wrong
  one_line
done
expect 1 "$SGM" fly "$cave" --seed 4 --frames 10 --journal dug
err_has 'journal'
only "${left[@]}"
finish

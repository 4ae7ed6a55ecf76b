#!/usr/bin/env bash
# sgm fly: flights whose every frame is closed, the same world whoever flies, and what it refuses.
source "$(dirname "$0")/common.sh"
cave=$SOURCE/samples/grammars/cave.sgm

# SPEED SEED PACE: every frame checked, with leaps. Three of them are 3,000 frames; --long flies further. Paced flights
# see more of what is drawn change, the others more frames at odds with the jobs.
frames=1000
[[ -n ${SGM_LONG:-} ]] && frames=33400
for flight in "5 1 --unpaced" "20 2" "60 3 --unpaced"; do
  read -r speed seed pace <<<"$flight"
  expect 0 "$SGM" fly "$cave" --cell 0.5 --seed "$seed" --speed "$speed" --frames "$frames" --teleports 3 --finest 16 \
    --top-level 5 --view 200 --check --json $pace
  json "j.frames === $frames && j.commits > 10 && j.chunks_meshed > 500"
  json 'j.open_edges === 0 && j.nonmanifold_edges === 0 && j.degenerate_triangles === 0 && j.overlaps === 0'
  [[ -n $pace ]] || json 'j.commits > 80 && j.chunks_meshed > 1500'
  json 'j.whole_checks >= 2 && j.whole_failures === 0'
  json 'j.peak_bytes.meshes > 1e6 && j.peak_bytes.meshes < 256 * 2 ** 20'
done

# The same place by another way, at another speed, with other threads.
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
out_has 'changes of what is drawn'
err_empty

# What is wrong is said in one line, and nothing is left behind.
printf '{"points": [[0, 0, 0]]}' >one.json
printf '{"points": ' >torn.json
printf '{"points": [[0, 0, 0], [1, 2]]}' >flat.json
for path in one torn flat missing; do
  run "$SGM" fly "$cave" --path "$path.json" --frames 10
  [[ $status == 1 || $status == 4 ]] || failed "status 1 or 4 expected"
  one_line
done
expect 2 "$SGM" fly "$cave" --path path.json --teleports 2
err_has 'usage'
expect 2 "$SGM" fly "$cave" --frames 0
expect 2 "$SGM" fly "$cave" --out sheet.png
expect 1 "$SGM" fly "$cave" --mesh-mb 1 --frames 10
err_has 'mesh_bytes'
only path.json other.json one.json torn.json flat.json
finish

#!/usr/bin/env bash
# Tests sgm bake and sgm store: a bake has the same bytes however the work is divided, a world streamed from it is the
# same as a derived one, and invalid calls are refused.
source "$(dirname "$0")/common.sh"
cave=$SOURCE/tests/bench/grammars/cave.sgm
if [[ ${SGM_TEST_DISK_CACHE:-1} == 0 ]]; then
  expect 3 "$SGM" bake "$cave" --region 0,0,0:8,8,8 --out store
  err_has 'SGM_DISK_CACHE=ON'
  one_line
  finish
  exit
fi
world=("$cave" --seed 3 --region 0,0,0:192,160,192 --levels 0..5 --backend cpu)

expect 0 "$SGM" bake "${world[@]}" --out one --json
json 'j.tiles > 10 && j.chunks > 1000 && j.triangles > 50000 && j.sound'
json 'j.bytes_per_triangle > 1 && j.bytes_per_triangle < 12 && j.contents < j.chunks'
name=$(node -p 'JSON.parse(require("fs").readFileSync(process.argv[1])).world' "$work/.out")
expect 0 "$SGM" bake "${world[@]}" --out one
out_has 'already baked'

# After one worker was killed in the middle of its work, three workers run concurrently; the result must be the same.
expect 0 "$SGM" bake "${world[@]}" --out many --shard 5/50
timeout -s KILL 0.15 "$SGM" bake "${world[@]}" --out many --shard 1/3 --threads 1 >/dev/null 2>&1
expect 1 "$SGM" bake "${world[@]}" --out many --merge
err_has 'tiles are not baked yet'
one_line
for shard in 2 0 1; do "$SGM" bake "${world[@]}" --out many --shard "$shard/3" >"shard$shard.txt" 2>&1 & done
wait
# The result must not depend on file times, since these come from the clocks of the workers' machines.
find many -type f | awk 'NR % 2' | xargs touch -d 2099-01-01
find many -type f | awk 'NR % 2 == 0' | xargs touch -d 1971-01-01
expect 0 "$SGM" bake "${world[@]}" --out many --shard 1/3 --json
json 'j.made === 0 && j.made_before === j.tiles && j.tiles > 0'
expect 0 "$SGM" bake "${world[@]}" --out many --merge
expect 0 diff -r one many
rm -rf shard?.txt many

expect 0 "$SGM" store info one --json
json "j.worlds.length === 1 && j.worlds[0].world === '$name' && j.worlds[0].levels.join() === '0,5'"
expect 0 node -e '
  const m = JSON.parse(require("fs").readFileSync(process.argv[1]));
  if (m.seed !== 3 || m.grammar.file !== "cave.sgm" || !m.grammar.text.includes("sgm 1") || m.levels[1] !== 5 ||
      Object.values(m.defects).some((n) => n !== 0) || m.parameters.boxy !== 0.3) process.exit(1);' "one/worlds/$name.json"
expect 0 "$SGM" store verify one --json
json 'j.worlds[0].problems === 0 && j.worlds[0].borders > 100 && j.worlds[0].contents > 100'
expect 0 "$SGM" store verify one "$cave" --seed 3 --region 0,0,0:1,1,1 --samples 20 --backend cpu --json
json 'j.worlds[0].problems === 0 && j.baked_again.chunks === 20 && j.baked_again.problems === 0'
expect 1 "$SGM" store verify one "$cave" --seed 4 --region 0,0,0:1,1,1
err_has 'no bake of .*cave.sgm. with this seed'
one_line
expect 0 "$SGM" store info one --json
json 'j.worlds[0].from.grammar === "cave.sgm" && j.worlds[0].from.seed === 3 && j.worlds[0].from.parameters.boxy === 0.3'

# A store without its pack files must fail verification, with and without a grammar.
cp -r one bare
rm -r bare/packs
expect 1 "$SGM" store verify bare "$cave" --seed 3 --region 0,0,0:1,1,1 --samples 5 --backend cpu
err_has 'bake the world again'
rm bare/worlds/*.sgmi
expect 1 "$SGM" store verify bare
err_has 'no worlds to verify'
one_line
expect 0 "$SGM" store gc bare
[[ -z $(ls bare/worlds) ]] || failed "a manifest stays without its index"
rm -r bare

# A world streamed from the store must be the same as a derived one, also with edits on top.
printf '{"points": [[40, 60, 60], [110, 96, 96], [120, 96, 100]]}' >path.json
flight=(fly "$cave" --seed 3 --path path.json --speed 60 --frames 150 --finest 16 --top-level 5 --view 120 --unpaced --check
  --backend cpu --json)
declare -A hashes
for digs in 0 4; do
  expect 0 "$SGM" "${flight[@]}" --edits "$digs"
  json 'j.open_edges === 0 && j.stores.hits === 0'
  hash=$(node -p 'JSON.parse(require("fs").readFileSync(process.argv[1])).world_hash' "$work/.out")
  expect 0 "$SGM" "${flight[@]}" --edits "$digs" --store one
  hashes[$digs]=$hash
  json "j.world_hash === '$hash' && j.open_edges === 0 && j.stores.hits > 500 && j.stores.damaged === 0 && j.stores.bytes > 0"
done

# If parts of a store are damaged, their chunks must be derived instead.
for pack in one/packs/*/*.sgmp; do printf 'xxxxxxxx' | dd of="$pack" bs=1 seek=64 conv=notrunc 2>/dev/null; done
expect 0 "$SGM" "${flight[@]}" --edits 0 --store one
json "j.world_hash === '${hashes[0]}' && j.stores.damaged > 0 && j.open_edges === 0"
expect 1 "$SGM" store verify one
err_has 'is damaged: remove it, and bake the world again'
expect 0 "$SGM" store gc one
rm one/packs/*/*.sgmp
expect 0 "$SGM" "${flight[@]}" --edits 4 --store one
json "j.world_hash === '${hashes[4]}' && j.stores.damaged > 0 && j.open_edges === 0"
expect 0 "$SGM" bake "${world[@]}" --out one
out_has ' 0 of them baked before'
expect 0 "$SGM" store verify one

expect 0 "$SGM" bake "$cave" --seed 3 --region 0,0,0:32,32,32 --levels 0 --cell 0.25 --backend cpu --out finer
expect 1 "$SGM" store diff one finer
err_has 'have cells of'
one_line
rm -r finer

# Bakes a second time into the same store, with one parameter changed: equal contents must be stored only once.
small=("$cave" --seed 3 --region 192,0,0:384,192,192 --levels 1..2 --backend cpu)
expect 0 "$SGM" bake "${small[@]}" --out two
expect 0 "$SGM" bake "${small[@]}" --set boxy=0.9 --out two --json
json 'j.new_bytes > 0 && j.new_bytes < j.pack_bytes / 2'
expect 0 "$SGM" store info two --json
json 'j.worlds.length === 2'
read -r first second <<<"$(node -p 'JSON.parse(require("fs").readFileSync(process.argv[1])).worlds.map((w) => w.world).join(" ")' "$work/.out")"
expect 0 "$SGM" store diff two two --from "$first" --to "$second" --json
json 'j.changed === j.chunks.length && j.added === 0 && j.removed === 0 && j.changed > 0 && j.changed < 20 && j.bytes > 0'
expect 0 "$SGM" store diff two two --from "$first" --to "$first"
out_has '^0 chunks changed, 0 added, 0 removed; 0.00 MB'
expect 1 "$SGM" store diff two two
err_has '2 worlds: choose one'
rm two/worlds/"$second".*
expect 0 "$SGM" store gc two
[[ -z $err ]] || failed "words of nothing: $err"
expect 0 "$SGM" store verify two

# While one process holds the store's lock, a second process that changes the store must wait and report that.
exec {held}<two/format
flock "$held"
(sleep 1 && flock -u "$held") &
expect 0 "$SGM" store gc two
err_has 'waiting for it'
one_line
exec {held}<&-
wait

# Starts the shards by hand, as a job scheduler other than Slurm would.
PATH=$(dirname "$SGM"):$PATH
for share in 1 2; do SGE_TASK_ID=$share expect 0 bash "$SOURCE/samples/bake/share.sh" 2 sgm bake "${small[@]}" --out three; done
expect 0 bash "$SOURCE/samples/bake/share.sh" end sgm bake "${small[@]}" --out three
out_has 'complete and closed'
expect 2 bash "$SOURCE/samples/bake/share.sh" 2 sgm bake "${small[@]}" --out three
err_has 'set SHARE, from 0 to 1'

# Invalid calls must be refused with a one-line message, and leave no files.
expect 1 "$SGM" bake "$cave" --seed 3 --region 0,0,0:64,64,64 --levels 0..2 --backend cpu --out one
err_has 'has another region of this world'
one_line
expect 1 "$SGM" bake "${small[@]}" --out nowhere --merge
err_has 'is not a store of baked worlds'
printf 'xx' >one/worlds/damaged.sgmi
expect 1 "$SGM" store verify one
err_has 'damaged.sgmi.*remove it, and bake its world again'
out_has 'complete and closed'
rm one/worlds/damaged.sgmi
mkdir taken && touch taken/file
for line in "1:taken:is neither empty nor a store" "1:old:store of another version"; do
  IFS=: read -r wanted folder message <<<"$line"
  [[ $folder != old ]] || { mkdir old && echo "sgm store 99" >old/format; }
  expect "$wanted" "$SGM" bake "${small[@]}" --out "$folder"
  err_has "$message"
  one_line
done
expect 1 "$SGM" fly "$cave" --frames 1 --unpaced --store taken
err_has 'is not a store of baked worlds'
for options in "--shard 3/3" "--shard x" "--levels 3..1" "--levels 0..99" "--merge --shard 0/2"; do
  # shellcheck disable=SC2086
  expect 2 "$SGM" bake "${small[@]}" --out new $options
done
expect 2 "$SGM" bake "$cave" --out new
err_has 'choose a part with --region'
expect 1 "$SGM" bake "$cave" --region -2000000,-2000000,-2000000:2000000,2000000,2000000 --out new
err_has 'more than 4194304 tiles'
# Simulates a full disk by a limit on file sizes.
expect 4 bash -c 'trap "" XFSZ; ulimit -f 8; exec "$@"' bash "$SGM" bake "${small[@]}" --out full
one_line
expect 0 "$SGM" bake "${small[@]}" --out full
expect 0 "$SGM" store verify full
only full old one path.json taken three two
finish

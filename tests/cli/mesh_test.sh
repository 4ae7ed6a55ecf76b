#!/usr/bin/env bash
# Tests sgm mesh: its output, the files that it writes, and the calls that it refuses.
source "$(dirname "$0")/common.sh"
ball >ball.sgm
cave=$SOURCE/tests/bench/grammars/cave.sgm

expect 0 "$SGM" mesh ball.sgm --out ball.glb --region=-4,-4,-4:4,4,4 --cell 0.25 --json
json 'j.triangles > 1000 && j.vertices > 500 && j.chunks === 8 && j.seconds > 0 && /^[0-9a-f]{16}$/.test(j.hash)'
json 'j.cell === 0.25 && j.cell_units === 256 && j.seed === 0 && j.out === "ball.glb" && j.backend === "cpu"'
json 'Math.abs(j.area - 4 * Math.PI * 9) < 1 && Math.abs(j.volume - 36 * Math.PI) < 3 && j.objects === 1'
json 'j.region[0].join() === "-8,-8,-8" && j.region[1].join() === "8,8,8"'
json "j.bytes === $(stat -c %s ball.glb)"
json 'Math.abs(j.volume + j.void_volume - 16 ** 3) < 1e-6 && Math.abs(j.cubes.solid + j.cubes.void - 16 ** 3) < 1e-6'
json 'Math.abs(j.cubes.solid - 36 * Math.PI) < 6 && j.cubes.solid !== j.volume && j.cubes.edge === 0.25'
[[ $(head -c 4 ball.glb) == glTF ]] || failed "no GLB"
err_empty
for format in obj ply stl GLB; do
  expect 0 "$SGM" mesh ball.sgm --out "ball.$format" --region=-4,-4,-4:4,4,4
  [[ -s ball.$format ]] || failed "no ball.$format"
  out_has triangles
done
rm -f ball.glb ball.obj ball.mtl ball.ply ball.stl ball.GLB

# With texture coordinates, the triangles must stay the same; formats without texture coordinates must be refused.
expect 0 "$SGM" mesh ball.sgm --out plain.glb --json
json 'j.texture === null'
plain=$(node -p 'JSON.parse(require("fs").readFileSync(process.argv[1])).hash' "$work/.out")
expect 0 "$SGM" mesh ball.sgm --out ball.glb --uv --json
json "j.hash === '$plain'"
json 'j.texture.wedges > j.vertices && j.texture.seams > 0 && j.texture.seams < 0.5'
json 'j.texture.density.p5 > 0.6 && j.texture.density.p95 < 1.3 && j.texture.density.p50 > 0.8 && j.texture.density.p50 < 1.1'
grep -q TEXCOORD_0 ball.glb || failed "no TEXCOORD_0"
grep -q TEXCOORD_0 plain.glb && failed "TEXCOORD_0 without --uv"
expect 0 "$SGM" mesh ball.sgm --out ball.obj --uv
out_has 'texture +tiles of 1 m are [0-9.]+ to [0-9.]+ times'
grep -q '^vt ' ball.obj && grep -Eq '^f [0-9]+/[0-9]+/[0-9]+ ' ball.obj || failed "no vt in the .obj"
for format in ply stl; do
  expect 2 "$SGM" mesh ball.sgm --out "ball.$format" --uv
  err_has '\.glb and \.obj'
  one_line
done
rm -f plain.glb ball.glb ball.obj ball.mtl

# With sharp features, a box must get more vertices at its edges, and the same bytes with any number of threads; a ball
# must not change.
echo 'sgm 1; units m; start Box; rule Box { rot(y, 30deg) rot(x, 20deg) box(4m, 4m, 4m); }' >box.sgm
expect 0 "$SGM" mesh box.sgm --out box.ply --region=-4,-4,-4:4,4,4 --cell 0.5 --json
json 'j.area < 95.5 && j.objects === 1'
expect 0 "$SGM" mesh box.sgm --out sharp.ply --region=-4,-4,-4:4,4,4 --cell 0.5 --sharp --threads 1 --json
json 'Math.abs(j.area - 96) < 0.01 && j.objects === 1'
expect 0 "$SGM" mesh box.sgm --out again.ply --region=-4,-4,-4:4,4,4 --cell 0.5 --sharp --threads 3 --json
cmp -s sharp.ply again.ply || failed "--sharp depends on threads"
for sharp in '' --sharp; do
  expect 0 "$SGM" mesh ball.sgm --out "ball$sharp.ply" --region=-4,-4,-4:4,4,4 --cell 0.25 $sharp
done
cmp -s ball.ply ball--sharp.ply || failed "--sharp changes a ball"
rm -f box.sgm box.ply sharp.ply again.ply ball.ply ball--sharp.ply

# An .obj must be written with its .mtl, and this must be reported; a .mtl file of another program must not be
# overwritten.
expect 0 "$SGM" mesh ball.sgm --out ball.obj
out_has '^ball\.obj, ball\.mtl: [0-9]+ triangles'
expect 0 "$SGM" mesh ball.sgm --out ball.obj --json
json 'j.out === "ball.obj" && j.files.join() === "ball.obj,ball.mtl"'
json "j.bytes === $(cat ball.obj ball.mtl | wc -c)"
printf '# Blender 3.4.1 MTL File\nnewmtl Skin\n' >ball.mtl
cp ball.mtl theirs
cp ball.obj before
expect 4 "$SGM" mesh ball.sgm --out ball.obj --cell 0.25
one_line
err_has "cannot write 'ball.mtl'"
cmp -s ball.mtl theirs && cmp -s ball.obj before || failed "a file of somebody else's was touched"
rm ball.obj ball.mtl theirs before

# A file name that is not UTF-8 must be used unchanged; JSON must have replacement characters instead.
name=$(printf 'b\xe4ll.glb')
expect 0 "$SGM" mesh ball.sgm --out "$name" --json
json 'j.out === "b\ufffdll.glb"'
[[ -s $name ]] || failed "no file of that name"
rm "$name"

# For an empty mesh, the message must give possible reasons and advice.
empty() {
  local why=$1
  shift
  printf '%s\n' "$1" >empty.sgm
  shift
  expect 0 "$SGM" mesh empty.sgm "$@"
  out_has '^0 triangles'
  [[ $err == "sgm: warning: no triangles: $why" ]] || failed "another reason is expected: $why"
  expect 0 "$SGM" mesh empty.sgm "$@" --json
  json 'j.triangles === 0'
}
empty 'no shape lies in this region: the shapes may lie elsewhere (choose another --region), or be left out (see the warnings)' \
  'sgm 1; start A; rule A { sphere(2m); }' --region 90,0,0:99,9,9
empty 'nothing is cut from the rock in this region: the shapes may lie elsewhere (choose another --region), or be left out (see the warnings)' \
  'sgm 1; domain infinite solid rock; layer a cell 64m reach 9m { start A; } rule A { cut sphere(2m); }' --region 20,20,20:30,30,30
empty 'this region lies entirely inside the solid: choose a larger --region' \
  'sgm 1; start A; rule A { box(300m); }' --region 9,9,9:10,10,10
empty 'the shapes here are thinner than a cell of 1 m: choose smaller cells with --cell' \
  'sgm 1; start A; rule A { at(30cm, 30cm, 30cm) sphere(5cm); }' --cell 1
empty 'all shapes are cut away here, or thinner than a cell of 0.5 m: check the cuts, or choose smaller cells with --cell' \
  'sgm 1; start A; rule A { sphere(2m); cut box(9m); }'
empty 'all cuts are filled again here, or thinner than a cell of 0.5 m: check the cuts, or choose smaller cells with --cell' \
  'sgm 1; domain infinite solid rock; layer a cell 64m reach 9m { start A; } rule A { cut { sphere(2m); cut box(9m); } }' --region=-4,-4,-4:4,4,4
rm empty.sgm
echo 'sgm 1; start A; rule A { size(9m, 3m, 9m) { box(scope); cut treemap(wall 0.15m) { a 3: { } b 4: { } } } }' >rooms.sgm
expect 0 "$SGM" mesh rooms.sgm --cell 0.25
[[ ${err%%$'\n'*} == 'rooms.sgm:1:61: warning: the walls of this treemap, 0.15 m, are thinner than a cell of 0.25 m, and may have holes or be missing: choose smaller cells, such as --cell 0.075' ]] ||
  failed 'nothing is said of thin walls'
expect 0 "$SGM" mesh rooms.sgm --cell 0.125
err_empty
rm rooms.sgm

# The reported volume must be that of the solid inside the region, whether the border cuts the solid or not, with and
# without --sharp.
printf 'sgm 1;\nstart A;\nrule A { box(10m, 1m, 10m); }\n' >slab.sgm
for sharp in '' --sharp; do
  expect 0 "$SGM" mesh slab.sgm --cell 0.1 $sharp --json
  json 'Math.abs(j.volume - 100) < 1'
  expect 0 "$SGM" mesh slab.sgm --cell 0.1 $sharp --region=0,-3,-6:6,3,0 --json
  json 'j.cut && Math.abs(j.volume - 25) < 0.25'
done
rm slab.sgm
expect 0 "$SGM" mesh "$cave" --region 64,64,64:128,128,128 --cell 1 --json
json 'j.volume > 64 ** 3 / 2 && j.volume < 64 ** 3 && Math.abs(j.volume / j.cubes.solid - 1) < 0.01'

# If the region has too many chunks, the message must suggest a cell size that works.
for level in 0 2; do
  expect 1 "$SGM" mesh ball.sgm --cell 0.01 --max-chunks 10 --level $level --region=-4,-4,-4:4,4,4
  one_line
  err_has '^sgm: error: the region has [0-9]+ chunks with cells of [0-9.]+ m, more than 10: .*--cell ([0-9.]+) fits'
  expect 0 "$SGM" mesh ball.sgm --cell "${BASH_REMATCH[1]}" --max-chunks 10 --level $level --region=-4,-4,-4:4,4,4
done
expect 1 "$SGM" measure ball.sgm --cell 0.01 --max-chunks 10 --radius 1
err_has '--cell 0.[0-9]+ fits'

# A coarser level must have cells of twice the edge and chunks of twice the size.
expect 0 "$SGM" mesh ball.sgm --cell 0.25 --level 1 --json
json 'j.level === 1 && j.cell === 0.5 && j.cell_units === 512 && j.region[0].join() === "-16,-16,-16"'
json 'Math.abs(j.volume - 36 * Math.PI) < 6'
out_level=$out
expect 0 "$SGM" mesh ball.sgm --cell 0.5 --json
json "j.triangles === $(sed -n 's/.*"triangles": \([0-9]*\).*/\1/p' <<<"$out_level")"
expect 2 "$SGM" mesh ball.sgm --level 17
expect 2 "$SGM" mesh ball.sgm --level -1

# Far from the world's origin, positions must be relative to the region's corner, and the report must say so.
expect 0 "$SGM" mesh ball.sgm --json
json 'j.origin.join() === "0,0,0" && j.origin_units.join() === "0,0,0"'
expect 0 "$SGM" mesh ball.sgm --region 5000,0,0:5001,1,1
out_has '  origin   4992,0,0 m: positions count from here'
expect 0 "$SGM" mesh ball.sgm --region 5000,0,0:5001,1,1 --json
json 'j.origin.join() === "4992,0,0" && j.origin_units[0] === 4992 * 1024'
only ball.sgm

# The mesh must not depend on the number of threads, but on seed and parameters.
hash() { sed -n 's/.*"hash": "\([0-9a-f]*\)".*/\1/p' <<<"$out"; }
expect 0 "$SGM" mesh "$cave" --region 64,64,112:96,96,144 --seed 7 --json --threads 1
first=$(hash)
expect 0 "$SGM" mesh "$cave" --region 64,64,112:96,96,144 --seed 7 --json --threads 3
[[ $(hash) == "$first" ]] || failed "the hash depends on threads"
expect 0 "$SGM" mesh "$cave" --region 64,64,112:96,96,144 --seed 8 --json
[[ $(hash) != "$first" ]] || failed "the seed does not matter"
expect 0 "$SGM" mesh ball.sgm --region=-4,-4,-4:4,4,4 --set radius=2m --json
json 'Math.abs(j.area - 16 * Math.PI) < 1.5'
radius_2m=$(hash)
# The grammar has `units m`, so a value of 2 without a unit must mean 2 m.
expect 0 "$SGM" mesh ball.sgm --region=-4,-4,-4:4,4,4 --set radius=2 --json
[[ $(hash) == "$radius_2m" ]] || failed "a bare length is not in the file's units"
expect 0 "$SGM" mesh ball.sgm --region=-4,-4,-4:4,4,4 --ld 10 --json
json 'j.cell_units === 102 && Math.abs(j.cell - 0.099609375) < 1e-12'
# A finite world must need no --region.
expect 0 "$SGM" mesh ball.sgm --json
json 'Math.abs(j.area - 4 * Math.PI * 9) < 2'
only ball.sgm

# Invalid input must give status 1 and a one-line message, and leave no file.
wrong() {
  expect 1 "$SGM" mesh ball.sgm --out wrong.glb "$@"
  err_has '^sgm: error: .'
  one_line
  out_empty
  only ball.sgm
}
region=--region=-4,-4,-4:4,4,4
wrong $region --cell 0
err_has '--cell: '
wrong $region --cell -1
wrong $region --cell nan
wrong $region --cell 1e-9
wrong $region --cell 1e12
wrong $region --cell inf
wrong $region --ld 0
err_has '--ld: '
wrong $region --ld inf
err_has '--ld: .* not a finite number above 0'
wrong $region --ld -3
wrong $region --ld 1e9
err_has '--ld: 1000000000 cells per metre'
wrong --region 0,0,0:1e300,1,1
wrong --region 0,0,0:1e999,1,1
wrong --region 0,0,0:nan,1,1
wrong --region 3000000,0,0:3000001,1,1
wrong --region 2097150,0,0:2097152,1,1
wrong --region 2097151,0,0:2097152,1,1
err_has '2097152 m lies outside the world, which reaches from -2097152 m to 2097151.999 m'
wrong --region 0,0,0:0,1,1
wrong --region 4,4,4:-4,-4,-4
wrong $region --cell 0.01 --max-chunks 10
wrong --region=-2000000,-2000000,-2000000:2000000,2000000,2000000
wrong $region --set radius=9m
wrong $region --set radius=20
wrong $region --set radius=2deg
wrong $region --set radius=
wrong $region --set raduis=2m
err_has 'did you mean `radius`\?; it has radius'
wrong $region --set no_such_name=2m
err_has "no parameter 'no_such_name'; it has radius"
wrong $region --set =

# Invalid options must give status 2.
usage() {
  expect 2 "$SGM" mesh "$@"
  err_has '^sgm: usage: .'
  out_empty
  only ball.sgm
}
usage
usage ball.sgm --region 1,2:3,4
usage ball.sgm --region 0,0,0
usage ball.sgm --region 0,0,0:1,1,x
usage ball.sgm --set radius
usage ball.sgm --out ball.blend
usage ball.sgm --out noextension
usage ball.sgm --seed -1
usage ball.sgm --seed one
usage ball.sgm --cell 1 --ld 2
usage ball.sgm --backend metal
usage ball.sgm --threads -2
usage ball.sgm --max-chunks many
usage ball.sgm --max-chunks -1
usage "$cave" --out cave.glb  # error: an infinite world needs --region

# A backend that is not available must give status 3.
refused() {
  expect 3 "$SGM" mesh ball.sgm --out wrong.glb --backend "$1"
  one_line
  only ball.sgm
}
refused cuda

# A Vulkan device, at least lavapipe, must write the same file as the CPU.
expect 0 "$SGM" backends --json
if node -e 'process.exit(JSON.parse(require("fs").readFileSync(process.argv[1])).backends[1].usable ? 0 : 1)' "$work/.out"; then
  expect 0 "$SGM" mesh ball.sgm $region --out cpu.glb --backend cpu
  expect 0 "$SGM" mesh ball.sgm $region --out vulkan.glb --backend vulkan --json
  json 'j.backend === "vulkan" && j.triangles > 100'
  cmp cpu.glb vulkan.glb || failed "the two backends' files differ"
  rm cpu.glb vulkan.glb
else
  [[ -z ${SGM_REQUIRE_ALL:-} ]] || failed "a Vulkan device is required here"
  refused vulkan
fi

# Files that cannot be read or written must give status 4 and a one-line message, and leave no file.
unwritable() {
  expect 4 "$SGM" mesh ball.sgm $region --out "$1"
  err_has '^sgm: error: cannot write '
  one_line
  out_empty
}
unwritable ball.sgm/under_a_file.glb
unwritable nowhere/ball.glb
mkdir folder.glb
unwritable folder.glb
rmdir folder.glb
only ball.sgm
expect 4 "$SGM" mesh none.sgm --out wrong.glb
# Writes standard output to a full disk.
"$SGM" mesh ball.sgm $region --json >/dev/full 2>"$work/.err" </dev/null
[[ $? == 4 ]] || failed "a full standard output went unseen"
# Simulates a disk that becomes full, by a limit on file sizes: at the first byte, in the middle, and in the last part.
trap '' XFSZ
for format in glb obj ply stl; do
  printf 'what was here before' >"ball.$format"
  for blocks in 0 1 40; do
    expect 4 bash -c '(ulimit -f "$1" && shift && exec "$@") 2>&1 | cat; exit "${PIPESTATUS[0]}"' bash $blocks \
      "$SGM" mesh ball.sgm $region --cell 0.1 --out "ball.$format"
    [[ $out == "sgm: error: cannot write 'ball."*"': File too large" ]] || failed "not the one line that says why"
    [[ $(cat "ball.$format") == 'what was here before' ]] || failed "a full disk took something"
    only ball.sgm "ball.$format"
  done
  rm "ball.$format"
done
trap - XFSZ

# An output file that cannot be written must be reported before the work, which would take minutes here.
expect 4 timeout 120 "$SGM" mesh "$cave" --region=-512,-512,-512:512,512,512 --cell 0.1 --max-chunks 99999999 \
  --out nowhere/cave.glb
one_line

# A signal must end the command at once, at any stage, and leave no file. The result must be the same with and without
# O_TMPFILE; tests/unit/base tests both.
printf 'what was here before' >cave.obj
for signal in TERM INT HUP; do
  for delay in 0.02 0.3 1; do
    last="kill -$signal after $delay s"
    # A script's background jobs ignore SIGINT, so restore its default action.
    env --default-signal=INT "$SGM" mesh "$cave" --region=-192,-192,-192:192,192,192 --cell 0.1 --max-chunks 99999999 \
      --out cave.obj >"$work/.out" 2>"$work/.err" </dev/null &
    # Waits until the command has started: on a busy machine this may take longer than the shortest delay.
    until [[ $(readlink "/proc/$!/exe") == "$(readlink -f "$SGM")" || ! -d /proc/$! ]]; do sleep 0.01; done
    sleep $delay
    kill -$signal $!
    wait $! 2>/dev/null
    status=$?
    ((status == 128 + $(kill -l $signal))) || failed "status $((128 + $(kill -l $signal))) expected"
    only ball.sgm cave.obj
  done
done
[[ $(cat cave.obj) == 'what was here before' ]] || failed "a signal took something"
rm cave.obj

# The old file at --out must stay until the new one is complete.
printf 'before' >ball.glb
expect 1 "$SGM" mesh ball.sgm $region --cell 0 --out ball.glb
[[ $(cat ball.glb) == before ]] || failed "a failure touched the file"
expect 0 "$SGM" mesh ball.sgm $region --out ball.glb
[[ $(head -c 4 ball.glb) == glTF ]] || failed "the file was not replaced"
rm ball.glb
only ball.sgm
finish

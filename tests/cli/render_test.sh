#!/usr/bin/env bash
# Tests sgm render: pictures, cameras and refused calls. Needs a Vulkan device, at least lavapipe.
source "$(dirname "$0")/common.sh"
ball >ball.sgm
cave=$SOURCE/tests/bench/grammars/cave.sgm

expect 0 "$SGM" backends --json
if ! node -e 'process.exit(JSON.parse(require("fs").readFileSync(process.argv[1])).vulkan_devices.length ? 0 : 1)' "$work/.out"; then
  # Without a device, the command must report that.
  expect 3 "$SGM" render ball.sgm --out ball.png
  one_line
  only ball.sgm
  [[ -z ${SGM_REQUIRE_ALL:-} ]] || { echo "a Vulkan device is required here" >&2; exit 1; }
  echo "SKIPPED: no Vulkan device"
  exit 77
fi

# picture FILE WIDTH HEIGHT: fails unless FILE is a PNG of that size.
picture() {
  [[ $(head -c 8 "$1" | od -An -tx1 | tr -d ' \n') == 89504e470d0a1a0a ]] || failed "$1 is no PNG"
  [[ $(od -An -tx1 -j16 -N8 "$1" | tr -d ' \n') == "$(printf '%08x%08x' "$2" "$3")" ]] || failed "$1 is not $2x$3"
}
expect 0 "$SGM" render ball.sgm --out ball.png --size 160x90 --json
json 'j.triangles > 100 && j.width === 160 && j.height === 90 && j.out === "ball.png" && j.seconds > 0 && j.device.length > 0'
json 'j.camera.position.length === 3 && j.camera.target.length === 3'
json 'j.seed === 0 && j.level === 0 && j.cell === 0.5 && j.cell_units === 512 && j.chunks === 8 && j.backend === "cpu"'
json 'j.region[0].join() === "-16,-16,-16" && j.origin.join() === "0,0,0"'
picture ball.png 160 90
expect 0 "$SGM" render "$cave" --out cave.png --cell 1 --size 160x90 --seed 7
picture cave.png 160 90
expect 0 "$SGM" render ball.sgm --out looked.png --camera 0,0,8:0,0,0 --size 64x64 --json
json 'j.camera.position.join() === "0,0,8"'
picture looked.png 64 64
cmp -s ball.png looked.png && failed "the camera does not matter"
expect 0 "$SGM" render ball.sgm --out chequered.png --camera 0,0,8:0,0,0 --size 64x64 --uv --json
json 'j.texture.wedges > j.vertices'
picture chequered.png 64 64
cmp -s chequered.png looked.png && failed "chequers are not drawn"
rm chequered.png
# --pixels must make cells smaller near the camera; the camera that the command chooses must stay the same.
expect 0 "$SGM" render ball.sgm --out plain.png --size 160x90 --json
even=$(<"$work/.out")
expect 0 "$SGM" render ball.sgm --out fine.png --pixels 2 --size 160x90 --json
EVEN=$even json 'const e = JSON.parse(process.env.EVEN); j.triangles > 4 * e.triangles && j.cell === e.cell &&
  j.camera.position.every((x, i) => Math.abs(x - e.camera.position[i]) < 0.001) && j.region.join() === e.region.join()'
picture fine.png 160 90
cmp -s plain.png fine.png && failed "--pixels does not matter"
expect 0 "$SGM" render ball.sgm --out fine.png --pixels 1000 --camera 0,0,8:0,0,0 --size 64x64
cmp -s fine.png looked.png || failed "--pixels matters where no cell looks as wide"
rm plain.png fine.png
expect 2 "$SGM" render ball.sgm --out ball.png --pixels 0
expect 2 "$SGM" render ball.sgm --out ball.png --pixels 2 --volume
expect 2 "$SGM" render ball.sgm --out ball.png --pixels 2 --plan
expect 0 "$SGM" render "$cave" --out at.png --at spawn --region=0,0,0:192,192,192 --cell 2 --size 64x64 --seed 7
picture at.png 64 64
# If the world is infinite, the command must show the whole component that is nearest to the origin. It must choose
# cells so large that this is possible.
cat >sky.sgm <<'END'
sgm 1;
domain infinite axes xz;
layer sky cell 2km reach 1km { start Sky; }
rule Sky { at(1.4km, 1.8km, 900m) sphere(300m); }
END
expect 0 "$SGM" render sky.sgm --out sky.png --size 64x64 --json
json 'j.cut === false && j.cell === 2 && j.triangles > 0'
expect 0 "$SGM" render sky.sgm --out part.png --size 64x64 --region=1400,1800,900:1800,2200,1200 --cell 8
out_has 'border +cuts the surface, which continues outside'
rm sky.sgm sky.png part.png

expect 0 "$SGM" render "$cave" --out level.png --level 1 --cell 1 --size 64x64 --seed 7 --json
json 'j.level === 1 && j.cell === 2'
# dark FILE: prints the number of dark pixels. The mesh's edges are drawn dark, so finer cells must give more.
dark() { node "$SOURCE/tests/cli/png.js" "$1" | cut -d" " -f2; }
look=(--camera 0,2,9:0,0,0 --size 256x256)
expect 0 "$SGM" render ball.sgm --out plain.png --cell 1 "${look[@]}"
expect 0 "$SGM" render ball.sgm --out coarse.png --cell 1 --wires "${look[@]}"
expect 0 "$SGM" render ball.sgm --out fine.png --cell 0.5 --wires "${look[@]}"
picture coarse.png 256 256
plain=$(dark plain.png) coarse=$(dark coarse.png) fine=$(dark fine.png)
((coarse > plain + 300 && fine > coarse + 300)) || failed "dark pixels: $plain, with wires $coarse, finer $fine"
expect 2 "$SGM" render ball.sgm --out wrong.png --wires --volume
err_has 'excludes'
err_has '--wires'
[[ ! -e wrong.png ]] || failed "a picture was written"
# With --volume, the solid must be drawn as fog, from the same camera.
printf 'sgm 1;\nunits m;\ndomain finite box(8m) output density edge 2m;\nstart Puff;\nrule Puff { sphere(3m); }\n' >fog.sgm
expect 0 "$SGM" render fog.sgm --out solid.png --size 96x64 --json
camera=$(node -p 'JSON.stringify(JSON.parse(require("fs").readFileSync(process.argv[1])).camera)' "$work/.out")
json '!("volume" in j)'
expect 0 "$SGM" render fog.sgm --out fog.png --size 96x64 --volume --json
json "JSON.stringify(j.camera) === '$camera' && j.volume.edge === 2 && j.volume.points === 65 ** 3"
json 'j.volume.bricks === 729 && j.volume.uniform > 0 && j.volume.uniform < j.volume.bricks'
picture fog.png 96 64
cmp -s fog.png solid.png && failed "fog looks as a wall does"
expect 0 "$SGM" render fog.sgm --out fog.png --size 96x64 --volume --level 1
out_has 'density +at 274625 points'
expect 1 "$SGM" render ball.sgm --out wrong.png --volume
one_line
err_has 'output density'
# A density edge thinner than samples can resolve must be refused.
expect 1 "$SGM" render fog.sgm --out wrong.png --volume --cell 0.0004 --region=2.99,0,0:3.01,0.01,0.01
one_line
err_has 'edge'
rm ./*.png fog.sgm
only ball.sgm

# The choice between sun and lamp must depend on what the camera sees, wherever the region ends. The choice must be
# reported, and an option must override it. The numbers are means of red + green + blue: a day is bright, a cave is not,
# and neither is black.
cat >town.sgm <<'END'
sgm 1;
units m;
domain infinite axes xz empty;
layer ground cell 32m reach 4m { start Ground; }
layer rows cell 32m reach 16m { start Row; }
rule Ground { at(16m, -1m, 16m) box(33m, 2m, 33m); mat slate; }
rule Row { at(16m, 6m, 16m) box(26m, 12m, 33m); mat plaster; }
END
cat >hall.sgm <<'END'
sgm 1;
units m;
param open = 0 in 0..1 "of the hall's long wall";
param side = 0 in -1..1 "that a lantern is on; 0: there is none";
start Hall;
rule Hall {
  for i in 0..abs(side) { at(4m*side, 3m, 2m) anchor light "lantern"; }
  at(y 4m) box(14m, 10m, 40m);
  cut { at(y 4m) box(10m, 8m, 36m); at(6m, 3m, 0m) box(6m, 4m*open + 0.01m, 30m*open + 0.01m); }
  mat limestone;
}
END
cat >mouth.sgm <<'END'
sgm 1;
units m;
start Hill;
rule Hill { at(0m, 10m, -40m) box(60m, 40m, 80m); cut capsule((0m, 0m, 4m), (0m, 0m, -70m), 3m); mat limestone; }
END
# lit LIGHT MIN-MAX GRAMMAR OPTION...: expects that this light is chosen, and that the mean of red + green + blue is in
# this range.
lit() {
  local light=$1 low=${2%-*} high=${2#*-} mean
  shift 2
  expect 0 "$SGM" render "$@" --out lit.png --size 96x54 --json
  json "j.light === '$light' && (j.daylight >= 0.03) === ('$light' === 'sun')"
  mean=$(node "$SOURCE/tests/cli/png.js" lit.png | cut -d" " -f1)
  ((mean >= low && mean <= high)) || failed "mean brightness $mean, expected $low to $high"
}
lit sun 150-600 town.sgm --cell 1 --region=-32,-2,-32:32,16,32 --camera 0,1.7,-20:0,2,20
lit sun 150-600 town.sgm --cell 1 --region=-16,-2,-16:16,16,16 --camera 0,1.7,0:2,8,4
lit sun 150-600 town.sgm --cell 1 --region=-32,-2,-32:32,16,32 --camera 0,40,-20:0,0,30
lit lamp 20-300 hall.sgm --cell 0.5 --camera 0,1.7,-15:0,3,15
lit sun 100-600 hall.sgm --cell 0.5 --set open=1 --camera 0,1.7,-15:0,3,15
lit sun 100-600 hall.sgm --cell 0.5
lit sun 60-600 mouth.sgm --cell 0.5 --camera 0,0,-3:0,0,20
lit sun 60-600 mouth.sgm --cell 0.5 --camera 0,0,14:0,0,-20
lit lamp 20-300 mouth.sgm --cell 0.5 --camera 0,0,-40:0,0,-60
lit lamp 20-300 "$cave" --cell 1 --seed 7
lit lamp 20-300 "$SOURCE/samples/grammars/passage.sgm" --cell 1 --camera 32,0,0:64,0,0 --region=0,-16,-16:160,16,16
lit sun 150-700 "$SOURCE/samples/grammars/cloud.sgm"
# A camera inside the rock must see the parts that are cut open.
expect 0 "$SGM" render mouth.sgm --out lit.png --size 96x54 --json --cell 0.5 --camera 25,2,-40:0,0,-40
json 'j.light === "sun" && j.daylight === null'
expect 0 "$SGM" render hall.sgm --out lit.png --size 32x18 --cell 1 --camera 0,1.7,-15:0,3,15
out_has 'light +lamp: 0.0 % of the sky'
for light in sun lamp none; do
  expect 0 "$SGM" render town.sgm --out $light.png --size 96x54 --cell 1 --region=-32,-2,-32:32,16,32 \
    --camera 0,1.7,-20:0,2,20 --light $light --json
  json "j.light === '$light' && j.daylight === null"
done
cmp -s sun.png lamp.png && failed "--light changes nothing"
cmp -s lamp.png none.png && failed "--light none has a lamp"
# With uniform light from all sides, no part of the street's ground must be dark.
read -r mean _ < <(node "$SOURCE/tests/cli/png.js" none.png 20 40 56 14)
((mean > 60)) || failed "by --light none the ground's mean is $mean"
# The lamp must be placed at an anchor of kind `light`: of two walls, it lights the nearer one more. In the picture, x
# grows to the left.
walls() {
  expect 0 "$SGM" render hall.sgm --out walls.png --size 96x54 --cell 0.5 --camera 0,1.7,-15:0,3,15 --light lamp --set "side=$1"
  left=$(node "$SOURCE/tests/cli/png.js" walls.png 33 20 6 10 | cut -d" " -f1)
  right=$(node "$SOURCE/tests/cli/png.js" walls.png 57 20 6 10 | cut -d" " -f1)
}
walls 1
((left > right + 20)) || failed "with a lantern on the left the walls' means are $left and $right"
walls -1
((right > left + 20)) || failed "with a lantern on the right the walls' means are $left and $right"
expect 2 "$SGM" render town.sgm --out wrong.png --light moon
expect 2 "$SGM" render town.sgm --out wrong.png --light lamp --volume
err_has 'excludes'
rm town.sgm hall.sgm mouth.sgm lit.png sun.png lamp.png none.png walls.png

# If there are anchors at the border and inside the region, one inside must be chosen.
printf '%s\n' 'sgm 1; domain infinite solid rock; layer a cell 32m reach 9m { start A; }' \
  'rule A { cut at(3m, 16m, 16m) sphere(8m); at(3m, 16m, 16m) anchor spawn; }' >row.sgm
expect 0 "$SGM" render row.sgm --out row.png --at spawn --region 0,0,0:96,32,32 --cell 1 --size 32x32 --json
json 'j.camera.position[0] > 12'
rm row.sgm row.png
# A note must report that an anchor inside rock is not used. An anchor in a hollow must be used, although the camera
# stands back from it.
printf '%s\n' 'sgm 1; domain finite box(24m, 24m, 24m); start A;' \
  'rule A { box(20m); cut { sphere(6m); anchor spawn; } at(0m, 11m, 0m) anchor beacon; }' >hollow.sgm
expect 0 "$SGM" render hollow.sgm --out hollow.png --at spawn --cell 1 --size 32x32
[[ $err != *'is ignored'* ]] || failed "an anchor in a hollow is said not to be used"
expect 0 "$SGM" render hollow.sgm --out hollow.png --at spawn --cell 1 --size 32x32 --pixels 2
[[ $err != *'is ignored'* ]] || failed "an anchor in a hollow is said not to be used with small cells near it"
expect 0 "$SGM" render hollow.sgm --out hollow.png --at beacon --cell 1 --size 32x32
err_has 'note: --at beacon is ignored'
rm hollow.sgm hollow.png

# Several seeds must be drawn side by side, in about as many columns as rows. If a seed fails, its place must stay
# empty, and the error must be reported and determine the exit status.
cat >fickle.sgm <<'END'
sgm 1;
units m;
start Maybe;
rule Maybe weight 1 { sphere(rand(1m, 3m)); mat marble; }
rule Maybe weight 1 { }
END
expect 1 "$SGM" render fickle.sgm --out sheet.png --seeds 1..7 --sheet --size 480x270 --region=-4,-4,-4:4,4,4 --json
json 'j.columns === 3 && j.seeds.map(s => s.seed).join() === "1,2,3,4,5,6,7" && Math.abs(j.width - 480) < 12'
json 'j.seeds.some(s => s.error) && j.seeds.some(s => !s.error && s.triangles > 50) && Math.abs(j.height - 270) < 24'
[[ $(grep -c . <<<"$err") == 1 ]] || failed "the same reason is told more than once"
err_has 'error: seeds? [0-9, ]+: there is no surface to draw'
picture sheet.png "$(node -p 'JSON.parse(require("fs").readFileSync(process.argv[1])).width' "$work/.out")" \
  "$(node -p 'JSON.parse(require("fs").readFileSync(process.argv[1])).height' "$work/.out")"
expect 0 "$SGM" render ball.sgm --out sheet.png --seeds 3,9 --sheet --size 320x180 --cell 1
out_has '2 seeds in 2 columns'
expect 1 "$SGM" render fickle.sgm --out none.png --seeds 1..3 --sheet --region=100,100,100:110,110,110
one_line
err_has 'seeds 1, 2, 3: there is no surface'
[[ ! -e none.png ]] || failed "a sheet without a picture was written"
for seeds in 4..2 x 1.. ..3 1,1 1,,2 -1 1..9999 1..3,2; do
  expect 2 "$SGM" render ball.sgm --out wrong.png --seeds=$seeds --sheet
  err_has "usage: --seeds: '"
done
expect 2 "$SGM" render ball.sgm --out wrong.png --seeds 1..3
err_has '--seeds requires --sheet'
expect 2 "$SGM" render ball.sgm --out wrong.png --sheet
err_has '--sheet requires --seeds'
expect 2 "$SGM" render ball.sgm --out wrong.png --seeds 1..3 --sheet --seed 4
err_has 'excludes'
expect 2 "$SGM" render ball.sgm --out wrong.png --seeds 1..200 --sheet --size 320x180
err_has 'larger --size or fewer --seeds'
expect 1 "$SGM" render ball.sgm --out wrong.png --seeds 1..3 --sheet --cell 0
one_line
rm fickle.sgm sheet.png

# --frame must show one use of a rule so that it fills the picture, from a side where it is visible.
cat >posts.sgm <<'END'
sgm 1;
units m;
domain infinite axes xz;
layer rows cell 32m reach 8m { start Row; }
rule Row { for i in 0..3 { at(8m + 8m*i, 2m, 16m) Post(1m + 0.5m*i); } at(16m, -1m, 16m) box(33m, 2m, 33m); }
rule Post(h) { box(1m, 2*h, 1m); mat marble; }
END
expect 0 "$SGM" render posts.sgm --out post.png --frame "Row/Post[2]" --size 96x96 --json
json 'j.frame.path.endsWith("/Row/Post[2]") && j.frame.seen > 0.8 && !j.frame.inside && j.frame.fill > 0.6 && j.frame.fill < 0.85'
json 'j.cell < 0.5 && j.camera.position[1] > 0'
picture post.png 96 96
expect 0 "$SGM" render posts.sgm --out post.png --frame Post --size 32x32 --region=0,-4,0:32,8,32
out_has 'frame +rows\(0, 0, 0\)/Row/Post\[[0-2]\], [0-9]+ % of its near side visible'
# A room must be shown from inside.
lake=$SOURCE/tests/bench/grammars/lake.sgm
expect 0 "$SGM" render "$lake" --out post.png --frame Room --seed 3 --size 32x32 --cell 1 --json
json 'j.frame.inside && j.frame.path.endsWith("/Node/Room[0]") && j.light === "lamp"'
expect 0 "$SGM" render "$lake" --out post.png --frame cave.Dripstone --seed 3 --size 32x32 --json
json 'j.frame.path.includes("/cave.Dripstone[") && j.frame.seen > 0.5 && j.cell < 0.5'
expect 1 "$SGM" render posts.sgm --out wrong.png --frame Pots
one_line
err_has "there is no rule 'Pots': did you mean 'Post'\\?"
expect 1 "$SGM" render posts.sgm --out wrong.png --frame Elephant
one_line
err_has "there is no rule 'Elephant': the grammar has Post, Row"
expect 1 "$SGM" render "$lake" --out wrong.png --frame Dripstone
err_has "did you mean 'cave.Dripstone'\\?"
expect 1 "$SGM" render posts.sgm --out wrong.png --frame "Row/Post[7]" --region=0,-4,0:32,8,32
one_line
err_has "'Row/Post\\[7\\]' is not used in the region"
expect 1 "$SGM" render posts.sgm --out wrong.png --frame "Row//Post"
one_line
err_has 'neither a rule nor a path'
printf 'rule Spare { sphere(1m); }\n' >>posts.sgm
expect 1 "$SGM" render posts.sgm --out wrong.png --frame Spare
err_has "'Spare' is not used within 512 m of the origin"
expect 2 "$SGM" render posts.sgm --out wrong.png --frame Post --camera 0,0,8:0,0,0
err_has 'excludes'
rm posts.sgm post.png

expect 1 "$SGM" render ball.sgm --out wrong.png --at nothing_of_that_name
err_has "no anchor of the name, kind or tag 'nothing_of_that_name'; it has no anchors"
printf 'sgm 1; start A; rule A { sphere(2m); anchor spawn "camp"; }\n' >named.sgm
expect 1 "$SGM" render named.sgm --out wrong.png --at spwan
err_has "no anchor of the name, kind or tag 'spwan'; did you mean 'spawn'\\?"
expect 1 "$SGM" render named.sgm --out wrong.png --at treasure
err_has "no anchor of the name, kind or tag 'treasure'; it has camp, spawn"
rm named.sgm
one_line
expect 1 "$SGM" render ball.sgm --out wrong.png --cell 0
expect 2 "$SGM" render ball.sgm
expect 2 "$SGM" render ball.sgm --out wrong.jpg
for size in 0x10 10 10x 99999x10 axb -1x5; do
  expect 2 "$SGM" render ball.sgm --out wrong.png --size "$size"
done
expect 2 "$SGM" render ball.sgm --out wrong.png --camera 1,2,3
expect 2 "$SGM" render ball.sgm --out wrong.png --camera 0,0,8:0,0,0 --at spawn
expect 1 "$SGM" render ball.sgm --out wrong.png --camera 0,0,8:0,0,8
expect 4 "$SGM" render ball.sgm --out nowhere/ball.png --size 64x64
one_line
expect 4 "$SGM" render none.sgm --out wrong.png
# An output file that cannot be written must be reported before the work.
expect 4 timeout 120 "$SGM" render "$cave" --out nowhere/cave.png --region=-512,-512,-512:512,512,512 --cell 0.1 \
  --max-chunks 99999999
one_line
printf 'what was here before' >ball.png
trap '' XFSZ
for blocks in 0 1; do
  expect 4 bash -c '(ulimit -f "$1" && shift && exec "$@") 2>&1 | cat; exit "${PIPESTATUS[0]}"' bash $blocks \
    "$SGM" render ball.sgm --out ball.png --size 256x256
done
trap - XFSZ
[[ $(cat ball.png) == 'what was here before' ]] || failed "a full disk took something"
rm ball.png
only ball.sgm
finish

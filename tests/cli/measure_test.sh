#!/usr/bin/env bash
# Tests sgm measure: with files in four formats and a grammar, with damaged files, and with files that contain no mesh.
source "$(dirname "$0")/common.sh"

ball >ball.sgm
expect 0 "$SGM" measure ball.sgm --cell 0.25 --json
json 'j.valid && j.watertight && j.problems.length === 0 && j.genus === 0 && j.euler === 2 && j.objects === 1 && j.shells === 1'
json 'Math.abs(j.area / (4 * Math.PI * 9) - 1) < 0.005 && Math.abs(j.volume / (36 * Math.PI) - 1) < 0.005'
json 'j.self_intersections === 0 && j.open_edges === 0 && j.nonmanifold_edges === 0 && j.degenerate === 0 && j.flat === 0 && j.folded === 0 && j.duplicates === 0'
json 'Math.abs(j.histogram.shares.reduce((a, b) => a + b) - 1) < 1e-12 && j.histogram.bins === 33 && j.histogram.convex > 0.9'
json 'j.seed === 0 && j.cell === 0.25 && j.hash.length === 16'
grammar_area=$(node -e 'console.log(JSON.parse(require("fs").readFileSync(process.argv[1], "utf8")).area)' .out)

# The same mesh in each format must have the same measures, up to the rounding of positions to single precision.
for format in glb obj ply stl; do
  expect 0 "$SGM" mesh ball.sgm --cell 0.25 --out ball.$format
  expect 0 "$SGM" measure ball.$format --json
  json "j.valid && j.genus === 0 && Math.abs(j.area / $grammar_area - 1) < 1e-6 && j.file === 'ball.$format'"
done
json 'j.welded_points === j.points - j.triangles / 2 - 2'
expect 0 "$SGM" measure ball.glb
out_has '^ball.glb: [0-9]+ triangles, [0-9]+ points, '
out_has 'verdict +valid'
err_empty

expect 0 "$SGM" measure ball.ply --json --mode printed --bins 10 --cubes 0.2
json 'j.histogram.mode === "printed" && j.histogram.first_bin === -3 && j.histogram.shares.length === 8 && j.histogram.entries_index_le_0 > 0'
json 'j.cubes.all_corners < j.volume && j.cubes.any_corner > j.volume'
expect 0 "$SGM" measure ball.ply --json --mode curvature --unique-edges --curvature-length 3 --no-self-intersections --weld 0.001
json 'j.histogram.edges === j.edges && j.self_intersections === null && j.folded === null && Math.abs(j.histogram.shares.reduce((a, v, i) => a + i * v, 0) - 24) < 1.5'

# Compares the mesh with the field: normals must point outwards along the gradient, vertices must lie on the surface.
expect 0 "$SGM" measure ball.sgm --cell 0.25 --field --json
json 'j.valid && j.field.vertices === j.points && j.field.normals.count === j.points && j.field.in_creases === 0'
json 'j.field.normals.inward === 0 && j.field.normals.outward === 1 && j.field.normals.p99 < 0.1 && j.field.faces.median < 5'
json 'j.field.step === 1 / 32 && j.field.residual.max < 0.25 * 0.25 / 8 / 3 + 0.25 / 256'
json 'Math.abs(j.field.residual.max / 0.25 - j.field.residual.max_cells) < 1e-9 && j.field.residual.p99 <= j.field.residual.max'
json 'Math.abs(j.field.offset.max - j.field.residual.max) < 1e-4 && j.field.offset.mean_cells < j.field.offset.p99_cells'
expect 0 "$SGM" measure ball.sgm --cell 0.25 --field
out_has 'normals +0 of [0-9]+ vertices inward'
out_has 'faces +0 of [0-9]+ triangles. corners inward'
out_has 'residual +.f. 0.0'
err_empty

# Compares levels of detail with each other: distances must be below the bound, and grow with the level.
expect 0 "$SGM" measure ball.sgm --cell 0.125 --levels 3 --level 1 --json
json 'j.level === 1 && j.levels.length === 3 && j.levels.every((l, i) => l.level === i + 1 && l.coarse_level === i + 2)'
json 'j.levels.every((l) => l.coarse_cell === 0.125 * 2 ** l.coarse_level && l.at_least <= l.at_most && l.at_most < l.bound)'
json 'j.levels.every((l) => !l.beyond_bound && Math.abs(l.bound / l.coarse_cell - 1.5 * Math.sqrt(3)) < 1e-9)'
json 'j.levels[1].at_least > 2 * j.levels[0].at_least && j.levels[0].left_out[0] + j.levels[0].left_out[1] === 0'
# The region contains half of the ball: places near the cut must be left out of the comparison.
expect 0 "$SGM" measure ball.sgm --cell 0.125 --region -4,-4,-4:0,4,4 --levels 1 --json
json 'j.cut && j.levels[0].left_out[0] > 0 && j.levels[0].at_least < 0.05'
expect 0 "$SGM" measure ball.sgm --cell 0.125 --region -4,-4,-4:0,4,4 --levels 1
out_has 'levels +0 and 1: 0.0'
out_has 'left out, at the region.s cut'

# The cut at the region's border must not count as a defect, but a hole elsewhere must.
expect 0 "$SGM" measure ball.sgm --cell 0.25 --region -4,-4,-4:0,4,4 --json --strict
json 'j.cut && !j.valid && j.valid_but_for_cut && j.cut_edges > 30 && j.cut_edges === j.open_edges && j.problems.length === 0'
expect 0 "$SGM" measure ball.sgm --cell 0.25 --region -4,-4,-4:0,4,4
out_has 'verdict +closed except at the region.s border, which cuts it along [0-9]+ edges'
out_has 'volume .*m3, which means little: the surface is cut'
out_has 'cells of 0.25 m, region -8,-8,-8:0,8,8 m'
expect 0 "$SGM" measure ball.sgm --cell 0.25 --strict
printf 'sgm 1; start A; rule A { at(8032m, 32m, 8032m) sphere(20m); }\n' > far.sgm
expect 1 "$SGM" measure far.sgm --region 0,0,0:8,8,8 --strict
out_has 'verdict +empty'

# The places of defects of an open mesh must be reported.
printf 'v 0 0 0\nv 4 0 0\nv 0 4 0\nv 0 0 4\nf 1 3 2\nf 1 2 4\nf 1 4 3\n' > open.obj
expect 0 "$SGM" measure open.obj
out_has '3 open edges .with one triangle.: there are holes, the first at 2,2,0'
expect 1 "$SGM" measure open.obj --strict --json
json 'j.places.length === 3 && j.places.every((p) => p.kind === "open_edge") && j.places[0].at.join() === "2,2,0" && !j.valid_but_for_cut'
printf 'v 0 0 0\nv 4 0 0\nv 0 4 0\nv 0 0 4\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n' > tetra.obj
{ cat tetra.obj; sed 's/^v 0 0 0/v 0.5 0.5 0.5/; s/^v 4 0 0/v 1 0.5 0.5/; s/^v 0 4 0/v 0.5 1 0.5/; s/^v 0 0 4/v 0.5 0.5 1/; s/^f .*//' tetra.obj
  printf 'f 5 7 6\nf 5 6 8\nf 5 8 7\nf 6 7 8\n'; } > nested.obj
expect 0 "$SGM" measure nested.obj --json
json 'j.nested === 1 && j.volume_counts_once === false && j.places[0].kind === "nested"'
expect 0 "$SGM" measure nested.obj
out_has 'counts overlaps of parts several times'
expect 0 "$SGM" measure tetra.obj --json
json 'j.valid && j.volume_counts_once && j.places.length === 0'

# Far from the world's origin, positions in files are relative to another origin; reported places must be world
# positions.
expect 0 "$SGM" mesh far.sgm --region 8000,0,8000:8064,64,8064 --cell 1 --out far.glb
expect 0 "$SGM" measure far.sgm --region 8000,0,8000:8064,64,8064 --cell 1 --json --against far.glb --levels 1 --field
json 'j.origin.join() === "8000,0,8000" && Math.abs(j.bounds[0][0] - 8012) < 0.5 && j.against.at_most < 1e-3'
json '[j.levels[0].there.farthest, j.field.residual.farthest].every((p) => p[0] > 8010 && p[0] < 8054 && p[1] > 10 && p[1] < 54)'
expect 0 "$SGM" measure far.sgm --region 8032,0,8000:8064,64,8064 --cell 1 --json --against far.glb
json 'j.against.there.at_most < 1e-3 && j.against.back.at_least > 19'
for format in glb obj ply stl; do
  expect 0 "$SGM" mesh far.sgm --region 8000,0,8000:8064,64,8064 --cell 1 --out far.$format
  expect 0 "$SGM" measure far.$format --json
  json 'j.origin.join() === "8000,0,8000" && Math.abs(j.bounds[0][0] - 8012) < 0.5 && Math.abs(j.bounds[1][1] - 52) < 0.5'
done

# A level without a surface must not stop the comparison of levels.
printf 'sgm 1; start A; rule A { at(0.7m, 0.7m, 0.7m) sphere(0.4m); }\n' > speck.sgm
expect 0 "$SGM" measure speck.sgm --cell 0.25 --region -8,-8,-8:8,8,8 --levels 3 --json
json 'j.valid && j.levels.length === 3 && !j.levels[0].vanished && j.levels.some((l) => l.vanished && l.at_least === undefined)'
expect 0 "$SGM" measure speck.sgm --cell 0.25 --region -8,-8,-8:8,8,8 --levels 3
out_has 'one has a surface here and the other has none'
out_has 'neither has a surface here'

# Options for grammars must be refused with files, and options for files with grammars.
for option in '--seed 3' '--sharp' '--region 0,0,0:1,1,1' '--set a=3' '--cell 4' '--backend cpu' '--level 2'; do
  # shellcheck disable=SC2086
  expect 2 "$SGM" measure tetra.obj $option
  err_has "${option%% *} is for grammars"
done
expect 2 "$SGM" measure ball.sgm --seconds 3
err_has '.--seconds is for mesh files'
expect 2 "$SGM" measure ball.sgm --level 14 --levels 4
err_has '.--level and --levels reach level 18, and 16 is the coarsest'

# Measures distances to another mesh in both directions: to a copy, and to a ball that is 0.1 m larger.
expect 0 "$SGM" measure ball.glb --against ball.ply --json
json 'j.valid && j.against.file === "ball.ply" && j.against.at_most < 1e-6 && j.against.triangles === j.triangles'
expect 0 "$SGM" mesh ball.sgm --cell 0.25 --set radius=3.1m --out larger.glb
expect 0 "$SGM" measure ball.obj --against larger.glb --json
json 'Math.abs(j.against.at_least - 0.1) < 0.01 && Math.abs(j.against.there.mean - 0.1) < 0.002 && j.against.at_most < 0.12'
json 'j.against.at_least === Math.max(j.against.there.at_least, j.against.back.at_least)'
expect 0 "$SGM" measure ball.sgm --cell 0.25 --against larger.glb
out_has 'distance +0\.(09|10)[0-9]* to 0\.1[0-9]* between this and larger.glb'
err_empty

# Measures texel densities of files with and without texture coordinates, and of a grammar, whose three projection
# planes have one density.
expect 0 "$SGM" mesh ball.sgm --cell 0.25 --uv --out textured.glb
expect 0 "$SGM" measure textured.glb --texels 512 --json
json 'j.texels.resolution === 512 && j.texels.triangles === j.triangles && j.texels.min >= 500 && j.texels.ratio < 1.3'
expect 0 "$SGM" measure ball.sgm --cell 0.25 --texels --json
json 'j.texels.resolution === 1024 && j.texels.triangles > 0 && j.texels.min > 1000 && j.texels.triplanar_share === 0'
expect 0 "$SGM" measure textured.glb --texels
out_has 'texels +1[0-9.e+]* per unit of length at the median, .* for a texture of 1024'

# Vertex cache: two triangles that share an edge must load 4 vertices once each; a strip drawn in three rounds must load
# each vertex three times. Overdraw: if the nearer of two squares is drawn last, the pixels must be shaded twice.
printf 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n' > square.obj
expect 0 "$SGM" measure square.obj --drawing --json
json 'j.drawing.triangles === 2 && j.drawing.acmr === 2 && j.drawing.atvr === 1 && j.drawing.overdraw === 1'
for y in 0 1; do for i in $(seq 0 39); do echo "v $i $y 0"; done; done > strip.obj
for round in 1 2 3; do for i in $(seq 1 39); do echo "f $i $((i + 1)) $((i + 41))"; done; done >> strip.obj
expect 0 "$SGM" measure strip.obj --drawing --json
json 'j.drawing.triangles === 117 && Math.abs(j.drawing.atvr - 3) < 1e-6'
printf 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\nf 1 2 3 4\nf 5 6 7 8\n' > back_first.obj
printf 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\nf 5 6 7 8\nf 1 2 3 4\n' > front_first.obj
expect 0 "$SGM" measure back_first.obj --drawing --json
json 'j.drawing.overdraw === 2'
expect 0 "$SGM" measure front_first.obj --drawing --json
json 'j.drawing.overdraw === 1'
expect 0 "$SGM" measure ball.sgm --cell 0.25 --drawing --json
json 'j.drawing.triangles === j.triangles && j.drawing.acmr > 0.5 && j.drawing.acmr < 1 && j.drawing.overdraw >= 1'
expect 0 "$SGM" measure ball.sgm --cell 0.25 --drawing
out_has 'drawing +0[0-9.]+ vertices per triangle .ACMR., each 1[0-9.]+ times .ATVR., with a cache of 16; each pixel'
printf 'sgm 1; start A; rule A { at(100m, 0m, 0m) sphere(1m); }\n' > elsewhere.sgm
expect 0 "$SGM" measure elsewhere.sgm --region 0,0,0:8,8,8 --drawing
out_has 'drawing +no triangle that could be drawn'
expect 0 "$SGM" measure ball.stl --texels --json
json 'j.texels === null'
expect 0 "$SGM" measure ball.stl --texels
out_has 'texels +none: the file has no texture coordinates'
# Cells of a cellular automaton have no texture axes of their own, so all their faces are triplanar.
expect 0 "$SGM" measure "$SOURCE/samples/grammars/table4/voxel.sgm" --region 0,0,0:16,16,16 --texels --json
json 'j.triangles > 100 && j.texels.triplanar_share === 1 && j.texels.triangles === 0 && j.texels.triplanar_density === 1024'
expect 0 "$SGM" measure "$SOURCE/samples/grammars/table4/voxel.sgm" --region 0,0,0:16,16,16 --texels
out_has 'texels +1024 everywhere on the 100.0 % of the area with triplanar texturing'

# Options that need data which the file does not have must be refused; so must missing files.
expect 2 "$SGM" measure ball.glb --field
err_has '--field is for grammars'
one_line
expect 2 "$SGM" measure ball.glb --levels 2
err_has '--levels is for grammars'
one_line
expect 2 "$SGM" measure ball.sgm --levels 0
expect 2 "$SGM" measure ball.sgm --levels 17
expect 2 "$SGM" measure ball.glb --texels 0
expect 2 "$SGM" measure ball.glb --texels nan
echo 'Dear Sir or Madam' >letter.txt
expect 1 "$SGM" measure ball.glb --against letter.txt
err_has 'letter.txt: the mesh format is unsupported; use .glb'
one_line
for subject in ball.glb ball.sgm; do
  expect 4 "$SGM" measure $subject --against nothing.glb
  err_has 'cannot read nothing.glb'
  one_line
  out_empty
done

# A damaged mesh must be measured and its defects reported, without an error.
grep -v '^f' ball.obj >holes.obj
grep '^f' ball.obj | tail -n +4 >>holes.obj
expect 0 "$SGM" measure holes.obj
out_has 'not the surface of a solid'
out_has 'open edges .with one triangle.: there are holes'
expect 0 "$SGM" measure holes.obj --json
json '!j.valid && !j.watertight && j.open_edges > 3 && j.problems.length === 1'
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n' >inverted.obj
expect 0 "$SGM" measure inverted.obj --json
json '!j.valid && j.watertight && j.inside_out === 1 && j.volume < 0 && Math.abs(j.volume + 1 / 6) < 1e-12'

# A damaged file that contains no readable mesh must cause one line on standard error, which names the place of the
# damage, and exit status 1.
head -c 2000 ball.glb >cut.glb
expect 1 "$SGM" measure cut.glb
err_has 'cut.glb: .*at byte'
one_line
out_empty
printf 'v 0 0 0\nv 1 0 0\nv nan 1 0\nf 1 2 3\n' >nan.obj
expect 1 "$SGM" measure nan.obj
err_has 'nan.obj: .*at line 3'
one_line
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 7\n' >index.obj
expect 1 "$SGM" measure index.obj
err_has 'index.obj: .*at line 4'
one_line
expect 1 "$SGM" measure ball.sgm --against index.obj
err_has 'index.obj: .*at line 4'
one_line
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\n' >points.obj
expect 1 "$SGM" measure ball.sgm --against points.obj
one_line
out_empty
expect 4 "$SGM" measure nothing.glb
err_has 'cannot read nothing.glb'
one_line
mkdir folder.glb
expect 4 "$SGM" measure folder.glb
err_has 'cannot read folder.glb: it is not a regular file'
one_line
mkfifo pipe.obj
expect 4 "$SGM" measure pipe.obj
one_line
expect 4 "$SGM" measure ball.txt
err_has 'cannot read ball.txt'
one_line
expect 1 "$SGM" measure letter.txt
err_has 'letter.txt: the mesh format is unsupported; use .glb'
one_line
# A name without a known extension must be accepted: the content decides the format.
cp ball.glb unnamed
expect 0 "$SGM" measure unnamed
err_has 'unnamed: by its bytes it is glTF, and is read as such'
# Extensions must be recognised in upper and lower case.
cp ball.sgm CAPITALS.SGM
cp ball.glb CAPITALS.GLB
for subject in 'CAPITALS.SGM --cell 0.25' CAPITALS.GLB; do
  # shellcheck disable=SC2086
  expect 0 "$SGM" measure $subject --json
  json "j.valid && Math.abs(j.area / $grammar_area - 1) < 1e-6 && j.file === '${subject%% *}'"
done
expect 2 "$SGM" measure ball.ply --bins 0
expect 2 "$SGM" measure ball.ply --weld=-1

# Memory limits must hold whatever sizes a file claims.
if [[ $("$SGM" --version; nm -D "$SGM" 2>/dev/null) != *__asan* ]]; then
  node -e '
    const n = 700000, bytes = Buffer.alloc(84 + 50 * n);
    bytes.writeUInt32LE(n, 80);
    for (let i = 0; i < n; ++i) for (let k = 0; k < 9; ++k) bytes.writeFloatLE(Math.fround(i + (k * 7919 % 13)), 84 + 50 * i + 12 + 4 * k);
    require("fs").writeFileSync("large.stl", bytes);'
  expect 1 "$SGM" measure large.stl --memory 64
  err_has 'it takes more than 64 MB of memory'
  one_line
  expect 1 "$SGM" measure large.stl --seconds 0.1
  err_has 'it takes more than 0.1 s'
  one_line
fi
# Measures the void: two rooms in rock, a corridor between them that is 1 m wide, and a third room that is sealed.
cat >rooms.sgm <<'END'
sgm 1;
domain finite box(40m, 16m, 16m) solid;
start Rooms;
rule Rooms {
  cut {
    at(-14m, 0m, 0m) box(6m, 6m, 6m);
    at(2m, 0m, 0m) box(6m, 6m, 6m);
    at(-6m, 0m, 0m) box(16m, 1m, 1m);
    at(14m, 0m, 0m) box(4m, 4m, 4m);
  }
}
END
from_to=(--from -13.9,0,0 --to 2,0.2,0)
expect 0 "$SGM" measure rooms.sgm --cell 0.25 "${from_to[@]}"
out_has 'voids +2, .* 2 of them sealed'
out_has 'path +1[5-7]\.?[0-9]* m, [0-9]+ places'
out_has 'widest +agents of radius below 0\.[5-9][0-9]* m pass'
err_empty
expect 0 "$SGM" measure rooms.sgm --cell 0.25 "${from_to[@]}" --radius 0.4 --json --threads 3
json 'j.way.found && j.way.verdict === "found" && j.way.why === null && j.radius === 0.4 && j.cell === 0.25'
json 'j.way.length >= 15.8 && j.way.length < 18 && j.way.places.length > 50 && j.way.widest > 0.4 && j.way.widest < 1'
json 'Math.abs(j.way.places[0][0] + 13.9) <= 0.25 && Math.abs(j.way.places.at(-1)[0] - 2) <= 0.25'
json 'j.way.places.every((p, i) => i === 0 || Math.hypot(...p.map((x, a) => x - j.way.places[i - 1][a])) < 0.36)'
json 'j.voids.count === 2 && j.voids.sealed === 2 && j.voids.largest.length === 2 && j.voids.sealed_volume === j.voids.volume'
expect 1 "$SGM" measure rooms.sgm --cell 0.25 "${from_to[@]}" --radius 1
out_has 'voids +3'
err_has 'there is no path in the region: --from lies in a void of .* agents of radius below 0\.[5-9]'
one_line
expect 1 "$SGM" measure rooms.sgm --cell 0.25 --from -14,0,0 --to 14,0,0 --json
json '!j.way.found && j.way.verdict === "apart" && j.way.widest === 0 && j.way.length === null && j.way.places.length === 0'
json '/no agent passes/.test(j.way.why) && j.way.from_volume > j.way.to_volume'
err_empty
expect 1 "$SGM" measure rooms.sgm --cell 0.25 --from -14,0,0 --to 14,0,0
out_has 'widest +no agent passes, however small'
expect 1 "$SGM" measure rooms.sgm --cell 0.25 --from -19,-7,-7 --to 14,0,0
err_has 'error: --from lies in rock'
out_has 'voids +2'
[[ $out != *widest* ]] || failed "rock at an end is told as a width"
expect 1 "$SGM" measure rooms.sgm --cell 0.25 --from -14,0,0 --to 19,7,7
err_has 'error: --to lies in rock'
[[ $out != *widest* ]] || failed "rock at an end is told as a width"
# An agent of the reported greatest width must pass, and an agent that is wider by the last bit must not.
expect 0 "$SGM" measure rooms.sgm --cell 0.25 "${from_to[@]}" --json
widest=$(node -p 'JSON.parse(require("fs").readFileSync(".out")).way.widest')
expect 1 "$SGM" measure rooms.sgm --cell 0.25 "${from_to[@]}" --radius "$widest" --json
json "j.radius === j.way.widest && j.radius === $widest"
expect 1 "$SGM" measure rooms.sgm --cell 0.25 --from -14,0,0 --to -6,0,0 --radius 0.8
err_has 'does not fit at --to: rock is 0\.[5-9]'
expect 0 "$SGM" measure rooms.sgm --cell 0.25 --radius 0 --json
json 'j.way === null && j.voids.count === 2 && Math.abs(j.voids.volume / (2 * 216 + 10 + 64) - 1) < 0.15'
expect 2 "$SGM" measure rooms.sgm --from -14,0,0
expect 2 "$SGM" measure rooms.sgm --from -14,0,0 --to 1,2
expect 2 "$SGM" measure rooms.sgm --radius=-1
expect 2 "$SGM" measure rooms.sgm --radius nan
expect 2 "$SGM" measure rooms.sgm --radius 0 --bins 9
expect 2 "$SGM" measure rooms.sgm --radius 0 --backend cuda
expect 2 "$SGM" measure rooms.sgm "${from_to[@]}" --backend cpu
err_has '--backend excludes --from'
expect 2 "$SGM" measure ball.ply --radius 0
err_has 'a mesh file has none'
one_line
expect 1 "$SGM" measure rooms.sgm --cell 0.25 --radius 8
err_has 'less than 32 cells, 8 m'
one_line
expect 1 "$SGM" measure rooms.sgm --from -14,0,0 --to 1e9,8,8
err_has 'the end `to` of the path lies outside of the region: it is at \(1e\+09, 8, 8\), but the region goes from \(-32, -16, -16\) to \(32, 16, 16\), in metres'
one_line
expect 2 "$SGM" measure "$SOURCE/tests/bench/grammars/cave.sgm" --radius 0
err_has 'endless: choose a part with --region'
one_line

# Long work must show its progress if standard error is a terminal.
expect 0 "$SGM" mesh ball.sgm --cell 0.05 --out looked_at.glb
if command -v script >/dev/null; then
  run script -qec "$SGM measure looked_at.glb" /dev/null
  out_has 'measuring \[#* *\] [0-9]+/[0-9]+'
fi
rm looked_at.glb

# If the calling process ends, the child process that reads the file must end, too.
if [[ -e large.stl ]]; then
  "$SGM" measure large.stl >/dev/null 2>&1 &
  sleep 0.3
  reader=$(pgrep -P $! || true)
  kill -TERM $! 2>/dev/null
  wait $! 2>/dev/null
  sleep 0.3
  # If the reading process is still listed, it must be a zombie: a process that has ended, but whose parent has not yet
  # asked for its status.
  [[ -z $reader || $(ps -o stat= -p "$reader") != [^Z]* ]] || failed 'the process that reads outlives its caller'
fi
finish

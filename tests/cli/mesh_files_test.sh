#!/usr/bin/env bash
# Tests mesh files as common exporters write them, with content other than triangles, or with wrong extensions. Measure,
# inspect and import must read them in the same way and give the same notes.
source "$(dirname "$0")/common.sh"
files=$SOURCE/tests/cli/mesh_files

# measured FILE EXPRESSION NOTE: measures the file; the JSON must satisfy the expression, and both JSON and standard
# error must have exactly this note ('' for none).
measured() {
  expect 0 "$SGM" measure "$1" --json
  json "$2"
  if [[ -z $3 ]]; then
    json 'j.notes.length === 0'
    err_empty
  else
    json "j.notes.length === 1 && j.notes[0].includes('$3')"
    err_has "^sgm: note: $1: "
    one_line
  fi
}
near() { echo "Math.abs($1 - $2) < 1e-5"; }

for file in "$files"/*; do cp "$file" .; done
measured concave_l.obj "j.valid && $(near j.volume 3) && $(near j.area 14)" ''
measured concave_c.ply "j.valid && $(near j.volume 7) && $(near j.area 30)" ''
measured skinned.glb "j.valid && $(near j.volume 8) && $(near '(j.bounds[0][0] + j.bounds[1][0]) / 2' 100)" ''
measured morphed.glb "j.valid && $(near j.volume 12)" ''
measured sparse.glb "j.valid && $(near j.volume 8)" ''
measured strip.glb "j.valid && $(near j.volume 8)" '1 strip has triangles at odd places only, at /meshes/0/primitives/0'
measured lines_beside.glb "j.valid && $(near j.volume 8)" '1 primitive of lines or points is left out, at /meshes/0/primitives/1'
measured byte_order_mark.stl "j.valid && $(near j.volume 8)" ''
measured glb_named.stl "j.valid && $(near j.volume 8)" 'by its bytes it is glTF, not STL'
measured bytes_behind.stl "j.valid && $(near j.volume 8)" '16 bytes after its last triangle are left out, at byte 684'
measured empty_normals.obj "j.valid && $(near j.volume 8)" ''
measured missing_coordinates.obj "j.valid && $(near j.volume '8 / 6')" '12 corners of faces name texture coordinates that the file does not have, such as number 4 at line 6'
measured surplus_values.ply "j.valid && $(near j.volume 4.5)" '4 lines have more values than the header declares, the first at line 19'
measured unpadded.glb "j.valid && $(near j.volume '8 / 6')" 'the length of a chunk is not a multiple of 4 (518), at byte 12'

# Measures a square of one metre with a texture of 256 pixels that is repeated four times in each direction.
expect 0 "$SGM" measure texture_transform.glb --texels 256 --json
json 'Math.abs(j.texels.mean - 1024) < 0.01 || Math.abs(j.texels.median - 1024) < 0.01'

# Reads a mesh of the cases above in UTF-16, and another one as glTF in text form.
{ printf '\xFF\xFE' && iconv -f UTF-8 -t UTF-16LE concave_l.obj; } >wide.obj
measured wide.obj "j.valid && $(near j.volume 3)" ''
node -e '
  const fs = require("fs"), glb = fs.readFileSync("sparse.glb"), size = glb.readUInt32LE(12);
  const json = JSON.parse(glb.toString("utf8", 20, 20 + size));
  json.buffers[0].uri = "data:application/octet-stream;base64," + glb.subarray(28 + size).toString("base64");
  fs.writeFileSync("sparse.gltf", JSON.stringify(json));
  json.buffers[0].uri = "sparse.bin";
  fs.writeFileSync("outside.gltf", JSON.stringify(json));'
measured sparse.gltf "j.valid && $(near j.volume 8)" ''
expect 1 "$SGM" measure outside.gltf
err_has 'outside.gltf: buffer 0 lies in another file, `sparse.bin`, at /buffers/0 of its JSON; save it as binary glTF'
one_line
out_empty

# If a file is no mesh, the message must name its real format, whatever its name.
printf '\x89PNG\r\n\x1A\n' >picture.glb
expect 1 "$SGM" measure picture.glb
err_has 'picture.glb: it is a PNG picture, not a mesh; '
one_line
printf 'sgm 1;\n' >grammar.obj
expect 1 "$SGM" measure grammar.obj
err_has 'it is a grammar .\.sgm., not a mesh file'
one_line

# A self-intersecting polygon must be reported with its line.
printf 'v 0 0 0\nv 2 2 0\nv 2 0 0\nv 0 2 0\nf 1 2 3 4\n' >bow.obj
expect 0 "$SGM" measure bow.obj
err_has '^sgm: note: bow.obj: 1 polygon crosses itself or has no area, at line 5'

# Notes about damaged files must also be printed for the second file of --against, and for classified files.
expect 0 "$SGM" measure concave_l.obj --against bytes_behind.stl --json
err_has '^sgm: note: bytes_behind.stl: 16 bytes'
ball >ball.sgm
expect 0 "$SGM" mesh ball.sgm --cell 0.5 --out ball.stl
printf 'behind' >>ball.stl
expect 0 "$SGM" classify ball.stl --json
json 'j.notes.length === 1 && j.notes[0].startsWith("6 bytes after")'
err_has '^sgm: note: ball.stl: 6 bytes after'

# An uploaded file must be read like a file on the command line, whatever its declared type. Its report must contain the
# notes.
"$SGM" inspect --kind stl --name house.stl <glb_named.stl >.frame 2>.err
last='inspect glb_named.stl'
[[ -s .err ]] && failed 'inspect speaks on standard error'
node -e '
  const all = require("fs").readFileSync(".frame");
  require("fs").writeFileSync(".out", all.subarray(8, 8 + Number(all.readBigUInt64LE(0))));'
out=$(<.out)
json "j.valid && $(near j.measures.volume 8) && j.measures.notes.length === 1 && j.measures.notes[0].startsWith('by its bytes')"

# If a grammar imports a mesh file that causes notes, they must be reported as warnings at the import.
cp lines_beside.glb box.glb
printf 'sgm 1;\nunits m;\nimport "box.glb" as box;\nstart Box;\nrule Box { size(2m, 2m, 2m) fit box; }\n' >box.sgm
expect 0 "$SGM" check box.sgm
[[ "$out$err" == *'box.sgm:3:'*'`box.glb`: 1 primitive of lines or points is left out'* ]] || failed 'the warning is not at the import'
expect 0 "$SGM" measure box.sgm --cell 0.25 --json
json 'j.valid'

# The .mtl file's name must be written so that every reader finds the file.
mkdir 'my meshes'
expect 0 "$SGM" mesh ball.sgm --cell 0.5 --out 'my meshes/a house ß.obj'
library=$(sed -n 's/^mtllib //p' 'my meshes/a house ß.obj')
[[ $library =~ ^a_house__+[0-9a-f]{8}\.mtl$ && -s "my meshes/$library" ]] || failed "mtllib '$library' is not there"
expect 0 "$SGM" mesh ball.sgm --cell 0.5 --out 'plain-1.2_x.obj'
grep -qx 'mtllib plain-1.2_x.mtl' plain-1.2_x.obj || failed 'a plain name is kept'
finish

#!/usr/bin/env bash
# Writes small mesh files as initial inputs of mesh_file_fuzz: a letter for the format, then the file.
#
#   mesh_seeds.sh FOLDER GLB...
set -euo pipefail
folder=$1
shift
rm -rf "$folder"
mkdir -p "$folder"
seed() { cat >"$folder/$1"; }

for glb in "$@"; do
  { printf g && cat "$glb"; } | seed "glb_$(basename "$glb")"
done

square='v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 -5e-1\n'
printf "o# a square\n${square}usemtl brick\nf 1 2 3 4\n" | seed obj_square
printf "o${square}vt 0 0\nvt 1 0 0\nvn 0 0 1\nvn 1 0 0\nf 1/1/1 2/2/1 3/1/1\nf -4//2 -2//1 \\\\\\n -1//1\n" | seed obj_corners
printf "o\xEF\xBB\xBFmtllib a.mtl\r\no x\r\ng y\r\ns 1\r\nv +1 2 3\r\nf 1/ 1 1 1 1 # all\r\n" | seed obj_windows

printf "o${square}v .5 .5 0\nf 1 2 5 3 4\nf 1 2 4 3\nl 1 2\nf 1//9 2/7/ 3//\n" | seed obj_polygons
printf 'g{"asset":{},"nodes":[{"mesh":0,"skin":0},{}],"skins":[{"joints":[1]}],"meshes":[{"weights":[1],"primitives":[{"mode":5,"attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2},"targets":[{"POSITION":0}]}]}],"accessors":[{"componentType":5126,"count":3,"type":"VEC3","sparse":{"count":1,"indices":{"bufferView":0,"componentType":5121},"values":{"bufferView":0}}},{"bufferView":0,"componentType":5121,"count":3,"type":"VEC4"},{"bufferView":0,"componentType":5121,"normalized":true,"count":3,"type":"VEC4"}],"bufferViews":[{"buffer":0,"byteLength":12}],"buffers":[{"byteLength":12,"uri":"data:;base64,AAAAAAAAAAAAAAAA"}]}' | seed gltf_text
printf 's\xFF\xFEs\0o\0l\0i\0d\0\n\0' | seed stl_wide

properties='property float x\nproperty float y\nproperty float z\n'
faces='element face 1\nproperty list uchar int vertex_indices\nend_header\n'
printf "pply\nformat ascii 1.0\ncomment c\nelement vertex 3\n${properties}property list uchar int skip\nproperty float s\nproperty float t\n${faces}0 0 0 0 0 0\n1 0 0 1 5 1 0\n0 1 0 0 0 1\n3 0 1 2\n" |
  seed ply_text
printf "pply\nformat ascii 1.0\nelement vertex 4\n${properties}element tristrips 1\nproperty list int int vertex_indices\nend_header\n0 0 0 9\n1 0 0\n0 1 0\n0 0 1\n9 0 1 2 3 -1 1 0 2 3 7\n" | seed ply_strips
one='\0\0\x80\x3F' zero='\0\0\0\0'
printf "pply\nformat binary_little_endian 1.0\nelement vertex 3\n${properties}property float nx\nproperty float ny\nproperty float nz\n${faces}$zero$zero$zero$zero$zero$one$one$zero$zero$zero$zero$one$zero$one$zero$zero$zero$one\x03$zero\1\0\0\0\2\0\0\0" |
  seed ply_little
one='\x3F\x80\0\0'
printf "pply\r\nformat binary_big_endian 1.0\r\nelement other 1\r\nproperty double d\r\nelement vertex 3\r\n${properties//\\n/\\r\\n}${faces//\\n/\\r\\n}$zero$zero$zero$zero$zero$one$zero$zero$zero$one$zero\x03$zero\0\0\0\1\0\0\0\2" |
  seed ply_big

facet='facet normal 0 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1 0 0\n  vertex 0 1e0 0\n endloop\nendfacet\n'
printf "ssolid a\n$facet${facet}endsolid a\n" | seed stl_text
one='\0\0\x80\x3F'
{ printf 's%-80s\1\0\0\0' 'solid, and yet binary' && printf "$zero$zero$one$zero$zero$zero$one$zero$zero$zero$one$zero\0\0"; } |
  seed stl_binary

#!/usr/bin/env bash
# Tests the command on a simulated CUDA GPU: LD_LIBRARY_PATH makes the loader find the libcuda.so.1 of the simulation
# first.
source "$(dirname "$0")/common.sh"

expect 0 "$SGM" backends
out_has 'auto chooses cuda'
out_has 'a GPU that pretends \(compute capability 9\.0, 2 multiprocessors, .* CUDA 13\.0\): usable, exact'
expect 0 "$SGM" backends --json
json 'j.backends[2].usable && j.backends[2].device === "a GPU that pretends"'

expect 0 "$SGM" bench paper --size 16 --runs 1 --backend cuda --json
json 'j.stages.every(s => s.rows[1].name === "cuda" && s.rows[1].hash === s.rows[0].hash && s.rows[1].chunks_on_cpu === 0)'

expect 0 "$SGM" mesh "$SOURCE/samples/grammars/passage.sgm" --region 0,-8,-8:64,8,8 --cell 1 --backend cpu --out cpu.ply
expect 0 "$SGM" mesh "$SOURCE/samples/grammars/passage.sgm" --region 0,-8,-8:64,8,8 --cell 1 --backend cuda --out cuda.ply
cmp cpu.ply cuda.ply || failed "the meshes differ"
rm cpu.ply cuda.ply
only
finish

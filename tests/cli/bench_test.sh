#!/usr/bin/env bash
# Tests sgm bench paper: its figures follow from its times, all backends make equal meshes, and each missing measurement
# has a reason.
source "$(dirname "$0")/common.sh"

expect 0 "$SGM" bench paper --help
out_has 'Example:'
expect 0 "$SGM" bench --help
out_has 'sgm bench paper'

expect 0 "$SGM" bench paper --size 32 --runs 3 --threads 2 --json
err_empty
json 'j.runs === 3 && j.stages.map(s => s.stage).join() === "cave,cloud,building"'
json 'j.stages.every(s => s.rows.map(r => r.name).join() === "sequential,cpu,vulkan,cuda")'
json 'j.stages.every(s => s.chunks >= 1 && s.operations > 1000 && s.cell_units === s.cell * 1024)'
json 'j.stages.every(s => s.rows.slice(0, 2).every(r => r.measured && r.device && r.triangles > 0 && r.seconds > 0 && r.first_seconds > 0))'
json 'j.stages.every(s => s.rows[0].workers === 1 && s.rows[0].speedup === 1 && s.rows[0].efficiency === 1)'
json 'j.stages.every(s => s.rows[1].workers === 2 && s.rows[1].chunks_on_cpu === 0)'
# All rows of a stage must have the same hash, and different stages different hashes.
json 'j.stages.every(s => new Set(s.rows.filter(r => r.measured).map(r => r.hash)).size === 1)'
json 'new Set(j.stages.map(s => s.rows[0].hash)).size === 3 && j.stages.every(s => /^[0-9a-f]{16}$/.test(s.rows[0].hash))'
# Checks the paper's equations 2 to 4 with the times of the runs.
near='const near = (a, b) => Math.abs(a - b) <= 1e-12 * Math.abs(b); const median = a => [...a].sort((x, y) => x - y)[1];'
measured='const rows = j.stages.flatMap(s => s.rows.filter(r => r.measured).map(r => ({s, r})));'
json "$near $measured rows.every(({r}) => r.run_seconds.length === 3 && near(r.seconds, median(r.run_seconds)))"
json "$near $measured rows.every(({s, r}) => near(r.speedup, s.rows[0].seconds / r.seconds))"
json "$near $measured rows.every(({r}) => r.workers === null ? r.no_efficiency : near(r.efficiency, r.speedup / r.workers))"
json "$near $measured rows.every(({s, r}) => near(r.operations_per_second, s.operations / r.seconds))"
# A row must give the reason if it was not measured: its backend is missing, or cannot run the stage by itself.
json 'j.stages.every(s => s.rows.every(r => r.measured ? r.reason === undefined : r.reason.length > 0 && !r.hash))'
# Checks the figures that are quoted from the printed paper.
json 'j.paper.workers === 255 && j.paper.sequential_gflops === 0.8 && j.paper.parallel_gflops === 20.61'
json 'j.stages[0].paper.speedup === 0.81 / 0.096 && j.stages[0].paper.printed_efficiency === 0.028'
json 'j.paper.inconsistencies.length >= 5 && j.counted && j.measured'
operations=$(node -p 'JSON.parse(require("fs").readFileSync(".out")).stages.map(s => s.operations + s.rows[0].hash).join()')

# With another number of threads, the meshes and the amount of work must be the same; the table shows both rows.
expect 0 "$SGM" bench paper --size 32 --runs 1 --threads 1 --backend cpu --json
json 'j.stages.every(s => s.rows.map(r => r.name).join() === "sequential,cpu" && s.rows[1].workers === 1)'
json "j.stages.map(s => s.operations + s.rows[0].hash).join() === '$operations'"
hashes=$(node -p 'JSON.parse(require("fs").readFileSync(".out")).stages.map(s => s.rows[0].hash).join(" ")')
expect 0 "$SGM" bench paper --size 32 --runs 1
err_empty
out_has 'medians of 1 warm run'
for hash in $hashes; do
  out_has "sequential +1 +[0-9.]+ +[0-9.]+ +1\.00 +1\.000 +[0-9.]+ +[0-9]+ +$hash"
  out_has "cpu +[0-9]+ +[0-9.]+ +[0-9.]+ +[0-9.]+ +[0-9.]+ +[0-9.]+ +[0-9]+ +$hash"
done
out_has 'vulkan +(not measured: .|- +[0-9.]+)'
out_has 'cuda +(not measured: .|- +[0-9.]+)'
out_has 'paper, parallel +255 +0\.0960 +8\.44 +0\.028  by its own times 0\.0331'
out_has 'no one number fits'
out_has 'Operations: instructions of the field programs'

# --cell sets the cell edge of all stages.
expect 0 "$SGM" bench paper --cell 8 --runs 1 --backend cpu --json
json 'j.stages.every(s => s.cell === 8)'

# If a backend is requested by name but missing, the other rows must be measured, and the exit status must be 3.
expect 0 "$SGM" backends --json
if node -e 'process.exit(JSON.parse(require("fs").readFileSync(".out")).backends[2].usable ? 0 : 1)'; then
  expect 0 "$SGM" bench paper --size 32 --runs 1 --backend cuda --json
  json 'j.stages.every(s => s.rows[1].name === "cuda" && s.rows[1].hash === s.rows[0].hash)'
else
  expect 3 "$SGM" bench paper --size 32 --runs 1 --backend cuda --json
  json 'j.stages.every(s => s.rows.map(r => r.name).join() === "sequential,cuda" && s.rows[0].hash && s.rows[1].reason)'
  err_has '^sgm: error: cuda: .'
  one_line
fi

# Tests sgm bench chunks: it measures each instruction set of the processor, with a grammar of the user.
expect 0 "$SGM" bench chunks "$SOURCE"/samples/grammars/sphere.sgm --runs 2 --threads 2 --json
json 'j.rows.length >= 2 && j.rows[0].instruction_set === "scalar" && j.rows.every(r => r.threads <= 2)'
json 'new Set(j.rows.map(r => r.hash + r.triangles + r.chunks)).size === 1 && j.rows[0].triangles > 1000'
json 'j.rows.every(r => r.median_ms > 0 && (r.threads > 1 || r.surface_chunk_most_ms >= r.surface_chunk_median_ms))'
expect 0 "$SGM" bench chunks "$SOURCE"/tests/bench/grammars/cave.sgm --region 0,0,0:96,96,96 --runs 1 --threads 1
err_empty
out_has 'scalar +1 +[0-9.]+ +[0-9.]+'

# Invalid input and invalid options must be refused.
wrong() {
  expect "$@"
  out_empty
  one_line
}
wrong 1 "$SGM" bench paper --cell 0
err_has '--cell: '
wrong 1 "$SGM" bench paper --cell nan
wrong 1 "$SGM" bench paper --cell 0.01 --runs 1
err_has 'cave: sequential: '
usage() {
  expect 2 "$SGM" bench "$@"
  err_has '^sgm: usage: .'
  out_empty
}
usage
usage chunks
usage chunks "$SOURCE"/tests/bench/grammars/cave.sgm
usage chunks "$SOURCE"/samples/grammars/sphere.sgm --backend vulkan
usage speed
usage paper extra
usage paper --runs 0
usage paper --runs -1
usage paper --size 4
usage paper --size 99999
usage paper --size 64 --cell 1
usage paper --backend auto
usage paper --backend opencl
usage paper --threads -1
only
finish

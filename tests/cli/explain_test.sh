#!/usr/bin/env bash
# Tests sgm explain: it reports which rules made a place, as text and as JSON, and its paths can be used in overrides.
source "$(dirname "$0")/common.sh"

lipp=$SOURCE/tests/bench/grammars/table4/lipp.sgm
expect 0 "$SGM" explain "$lipp" --at=-9,-3,7.8
out_has '^-9,-3,7.79[0-9]+ m, seed 0, cells of 0.5 m'
out_has 'open: outside of the nearest shape, Palace/Body\[0\]/Storey\[0\]/Facade\[0\]/Bay\[1\]/Pier\[0\]'
out_has 'nearest surface 0.40 m away at -9.00,-3.00,7.40 m \(plaster\): Palace/Body\[0\]'
out_has '>   box +outside +0.40 m  .*lipp.sgm:[0-9]+:[0-9]+'
err_empty

# An override with the path that explain reports must remove the pier.
expect 0 "$SGM" explain "$lipp" --at=3,-7,7.2 --json
json 'j.solid && j.material === "plaster" && j.nodes.filter(n => n.decides).length === 1'
json 'j.nodes.find(n => n.decides).path === j.path && j.nodes.every(n => n.line > 0 && n.file.endsWith("lipp.sgm"))'
json 'j.surface.distance < 0.5 && Math.abs(j.surface.at[2] - 7.4) < 0.01 && Math.abs(j.surface.normal[2] - 1) < 0.01'
path=$(node -e 'console.log(JSON.parse(require("fs").readFileSync(process.argv[1], "utf8")).path)' .out)
{ cat "$lipp"; echo "override \"$path\" { }"; } >edited.sgm
expect 0 "$SGM" explain edited.sgm --at=3,-7,7.2 --json
json '!j.solid'

# In a cave, explain must report that a hall has cut out the void, and that rock comes from the statement `domain`.
cave=$SOURCE/tests/bench/grammars/cave.sgm
expect 0 "$SGM" explain "$cave" --at=95.98,82.95,100.18
out_has 'morph at t = 0.300'
out_has 'cave.hall'
expect 0 "$SGM" explain "$cave" --at=95.98,75,100.18 --json
json '!j.solid && j.layer === "net" && j.nodes[0].cuts && j.nodes[0].kind === "displace" && typeof j.nodes[0].by === "number"'
json 'j.nodes.find(n => n.kind === "morph").t === 0.30000001192092896'
expect 0 "$SGM" explain "$cave" --at=0,0,0 --json
json 'j.solid && j.material === "limestone"'

# Far from all shapes, there is nothing to explain.
ball >ball.sgm
expect 0 "$SGM" explain ball.sgm --at=500,0,0
out_has "open: no shape is near, the domain decides"
out_has 'no surface within 64 m'
expect 0 "$SGM" explain ball.sgm --at=0,2.5,0 --set radius=2m
out_has 'nearest surface 0.50 m away at 0.00,2.00,0.00 m \(marble\): Ball'

expect 2 "$SGM" explain ball.sgm
err_has '--at is required'
expect 2 "$SGM" explain ball.sgm --at=1,2
err_has "'1,2' is not a point such as 1,2.5,-3"
expect 2 "$SGM" explain ball.sgm --at=1e9,0,0
err_has 'outside of the world'
one_line
finish

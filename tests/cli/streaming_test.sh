#!/usr/bin/env bash
# Tests the script that measures streaming: it must measure every row, and fail if a flight fails or a surface is not
# closed.
source "$(dirname "$0")/common.sh"
script=$SOURCE/tests/bench/streaming.sh
expect 0 bash "$script" "$SGM" figures --quick
out_has '\| line \| asked \| reached \| met \|'
# Rows that need the program sgm_bench_crowds are measured only if it is built.
[[ -x $(dirname "$SGM")/sgm_bench_crowds ]] && crowds=6 || crowds=0
[[ $(grep -c 'not measured' <<<"$out") == $((6 - crowds)) ]] || failed "something was not measured"
lines=figures/streaming.csv
[[ $(head -1 $lines) == line,asked,reached,met,command ]] || failed "the CSV has no such columns"
[[ $(wc -l <$lines) == 19 && $(grep -c 'sgm fly tests/bench/grammars/cave.sgm --' $lines) == 12 ]] || failed "18 lines expected"
[[ $(grep -c 'sgm_bench_crowds tests/bench/grammars/cave.sgm' $lines) == $crowds ]] || failed "$crowds lines of crowds expected"
grep -q '^<svg .*</svg>$' figures/streaming.svg || failed "no chart"

# Makes two fake commands: one reports an open edge, the other prints nothing.
printf '#!/usr/bin/env bash\nsed "s/\\"open_edges\\": *0/\\"open_edges\\": 1/" "$REPORT"\n' >torn
printf '#!/usr/bin/env bash\nexit 1\n' >mute
chmod +x torn mute
for flight in figures/closed_*.flight.json; do
  node -p 'const f = JSON.parse(require("fs").readFileSync(process.argv[1])); JSON.stringify(f.report, null, 1)' "$flight" >one.json
done
expect 1 env REPORT=one.json bash "$script" "$PWD/torn" worse --quick
err_has 'not closed'
expect 1 bash "$script" "$PWD/mute" worse --quick
err_has 'failed with status 1'
out_has 'not measured'
expect 2 bash "$script"
finish

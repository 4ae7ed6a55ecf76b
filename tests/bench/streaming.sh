#!/usr/bin/env bash
# Measures the figures of streaming with `sgm fly`, and with sgm_bench_crowds if that program is in the same folder.
# Writes streaming.csv and streaming.svg, and prints a table with the targets. A slow time is no failure: the exit
# status is 1 only if a flight fails or a surface was not closed.
#
#   streaming.sh SGM [OUT_DIR] [--long | --quick]
#
#   SGM       the command
#   OUT_DIR   folder for the results and the reports of all flights (default: out/streaming)
#   --long    digs for a minute, checks 11,134 frames in each of nine flights, and flies over new ground for half an
#             hour
#   --quick   runs only a few frames of everything, to test this script: the figures mean nothing
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
sgm='' out='' mode=''
for word; do
  case $word in
    --long | --quick) mode=$word ;;
    *) if [[ -z $sgm ]]; then sgm=$word; else out=$word; fi ;;
  esac
done
[[ -n $sgm ]] || { sed -n '2,/^set /{/^set /d;s/^# \{0,1\}//;p}' "${BASH_SOURCE[0]}" >&2; exit 2; }
out=${out:-out/streaming}
mkdir -p "$out"
rm -f "$out"/*.flight.json "$out"/*.crowd.json

cave=$here/grammars/cave.sgm
frames=600 dug=1200 checked=1000
world=(--cell 0.25 --seed 3) speeds=(5 20 60) seeds=(1 2 3)
crowd_seconds=10 budget_seconds=5 far_seconds=180
[[ $mode == --long ]] && dug=3600 checked=11134 far_seconds=1800
if [[ $mode == --quick ]]; then
  frames=40 dug=90 checked=90 speeds=(60) seeds=(1)
  world=(--cell 0.5 --seed 3 --top-level 3 --view 60)
  crowd_seconds=1 budget_seconds=3 far_seconds=3
fi

failed=0
# flight NAME OPTION...: flies with these options; writes the report, the command and the exit status to
# NAME.flight.json.
flight() {
  local name=$1 status=0 report=$out/$1.report
  shift
  echo "sgm fly cave.sgm $*" >&2
  "$sgm" fly "$cave" "$@" --json >"$report" || status=$?
  ((status == 0)) || { failed=1; echo "streaming: the flight $name failed with status $status" >&2; }
  node -e 'const [file, status, command] = process.argv.slice(1);
    const text = require("fs").readFileSync(file, "utf8");
    console.log(JSON.stringify({ command, status: +status, report: text ? JSON.parse(text) : null }))' \
    "$report" "$status" "sgm fly tests/bench/grammars/cave.sgm $*" >"$out/$name.flight.json"
  rm "$report"
}

for run in 1 2 3; do flight "walk$run" "${world[@]}" --speed 20 --frames "$frames"; done
flight fast "${world[@]}" --speed 60 --frames "$frames"
flight reach "${world[@]}" --speed 20 --frames "$frames" --compare
flight leaps "${world[@]}" --speed 20 --frames "$frames" --teleports 10
flight digs "${world[@]}" --speed 5 --edits 60 --frames "$dug"
for speed in "${speeds[@]}"; do
  for seed in "${seeds[@]}"; do
    flight "closed_${speed}_$seed" --cell 0.5 --seed "$seed" --speed "$speed" --frames "$checked" --finest 16 \
      --top-level 5 --view 200 --teleports 10 --edits 5 --unpaced --check
  done
done
# crowd NAME ROW OPTION...: runs sgm_bench_crowds; writes its figures and the command to NAME.crowd.json.
crowd() {
  local name=$1 status=0 report=$out/$1.report
  shift
  echo "sgm_bench_crowds cave.sgm $*" >&2
  "$(dirname "$sgm")/sgm_bench_crowds" "$cave" "$@" >"$report" || status=$?
  ((status == 0)) || { failed=1; echo "streaming: the row $name failed with status $status" >&2; }
  node -e 'const [file, command] = process.argv.slice(1);
    const text = require("fs").readFileSync(file, "utf8");
    console.log(JSON.stringify({ command, report: text ? JSON.parse(text) : null }))' \
    "$report" "sgm_bench_crowds tests/bench/grammars/cave.sgm $*" >"$out/$name.crowd.json"
  rm "$report"
}
crowds() {
  crowd crowd walkers --count 64 --seconds "$crowd_seconds"
  crowd worlds worlds --count 32 --rate 125 --seconds "$((crowd_seconds == 10 ? 8 : crowd_seconds))"
  crowd edits fast --seconds "$crowd_seconds"
  crowd budget budget --seconds "$budget_seconds"
  crowd colliders walk --seconds "$crowd_seconds"
  crowd far far --speed 60 --seconds "$far_seconds"
}
if [[ -x $(dirname "$sgm")/sgm_bench_crowds ]]; then
  crowds
else
  echo "streaming: there is no sgm_bench_crowds beside $sgm: build the benchmarks to measure crowds" >&2
fi
node "$here/streaming_table.js" "$out" || failed=1
exit "$failed"

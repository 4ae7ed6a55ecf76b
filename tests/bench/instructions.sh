#!/usr/bin/env bash
# Counts the instructions of a small fixed piece of work under valgrind and compares them with the recorded figures:
# unlike a time, a count is the same on a busy machine. It may differ from the record by the tolerance in
# instructions.json. A count that fell by more is also an error, so that the record is updated.
#
#   instructions.sh PROGRAM COMPILER PATH [--record]
#
#   PROGRAM   sgm_bench_instructions
#   COMPILER  name and version, as CMake prints them: each compiler has its own figures
#   PATH      scalar or avx2: the instruction set that the evaluator uses
#   --record  writes the counts of this run into instructions.json instead
set -euo pipefail
program=$1 compiler=$2 path=$3 record=${4-}
figures=$(dirname "${BASH_SOURCE[0]}")/instructions.json

skip() {
  echo "SKIPPED: $1"
  if [[ ${SGM_REQUIRE_ALL-} == 1 ]]; then exit 1; fi
  exit 77
}
command -v valgrind >/dev/null || skip "valgrind is not here: install the package valgrind"
if [[ $path == avx2 ]] && ! grep -qw avx2 /proc/cpuinfo; then skip "this processor has no AVX2"; fi

tolerance=$(sed -n 's/.*"tolerance": \([0-9.]*\).*/\1/p' "$figures")
failed=0
unknown=""
for work in $("$program" --list); do
  out=$(valgrind --tool=callgrind --collect-atstart=no --toggle-collect=measured --callgrind-out-file=/dev/null \
    "$program" "$path" "$work" 2>&1) || { echo "$out" >&2; exit 1; }
  count=$(sed -n 's/.*Collected : \([0-9]*\).*/\1/p' <<<"$out")
  [[ ${count:-0} -gt 0 ]] || { echo "$out"; echo "instructions: nothing was counted for $work" >&2; exit 1; }
  key="$compiler, $path, $work"
  if [[ $record == --record ]]; then
    if grep -q "\"$key\":" "$figures"; then
      sed -i "s/\"$key\": [0-9]*/\"$key\": $count/" "$figures"
    else
      sed -i "s/^  \"counts\": {\$/&\n    \"$key\": $count,/" "$figures"
    fi
    echo "recorded $key: $count"
    continue
  fi
  known=$(sed -n "s/.*\"$key\": \([0-9]*\).*/\1/p" "$figures")
  if [[ -z $known ]]; then
    echo "$key: $count instructions, none recorded"
    unknown+=" $work"
    continue
  fi
  verdict=$(awk -v now="$count" -v was="$known" -v tolerance="$tolerance" 'BEGIN {
    change = now / was - 1
    printf "%+.2f%% %s", 100 * change, (change > tolerance ? "MORE" : (change < -tolerance ? "FEWER" : "ok")) }')
  echo "$key: $count instructions, recorded $known: $verdict"
  [[ $verdict == *ok ]] || failed=1
done
if ((failed)); then
  echo "If the change is meant, run: bash $0 $program '$compiler' $path --record" >&2
fi
# A deviation from a recorded figure always fails. Without a deviation, the test is skipped if a figure has not been
# recorded yet.
if ((!failed)) && [[ -n $unknown ]]; then
  skip "no figures for '$compiler, $path' and$unknown yet: run with --record"
fi
exit "$failed"

#!/usr/bin/env bash
# Tests that every sample grammar has expectations and satisfies them; in the long run, for 100 seeds.
source "$(dirname "$0")/common.sh"
seeds=1
[[ ${SGM_LONG-} != 1 ]] || seeds=100
for grammar in "$SOURCE"/samples/grammars/*.sgm "$SOURCE"/samples/grammars/table4/*.sgm; do
  grep -q '^expect ' "$grammar" || { last=$grammar && failed "no expectation"; }
  # Skies take long with their finest cells, so several seeds are evaluated with cells of 2 m.
  cell=()
  [[ $seeds == 1 || ! $grammar =~ (birger|/cloud) ]] || cell=(--cell 2)
  expect 0 "$SGM" check --expect "$grammar" --seeds "$seeds" ${cell[@]+"${cell[@]}"}
  out_has "$(basename "$grammar"): ok, "
done
finish

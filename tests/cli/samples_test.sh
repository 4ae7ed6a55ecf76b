#!/usr/bin/env bash
# Every sample grammar says something of itself, and keeps it; in the long run with 100 seeds.
source "$(dirname "$0")/common.sh"
seeds=1
[[ ${SGM_LONG-} != 1 ]] || seeds=100
for grammar in "$SOURCE"/samples/grammars/*.sgm "$SOURCE"/samples/grammars/table4/*.sgm; do
  grep -q '^expect ' "$grammar" || { last=$grammar && failed "no expectation"; }
  # A sky takes long at its finest level: of its many seeds only the first is seen there.
  cell=()
  [[ $seeds == 1 || ! $grammar =~ (birger|/cloud) ]] || cell=(--cell 2)
  expect 0 "$SGM" check --expect "$grammar" --seeds "$seeds" ${cell[@]+"${cell[@]}"}
  out_has "$(basename "$grammar"): ok, "
done
finish

#!/usr/bin/env bash
# Every sample grammar says something of itself, and keeps it; in the long run with several seeds.
source "$(dirname "$0")/common.sh"
seeds=1
[[ ${SGM_LONG-} != 1 ]] || seeds=3
for grammar in "$SOURCE"/samples/grammars/*.sgm "$SOURCE"/samples/grammars/table4/*.sgm; do
  grep -q '^expect ' "$grammar" || { last=$grammar && failed "no expectation"; }
  expect 0 "$SGM" check --expect "$grammar" --seeds "$seeds"
  out_has "$(basename "$grammar"): ok, "
done
finish

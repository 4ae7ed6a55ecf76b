#!/usr/bin/env bash
# Every sample grammar says something of itself, and keeps it; in the long run with several seeds.
source "$(dirname "$0")/common.sh"
for grammar in "$SOURCE"/samples/grammars/*.sgm; do
  grep -q '^expect ' "$grammar" || { last=$grammar && failed "no expectation"; }
  seeds=${SGM_LONG:+3} sets=()
  if [[ $grammar == */cave.sgm ]]; then
    # What drips is smaller than the cells and so in no sample, but to derive it in a quarter of a million cells would take minutes.
    seeds=1 sets=(--set wet=0%)
  fi
  expect 0 "$SGM" check --expect "$grammar" --seeds "${seeds:-1}" ${sets[@]+"${sets[@]}"}
  out_has "$(basename "$grammar"): ok, "
done
finish

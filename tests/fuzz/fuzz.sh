#!/usr/bin/env bash
# Runs one fuzzer: a fixed number of inputs from a fixed seed, or for half an hour with SGM_LONG=1. An input that
# makes it fail is kept in FOLDER, and the output has its name.
#
#   fuzz.sh PROGRAM RUNS FOLDER [SEEDS [LONG_SEEDS]]
set -euo pipefail
program=$1 runs=$2 folder=$3 seeds=${4-} long_seeds=${5-}
mkdir -p "$folder/found" "$folder/failed"
# A short run ignores inputs that earlier runs found, so that it is reproducible.
how=(-runs="$runs" -seed=1)
corpus=("$folder/found")
if [[ ${SGM_LONG-} == 1 ]]; then
  how=(-max_total_time=1800)
else
  rm -rf "$folder/found"
  mkdir "$folder/found"
fi
if [[ -n $seeds ]]; then
  corpus+=("$seeds")
  [[ -z $long_seeds || ${SGM_LONG-} != 1 ]] || corpus+=("$long_seeds")
  for of in "${corpus[@]}"; do [[ -d $of ]] || { echo "fuzz.sh: there is no folder $of" >&2; exit 1; }; done
else
  # Without initial inputs, try long inputs from the start; otherwise a short run would never reach any.
  how+=(-len_control=0)
fi
exec "$program" "${how[@]}" -timeout=20 -rss_limit_mb=4096 -max_len=8192 -print_final_stats=1 -verbosity=0 \
  -artifact_prefix="$folder/failed/" "${corpus[@]}" </dev/null

#!/usr/bin/env bash
# The demo's grammars are copies of the samples, so that the demo project can be copied to another place.
#
#   bash editor_plugin/tests/demo_grammars.sh [write]     compares them; write: copies the samples over them
set -euo pipefail
cd "$(dirname "$0")/../.."
status=0
count=0
for copy in editor_plugin/demo/grammars/*.sgm; do
  [[ -e $copy ]] || continue
  count=$((count + 1))
  sample="samples/grammars/$(basename "$copy")"
  if [[ ${1-} == write ]]; then
    cp "$sample" "$copy"
  elif ! cmp "$sample" "$copy"; then
    echo "$copy differs from $sample: bash editor_plugin/tests/demo_grammars.sh write" >&2
    status=1
  fi
done
if [ "$count" -eq 0 ]; then
  echo "editor_plugin/demo/grammars has no grammar: copy those of samples/grammars that the demo shows" >&2
  exit 1
fi
exit "$status"

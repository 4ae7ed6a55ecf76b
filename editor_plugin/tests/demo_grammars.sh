#!/usr/bin/env bash
# The demo's grammars are plain copies, so that the project can be copied away: of those that stay as they are, since the
# demo's cameras stand at places of theirs.
set -euo pipefail
cd "$(dirname "$0")/../.."
status=0
count=0
for copy in editor_plugin/demo/grammars/*.sgm; do
  count=$((count + 1))
  sample="tests/bench/grammars/$(basename "$copy")"
  if ! cmp "$sample" "$copy"; then
    echo "$copy differs from $sample: copy that over it" >&2
    status=1
  fi
done
if [ "$count" -eq 0 ]; then
  echo "editor_plugin/demo/grammars has no grammar: copy those of tests/bench/grammars that the demo shows" >&2
  exit 1
fi
exit "$status"

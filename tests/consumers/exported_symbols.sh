#!/usr/bin/env bash
# The library shows what its headers declare and nothing else.
#
#   bash exported_symbols.sh LIBRARY INCLUDE_FOLDER
set -euo pipefail
export LC_ALL=C
library=$1 include=$2
exported=$(nm -D --defined-only --format=posix "$library" | awk '{ print $1 }' | sort)
declared=$(sed -n 's/^SGM_API .*\b\(sgm_[a-z0-9_]*\)(.*/\1/p' "$include"/*.h | sort)
diff <(echo "$declared") <(echo "$exported") >/dev/null && { wc -l <<<"$exported"; exit 0; }
echo "declared only:" >&2
comm -23 <(echo "$declared") <(echo "$exported") >&2
echo "exported only:" >&2
comm -13 <(echo "$declared") <(echo "$exported") >&2
exit 1

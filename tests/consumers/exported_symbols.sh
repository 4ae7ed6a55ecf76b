#!/usr/bin/env bash
# Checks that the libraries export exactly the functions that their headers declare.
#
#   bash exported_symbols.sh LIBRARY INCLUDE_FOLDER [SERVICE_LIBRARY]
set -euo pipefail
export LC_ALL=C
different=0

# compare LIBRARY HEADER...: compares the exported functions of one library with the declared ones.
compare() {
  local exported declared
  exported=$(nm -D --defined-only --format=posix "$1" | awk '{ print $1 }' | sort)
  declared=$(sed -n 's/^SGM_API .*\b\(sgm_[a-z0-9_]*\)(.*/\1/p' "${@:2}" | sort)
  diff <(echo "$declared") <(echo "$exported") >/dev/null && { wc -l <<<"$exported"; return; }
  different=1
  echo "declared only:" >&2
  comm -23 <(echo "$declared") <(echo "$exported") >&2
  echo "exported only:" >&2
  comm -13 <(echo "$declared") <(echo "$exported") >&2
}

service=$2/sgm_service.h
headers=("$2"/*.h)
compare "$1" "${headers[@]/$service/\/dev\/null}"
[[ -z ${3-} ]] || compare "$3" "$service"
exit $different

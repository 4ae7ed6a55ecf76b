#!/usr/bin/env bash
# Checks that every function that sgm/sgm.h declares is called with wrong arguments in one of the TESTS, except for the
# four functions that take no pointer; and that constants.c checks every constant that the header defines.
#   every_function.sh HEADER CONSTANTS TESTS...
set -euo pipefail
header=$1 constants=$2
shift 2
missing=0
complain() {
  echo "$1" >&2
  missing=1
}

functions=$(grep -oE '^SGM_API [^;(]*\b(sgm_[a-z0-9_]+)\(' "$header" | grep -oE 'sgm_[a-z0-9_]+\($' | tr -d '(') || true
[[ -n $functions ]] || complain "no function was found in $header"
for name in $functions; do
  case $name in sgm_version | sgm_version_string | sgm_build_info | sgm_result_name) continue ;; esac
  grep -q "\b$name(" "$@" || complain "$name is not called with wrong arguments"
done

numbers=$(grep -oE '^(  SGM_[A-Z0-9_]+ =|#define SGM_[A-Z0-9_]+ [(0-9])' "$header" | grep -oE 'SGM_[A-Z0-9_]+') || true
[[ -n $numbers ]] || complain "no number was found in $header"
for name in $numbers; do
  grep -q "\b$name ==" "$constants" || complain "$name is not pinned"
done
exit $missing

#!/usr/bin/env bash
# Checks that arguments_test.cpp calls every function that sgm/sgm.h declares, except the four that take no pointer, and
# that layout.c asserts the value of every constant that the header defines.
#   every_function.sh HEADER ARGUMENTS_TEST LAYOUT
set -euo pipefail
missing=0
complain() {
  echo "$1" >&2
  missing=1
}

functions=$(grep -oE '^SGM_API [^;(]*\b(sgm_[a-z0-9_]+)\(' "$1" | grep -oE 'sgm_[a-z0-9_]+\($' | tr -d '(') || true
[[ -n $functions ]] || complain "no function was found in $1"
for name in $functions; do
  case $name in sgm_version | sgm_version_string | sgm_build_info | sgm_result_name) continue ;; esac
  grep -q "\b$name(" "$2" || complain "$name is not called with wrong arguments"
done

numbers=$(grep -oE '^(  SGM_[A-Z0-9_]+ =|#define SGM_[A-Z0-9_]+ [(0-9])' "$1" | grep -oE 'SGM_[A-Z0-9_]+') || true
[[ -n $numbers ]] || complain "no number was found in $1"
for name in $numbers; do
  grep -q "\b$name ==" "$3" || complain "$name is not pinned"
done
exit $missing

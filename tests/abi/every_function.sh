#!/usr/bin/env bash
# Every function that sgm/sgm.h declares is called in arguments_test.cpp, or is one of the four that take no pointer.
#   every_function.sh HEADER ARGUMENTS_TEST
set -euo pipefail
missing=0
for name in $(grep -oE '^SGM_API [^;(]*\b(sgm_[a-z_]+)\(' "$1" | grep -oE 'sgm_[a-z_]+\($' | tr -d '('); do
  case $name in sgm_version | sgm_version_string | sgm_build_info | sgm_result_name) continue ;; esac
  if ! grep -q "\b$name(" "$2"; then
    echo "$name is not called with wrong arguments" >&2
    missing=1
  fi
done
exit $missing

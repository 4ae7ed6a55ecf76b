#!/usr/bin/env bash
# Runs the test cases that use one judge (cgal or manifold). If that program is not installed, prints the package to
# install.
#
#   judges_test.sh JUDGE TEST_PROGRAM
set -euo pipefail
judge=$1 program=$2
case $judge in
  cgal) missing=$([[ -n ${SGM_JUDGE_CGAL:-} ]] || echo "CGAL: install the package libcgal-dev, and configure again") ;;
  manifold) missing=$([[ -e $SGM_NODE_MODULES/manifold-3d ]] || echo "manifold-3d in $SGM_NODE_MODULES: tests/run.sh installs it") ;;
esac
if [[ -n $missing ]]; then
  echo "SKIPPED: no $missing"
  [[ -z ${SGM_REQUIRE_ALL:-} ]] && exit 77
  exit 1
fi
exec "$program" "[$judge]"

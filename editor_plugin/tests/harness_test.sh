#!/usr/bin/env bash
# Tests the harness of the plugin's tests: faulty tests must fail for the right reason, and correct ones must pass.
set -euo pipefail
tests=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
mkdir -p "$out/editor_plugin/tests/headless" "$out/demo"
cp "$tests/run.sh" "$out/editor_plugin/tests/"
cp -a "$tests/lib" "$out/editor_plugin/tests/"
godot=$(bash "$tests/../get_godot.sh" 2>/dev/null)
printf '#!/bin/sh\necho "%s"\n' "$godot" >"$out/editor_plugin/get_godot.sh"
printf 'config_version=5\n[application]\nconfig/name="harness"\n' >"$out/demo/project.godot"
rm -f "$out"/editor_plugin/tests/lib/cave.gd  # cave.gd needs the plugin's classes, which this project lacks

# script NAME BODY: makes a test with BODY as its function _initialize.
script() {
  printf 'extends SceneTree\nconst Checks := preload("res://tests/lib/checks.gd")\nvar _checks := Checks.new()\n\nfunc _initialize() -> void:\n%s\n' \
    "$2" >"$out/editor_plugin/tests/headless/$1.gd"
}
# The file .godot/sgm_imported marks the project, which has nothing to import, as imported.
mkdir "$out/demo/.godot"
touch "$out/demo/.godot/sgm_imported"
failed=0
# judged NAME STATUS PATTERN: runs a test, and checks the exit status and output of the harness.
judged() {
  local status=0
  SGM_GODOT_OUT=$out/out SGM_GODOT_DEMO=$out/demo bash "$out/editor_plugin/tests/run.sh" "headless/$1" >"$out/said" 2>&1 || status=$?
  if ((status != $2)) || ! grep -qE -- "$3" "$out/said"; then
    echo "$1: expected status $2 and '$3', got status $status and:"
    cat "$out/said"
    failed=1
  fi
}
end=$'\tawait _checks.finish(self)'
script passes $'\t_checks.check(true, "so it is")\n'"$end"
script silent $'\tquit(0)'
script checks_nothing "$end"
script fails $'\t_checks.equal(1, 2, "numbers")\n'"$end"
script pushes $'\t_checks.check(true, "")\n\tpush_error("something broke")\n'"$end"
script announces $'\t_checks.check(true, "")\n\t_checks.expect_error("something broke")\n\tpush_error("something broke")\n'"$end"
script announces_in_vain $'\t_checks.check(true, "")\n\t_checks.expect_error("something broke")\n'"$end"
script leaks $'\t_checks.check(true, "")\n\tNode.new()\n'"$end"
script breaks $'\t_checks.check(true, "")\n\tvar nothing: Object = null\n\tnothing.call("x")\n'"$end"
script hangs $'\tpass'
judged passes 0 'SGM TEST PASSED: 1 checks'
judged silent 1 'there is no marker'
judged checks_nothing 1 'there is no marker'
judged fails 1 'numbers: got 1, wanted 2'
judged pushes 1 'something broke'
judged announces 0 'SGM TEST PASSED'
judged announces_in_vain 1 'which did not come: something broke'
judged leaks 1 'leaked'
SGM_GODOT_TIMEOUT=10 judged breaks 1 'SCRIPT ERROR'
SGM_GODOT_TIMEOUT=5 judged hangs 1 'ended with status 124'
exit "$failed"

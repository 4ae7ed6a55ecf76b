#!/usr/bin/env bash
# Tests that get_godot.sh prints one clear line if no Godot can be found, and leaves no incomplete files.
set -euo pipefail
script=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)/get_godot.sh
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
unset GODOT SGM_GODOT_CACHE
failed=0
# refuses PATTERN COMMAND...: the command must exit with 1, print nothing to stdout, and one line to stderr that
# matches.
refuses() {
  local pattern=$1 status=0
  shift
  "$@" >"$out/stdout" 2>"$out/stderr" </dev/null || status=$?
  if ((status != 1)) || [[ -s $out/stdout ]] || [[ $(grep -c 'error:' "$out/stderr") != 1 ]] || ! grep -qE "$pattern" "$out/stderr"; then
    echo "expected a refusal with '$pattern' of: $* (status $status)"
    cat "$out/stdout" "$out/stderr"
    failed=1
  fi
}
program() {  # program NAME VERSION: makes a program that prints this version
  mkdir -p "$out/bin"
  printf '#!/bin/sh\necho "%s"\n' "$2" >"$out/bin/$1"
  chmod +x "$out/bin/$1"
  echo "$out/bin/$1"
}

refuses "which is not a program" env GODOT=no-such-godot bash "$script"
refuses "not a working Godot.*4\.3 or newer" env GODOT="$(command -v false)" bash "$script"
refuses "'4\.2\.1.*4\.3 or newer" env GODOT="$(program old 4.2.1.stable)" bash "$script"
refuses "'3\.6.*4\.3 or newer" env GODOT="$(program older 3.6.stable)" bash "$script"

right=$(program godot 4.3.stable)
[[ $(GODOT=$right bash "$script" 2>/dev/null) == "$right" ]] || { echo "a Godot in GODOT is not taken"; failed=1; }
[[ $(PATH=$out/bin:$PATH bash "$script" 2>/dev/null) == "$right" ]] || { echo "a Godot in PATH is not taken"; failed=1; }
GODOT=$right bash "$script" 2>&1 >/dev/null | grep -q '4\.3\.stable' || { echo "its version is not printed"; failed=1; }

# Without a network: run in a network namespace without interfaces, if this machine allows making one.
if unshare -rn true 2>/dev/null; then
  rm -rf "$out/bin"
  refuses "could not be downloaded|no mirror|set GODOT" env -u GODOT PATH=/usr/sbin:/usr/bin:/sbin:/bin \
    SGM_GODOT_CACHE="$out/cache/godot" timeout 300 unshare -rn bash "$script"
  [[ ! -e $out/cache/godot && ! -e $out/cache/godot.unfinished ]] || { echo "something half is left"; failed=1; }
fi
exit "$failed"

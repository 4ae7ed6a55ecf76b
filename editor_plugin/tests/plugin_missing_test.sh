#!/usr/bin/env bash
# Tests that the editor plugin, without the native library or with one of another version, says once what to do, and
# loads nothing.
set -euo pipefail
tests=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$tests/../.." && pwd)
godot=$(bash "$root/editor_plugin/get_godot.sh" 2>/dev/null) || {
  echo "no Godot (bash editor_plugin/get_godot.sh says why)" >&2
  exit 2
}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export HOME=$folder/home XDG_DATA_HOME=$folder/home XDG_CONFIG_HOME=$folder/home XDG_CACHE_HOME=$folder/home
mkdir -p "$HOME"

# Makes a project that contains only the addon, so that no other file causes messages about the missing library.
project_of() {
  local project=$folder/$1
  mkdir -p "$project/addons"
  cp -a "$root/editor_plugin/demo/addons/sgm" "$project/addons/"
  cat >"$project/project.godot" <<'PROJECT'
config_version=5
[editor_plugins]
enabled=PackedStringArray("res://addons/sgm/plugin.cfg")
PROJECT
  # Register the native library before the first import: an engine that discovers the library only during the import
  # crashes when it quits (godotengine/godot#111048).
  mkdir "$project/.godot"
  echo "res://addons/sgm/sgm.gdextension" >"$project/.godot/extension_list.cfg"
  echo "$project"
}

# check NAME PROJECT PATTERN COUNT: opens the project in the editor; the editor's log must have COUNT lines of the
# plugin that match the pattern.
check() {
  local name=$1 project=$2 pattern=$3 count=$4 log=$folder/$1.log
  timeout 120 "$godot" --headless --path "$project" --import >"$log.import" 2>&1 </dev/null || true
  timeout 120 "$godot" --headless --editor --path "$project" --quit-after 30 >"$log" 2>&1 </dev/null || {
    echo "$name: the editor ended badly:" >&2
    cat "$log" >&2
    exit 1
  }
  if [[ $(grep -c 'SG+M: ' "$log") != "$count" || $(grep -cE "SG\+M: $pattern" "$log") != "$count" ]] ||
    grep -E '^(SCRIPT ERROR|Parse Error)' "$log"; then
    echo "$name: wanted $count lines 'SG+M: $pattern', and no script's error:" >&2
    cat "$log" >&2
    exit 1
  fi
}

missing=$(project_of missing)
rm -rf "$missing/addons/sgm/bin"
check missing "$missing" '.*missing or does not load; run editor_plugin/build\.sh, or copy' 1
other=$(project_of other)
sed -i 's/^version=.*/version="99.0.0"/' "$other/addons/sgm/plugin.cfg"
check other "$other" '.*the plugin of version 99\.0\.0; run editor_plugin/build\.sh, or copy' 1
check fitting "$(project_of fitting)" '' 0

# Simulates a libsgm of another version than the plugin was built for: copies this libsgm, and changes the constant that
# its version function returns (2000: 0.2.0).
mixed=$(project_of mixed)
library=$mixed/addons/sgm/bin/libsgm.so.0.2
mapfile -t places < <(LC_ALL=C grep -obUaP '\xb8\xd0\x07\x00\x00\xc3' "$library" | cut -d: -f1)
((${#places[@]} == 1)) || { echo "mixed: sgm_version is not found in $library" >&2; exit 1; }
printf '\xd1' | dd of="$library" bs=1 seek="$((places[0] + 1))" conv=notrunc status=none
found='is not loaded: the plugin was built for libsgm [0-9.]* and found .*; copy the whole folder'
timeout 120 "$godot" --headless --editor --path "$mixed" --quit-after 30 >"$folder/mixed.log" 2>&1 </dev/null || true
grep -qE "SG\+M $found" "$folder/mixed.log" || {
  echo "mixed: wanted a line 'SG+M $found':" >&2
  cat "$folder/mixed.log" >&2
  exit 1
}
echo "the editor plugin says what to do without its native library, and with one, or a libsgm, of another version"

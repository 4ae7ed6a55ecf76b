#!/usr/bin/env bash
# Tests the demo without the native library: it must show what to do, and neither crash nor open a place.
set -euo pipefail
tests=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$tests/../.." && pwd)
godot=$(bash "$root/editor_plugin/get_godot.sh" 2>/dev/null) || {
  echo "no Godot (bash editor_plugin/get_godot.sh says why)" >&2
  exit 2
}
project=$(mktemp -d)
trap 'rm -rf "$project"' EXIT
export HOME=$project/home XDG_DATA_HOME=$project/home XDG_CONFIG_HOME=$project/home XDG_CACHE_HOME=$project/home
mkdir -p "$HOME" "$project/demo"
cp -a "$root/editor_plugin/demo/." "$project/demo/"
rm -rf "$project/demo/.godot" "$project/demo/addons/sgm/bin"
cat >"$project/demo/missing.gd" <<'SCRIPT'
extends SceneTree


func _initialize() -> void:
	change_scene_to_file("res://menu/menu.tscn")
	for i in 5:
		await process_frame
	print("NOTE: ", (current_scene.get_node("%Note") as Label).text)
	print("PLACES: ", current_scene.get_node("%Buttons").get_child_count())
	quit()
SCRIPT
status=0
timeout 120 "$godot" --headless --path "$project/demo" --script missing.gd >"$project/log" 2>&1 </dev/null || status=$?
if ((status == 0)) && grep -q '^NOTE: .*editor_plugin/build.sh' "$project/log" &&
  grep -q '^PLACES: 0$' "$project/log"; then
  echo "the menu says what to do without the native library"
else
  echo "the demo without its native library ended with status $status:" >&2
  cat "$project/log" >&2
  exit 1
fi

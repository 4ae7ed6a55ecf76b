#!/usr/bin/env bash
# Tests a restart of the editor while a grammar is open as text. When the editor has opened the scene and the text
# again, the scene's world must still have the grammar, and saving the scene must keep the reference to the grammar's
# file.
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
# The driver's shader cache is shared between tests, because shaders take long to compile.
export MESA_SHADER_CACHE_DIR=$root/build/godot/home/cache GALLIVM_PERF=nopt
project=$folder/demo
mkdir -p "$HOME" "$project/tests"
cp -a "$root/editor_plugin/demo/." "$project/"
cp -a "$tests/lib/driver" "$project/addons/sgm_test"
sed -i 's#^enabled=PackedStringArray(#&"res://addons/sgm_test/plugin.cfg", #' "$project/project.godot"
mkdir -p "$root/build/godot/editor_shaders"
[[ -e $project/.godot/shader_cache ]] || ln -s "$root/build/godot/editor_shaders" "$project/.godot/shader_cache"
cat >"$project/tests/close.gd" <<'SCRIPT'
@tool
extends RefCounted


func run(plugin: EditorPlugin) -> void:
	EditorInterface.open_scene_from_path("res://cave/cave.tscn")
	load("res://addons/sgm/editor/text_editing.gd").open("res://grammars/cave.sgm")
	# The editor saves its list of open files after some seconds.
	await plugin.get_tree().create_timer(4.0).timeout
	plugin.get_tree().quit()
SCRIPT
cat >"$project/tests/open.gd" <<'SCRIPT'
@tool
extends RefCounted


func run(plugin: EditorPlugin) -> void:
	await plugin.get_tree().create_timer(2.0).timeout
	var world := EditorInterface.get_edited_scene_root().get_node("World") as SgmWorld3D
	print("TEXTS ", EditorInterface.get_script_editor().get_open_script_editors().size())
	print("GRAMMAR ", world.grammar.resource_path, " ", world.grammar == load("res://grammars/cave.sgm"))
	EditorInterface.save_scene()
	await plugin.get_tree().create_timer(1.0).timeout
	plugin.get_tree().quit()
SCRIPT
timeout 120 "$godot" --headless --path "$project" --import >"$folder/log.import" 2>&1 </dev/null || true
status=0
for step in close open; do
  SGM_EDITOR_TEST=res://tests/$step.gd timeout 200 xvfb-run -a -s "-screen 0 1280x720x24" "$godot" \
    --rendering-driver vulkan --editor --path "$project" >"$folder/log.$step" 2>&1 </dev/null || status=$?
done
if ((status == 0)) && grep -q '^TEXTS 1$' "$folder/log.open" &&
  grep -q '^GRAMMAR res://grammars/cave.sgm true$' "$folder/log.open" &&
  grep -q '^\[ext_resource type="SgmGrammar".* path="res://grammars/cave.sgm"' "$project/cave/cave.tscn" &&
  cmp "$root/editor_plugin/demo/grammars/cave.sgm" "$project/grammars/cave.sgm"; then
  echo "scenes keep their grammars while these are open as text, also after a restart of the editor"
else
  echo "the editor that was closed and opened again ended with status $status:" >&2
  tail -n 40 "$folder"/log.close "$folder"/log.open >&2
  grep -n grammar "$project/cave/cave.tscn" >&2
  exit 1
fi

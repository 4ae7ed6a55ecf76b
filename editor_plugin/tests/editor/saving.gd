@tool
extends RefCounted
## Tests saving a scene with a world: the scene is packed as the editor does to save it, and read again. It keeps the
## settings, and contains nothing of the drawn chunks. (The scene is not saved by the editor, because Godot 4.6 logs an
## error of its own when a script makes the editor save any scene.)

const Checks := preload("res://tests/lib/checks.gd")
const SCENE := "res://cave/cave.tscn"
const SAVED := "res://saved.tscn"

var _checks := Checks.new()


func run(plugin: EditorPlugin) -> void:
	var tree := plugin.get_tree()
	EditorInterface.open_scene_from_path(SCENE)
	await tree.process_frame
	var world: SgmWorld3D = EditorInterface.get_edited_scene_root().get_node("World")
	var limit := Time.get_ticks_msec() + 60_000
	while int(world.get_statistics().get("triangles", 0)) == 0 and Time.get_ticks_msec() < limit:
		await tree.process_frame
	_checks.check(int(world.get_statistics().get("triangles", 0)) > 0, "the world is drawn")
	world.seed = 41
	world.set("parameters/wet", 0.25)
	var packed := PackedScene.new()
	_checks.equal(packed.pack(EditorInterface.get_edited_scene_root()), OK, "the scene is packed")
	_checks.equal(ResourceSaver.save(packed, SAVED), OK, "and saved")
	var before := FileAccess.get_file_as_string(SCENE)
	var after := FileAccess.get_file_as_string(SAVED)
	_checks.check("seed = 41" in after and "parameters/wet = 0.25" in after, "what was set is in the file")
	_checks.equal(after.count("[node "), before.count("[node "), "nodes in the file")
	_checks.equal(after.count("[sub_resource "), before.count("[sub_resource "), "resources in the file")
	var again := (ResourceLoader.load(SAVED, "", ResourceLoader.CACHE_MODE_IGNORE) as PackedScene).instantiate()
	world = again.get_node("World")
	_checks.equal(world.seed, 41, "the seed that is read")
	_checks.near(world.get("parameters/wet"), 0.25, 1e-6, "the parameter that is read")
	again.free()
	await _checks.finish(tree)

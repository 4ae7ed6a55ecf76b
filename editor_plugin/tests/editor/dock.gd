@tool
extends RefCounted
## Tests the dock, the preview and the gizmo of the cave in the editor, and takes a picture of them.

const Checks := preload("res://tests/lib/checks.gd")
const Dock := preload("res://addons/sgm/editor/dock.gd")
const Gizmo := preload("res://addons/sgm/editor/gizmo.gd")
const Preview := preload("res://addons/sgm/editor/preview.gd")
const WINDOW := Vector2i(1600, 900)
# A coarser world than in the demo, so that it becomes idle soon even on software renderers.
const DETAIL := {&"cell_size": 0.8, &"finest_distance": 24.0, &"view_distance": 120.0, &"collision": false}

var _checks := Checks.new()
var _plugin: EditorPlugin
var _tree: SceneTree
var _world: SgmWorld3D
var _dock: Dock


func run(plugin: EditorPlugin) -> void:
	_plugin = plugin
	_tree = plugin.get_tree()
	_tree.root.mode = Window.MODE_WINDOWED
	_tree.root.size = WINDOW
	_dock = _tree.root.find_children("SG+M", "VBoxContainer", true, false)[0]
	_bring_to_front(_dock)
	_check_without_world()
	EditorInterface.open_scene_from_path("res://cave/cave.tscn")
	EditorInterface.set_main_screen_editor("3D")
	await _frames(5)
	_world = EditorInterface.get_edited_scene_root().get_node("World")
	for setting: StringName in DETAIL:
		_world.set(setting, DETAIL[setting])
	await _enter_hall()
	_checks.check(await _until(_world.is_idle, 120.0), "the preview comes to rest")
	_checks.check(await _until(_is_measured, 60.0), "the dock measures once the world is idle")
	_check_figures()
	_check_gizmo()
	await _save_picture()
	await _check_dialog("Bake to scene…", ".scn")
	await _check_dialog("Export GLB…", ".glb")
	await _check_seed()
	await _check_restart()
	await _check_other_scene()
	# An editor that quits while its inspector shows a node may log errors of its own.
	EditorInterface.get_selection().clear()
	EditorInterface.inspect_object(null)
	await _frames(5)
	await _checks.finish(_tree)


# Brings the dock to the front of its tabs. In newer versions of the editor, a wrapper of the dock is in the tabs.
func _bring_to_front(control: Control) -> void:
	var tabs := control.get_parent() as TabContainer
	if tabs == null:
		_bring_to_front(control.get_parent())
	else:
		tabs.current_tab = tabs.get_tab_idx_from_control(control)


func _check_without_world() -> void:
	_dock.refresh()
	_checks.equal(_dock.figure("triangles"), Dock.NONE, "triangles without a world")
	for button: Button in _buttons():
		_checks.check(button.disabled and button.tooltip_text.ends_with("."), button.text + " says why it cannot be used")


# Moves the editor's camera to the hall nearest to the origin, so that it looks from the hall's anchor along the longest
# view.
func _enter_hall() -> void:
	await _until(func() -> bool: return _world.running, 20.0)
	var halls := _world.get_anchors(AABB(Vector3.ZERO, Vector3.ZERO).grow(420.0)).filter(
			func(anchor: Dictionary) -> bool: return anchor.kind == "spawn")
	halls.sort_custom(func(a: Dictionary, b: Dictionary) -> bool:
		return (a.transform as Transform3D).origin.length() < (b.transform as Transform3D).origin.length())
	_checks.check(not halls.is_empty(), "there is a hall")
	var middle := (halls[0].transform as Transform3D).origin
	var ahead := Vector3.FORWARD
	var widest := 0.0
	for i in 24:
		var direction := Vector3.FORWARD.rotated(Vector3.UP, TAU * i / 24.0)
		var hit := _world.ray_cast(middle, direction, 100.0)
		var distance: float = hit.distance if not hit.is_empty() else 100.0
		if distance > widest:
			widest = distance
			ahead = direction
	var eye := middle - ahead * 6.0 + Vector3.UP * 2.0
	Preview.editor_camera().global_transform = Transform3D(Basis.looking_at(middle + ahead * 12.0 - eye), eye)
	await _frames(3)
	_checks.check(Preview.editor_camera().global_position.distance_to(eye) < 0.1, "the camera stays in the hall")


func _is_measured() -> bool:
	return not _dock.histogram.shares.is_empty()


func _check_figures() -> void:
	_dock.refresh()
	_checks.equal(_dock.figure("state"), "idle", "state")
	for row: String in ["triangles", "area", "volume", "objects"]:
		_checks.check(_dock.figure(row).replace(",", "").to_int() > 0, row + " has a figure: " + _dock.figure(row))
	_checks.equal(_dock.figure("triangles"), Dock.grouped(_world.get_statistics().triangles), "triangles")
	_checks.equal(_dock.figure("watertight"), "yes", "watertight")
	_checks.check(_dock.figure("device").length() > 3, "the device is told")
	var shares := _dock.histogram.shares
	_checks.equal(shares.size(), 33, "bars of the histogram")
	var sum := 0.0
	for share in shares:
		sum += share
	_checks.near(sum, 1.0, 1e-6, "sum of the shares")
	_checks.check("%" in _dock.histogram.get_tooltip(_dock.histogram.size / 2.0), "the histogram tells a share")


func _check_gizmo() -> void:
	_checks.equal(_world.get_gizmos().filter(_is_ours).size(), 1, "gizmos of the world")
	_checks.equal(Gizmo.bounds_lines(_world).size(), 24, "ends of the bounds' edges")
	for i in range(0, 24, 2):
		var edge := Gizmo.bounds_lines(_world)[i + 1] - Gizmo.bounds_lines(_world)[i]
		_checks.check(edge[edge.max_axis_index()] == edge.length() and edge.length() > 1.0, "an edge lies along an axis")
	var anchors := Gizmo.anchors_near_camera(_world)
	_checks.check(not anchors.is_empty(), "there are anchors around the camera")
	_checks.equal(Gizmo.anchor_lines(anchors, 1).size(), anchors.size() * 2, "ends of the crosses' strokes")


func _is_ours(gizmo: Node3DGizmo) -> bool:
	return gizmo is EditorNode3DGizmo and (gizmo as EditorNode3DGizmo).get_plugin() is Gizmo


func _check_dialog(button: String, ending: String) -> void:
	_press(button)
	await _frames(2)
	var dialog := _dock.find_children("*", "EditorFileDialog", true, false)[0] as EditorFileDialog
	_checks.check(dialog.visible and dialog.current_file.ends_with(ending), button + " asks for a file")
	dialog.hide()
	await _frames(2)


# Changes to another scene while a measurement of the world is running.
func _check_other_scene() -> void:
	_dock.measure()
	EditorInterface.open_scene_from_path("res://menu/menu.tscn")
	await _frames(5)
	_dock.refresh()
	_checks.equal(_dock.figure("objects"), Dock.NONE, "objects in a scene without a world")
	EditorInterface.open_scene_from_path("res://cave/cave.tscn")
	_checks.check(await _until(_is_measured, 120.0), "the dock measures the world again")


func _check_seed() -> void:
	var before := _world.seed
	_press("New seed")
	var after := _world.seed
	_checks.check(after != before, "another seed comes")
	_press("Copy seed")
	_checks.equal(DisplayServer.clipboard_get(), str(after), "the clipboard")
	var manager := _plugin.get_undo_redo()
	var history := manager.get_history_undo_redo(manager.get_object_history_id(_world))
	history.undo()
	_checks.equal(_world.seed, before, "the seed is back")
	history.redo()
	_checks.equal(_world.seed, after, "the seed comes again")
	history.undo()
	await _frames(3)


func _check_restart() -> void:
	_press("Restart")
	_checks.check(await _until(func() -> bool: return not _world.is_idle(), 10.0), "the world begins anew")
	_checks.check(await _until(_world.is_idle, 120.0), "the world comes to rest again")


func _press(text: String) -> void:
	for button: Button in _buttons():
		if button.text == text and _checks.check(not button.disabled, text + " can be pressed"):
			button.pressed.emit()
			return
	_checks.check(false, "there is a button " + text)


# Returns the dock's own buttons. Buttons of its dialogs are left out: they are below the dock in the tree, but belong
# to separate windows.
func _buttons() -> Array[Node]:
	return _dock.find_children("*", "Button", true, false).filter(_is_in_dock)


func _is_in_dock(button: Button) -> bool:
	return button.get_window() == _dock.get_window() and not button.text.is_empty()


func _save_picture() -> void:
	EditorInterface.get_selection().clear()
	EditorInterface.get_selection().add_node(_world)
	var lights := _lights()
	for light in lights:
		EditorInterface.get_edited_scene_root().add_child(light)
	RenderingServer.render_loop_enabled = true
	await _frames(20)
	await RenderingServer.frame_post_draw
	var picture := _tree.root.get_texture().get_image()
	_checks.equal(picture.get_size(), WINDOW, "size of the picture")
	_checks.equal(picture.save_png(OS.get_environment("SGM_PICTURES").path_join("editor.png")), OK, "picture is saved")
	RenderingServer.render_loop_enabled = false
	for light in lights:
		light.free()


# Adds a lamp at the camera, like the player's. Also adds a sun with energy 0: for a scene without a sun the editor adds
# a sun, which would shine into the cave from outside.
func _lights() -> Array[Light3D]:
	var sun := DirectionalLight3D.new()
	sun.light_energy = 0.0
	var lamp := OmniLight3D.new()
	lamp.omni_range = 60.0
	lamp.light_energy = 8.0
	lamp.position = Preview.editor_camera().global_position
	return [sun, lamp]


func _frames(count: int) -> void:
	for i in count:
		await _tree.process_frame


func _until(condition: Callable, seconds: float) -> bool:
	var limit := Time.get_ticks_msec() + roundi(seconds * 1000.0)
	while not condition.call():
		if Time.get_ticks_msec() > limit:
			return false
		await _tree.process_frame
	return true

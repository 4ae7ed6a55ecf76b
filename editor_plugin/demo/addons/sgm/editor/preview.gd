@tool
extends Node
## Streams the worlds of the edited scene around the camera of the 3D editor, and updates their gizmos.

## Seconds between two searches for worlds, and between two updates of a gizmo.
const PACE := 0.5
## Distance in metres: after the camera has moved this far, the gizmo is updated to show other anchors.
const STEP := 4.0

## All SG+M worlds in the edited scene.
var worlds: Array[SgmWorld3D] = []

var _root: Node
var _rest := 0.0
## For each world (by its instance id), the state that its gizmo last showed.
var _drawn := {}


func _process(delta: float) -> void:
	_rest -= delta
	var root := EditorInterface.get_edited_scene_root()
	if _rest <= 0.0 or root != _root:
		_rest = PACE
		_root = root
		_find_worlds()
		_refresh_gizmos()
	var camera := editor_camera()
	if camera == null:
		return
	for world in worlds:
		if is_instance_valid(world):
			world.set_editor_view(camera.global_transform, camera.fov)


## Returns the camera of the first viewport in the 3D editor; null if there is none.
static func editor_camera() -> Camera3D:
	var viewport := EditorInterface.get_editor_viewport_3d(0)
	return viewport.get_camera_3d() if viewport != null else null


## Returns the world that the dock shows: the selected one; without a selection, the only one in the scene; null if the
## scene has several.
func chosen_world() -> SgmWorld3D:
	for node in EditorInterface.get_selection().get_selected_nodes():
		if node is SgmWorld3D and node.is_inside_tree():
			return node
	if worlds.size() != 1 or not is_instance_valid(worlds[0]) or not worlds[0].is_inside_tree():
		return null
	return worlds[0]


func _find_worlds() -> void:
	worlds.clear()
	if _root == null:
		return
	if _root is SgmWorld3D:
		worlds.append(_root)
	for node in _root.find_children("*", "SgmWorld3D", true, false):
		worlds.append(node)


func _refresh_gizmos() -> void:
	var camera := editor_camera()
	var place := camera.global_position.snappedf(STEP) if camera != null else Vector3.ZERO
	var drawn := {}
	for world in worlds:
		var id := world.get_instance_id()
		drawn[id] = [world.is_idle(), world.get_bounds(), world.global_transform, place]
		# While a world streams, its anchors may change even if its bounds do not, so its gizmo is always updated.
		if not world.is_idle() or drawn[id] != _drawn.get(id):
			world.update_gizmos()
	_drawn = drawn

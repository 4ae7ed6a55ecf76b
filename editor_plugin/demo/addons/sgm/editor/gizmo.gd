@tool
extends EditorNode3DGizmoPlugin
## Draws the bounds of an SgmWorld3D's drawn chunks, and the anchors near the editor's camera.

const Preview := preload("preview.gd")
## Anchors are drawn up to this distance from the camera, in metres.
const REACH := 64.0
## Number of anchors, nearest first, whose names are shown.
const MOST_NAMES := 48
const NAME_HEIGHT := 0.4
const ICON_SCALE := 0.05
## Metres from the center of an anchor's cross to its ends.
const ARM := 0.5
const ICON := "../icons/SgmWorld3DGizmo.svg"
const AXES: Array[String] = ["anchor_x", "anchor_y", "anchor_z"]

var _names := {}


func _init() -> void:
	create_material("bounds", Color(0.45, 0.78, 0.6, 0.6))
	create_material(AXES[0], Color(0.96, 0.33, 0.42))
	create_material(AXES[1], Color(0.55, 0.84, 0.18))
	create_material(AXES[2], Color(0.24, 0.58, 0.96))
	create_icon_material("icon", load((get_script() as Script).resource_path.get_base_dir().path_join(ICON)))
	var ink := StandardMaterial3D.new()
	ink.shading_mode = BaseMaterial3D.SHADING_MODE_UNSHADED
	ink.billboard_mode = BaseMaterial3D.BILLBOARD_ENABLED
	ink.no_depth_test = true
	add_material("name", ink)


func _get_gizmo_name() -> String:
	return "SgmWorld3D"


func _has_gizmo(node: Node3D) -> bool:
	return node is SgmWorld3D


func _redraw(gizmo: EditorNode3DGizmo) -> void:
	gizmo.clear()
	var world := gizmo.get_node_3d() as SgmWorld3D
	var box := bounds_lines(world)
	if not box.is_empty():
		gizmo.add_lines(box, get_material("bounds", gizmo))
	gizmo.add_unscaled_billboard(get_material("icon", gizmo), ICON_SCALE)
	var anchors := named_near_camera(world)
	for axis in 3:
		var lines := anchor_lines(_places(anchors), axis)
		if not lines.is_empty():
			gizmo.add_lines(lines, get_material(AXES[axis], gizmo))
	for anchor in anchors.slice(0, MOST_NAMES):
		var place := (anchor.transform as Transform3D).origin + Vector3.UP * (ARM + NAME_HEIGHT)
		gizmo.add_mesh(_name_mesh(anchor.title), get_material("name", gizmo), Transform3D(Basis.IDENTITY, place))


## Returns the edges of the bounds of the drawn chunks, two points for each, in the world's own coordinates.
static func bounds_lines(world: SgmWorld3D) -> PackedVector3Array:
	var lines := PackedVector3Array()
	var box := world.get_bounds()
	if not box.has_surface():
		return lines
	for corner in 8:
		for axis in 3:
			# In a corner's index, bits 0, 1 and 2 tell whether the corner is at the lower or the upper end along z, y
			# and x. An edge along an axis thus starts at each corner whose bit for this axis is 0.
			var bit := 4 >> axis
			if corner & bit == 0:
				lines.append(box.get_endpoint(corner))
				lines.append(box.get_endpoint(corner | bit))
	return lines


## Returns the transforms of the anchors within [constant REACH] of the editor's camera, in the world's own coordinates.
static func anchors_near_camera(world: SgmWorld3D) -> Array[Transform3D]:
	return _places(named_near_camera(world))


## Returns the anchors within [constant REACH] of the editor's camera, nearest first, as dictionaries with transform and
## title.
static func named_near_camera(world: SgmWorld3D) -> Array[Dictionary]:
	var found: Array[Dictionary] = []
	var camera := Preview.editor_camera()
	if camera == null or not world.running:
		return found
	var middle := camera.global_position
	var to_local := world.global_transform.affine_inverse()
	for anchor: Dictionary in world.get_anchors(AABB(middle, Vector3.ZERO).grow(REACH)):
		var place: Transform3D = anchor.transform
		var distance := place.origin.distance_to(middle)
		if distance <= REACH:
			var title: String = anchor.kind
			if not anchor.name.is_empty() and anchor.name != title:
				title += " " + anchor.name
			found.append({distance = distance, title = title, transform = to_local * place})
	found.sort_custom(func(a: Dictionary, b: Dictionary) -> bool: return a.distance < b.distance)
	return found


## Returns the lines along one axis of all anchors' crosses, two points for each line.
static func anchor_lines(places: Array[Transform3D], axis: int) -> PackedVector3Array:
	var lines := PackedVector3Array()
	for place in places:
		var arm := place.basis[axis].normalized() * ARM
		lines.append(place.origin - arm)
		lines.append(place.origin + arm)
	return lines


static func _places(anchors: Array[Dictionary]) -> Array[Transform3D]:
	var places: Array[Transform3D] = []
	for anchor in anchors:
		places.append(anchor.transform)
	return places


func _name_mesh(title: String) -> TextMesh:
	if title not in _names:
		var mesh := TextMesh.new()
		mesh.text = title
		mesh.font_size = 32
		mesh.pixel_size = NAME_HEIGHT / mesh.font_size
		mesh.depth = 0.0
		_names[title] = mesh
	return _names[title]

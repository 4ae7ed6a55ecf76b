class_name DemoLeaves
extends MultiMeshInstance3D
## Leaves on the crowns of trees and bushes around the camera, for machines with a graphics card. They are placed on the
## drawn surfaces with materials in [member materials] whenever the world becomes idle. Below them, the crowns
## themselves are drawn dark, as gaps between leaves.

## Size of a leaf near the camera: length in metres, and the width of leaves and of sprigs of needles as a share of the
## length.
const LENGTH := 0.085
const WIDTH := 0.66
const NEEDLES_WIDTH := 0.3
## Metres by which a leaf's length grows for each metre of distance from the camera; distant leaves are also fewer.
const GROWTH := 0.006
## Leaf area for each unit of surface area; the area of a leaf counts as the square of its length.
const COVER := 2.2
## The roots of leaves lie between DEPTH metres below a crown's surface and REACH metres outside of it.
const REACH := 0.15
const DEPTH := 0.08
const MOST := 450_000
## Leaves are placed again when the camera has moved by this many metres. Placing them takes at most BUDGET microseconds
## of each frame.
const STEP := 15.0
const BUDGET := 2000
## Number of floats for each instance: its transform, the direction out of the crown, and the brightness, which is below
## 0 for needles.
const FLOATS := 16

@export var world: SgmWorld3D
@export var materials: Array[String] = ["leaf", "leaf_dark"]
## Maximum distance in metres from the camera to a leaf.
@export var radius := 110.0

var _middle := Vector3.INF
var _growing := false


func _ready() -> void:
	multimesh = MultiMesh.new()
	multimesh.transform_format = MultiMesh.TRANSFORM_3D
	multimesh.use_custom_data = true
	multimesh.mesh = _leaf()
	cast_shadow = GeometryInstance3D.SHADOW_CASTING_SETTING_OFF
	if DemoQuality.is_fast() and not DemoQuality.always_fast:
		world.became_idle.connect(grow)
		world.restarted.connect(_start_anew)
		world.edited.connect(func(_id: PackedInt64Array) -> void: _start_anew())


## Places all visible leaves at once, without a time limit. Used for pictures.
func fill() -> void:
	_grow(1 << 40)


## Places all visible leaves, over several frames. A coroutine.
func grow() -> void:
	await _grow(BUDGET)


func _start_anew() -> void:
	_middle = Vector3.INF


func _grow(microseconds: int) -> void:
	var camera := get_viewport().get_camera_3d()
	if _growing or camera == null or not world.is_running() or camera.global_position.distance_to(_middle) < STEP:
		return
	_growing = true
	var eye := camera.global_position
	_middle = eye
	var buffer := PackedFloat32Array()
	var chunks := world.bake_chunks()
	# Chunks near the camera get leaves first, because the number of leaves is limited.
	chunks.sort_custom(func(a: Dictionary, b: Dictionary) -> bool:
		return eye.distance_squared_to(a.transform.origin) < eye.distance_squared_to(b.transform.origin))
	var limit := Time.get_ticks_usec() + microseconds
	for chunk: Dictionary in chunks:
		for surface: Dictionary in chunk.surfaces:
			if surface.material in materials and buffer.size() < MOST * FLOATS:
				buffer.append_array(_grown(surface.arrays, chunk.transform, eye, surface.material == "leaf_dark"))
		if Time.get_ticks_usec() > limit:
			await get_tree().process_frame
			limit = Time.get_ticks_usec() + microseconds
	_growing = false
	multimesh.instance_count = buffer.size() / FLOATS
	if not buffer.is_empty():
		multimesh.buffer = buffer
	custom_aabb = AABB(eye - Vector3.ONE * radius, Vector3.ONE * 2.0 * radius)


# Returns the leaves of a chunk's crowns. Their number depends on the area of the triangles, not on the number of
# triangles.
func _grown(arrays: Array, place: Transform3D, eye: Vector3, needles: bool) -> PackedFloat32Array:
	var grown := PackedFloat32Array()
	var points: PackedVector3Array = arrays[Mesh.ARRAY_VERTEX]
	var normals: PackedVector3Array = arrays[Mesh.ARRAY_NORMAL]
	var corners: PackedInt32Array = arrays[Mesh.ARRAY_INDEX]
	if points.is_empty() or (place * points[0]).distance_to(eye) > radius:
		return grown
	var random := RandomNumberGenerator.new()
	random.seed = hash(place.origin)
	var wide := NEEDLES_WIDTH if needles else WIDTH
	for i in range(0, corners.size(), 3):
		var a := points[corners[i]]
		var b := points[corners[i + 1]] - a
		var c := points[corners[i + 2]] - a
		var out := normals[corners[i]]
		var long := maxf(LENGTH, GROWTH * (place * a).distance_to(eye))
		var count := 0.5 * b.cross(c).length() * COVER / (long * long) + random.randf()
		while count >= 1.0:
			count -= 1.0
			var u := random.randf()
			var v := random.randf()
			if u + v > 1.0:
				u = 1.0 - u
				v = 1.0 - v
			var high := random.randf()
			var root := place * (a + u * b + v * c + out * (REACH * high - DEPTH * (1.0 - high)))
			var facing := (Vector3(random.randf() - 0.5, random.randf() - 0.2, random.randf() - 0.5) + 0.4 * out).normalized()
			var along := facing.cross(Vector3(random.randf() - 0.5, random.randf() - 0.5, random.randf() - 0.5)).normalized()
			along = (along - Vector3(0.0, 0.3, 0.0)).normalized()
			var across := facing.cross(along).normalized()
			facing = along.cross(across)
			var own := long * random.randf_range(0.7, 1.3)
			along *= own
			across *= own * wide
			facing *= own
			var bright := (0.5 + 0.6 * high) * random.randf_range(0.8, 1.2)
			grown.append_array([along.x, facing.x, across.x, root.x, along.y, facing.y, across.y, root.y, along.z, facing.z,
					across.z, root.z, out.x, out.y, out.z, -bright if needles else bright])
	return grown


# Makes the mesh of a leaf: a blade along x, folded along its middle, that hangs down a little.
func _leaf() -> ArrayMesh:
	var tool := SurfaceTool.new()
	tool.begin(Mesh.PRIMITIVE_TRIANGLES)
	var outline: Array[Vector2] = [Vector2(0.0, 0.0), Vector2(0.3, -0.42), Vector2(0.34, 0.44), Vector2(0.66, -0.4),
			Vector2(0.7, 0.38), Vector2(1.0, 0.0)]
	for corner in [0, 1, 2, 2, 1, 3, 2, 3, 4, 4, 3, 5]:
		var at := outline[corner]
		tool.set_normal(Vector3.UP)
		tool.set_uv(at)
		tool.add_vertex(Vector3(at.x - 0.5, 0.5 * absf(at.y) - 0.2 * at.x * at.x, at.y))
	return tool.commit()

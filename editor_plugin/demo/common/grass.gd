class_name DemoGrass
extends MultiMeshInstance3D
## Draws tufts of grass around the camera where the ground's material is grass. The ground is found by queries of the
## world's field, so it need not be drawn yet, and ground that was dug away has no grass when the player returns.

const BLADES := 14
## Width of a tuft, metres.
const WIDTH := 0.4
## Microseconds of each frame that the search for ground may take.
const BUDGET := 1200
## Ground is searched from this many metres above the camera, over a depth of DEPTH metres.
const ABOVE := 14.0
const DEPTH := 40.0
const STEEPEST := 0.72
## Metres that the camera moves before tufts are added and removed.
const STEP := 2.0
## For machines with a graphics card: the radius of the planted area in metres, and the number of tufts in a cell.
const FINE_RADIUS := 30.0
const FINE_TUFTS := 13

@export var world: SgmWorld3D
@export var materials: Array[String] = ["grass"]
@export var radius := 20.0
## Edge of a cell in metres. The ground is searched at the middle of each cell; its slope there gives the height at all
## other points of the cell.
@export var spacing := 0.9
@export var tufts_in_cell := 7

var _tufts := {}
var _waiting: Array[Vector2i] = []
var _middle := Vector3.INF
var _changed := false


func _ready() -> void:
	if DemoQuality.is_fast():
		radius = FINE_RADIUS
		tufts_in_cell = FINE_TUFTS
	multimesh = MultiMesh.new()
	multimesh.transform_format = MultiMesh.TRANSFORM_3D
	multimesh.mesh = _tuft()
	cast_shadow = GeometryInstance3D.SHADOW_CASTING_SETTING_OFF
	world.restarted.connect(_start_anew)
	world.edited.connect(func(_id: PackedInt64Array) -> void: _start_anew())
	(material_override as ShaderMaterial).set_shader_parameter("radius", radius)


func _process(_delta: float) -> void:
	_plant(BUDGET)


## Plants all visible grass at once, without a time limit. Used for pictures.
func fill() -> void:
	_plant(1 << 40)


func _start_anew() -> void:
	_tufts.clear()
	_middle = Vector3.INF


func _plant(microseconds: int) -> void:
	var camera := get_viewport().get_camera_3d()
	if camera == null or not world.is_running():
		return
	var eye := camera.global_position
	if not eye.distance_to(_middle) < STEP:
		_middle = eye
		_choose(eye)
	var limit := Time.get_ticks_usec() + microseconds
	while not _waiting.is_empty() and Time.get_ticks_usec() < limit:
		var cell: Vector2i = _waiting.pop_back()
		_tufts[cell] = _at(cell, eye)
		_changed = true
	if _changed and (_waiting.is_empty() or Engine.get_process_frames() % 20 == 0):
		_show()


# Chooses the cells that must have tufts, nearest to the camera first.
func _choose(eye: Vector3) -> void:
	var middle := Vector2i((Vector2(eye.x, eye.z) / spacing).floor())
	var reach := ceili(radius / spacing)
	for cell: Vector2i in _tufts.keys():
		if (cell - middle).length_squared() > reach * reach:
			_tufts.erase(cell)
	_waiting.clear()
	for z in range(-reach, reach + 1):
		for x in range(-reach, reach + 1):
			var cell := middle + Vector2i(x, z)
			if x * x + z * z <= reach * reach and not _tufts.has(cell):
				_waiting.append(cell)
	_waiting.sort_custom(func(a: Vector2i, b: Vector2i) -> bool:
		return (a - middle).length_squared() > (b - middle).length_squared())
	_changed = true


# Returns the tufts of a cell; empty if no grass grows there.
func _at(cell: Vector2i, eye: Vector3) -> Array[Transform3D]:
	var tufts: Array[Transform3D] = []
	var middle := (Vector2(cell) + Vector2(0.5, 0.5)) * spacing
	var hit := world.ray_cast(Vector3(middle.x, eye.y + ABOVE, middle.y), Vector3.DOWN, DEPTH)
	if hit.is_empty() or hit.inside or hit.material not in materials or hit.normal.y < STEEPEST:
		return tufts
	var normal: Vector3 = hit.normal
	var random := RandomNumberGenerator.new()
	random.seed = hash(cell)
	for i in tufts_in_cell:
		var way := Vector2(random.randf() - 0.5, random.randf() - 0.5) * spacing
		var up := -(normal.x * way.x + normal.z * way.y) / normal.y
		var basis := Basis(Vector3.UP, random.randf() * TAU).scaled(Vector3(1.0, random.randf_range(0.55, 1.25), 1.0))
		tufts.append(Transform3D(basis, hit.position + Vector3(way.x, up - 0.03, way.y)))
	return tufts


func _show() -> void:
	_changed = false
	var buffer := PackedFloat32Array()
	var count := 0
	for tufts: Array[Transform3D] in _tufts.values():
		for t in tufts:
			var b := t.basis
			buffer.append_array(PackedFloat32Array([b.x.x, b.y.x, b.z.x, t.origin.x, b.x.y, b.y.y, b.z.y, t.origin.y,
					b.x.z, b.y.z, b.z.z, t.origin.z]))
			count += 1
	multimesh.instance_count = count
	if count > 0:
		multimesh.buffer = buffer
	custom_aabb = AABB(_middle - Vector3.ONE * (radius + DEPTH), Vector3.ONE * 2.0 * (radius + DEPTH))


# Makes the mesh of a tuft: blades that lean away from its middle. UV.y is the height along a blade, UV.x a random
# number for each blade.
func _tuft() -> ArrayMesh:
	var random := RandomNumberGenerator.new()
	random.seed = 5
	var tool := SurfaceTool.new()
	tool.begin(Mesh.PRIMITIVE_TRIANGLES)
	for i in BLADES:
		var turn := random.randf() * TAU
		var out := Vector3(cos(turn), 0.0, sin(turn))
		var across := Vector3(-out.z, 0.0, out.x) * random.randf_range(0.0035, 0.007)
		var foot := Vector3(random.randf_range(-0.5, 0.5), 0.0, random.randf_range(-0.5, 0.5)) * WIDTH
		var high := random.randf_range(0.08, 0.26)
		var lean := high * random.randf_range(0.25, 0.9)
		var knee := foot + out * lean * 0.3 + Vector3.UP * high * 0.6
		var tip := foot + out * lean + Vector3.UP * high
		var own := random.randf()
		var corners: Array[Vector3] = [foot - across, foot + across, knee - across, knee + across, tip]
		var heights: Array[float] = [0.0, 0.0, 0.6, 0.6, 1.0]
		for corner in [0, 1, 2, 2, 1, 3, 2, 3, 4]:
			tool.set_normal((Vector3.UP + 0.5 * out).normalized())
			tool.set_uv(Vector2(own, heights[corner]))
			tool.add_vertex(corners[corner])
	return tool.commit()

class_name DemoCloudVolume
extends MeshInstance3D
## Draws clouds as a participating medium that the sun lights. Two volumes around the camera hold the world's density, a
## fine one and a coarse one for everything far away; one shader draws both over the whole picture. Threads sample the
## volumes again as the camera moves.

## Emitted when all volumes have been filled once.
signal filled

## Metres of full density that reduce sunlight to 1/e. The second channel of the volumes stores how much sunlight is
## left at a point.
const FADE := 250.0
## Metres from a cloud's surface inwards to its full density; the shader's noise erodes this edge.
const EDGE := 110.0
const BASE := 960.0
const NAMES: Array[String] = ["near", "far"]
const SPACINGS: Array[float] = [36.0, 150.0]
const SIZES: Array[Vector3i] = [Vector3i(176, 72, 176), Vector3i(192, 18, 192)]
## Share of a volume's width that the camera may move before the volume is sampled again.
const SLACK := 0.15

@export var world: SgmWorld3D
@export var sun: DirectionalLight3D
## Materials on which clouds cast shadows: their shaders also receive the volumes as parameters.
@export var shaded: Array[ShaderMaterial] = []

var _middles: Array[Vector3] = [Vector3.INF, Vector3.INF]
var _tasks: Array[int] = [-1, -1]
var _filled: Array[bool] = [false, false]


func _ready() -> void:
	world.restarted.connect(func() -> void: _middles.fill(Vector3.INF))
	world.edited.connect(func(_id: PackedInt64Array) -> void: _middles.fill(Vector3.INF))
	_set_all("to_sun", sun.global_basis.z)


func _process(_delta: float) -> void:
	var camera := get_viewport().get_camera_3d()
	if camera == null or not world.is_running() or not visible:
		return
	global_position = camera.global_position
	var level := camera.global_position * Vector3(1.0, 0.0, 1.0)
	for i in NAMES.size():
		var width := SPACINGS[i] * SIZES[i].x
		if _tasks[i] < 0 and not level.distance_to(_middles[i]) < SLACK * width:
			_middles[i] = level.snappedf(SPACINGS[i])
			_tasks[i] = WorkerThreadPool.add_task(_sample.bind(i, _middles[i], sun.global_basis.z))


func _exit_tree() -> void:
	for task in _tasks:
		if task >= 0:
			WorkerThreadPool.wait_for_task_completion(task)
	_tasks.fill(-1)


func is_filled() -> bool:
	return not _filled.has(false)


# Samples a volume of density. Runs on a worker thread.
func _sample(i: int, middle: Vector3, to_sun: Vector3) -> void:
	var size := SIZES[i]
	var corner := middle - SPACINGS[i] * 0.5 * Vector3(size.x, 0.0, size.z) + Vector3(0.0, BASE, 0.0)
	var bytes := world.sample_density(corner, SPACINGS[i], size, to_sun, FADE, EDGE)
	_take.call_deferred(i, corner, bytes)


func _take(i: int, corner: Vector3, bytes: PackedByteArray) -> void:
	if _tasks[i] < 0:
		return
	WorkerThreadPool.wait_for_task_completion(_tasks[i])
	_tasks[i] = -1
	if bytes.is_empty():
		return
	var size := SIZES[i]
	var slice := size.x * size.y * 2
	var images: Array[Image] = []
	for z in size.z:
		images.append(Image.create_from_data(
				size.x, size.y, false, Image.FORMAT_RG8, bytes.slice(z * slice, (z + 1) * slice)))
	var texture := ImageTexture3D.new()
	texture.create(Image.FORMAT_RG8, size.x, size.y, size.z, false, images)
	_set_all(NAMES[i] + "_volume", texture)
	# The samples are at the centres of texels, so the volume's corner is half a texel before the first sample.
	_set_all(NAMES[i] + "_corner", corner - Vector3.ONE * 0.5 * SPACINGS[i])
	_set_all(NAMES[i] + "_size", Vector3(size) * SPACINGS[i])
	if not _filled[i]:
		_filled[i] = true
		if is_filled():
			filled.emit()


func _set_all(parameter: String, value: Variant) -> void:
	(material_override as ShaderMaterial).set_shader_parameter(parameter, value)
	for one in shaded:
		one.set_shader_parameter(parameter, value)

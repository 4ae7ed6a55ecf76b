extends SceneTree
## Tests that the drawn surface has no holes: no pixel behind the rock may be visible in any direction at any moment of
## streaming, while chunks appear and disappear, across seams between levels, with geomorphing, and after a dig.

const Checks := preload("res://tests/lib/checks.gd")
const Cave := preload("res://tests/lib/cave.gd")
const BEHIND := Color(1, 0, 1)
const SIZE := Vector2i(320, 240)

## Minimum length of the flight, and distance between two pictures, in metres.
var metres := 150.0
var step := 1.5

var _checks := Checks.new()
var _camera := Camera3D.new()
var _view := SubViewport.new()


func _initialize() -> void:
	var cave := Cave.new(self)
	cave.world.finest_distance = 16
	_view.size = SIZE
	_view.render_target_update_mode = SubViewport.UPDATE_ALWAYS
	_view.msaa_3d = Viewport.MSAA_DISABLED
	root.add_child(_view)
	_camera.fov = 90
	_camera.near = 0.05
	_camera.far = 1000
	_camera.environment = Environment.new()
	_camera.environment.background_mode = Environment.BG_COLOR
	_camera.environment.background_color = BEHIND
	_camera.environment.ambient_light_source = Environment.AMBIENT_SOURCE_COLOR
	_camera.environment.ambient_light_color = Color(0.5, 0.5, 0.5)
	_view.add_child(_camera)
	_view.world_3d = root.world_3d
	_camera.current = true
	await _frames(3)
	_checks.check(_seen() > SIZE.x * SIZE.y / 2, "before the world is there what lies behind is seen")
	await cave.enter()
	_camera.global_position = cave.viewer.global_position
	_checks.check(await cave.settle(), "the world comes to rest")
	var open := await _look_around()
	_checks.equal(open, 0, "pixels of what lies behind, at rest")

	var way := cave.passages(metres)
	var moving := 0
	var looks := 0
	var rest := 0.0
	for i in range(1, way.size()):
		rest += way[i - 1].distance_to(way[i])
		if rest < step:
			continue
		rest = 0.0
		cave.viewer.global_position = way[i]
		_camera.global_position = way[i]
		var ahead := way[mini(i + 8, way.size() - 1)] - way[i]
		if ahead.length() > 0.1:
			_camera.basis = Basis.looking_at(ahead if looks % 2 == 0 else -ahead, _up_for(ahead))
		await _frames(2)
		looks += 1
		var here := _seen()
		if here > 0 and moving == 0:
			_view.get_texture().get_image().save_png(OS.get_environment("SGM_PICTURES") + "/open.png")
			print("SGM NOTE open at ", way[i], " frame ", cave.world.get_statistics().frame, ": ", here, " pixels")
		moving += here
	_checks.check(looks > 50, "looked at on the way: %d" % looks)
	_checks.equal(moving, 0, "pixels of what lies behind, on the way")

	await cave.settle()
	var hit := cave.world.ray_cast(_camera.global_position, Vector3.DOWN, 30)
	cave.world.dig(hit.position, 3.0)
	for i in 20:
		await process_frame
		if _seen() > 0:
			_checks.check(false, "pixels of what lies behind, while a dig comes")
	await cave.settle()
	_checks.equal(await _look_around(), 0, "pixels of what lies behind, after a dig")
	_view.queue_free()
	await cave.leave()
	await _checks.finish(self)


func _up_for(ahead: Vector3) -> Vector3:
	return Vector3.UP if absf(ahead.normalized().y) < 0.95 else Vector3.RIGHT


func _look_around() -> int:
	var count := 0
	for direction: Vector3 in [Vector3.FORWARD, Vector3.BACK, Vector3.LEFT, Vector3.RIGHT, Vector3.UP, Vector3.DOWN]:
		_camera.basis = Basis.looking_at(direction, _up_for(direction))
		await _frames(3)
		count += _seen()
	return count


func _frames(count: int) -> void:
	for i in count:
		await process_frame
	await RenderingServer.frame_post_draw


## Number of pixels that show the background behind the rock.
func _seen() -> int:
	var image := _view.get_texture().get_image()
	var count := 0
	for y in image.get_height():
		for x in image.get_width():
			var pixel := image.get_pixel(x, y)
			if pixel.r > 0.9 and pixel.g < 0.1 and pixel.b > 0.9:
				count += 1
	return count

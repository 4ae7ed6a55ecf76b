extends SceneTree
## Takes pictures of the demo's places, as a player sees them: they must show the world, in many tones, without missing
## parts.

const Checks := preload("res://tests/lib/checks.gd")

var _checks := Checks.new()


func _initialize() -> void:
	await _cave()
	await _sky()
	await _valley()
	await _city()
	await _checks.finish(self)


func _cave() -> void:
	for file in DirAccess.get_files_at("user://"):
		DirAccess.remove_absolute("user://" + file)
	var place := await _enter("res://cave/cave.tscn")
	await _settle(place)
	_shoot_ready(place)
	await _shoot("cave")
	# Digs a hole, which is lit from the player's place.
	place.world.dig(place.player.eye() + place.player.gaze() * 5.0 + Vector3.DOWN * 1.5, 1.5, 0.3)
	await _settle(place)
	await _shoot("cave_dug")
	await _leave(place)


func _sky() -> void:
	var place := await _enter("res://sky/sky.tscn") as DemoSky
	await _settle(place)
	_shoot_ready(place)
	await _shoot("sky")
	# Draw the same clouds as a participating medium.
	place.fog = true
	var limit := Time.get_ticks_msec() + 60_000
	while not place.volume.is_filled() and Time.get_ticks_msec() < limit:
		await process_frame
	_checks.check(place.volume.is_filled(), "the clouds' volumes are sampled")
	await _shoot("sky_fog")
	await _leave(place)


func _valley() -> void:
	var place := await _enter("res://valley/valley.tscn")
	await _settle(place)
	_shoot_ready(place)
	await _shoot("valley")
	await _leave(place)


func _city() -> void:
	var place := await _enter("res://city/city.tscn")
	await _settle(place)
	_shoot_ready(place)
	await _shoot("city")
	await _leave(place)


func _enter(path: String) -> DemoPlace:
	var place := (load(path) as PackedScene).instantiate() as DemoPlace
	root.add_child(place)
	await process_frame
	return place


## Waits without drawing: a software renderer would leave the world's threads no time.
func _settle(place: DemoPlace) -> void:
	var limit := Time.get_ticks_msec() + 240_000
	var left := 240.0
	while not place.world.is_idle() and left > 0:
		place.world.wait_until_idle(left)
		await process_frame
		left = (limit - Time.get_ticks_msec()) / 1000.0
	_checks.check(place.world.is_idle(), "%s comes to rest: %s" % [place.name, place.world.get_statistics()])


func _shoot_ready(place: DemoPlace) -> void:
	place.overlay.visible = false


func _leave(place: DemoPlace) -> void:
	place.queue_free()
	for i in 2:
		await process_frame


func _shoot(picture: String) -> void:
	for i in 4:
		await process_frame
	await RenderingServer.frame_post_draw
	var image := root.get_texture().get_image()
	_checks.equal(image.save_png(OS.get_environment("SGM_PICTURES") + "/" + picture + ".png"), OK, picture + " is saved")
	var tones := {}
	var brightness := 0.0
	var small := image.duplicate() as Image
	small.resize(160, 90)
	for y in 90:
		for x in 160:
			var pixel := small.get_pixel(x, y)
			tones[pixel.to_rgba32() >> 8 & 0xF8F8F8] = true
			brightness += pixel.get_luminance() / (160 * 90)
	_checks.check(tones.size() > 40, "%s has many tones: %d" % [picture, tones.size()])
	_checks.check(brightness > 0.02 and brightness < 0.9, "%s is neither dark nor white: %.3f" % [picture, brightness])

extends SceneTree
## Draws the pictures of the README: the demo's places with the quality of a machine with a graphics card.
##
## SGM_PLACES names the places to draw (all by default); SGM_PICTURE_SIZE=960x540 makes smaller drafts.

const Checks := preload("res://tests/lib/checks.gd")
## For each place: the position of the camera (Vector3.INF: the player's start), its yaw to the left and its pitch in
## degrees, and its vertical angle of view in degrees, which is smaller than in play.
const VIEWS := {
	cave = [Vector3.INF, -90.0, 0.0, 70.0],
	sky = [Vector3(1900.0, 1370.0, 2250.0), 40.0, -1.0, 50.0],
	valley = [Vector3(38.0, 1.6, 121.0), -56.0, 7.0, 60.0],
	city = [Vector3(-5.7, 1.75, -4.4), -14.9, 4.6, 58.0],
}
const LONGEST := 900.0
const CAVE_SEED := 8

var _checks := Checks.new()


func _initialize() -> void:
	DemoQuality.always_fast = true
	var size := OS.get_environment("SGM_PICTURE_SIZE").split("x", false)
	if size.size() == 2:
		root.size = Vector2i(size[0].to_int(), size[1].to_int())
	var wanted := OS.get_environment("SGM_PLACES").split(" ", false)
	for name: String in VIEWS:
		if wanted.is_empty() or name in wanted:
			await _draw(name)
	await _checks.finish(self)


func _draw(name: String) -> void:
	var place := (load("res://%s/%s.tscn" % [name, name]) as PackedScene).instantiate() as DemoPlace
	for setting: String in place.fine:
		place.world.set(setting, place.fine[setting])
	# A cache, so that repeated pictures need not mesh the chunks again.
	place.world.cache_folder = "user://meshes"
	if place is DemoCave:
		place.world.seed = CAVE_SEED
	# Frames are drawn only when everything is ready: a software renderer would leave the world's threads no time.
	RenderingServer.render_loop_enabled = false
	root.add_child(place)
	await process_frame
	place.overlay.visible = false
	var view: Array = VIEWS[name]
	var eye: Vector3 = view[0]
	if place is DemoCave:
		eye = _hall(place as DemoCave)
	place.player.camera.fov = view[3]
	place.player.viewer.fov = view[3]
	if eye != Vector3.INF:
		place.player.flying = true
		place.player.teleport(eye - Vector3.UP * DemoPlayer.EYE_HEIGHT)
		place.player.look(deg_to_rad(view[1] as float), deg_to_rad(view[2] as float))
		await process_frame
	var limit := Time.get_ticks_msec() + roundi(LONGEST * 1000.0)
	while not place.world.is_idle() and Time.get_ticks_msec() < limit:
		place.world.wait_until_idle(10.0)
	_checks.check(place.world.is_idle(), "%s comes to rest" % name)
	for grass: DemoGrass in place.find_children("*", "DemoGrass", true, false):
		grass.fill()
	for leaves: DemoLeaves in place.find_children("*", "DemoLeaves", true, false):
		leaves.fill()
	if place is DemoSky:
		while not (place as DemoSky).volume.is_filled() and Time.get_ticks_msec() < limit:
			await process_frame
		_checks.check((place as DemoSky).volume.is_filled(), "the clouds' volumes are sampled")
	RenderingServer.render_loop_enabled = true
	for i in 2:
		await process_frame
	await RenderingServer.frame_post_draw
	var image := root.get_texture().get_image()
	_checks.equal(image.save_jpg(OS.get_environment("SGM_PICTURES") + "/" + name + ".jpg", 0.9), OK, name + " is saved")
	place.queue_free()
	for i in 2:
		await process_frame


# The player's starting place in the hall nearest to the middle.
func _hall(cave: DemoCave) -> Vector3:
	var best := Vector3.INF
	for anchor: Dictionary in cave.world.get_anchors(AABB(Vector3.ONE * -100.0, Vector3.ONE * 200.0)):
		var place: Vector3 = anchor.transform.origin
		if anchor.kind == "spawn" and (best == Vector3.INF or
				place.distance_to(DemoCave.MIDDLE) < best.distance_to(DemoCave.MIDDLE)):
			best = place
	return best

extends SceneTree
## Tests the patterns of the plugin's shaders in a single world: all compile together, each is drawn, and no two look
## the same.

const Checks := preload("res://tests/lib/checks.gd")
## One material for each SurfacePattern, in the order of the enum (runtime/tools/materials/material.h).
const NAMES := ["rock", "granite", "marble", "flowstone", "brick", "ashlar", "rubble", "paving", "cobble", "roof_tile",
		"slate", "plaster", "concrete", "wood", "iron", "asphalt", "glass", "sand", "gravel", "grass", "leaf", "bark",
		"moss", "water", "cloud", "boards", "glow", "joist",
		"lava", "leaded"]
const COLUMNS := 6
const METRES := 4.0  # distance in metres between neighbouring boxes
const TILE := 48  # pixels
const BEHIND := Color(1, 0, 1)

var _checks := Checks.new()
var _view := SubViewport.new()


func _initialize() -> void:
	var rows := ceili(NAMES.size() / float(COLUMNS))
	_view.size = Vector2i(COLUMNS, rows) * TILE
	_view.render_target_update_mode = SubViewport.UPDATE_ALWAYS
	root.add_child(_view)
	var camera := Camera3D.new()
	camera.projection = Camera3D.PROJECTION_ORTHOGONAL
	camera.size = rows * METRES
	camera.environment = Environment.new()
	camera.environment.background_mode = Environment.BG_COLOR
	camera.environment.background_color = BEHIND
	camera.environment.ambient_light_source = Environment.AMBIENT_SOURCE_COLOR
	camera.environment.ambient_light_color = Color(0.6, 0.6, 0.6)
	_view.add_child(camera)
	_view.world_3d = root.world_3d
	camera.position = Vector3((COLUMNS - 1) * METRES / 2, (rows - 1) * METRES / 2, 30)
	var sun := DirectionalLight3D.new()
	root.add_child(sun)
	sun.rotation_degrees = Vector3(-40, 30, 0)
	for mapping in 2:
		await _draw(mapping, rows)
	await _checks.finish(self)


func _grammar() -> SgmGrammar:
	var all := ""
	var rules := ""
	for i in NAMES.size():
		all += "  at(%dm, %dm, 0m) Box%d;\n" % [i % COLUMNS * METRES, i / COLUMNS * METRES, i]
		rules += "rule Box%d { mat %s; box(3.6m, 3.6m, 2m); }\n" % [i, NAMES[i]]
	var grammar := SgmGrammar.new()
	grammar.text = "sgm 1;\nstart All;\nrule All {\n" + all + "}\n" + rules
	_checks.check(grammar.is_valid(), "the grammar: " + grammar.get_error_text())
	return grammar


func _draw(mapping: int, rows: int) -> void:
	var world := SgmWorld3D.new()
	world.grammar = _grammar()
	world.mapping = mapping
	root.add_child(world)
	var viewer := SgmViewer3D.new()
	root.add_child(viewer)
	viewer.position = Vector3(10, 8, 3)
	var limit := Time.get_ticks_msec() + 60_000
	while not world.is_idle() and Time.get_ticks_msec() < limit:
		world.wait_until_idle(5)
		await process_frame
	_checks.check(world.is_idle(), "the world comes to rest: %s" % world.get_statistics())
	for i in 4:
		await process_frame
	await RenderingServer.frame_post_draw
	var image := _view.get_texture().get_image()
	image.save_png("%s/patterns_%d.png" % [OS.get_environment("SGM_PICTURES"), mapping])
	var seen := {}
	for i in NAMES.size():
		var corner := Vector2i(i % COLUMNS, rows - 1 - i / COLUMNS) * TILE
		var tile := image.get_region(Rect2i(corner + Vector2i.ONE * 8, Vector2i.ONE * (TILE - 16)))
		var holes := 0
		for y in tile.get_height():
			for x in tile.get_width():
				var pixel := tile.get_pixel(x, y)
				holes += 1 if pixel.r > 0.9 and pixel.b > 0.9 and pixel.g < 0.1 else 0
		# Leaves have gaps between them that show the background, so this pattern may have more holes than the others.
		_checks.check(holes < (TILE - 16) * (TILE - 16) / (2 if NAMES[i] == "leaf" else 100),
				"%s is drawn, mapping %d: %d pixels of what lies behind" % [NAMES[i], mapping, holes])
		seen[tile.get_data()] = NAMES[i]
	_checks.equal(seen.size(), NAMES.size(), "pictures that differ, mapping %d" % mapping)
	world.queue_free()
	viewer.queue_free()
	for i in 2:
		await process_frame

extends SceneTree
## Tests the demo's places as a player uses them: each is entered from the menu, walked through, dug in, generated again
## and left.

const Checks := preload("res://tests/lib/checks.gd")
## Seconds without progress after which a world counts as stuck. Its threads have a low priority, and other tests may
## run at the same time.
const PATIENCE := 90.0
const PLACES: Array[String] = ["res://cave/cave.tscn", "res://sky/sky.tscn", "res://valley/valley.tscn",
		"res://city/city.tscn"]

var _checks := Checks.new()


func _initialize() -> void:
	await _menu()
	var before := 0.0
	for path in PLACES:
		var place := await _enter(path)
		match path:
			"res://cave/cave.tscn":
				await _cave(place as DemoCave)
			"res://sky/sky.tscn":
				await _sky(place as DemoSky)
			"res://valley/valley.tscn":
				await _stands(place, "the valley")
				await _leaves(place)
			"res://city/city.tscn":
				await _city(place)
		await _panel(place)
		place.queue_free()
		for i in 3:
			await process_frame
		_checks.equal(root.get_child_count(), 0, "nodes after %s" % path)
		_checks.equal(Performance.get_monitor(Performance.OBJECT_ORPHAN_NODE_COUNT), before, "orphans after %s" % path)
	await _checks.finish(self)


func _menu() -> void:
	change_scene_to_file("res://menu/menu.tscn")
	await _until(func() -> bool: return current_scene != null, 5.0)
	var buttons := current_scene.get_node("%Buttons")
	_checks.equal(buttons.get_child_count(), PLACES.size(), "places in the menu")
	_checks.equal((current_scene.get_node("%Note") as Label).text, "", "the menu's note")
	(buttons.get_child(0) as Button).pressed.emit()
	await _until(func() -> bool: return current_scene is DemoCave, 5.0)
	if _checks.check(current_scene is DemoCave, "the menu opens the cave"):
		(current_scene as DemoPlace).leave()
		await _until(func() -> bool: return current_scene != null and not current_scene is DemoPlace, 5.0)
		_checks.check(current_scene != null and not current_scene is DemoPlace, "a place leads back to the menu")
	unload_current_scene()
	for i in 3:
		await process_frame


func _enter(path: String) -> DemoPlace:
	var place: DemoPlace = (load(path) as PackedScene).instantiate()
	# Shorter distances than in the demo, so that the world becomes idle sooner.
	if not place is DemoSky:
		place.world.view_distance = 64.0
		place.world.finest_distance = 24.0
	root.add_child(place)
	await process_frame
	return place


func _cave(cave: DemoCave) -> void:
	await _stands(cave, "seed 0")
	var from := cave.player.global_position
	Input.action_press("move_forward")
	await _seconds(1.0)
	Input.action_release("move_forward")
	var way := cave.player.global_position - from
	_checks.check(Vector2(way.x, way.z).length() > 1.0, "a second's walk: %s" % way)
	_checks.check(not DemoGround.is_inside(cave.world, cave.player.eye()), "the eyes are free after the walk")

	cave.player.look(0.0, -0.9)
	await process_frame
	var edits: int = cave.world.get_edit_count()
	var state: int = cave.world.get_edits_hash()
	_checks.check(cave.dig(), "dig")
	_checks.equal(cave.world.get_edit_count(), edits + 1, "edits after a dig")
	_checks.check(cave.undo(), "undo")
	_checks.check(not cave.undo(), "there is no second one to undo")
	_checks.check(cave.dig(), "dig again")
	cave.save()
	edits = cave.world.get_edit_count()
	state = cave.world.get_edits_hash()
	for seed_number in [1, 2]:
		await cave.grow(seed_number)
		_checks.equal(cave.world.get_edit_count(), 0, "digs in a cave not visited before")
		await _stands(cave, "seed %d" % seed_number)
	await cave.grow(0)
	_checks.equal(cave.world.get_edit_count(), edits, "digs that are loaded again")
	_checks.equal(cave.world.get_edits_hash(), state, "what was dug is loaded again")

	# With other parameter values, the same seeds make other caves.
	cave.world.set("parameters/wet", 0.9)
	await cave.grow(2)
	await _stands(cave, "seed 2 with other parameters")
	cave.world.set("parameters/wet", 0.6)
	await cave.grow(0)
	_checks.equal(cave.world.get_edits_hash(), state, "what was dug is loaded when the parameters are back")

	var points := PackedVector3Array([from + Vector3.UP, from + Vector3(0.0, 1.0, 4.0)])
	cave.player.fly_to(points, 20.0)
	await _until(func() -> bool: return not cave.player.is_on_route(), 5.0)
	_checks.check(cave.player.global_position.is_equal_approx(points[1]), "a flight ends at its last point")
	cave.fog = true
	_checks.check(cave.environment.environment.volumetric_fog_enabled, "fog")

	# With the settings for graphics cards, cells have another size, so the cave is another world, with digs of its own.
	cave.player.flying = false
	cave.refine()
	cave.world.view_distance = 64.0
	await cave.world.restarted
	_checks.equal(cave.world.cell_size, float(cave.fine.cell_size), "the finer cave's cells")
	_checks.equal(cave.world.get_edit_count(), 0, "digs in the finer cave")
	cave.go_to_start()
	await _stands(cave, "the finer cave")


func _sky(sky: DemoSky) -> void:
	var from := sky.player.global_position
	await _seconds(0.5)
	_checks.check(sky.player.global_position.distance_to(from) > 1.0, "the sky drifts by")
	Input.action_press("move_up")
	await _seconds(0.5)
	Input.action_release("move_up")
	_checks.check(not sky.player.is_on_route() and sky.player.global_position.y > from.y, "hands end the drift")


func _city(city: DemoPlace) -> void:
	await _stands(city, "the city")
	_checks.near(city.player.global_position.y, 0.0, 0.3, "the street's height")


func _panel(place: DemoPlace) -> void:
	var parameters: Array = place.world.grammar.get_parameters()
	var sliders := place.overlay.panel.find_children("*", "Range", true, false)
	_checks.equal(sliders.size(), parameters.size(), "sliders")
	var slider: Range = sliders[0]
	slider.value = slider.max_value
	var name: String = parameters[0].name
	await _until(func() -> bool:
		return is_equal_approx(place.world.get("parameters/" + name), parameters[0].maximum), 2.0)
	_checks.near(place.world.get("parameters/" + name), parameters[0].maximum, 1e-6, "what the slider of %s sets" % name)
	place.overlay.toggle_statistics()
	await _seconds(0.4)
	_checks.check("chunks drawn" in DemoStatistics.describe(place.world), "statistics")


func _stands(place: DemoPlace, what: String) -> void:
	var player := place.player
	_checks.check(not DemoGround.is_inside(place.world, player.eye()), "%s: the eyes are free at the start" % what)
	await _until_while_it_works(func() -> bool: return player.ground_ready and player.is_on_floor(), place.world)
	_checks.check(player.ground_ready and player.is_on_floor(),
			"%s: the player stands: %s" % [what, place.world.get_statistics()])
	_checks.check(player.global_position.distance_to(place.start_place) < 2.0, "%s: nobody has fallen" % what)


func _leaves(place: DemoPlace) -> void:
	var leaves := place.get_node("Leaves") as DemoLeaves
	await _until_while_it_works(func() -> bool: return place.world.is_idle(), place.world)
	await leaves.grow()
	_checks.check(leaves.multimesh.instance_count > 0, "leaves grow over frames: %s" % place.world.get_statistics())


func _until(condition: Callable, seconds: float) -> void:
	var limit := Time.get_ticks_msec() + roundi(seconds * 1000.0)
	while not condition.call() and Time.get_ticks_msec() < limit:
		await process_frame


## Waits until the condition holds, but only while the world makes progress.
func _until_while_it_works(condition: Callable, world: SgmWorld3D) -> void:
	var done := -1
	var limit := 0
	while not condition.call():
		var statistics: Dictionary = world.get_statistics()
		var now: int = statistics.get("chunks_meshed", 0) + statistics.get("plans", 0)
		if now != done:
			done = now
			limit = Time.get_ticks_msec() + roundi(PATIENCE * 1000.0)
		elif Time.get_ticks_msec() > limit:
			return
		await process_frame


func _seconds(seconds: float) -> void:
	await create_timer(seconds).timeout

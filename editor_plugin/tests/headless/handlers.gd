extends SceneTree
## Tests handlers of a world's signals that end this world, or start another world. Also tests settings that change
## nothing, and settings for names that the grammar currently lacks.

const Checks := preload("res://tests/lib/checks.gd")
const Cave := preload("res://tests/lib/cave.gd")
const TURNED := "sgm 1;\nunits m;\nparam turn = 30deg in 0deg..90deg;\nstart Ball;\nrule Ball { rot(y, turn) box(5m, 4m, 3m); }\n"

var _checks := Checks.new()


func _initialize() -> void:
	for signal_name: String in ["chunk_ready", "anchor_ready", "restarted", "became_idle", "walkable"]:
		for how: String in ["remove", "free", "restart", "grammar"]:
			await _ends(signal_name, how)
	await _scene_ends()
	await _failed()
	await _same_settings()
	await _kept_settings()
	await _origin()
	await _backend()
	await _wrong_settings()
	await _checks.finish(self)


func _ends(signal_name: String, how: String) -> void:
	var cave := Cave.new(self)
	cave.world.view_distance = 64
	cave.world.collision = true
	var heard := [0]
	var world := cave.world
	var handler := func() -> void:
		heard[0] += 1
		if heard[0] > 1:
			return
		match how:
			"remove":
				root.remove_child(world)
			"free":
				world.queue_free()
				root.remove_child(world)
			"restart":
				world.restart()
			"grammar":
				world.grammar = (load("res://tests/grammars/city.sgm") as SgmGrammar)
	var arguments := _arguments(signal_name)
	var heard_by := handler.unbind(arguments) if arguments > 0 else handler
	if signal_name == "restarted":
		await cave.enter()
		world.connect(signal_name, heard_by)
		world.restart()
	else:
		world.connect(signal_name, heard_by)
		await cave.enter()
	var limit := Time.get_ticks_msec() + 60_000
	while heard[0] == 0 and Time.get_ticks_msec() < limit:
		await process_frame
	for i in 5:
		await process_frame
	_checks.check(heard[0] > 0, "%s comes, and its handler does this: %s" % [signal_name, how])
	if how == "remove":
		_checks.check(not world.is_running(), "the world has ended")
		world.free()
	elif how != "free":
		world.queue_free()
	cave.viewer.queue_free()
	for i in 2:
		await process_frame


func _arguments(signal_name: String) -> int:
	for found in ClassDB.class_get_signal_list("SgmWorld3D"):
		if found.name == signal_name:
			return (found.args as Array).size()
	return 0


## Returns a scene that consists of one node with a script.
func _scene_of(code: String) -> PackedScene:
	var script := GDScript.new()
	script.source_code = code
	script.reload()
	var node := Node3D.new()
	node.set_script(script)
	var scene := PackedScene.new()
	scene.pack(node)
	node.free()
	return scene


## A script in a scene may end the world while the scene is instantiated at an anchor.
func _scene_ends() -> void:
	var scene := _scene_of("extends Node3D\nfunc _ready() -> void:\n\tvar world := get_parent()\n\tworld.get_parent().remove_child.call_deferred(world)\n\tworld.set(\"cell_size\", 0.75)\n\tworld.restart()\n\tworld.wait_until_idle(0.0)\n")
	var cave := Cave.new(self)
	cave.world.anchor_scenes = {"spawn": scene}
	await cave.enter()
	var limit := Time.get_ticks_msec() + 60_000
	while cave.world.is_inside_tree() and Time.get_ticks_msec() < limit:
		await process_frame
	_checks.check(not cave.world.is_inside_tree(), "a scene at an anchor has ended the world")
	cave.world.free()
	cave.viewer.queue_free()
	await process_frame


## The last reference to a grammar is released while the grammar emits its signal of a change.
func _failed() -> void:
	var cave := Cave.new(self)
	var path := "user://turned.sgm"
	var file := FileAccess.open(path, FileAccess.WRITE)
	file.store_string(TURNED)
	file.close()
	cave.world.grammar = ResourceLoader.load(path, "", ResourceLoader.CACHE_MODE_IGNORE)
	await cave.tree.process_frame
	root.add_child(cave.world)
	await process_frame
	var other: SgmGrammar = load("res://tests/grammars/cave.sgm")
	cave.world.failed.connect(func(_message: String) -> void: cave.world.grammar = other)
	_checks.expect_error("unknown name `spere`")
	file = FileAccess.open(path, FileAccess.WRITE)
	file.store_string(TURNED.replace("box(5m, 4m, 3m)", "spere(5m)"))
	file.close()
	cave.world.grammar.reload()
	for i in 3:
		await process_frame
	_checks.equal(cave.world.grammar, other, "a handler of `failed` has set another grammar")
	await cave.leave()


func _same_settings() -> void:
	var cave := Cave.new(self)
	var restarts := [0]
	cave.world.restarted.connect(func() -> void: restarts[0] += 1)
	await cave.enter()
	for i in 5:
		cave.world.view_distance = cave.world.view_distance
		cave.world.collision = cave.world.collision
		cave.world.grammar = cave.world.grammar
		await process_frame
	_checks.equal(restarts[0], 1, "values that are there already begin nothing anew")
	await cave.leave()


func _kept_settings() -> void:
	var world := SgmWorld3D.new()
	world.grammar = SgmGrammar.new()
	world.grammar.text = TURNED
	var turn := _property(world, "parameters/turn")
	_checks.check((turn.get("hint_string", "") as String).begins_with("0,90,"), "an angle's range is in degrees: %s" % turn)
	world.set("parameters/turn", 1.0)
	world.set("parameters/gone", 2.0)
	world.set("colors/moss", Color.GREEN)
	_checks.expect_error("unknown name `spere`")
	world.grammar.text = TURNED.replace("box(5m, 4m, 3m)", "spere(5m)")
	for name: String in ["parameters/turn", "parameters/gone", "colors/moss"]:
		_checks.check(_property(world, name).get("usage", 0) & PROPERTY_USAGE_STORAGE, "%s stays in the scene" % name)
	world.free()


func _property(object: Object, name: String) -> Dictionary:
	for property in object.get_property_list():
		if property.name == name:
			return property
	return {}


## Scenes at anchors move with the world's origin, and already have their place when they enter the tree.
func _origin() -> void:
	var scene := _scene_of("extends Node3D\nvar entered_at: Vector3\nfunc _enter_tree() -> void:\n\tentered_at = global_position\n")
	var cave := Cave.new(self)
	cave.world.anchor_scenes = {"spawn": scene}
	await cave.enter()
	await cave.settle()
	var placed: Array[Node] = cave.world.get_children(true)
	_checks.check(placed.size() > 0, "scenes at anchors")
	var before: Vector3 = placed[0].global_position
	_checks.equal(placed[0].get("entered_at"), before, "a scene is at its place when it enters the tree")
	cave.world.origin += Vector3i(100, 0, 0)
	_checks.check(placed[0].global_position.is_equal_approx(before - Vector3(100.0, 0.0, 0.0)),
			"it goes with the origin at once: from %s to %s" % [before, placed[0].global_position])
	await cave.leave()


func _backend() -> void:
	_checks.expect_error("the backend CUDA cannot be used here")
	var cave := Cave.new(self)
	cave.world.backend = 4
	await cave.enter()
	_checks.check(cave.world.is_running(), "a number that is no backend's")
	await cave.leave()


## Each wrong setting must cause one message, and the previous world must stay.
func _wrong_settings() -> void:
	var cave := Cave.new(self)
	var messages: Array[String] = []
	cave.world.failed.connect(func(message: String) -> void: messages.append(message))
	_checks.expect_error("no parameter 'widht'")
	_checks.expect_error("the parameter boxy is 9")
	cave.world.set("parameters/widht", 3.0)
	cave.world.set("parameters/boxy", 9.0)
	await cave.enter()
	_checks.check(cave.world.is_running(), "parameters that are not there, or out of their range, are warned of")
	_checks.expect_error("cell_size is 0 m, view_distance is -5 m")
	cave.world.cell_size = 0.0
	cave.world.view_distance = -5.0
	for i in 3:
		await process_frame
	_checks.equal(messages.size(), 1, "distances that cannot be, told once")
	_checks.check(cave.world.is_running(), "the world before stays")
	_checks.expect_error("is scaled")
	cave.world.scale = Vector3.ONE * 2.0
	await process_frame
	cave.world.scale = Vector3.ONE
	await cave.leave()

extends SceneTree
## Tests the settings of a world: parameters as properties, seeds, materials, several viewers, anchors, an unavailable
## backend, a grammar with errors, measures.

const Checks := preload("res://tests/lib/checks.gd")
const Cave := preload("res://tests/lib/cave.gd")

var _checks := Checks.new()


func _initialize() -> void:
	await _parameters()
	await _viewers()
	await _anchors()
	await _backends()
	await _wrong_grammar()
	await _missing_grammar()
	await _checks.finish(self)


func _parameters() -> void:
	var cave := Cave.new(self)
	var restarts := [0]
	cave.world.restarted.connect(func() -> void: restarts[0] += 1)
	await cave.enter()
	var listed := cave.world.get_property_list().filter(func(p: Dictionary) -> bool: return p.name == "parameters/boxy")
	if _checks.equal(listed.size(), 1, "a parameter is a property"):
		_checks.check(listed[0].hint == PROPERTY_HINT_RANGE and listed[0].hint_string.begins_with("0,1,"),
				"with its range: %s" % listed[0].hint_string)
	_checks.equal(cave.world.get("parameters/boxy"), 0.3, "its default")
	_checks.equal(cave.world.property_get_revert("parameters/boxy"), 0.3, "what it goes back to")
	await cave.settle()
	var before := cave.world.get_world_hash(_box(cave))
	cave.world.set("parameters/boxy", 0.9)
	_checks.check(await cave.settle(), "a parameter is changed while it streams")
	var boxy := cave.world.get_world_hash(_box(cave))
	_checks.check(boxy != before, "other parameters, another world")
	cave.world.set("parameters/boxy", 0.3)
	await cave.settle()
	_checks.equal(cave.world.get_world_hash(_box(cave)), before, "and back")
	cave.world.seed = 99
	await cave.settle()
	_checks.check(cave.world.get_world_hash(_box(cave)) != before, "another seed, another world")
	_checks.equal(restarts[0], 1, "none of that begins anew")
	_checks.equal(cave.world.get_statistics().field_drawn, 3, "fields that were drawn")

	cave.world.set("materials/limestone", StandardMaterial3D.new())
	await cave.settle()
	_checks.equal(restarts[0], 1, "nor does a material")
	_checks.check(cave.world.get_statistics().surfaces > 50, "all is drawn again with it")
	cave.world.cell_size = 1.0
	await cave.settle()
	_checks.equal(restarts[0], 2, "another cell begins anew")
	_checks.check(cave.world.get_measures().watertight, "closed")
	var measured: Dictionary = cave.world.measure_drawn()
	_checks.near(measured.area, cave.world.get_measures().area, 0.01 * measured.area, "area, measured in two ways")
	_checks.equal(measured.histogram.size(), 33, "bins")
	_checks.near(measured.flat + measured.convex + measured.concave, 1.0, 1e-6, "shares of edges")
	_checks.check(cave.world.bake_chunks().size() > 20, "chunks to bake")
	await cave.leave()


func _viewers() -> void:
	var cave := Cave.new(self)
	await cave.enter()
	await cave.settle()
	var one := cave.world.get_statistics().drawn as int
	var second := SgmViewer3D.new()
	root.add_child(second)
	second.global_position = cave.viewer.global_position + Vector3(3000, 0, 0)
	await cave.settle()
	_checks.check(cave.world.get_statistics().drawn > one * 1.2, "two viewers see more than one")
	second.enabled = false
	await cave.settle()
	_checks.check(cave.world.get_statistics().drawn < one * 1.2, "a viewer that is off sees nothing")
	second.queue_free()
	await cave.leave()


func _anchors() -> void:
	var cave := Cave.new(self)
	var marker := Marker3D.new()
	marker.name = "Spawn"
	var scene := PackedScene.new()
	scene.pack(marker)
	marker.free()
	cave.world.anchor_scenes = {"spawn": scene}
	var keys := {}
	cave.world.anchor_ready.connect(func(anchor: Dictionary) -> void:
		_checks.check(not keys.has(anchor.key), "an anchor comes once")
		keys[anchor.key] = anchor)
	cave.world.anchor_removed.connect(func(key: int) -> void:
		_checks.check(keys.erase(key), "an anchor goes that has come"))
	await cave.enter()
	await cave.settle()
	_checks.check(keys.size() > 0, "anchors come")
	_checks.equal(cave.world.get_child_count(true), keys.size(), "a scene at each of them")
	var anchor: Dictionary = keys.values()[0]
	var places := cave.world.get_children(true).map(func(n: Node3D) -> Vector3: return n.global_position)
	_checks.check(places.has((anchor.transform as Transform3D).origin), "where the anchor is")
	cave.viewer.global_position += Vector3(2000, 0, 0)
	var near_before := keys.keys()
	await cave.settle()
	_checks.check(near_before.all(func(key: int) -> bool: return not keys.has(key)), "what is left behind goes")
	await process_frame
	_checks.equal(cave.world.get_child_count(true), keys.size(), "and its scenes")
	await cave.leave()
	_checks.equal(keys.size(), 0, "all are gone with the world")


func _backends() -> void:
	_checks.expect_error("the backend CUDA cannot be used here")
	var cave := Cave.new(self)
	cave.world.backend = 3
	await cave.enter()
	_checks.check(await cave.settle(), "a backend that is not there: another one does it")
	_checks.check(cave.world.get_statistics().backend in ["cpu", "vulkan"], "which one: " + cave.world.get_statistics().backend)
	var hash := cave.world.get_world_hash(_box(cave))
	cave.world.backend = 1
	await cave.settle()
	_checks.equal(cave.world.get_world_hash(_box(cave)), hash, "the same bytes")
	await cave.leave()


func _wrong_grammar() -> void:
	var cave := Cave.new(self)
	cave.world.grammar = cave.world.grammar.duplicate()
	var messages: Array[String] = []
	cave.world.failed.connect(func(message: String) -> void: messages.append(message))
	await cave.enter()
	await cave.settle()
	var before := cave.world.get_world_hash(_box(cave))
	_checks.expect_error("unknown name `Nowher`")
	var good: String = cave.world.grammar.text
	cave.world.grammar.text = good.replace("start Node;", "start Nowher;")
	await process_frame
	_checks.equal(messages.size(), 1, "a broken grammar is told once")
	_checks.check(cave.world.get_error_text().contains("Nowher"), "and kept: " + cave.world.get_error_text())
	await cave.settle()
	_checks.equal(cave.world.get_world_hash(_box(cave)), before, "the last good world stays")
	cave.world.grammar.text = good
	await process_frame
	_checks.equal(cave.world.get_error_text(), "", "mended, the error has gone")
	await cave.leave()


func _missing_grammar() -> void:
	var world := SgmWorld3D.new()
	root.add_child(world)
	await process_frame
	_checks.check(not world.is_running(), "without a grammar nothing runs")
	_checks.equal(world.get_statistics(), {}, "and there are no figures")
	_checks.equal(world.dig(Vector3.ZERO, 1).size(), 0, "and nothing to dig in")
	world.queue_free()
	await process_frame


## Returns a box around the hall of the viewer.
func _box(cave: RefCounted) -> AABB:
	return AABB(cave.viewer.global_position - Vector3.ONE * 24, Vector3.ONE * 48)

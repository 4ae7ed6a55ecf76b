extends SceneTree
## Tests digging: a dug place is void for rays, the field and the physics; after undo it is rock again; after saving it
## is dug in the next run; and exported edits make another world equal.

const Checks := preload("res://tests/lib/checks.gd")
const Cave := preload("res://tests/lib/cave.gd")
const JOURNAL := "user://edits_test/of/a/game.journal"

var _checks := Checks.new()


func _initialize() -> void:
	DirAccess.remove_absolute(JOURNAL)
	var cave := Cave.new(self)
	cave.world.collision = true
	cave.world.journal = JOURNAL
	await cave.enter()
	_checks.check(await cave.settle(), "the world comes to rest")

	var floor_hit := cave.world.ray_cast(cave.viewer.global_position, Vector3.DOWN, 60)
	if not _checks.check(not floor_hit.is_empty(), "there is a floor"):
		await _checks.finish(self)
		return
	_checks.check(floor_hit.normal.y > 0 and floor_hit.material != "", "the floor's normal and material: %s" % floor_hit)
	var before := await _physics_floor(cave)
	_checks.near(before, floor_hit.position.y, 1.0, "the physics' floor")

	var id := cave.world.dig(floor_hit.position, 4.0)
	_checks.equal([id.size(), cave.world.get_edit_count()], [2, 1], "a dig has an id")
	var deeper := cave.world.ray_cast(cave.viewer.global_position, Vector3.DOWN, 60)
	_checks.near(deeper.position.y, floor_hit.position.y - 4.0, 0.2, "the field's floor after digging")
	_checks.check(await cave.settle(), "the dig is drawn")
	_checks.near(await _physics_floor(cave), floor_hit.position.y - 4.0, 0.7, "the physics' floor after digging")
	_checks.check(cave.world.get_measures().watertight, "still closed")

	_checks.equal(cave.world.build(floor_hit.position + Vector3.UP * 2, 2.0, "calcite").size(), 2, "building")
	_checks.equal(cave.world.ray_cast(cave.viewer.global_position, Vector3.DOWN, 60).material, "calcite", "what was built")
	_checks.expect_error("no material 'chocolate'")
	_checks.equal(cave.world.build(floor_hit.position, 2.0, "chocolate").size(), 0, "a material that is not there")
	_checks.expect_error("shape 'cone'")
	_checks.equal(cave.world.edit({"shape": "cone"}).size(), 0, "a shape that is not there")
	var box := cave.world.edit({"shape": "box", "position": floor_hit.position, "size": Vector3(3, 6, 3), "smooth": 0.5})
	_checks.equal(box.size(), 2, "a box")
	_checks.equal(cave.world.undo(box).size(), 2, "undoing it")
	_checks.expect_error("no edit's id")
	_checks.equal(cave.world.undo(PackedInt64Array()).size(), 0, "undoing what is no id")
	_checks.expect_error("radius is -1 m")
	_checks.equal(cave.world.dig(floor_hit.position, -1.0).size(), 0, "a radius below 0")
	_checks.expect_error("no 'shpe'")
	_checks.equal(cave.world.edit({"shpe": "box"}).size(), 0, "a key that is misspelled")
	_checks.expect_error("no ''")
	_checks.equal(cave.world.edit({7: "box"}).size(), 0, "a key that is no text")
	_checks.expect_error("radius has to be a number")
	_checks.equal(cave.world.edit({"radius": "x"}).size(), 0, "a value of another type")
	_checks.expect_error("size.y is 0 m")
	_checks.equal(cave.world.edit({"shape": "box", "size": Vector3(1, 0, 1)}).size(), 0, "a box without height")
	_checks.expect_error("edit")
	_checks.equal(cave.world.undo(PackedInt64Array([1, 2])).size(), 0, "undoing what was never done")

	var hash := cave.world.get_edits_hash()
	var bytes := cave.world.export_edits()
	_checks.check(bytes.size() > 0, "edits as bytes")
	_checks.equal(cave.world.flush_edits(), OK, "saving")
	await cave.leave()

	# A new world with the same journal simulates the next run of the game.
	cave = Cave.new(self)
	cave.world.journal = JOURNAL
	await cave.enter()
	_checks.equal([cave.world.get_edit_count(), cave.world.get_edits_hash()], [4, hash], "what was saved is there")
	_checks.equal(cave.world.ray_cast(cave.viewer.global_position, Vector3.DOWN, 60).material, "calcite", "and what was built")
	await cave.leave()

	# A second world takes the role of another player's world.
	cave = Cave.new(self)
	await cave.enter()
	_checks.equal(cave.world.import_edits(bytes), OK, "another world takes them over")
	_checks.equal(cave.world.get_edits_hash(), hash, "and is the same then")
	_checks.expect_error("SgmWorld3D: ")
	_checks.check(cave.world.import_edits(PackedByteArray([1, 2, 3])) != OK, "bytes that are no edits")
	await cave.leave()
	DirAccess.remove_absolute(JOURNAL)
	await _checks.finish(self)


## Returns the height of the ground below the viewer, according to a ray of the engine's physics.
func _physics_floor(cave: RefCounted) -> float:
	for i in 3:
		await physics_frame
	var from: Vector3 = cave.viewer.global_position
	var query := PhysicsRayQueryParameters3D.create(from, from + Vector3.DOWN * 60)
	var hit := root.get_world_3d().direct_space_state.intersect_ray(query)
	return hit.position.y if not hit.is_empty() else NAN

extends SceneTree
## Tests a world that the command has baked: it must equal the meshed world, and be read instead of meshed. Also tests
## stores that are not valid.

const Checks := preload("res://tests/lib/checks.gd")
const Cave := preload("res://tests/lib/cave.gd")
const FOLDER := "user://stores_test"
const STORE := FOLDER + "/store"

var _checks := Checks.new()
var _messages: PackedStringArray


func _initialize() -> void:
	_remove(FOLDER)
	DirAccess.make_dir_recursive_absolute(FOLDER)
	var cave := Cave.new(self)
	cave.world.view_distance = 48
	cave.world.finest_distance = 12
	cave.world.seed = 7
	cave.world.failed.connect(func(message: String) -> void: _messages.append(message))
	await cave.enter()
	_checks.check(await cave.settle(), "the world comes to rest")
	var hash: String = str(cave.world.get_world_hash(_box(cave)))
	var made: Dictionary = cave.world.get_statistics()
	_checks.equal(made.store_hits, 0, "nothing was baked")
	if _bake(cave.viewer.global_position, made.top_level):
		cave.world.stores = [STORE]
		_checks.equal(cave.world.stores, PackedStringArray([STORE]), "the property")
		_checks.check(await cave.settle(), "it comes to rest again")
		_checks.equal(str(cave.world.get_world_hash(_box(cave))), hash, "the same world")
		var read: Dictionary = cave.world.get_statistics()
		_checks.check(read.store_hits > 50, "parts from the store: %d" % read.store_hits)
		_checks.equal(read.store_damaged, 0, "none damaged")
		_checks.check(cave.world.get_measures().watertight, "closed")
		var hit: Dictionary = cave.world.ray_cast(cave.viewer.global_position, Vector3.DOWN, 60)
		_checks.equal(cave.world.dig(hit.position, 2.0).size(), 2, "digging")
		_checks.check(await cave.settle(), "what was dug is drawn")
		_checks.check(str(cave.world.get_world_hash(_box(cave))) != hash, "edits lie on top")
	_checks.equal(_messages.size(), 0, "no complaint: %s" % _messages)
	_checks.expect_error("is not a store of baked worlds")
	cave.world.stores = [FOLDER]
	for i in 3:
		await process_frame
	_checks.check(_messages.size() == 1 and _messages[0].contains("is not a store of baked worlds"),
			"a folder that is none: %s" % _messages)
	_checks.expect_error("cannot be read [(]")
	cave.world.stores = ["http://127.0.0.1:9/store"]
	_checks.check(await cave.settle(), "a server that is not there holds nothing up")
	_checks.equal(cave.world.get_statistics().store_hits, 0, "and gives nothing")
	await cave.leave()
	_remove(FOLDER)
	await _checks.finish(self)


## Bakes a world with the command, as a game's build process would do.
func _bake(around: Vector3, top_level: int) -> bool:
	var command := OS.get_environment("SGM_COMMAND")
	var low := (around - Vector3.ONE * 40).floor()
	var high := (around + Vector3.ONE * 40).ceil()
	var region := "%d,%d,%d:%d,%d,%d" % [low.x, low.y, low.z, high.x, high.y, high.z]
	var output := []
	var status := OS.execute(command, ["bake", ProjectSettings.globalize_path("res://tests/grammars/cave.sgm"), "--seed", "7",
			"--region", region, "--levels", "0..%d" % top_level, "--backend", "cpu", "--out",
			ProjectSettings.globalize_path(STORE)], output, true)
	return _checks.equal(status, 0, "sgm bake: %s" % output)


func _box(cave: Cave) -> AABB:
	return AABB(cave.viewer.global_position - Vector3.ONE * 40, Vector3.ONE * 80)


func _remove(path: String) -> void:
	if not DirAccess.dir_exists_absolute(path):
		return
	for file in DirAccess.get_files_at(path):
		DirAccess.remove_absolute(path.path_join(file))
	for folder in DirAccess.get_directories_at(path):
		_remove(path.path_join(folder))
	DirAccess.remove_absolute(path)

extends SceneTree
## Tests sample_density(): the density and light of a known solid, calls from any thread, and errors for places that are
## not finite.

const Checks := preload("res://tests/lib/checks.gd")
## A ball with a diameter of 8 m in each square of 16 m; it has full density from one metre below its surface.
const BALLS := "sgm 1; units m; domain infinite axes xz output density edge 1m;
layer main cell 16m reach 8m { start Ball; }
rule Ball { at(8m, 8m, 8m) sphere(4m); }"
const MIDDLE := Vector3(8, 8, 8)
const FADE := 10.0

var _checks := Checks.new()
var _world := SgmWorld3D.new()


func _initialize() -> void:
	var grammar := SgmGrammar.new()
	grammar.text = BALLS
	_checks.check(grammar.is_valid(), "the grammar: " + grammar.get_error_text())
	_world.grammar = grammar
	_checks.check(_one(MIDDLE).is_empty(), "the answer is empty while no world runs")
	root.add_child(_world)
	# Wait for some frames, because the world's session starts only in the world's first frame.
	for i in 3:
		await process_frame
	_values()
	_light()
	_spacing()
	_origin()
	_threads()
	_wrong()
	_world.queue_free()
	await _checks.finish(self)


func _one(corner: Vector3) -> PackedByteArray:
	return _world.sample_density(corner, 1.0, Vector3i.ONE, Vector3.UP, FADE)


func _values() -> void:
	_checks.equal(_one(MIDDLE)[0], 255, "inside it is full")
	_checks.equal(_one(MIDDLE + Vector3(0, 4.5, 0))[0], 0, "outside it is empty")
	# The formula in sgm.h: 2 t^2 up to half of the edge, then 1 - 2 (1 - t)^2.
	_checks.near(_one(MIDDLE + Vector3(3.75, 0, 0))[0], 255 * 0.125, 2, "a quarter of a metre deep")
	_checks.near(_one(MIDDLE - Vector3(0, 3.25, 0))[0], 255 * 0.875, 2, "three quarters of a metre deep")
	var softer := _world.sample_density(MIDDLE + Vector3(3, 0, 0), 1.0, Vector3i.ONE, Vector3.UP, FADE, 2.0)
	_checks.near(softer[0], 255 * 0.5, 2, "another edge")
	# The result is ordered by x first, then y, then z.
	var size := Vector3i(3, 2, 4)
	var all := _world.sample_density(Vector3(6, 9, 5), 1.0, size, Vector3.UP, FADE)
	_checks.equal(all.size(), 2 * size.x * size.y * size.z, "two bytes for each point")
	var alike := true
	for z in size.z:
		for y in size.y:
			for x in size.x:
				alike = alike and all[2 * ((z * size.y + y) * size.x + x)] == _one(Vector3(6 + x, 9 + y, 5 + z))[0]
	_checks.check(alike, "each at its place")


func _light() -> void:
	var column := _world.sample_density(Vector3(8, 0, 8), 0.5, Vector3i(1, 32, 1), Vector3.UP, FADE)
	_checks.equal(column[2 * 31 + 1], 255, "above the ball it is bright")
	# A vertical ray crosses 8 m of the ball. The outer metre at each end has half the density on average, so 7 m of
	# full density remain.
	_checks.near(column[1], 255 * exp(-7.0 / FADE), 3, "below it the light has come through all of it")
	var falls := true
	for y in range(1, 32):
		falls = falls and column[2 * y - 1] <= column[2 * y + 1]
	_checks.check(falls, "nowhere is it brighter than higher up")
	# With the sun from the side, the ball shades points away from the sun, and no longer the points below it.
	var size := Vector3i(33, 16, 1)
	var slanted := _world.sample_density(Vector3(0, 0, 8), 1.0, size, Vector3(1, 1, 0), FADE)
	_checks.check(slanted[2 * 1 + 1] < 200, "shade lies away from the sun: %d" % slanted[2 * 1 + 1])
	var times := _world.sample_density(Vector3(0, 0, 8), 1.0, size, Vector3(100, 100, 0), FADE)
	_checks.check(times == slanted, "how long the way to the sun is written does not matter")


## A spacing below the minimum is replaced by the minimum, also for the computation of light.
func _spacing() -> void:
	var column := _world.sample_density(Vector3(8, 6, 8), 0.0003, Vector3i(1, 4096, 1), Vector3.UP, 4.0)
	_checks.near(column[1], 255 * exp(-1.0), 2, "4,096 points, a 1024th of a metre apart, are 4 m")


func _origin() -> void:
	var corner := Vector3(3, 4, 5)
	var before := _world.sample_density(corner, 0.7, Vector3i(9, 8, 7), Vector3(1, 2, 3), FADE)
	_world.origin = Vector3i(1, -2, 3)
	var there := _world.sample_density(corner - Vector3(1, -2, 3), 0.7, Vector3i(9, 8, 7), Vector3(1, 2, 3), FADE)
	_world.origin = Vector3i.ZERO
	_checks.check(before == there, "corners are in the node's own coordinates")


## Samples while another thread moves the origin: each result must belong to one of the two origins.
func _threads() -> void:
	var sample := func() -> PackedByteArray:
		return _world.sample_density(Vector3(2, 4, 2), 1.0, Vector3i(12, 8, 12), Vector3.UP, FADE)
	var here: PackedByteArray = sample.call()
	_world.origin = Vector3i(3, 1, 5)
	var there: PackedByteArray = sample.call()
	_checks.check(here != there, "the places differ")
	var wrong := func() -> int:
		var count := 0
		for i in 200:
			var now: PackedByteArray = sample.call()
			count += 0 if now == here or now == there else 1
		return count
	var thread := Thread.new()
	thread.start(wrong)
	while thread.is_alive():
		_world.origin = Vector3i.ZERO if _world.origin != Vector3i.ZERO else Vector3i(3, 1, 5)
	_checks.equal(thread.wait_to_finish(), 0, "samples of neither place")
	_world.origin = Vector3i.ZERO


func _wrong() -> void:
	_checks.expect_error("the corner's coordinate x lies outside of the world")
	_checks.expect_error("the corner's coordinate y lies outside of the world")
	_checks.expect_error("the corner's coordinate z lies outside of the world")
	_checks.expect_error("the spacing is wider than the world")
	_checks.expect_error("sample_density takes 1 to 4,096 points")
	_checks.expect_error("the points leave the world")
	for corner: Vector3 in [Vector3(NAN, 0, 0), Vector3(0, INF, 0), Vector3(0, 0, -INF), Vector3(1e30, 0, 0),
			Vector3(0, -3e6, 0)]:
		_checks.check(_one(corner).is_empty(), "no place: %s" % corner)
	for spacing: float in [1e9, 1e300, INF, NAN, 0.0, -1.0]:
		var got := _world.sample_density(MIDDLE, spacing, Vector3i.ONE, Vector3.UP, FADE)
		_checks.check(got.is_empty(), "no spacing: %f" % spacing)
	for sun: Vector3 in [Vector3(NAN, 1, 0), Vector3(0, INF, 0), Vector3.ZERO, Vector3.DOWN, Vector3.RIGHT]:
		_checks.check(_world.sample_density(MIDDLE, 1.0, Vector3i.ONE, sun, FADE).is_empty(), "no sun: %s" % sun)
	_checks.check(_world.sample_density(MIDDLE, 1.0, Vector3i.ONE, Vector3.UP, NAN).is_empty(), "no fade")
	_checks.check(_world.sample_density(MIDDLE, 1.0, Vector3i.ONE, Vector3.UP, FADE, NAN).is_empty(), "no edge")
	# The first point lies within the runtime's coordinates, the last one outside.
	_checks.check(_world.sample_density(Vector3(2_097_000, 0, 0), 1.0, Vector3i(4096, 1, 1), Vector3.UP, FADE).is_empty(),
			"points beyond the world's end")

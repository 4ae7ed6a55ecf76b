extends SceneTree
## Tests for memory leaks: a world enters and leaves the scene ten times, and memory must not grow.

const Checks := preload("res://tests/lib/checks.gd")
const Cave := preload("res://tests/lib/cave.gd")
const CYCLES := 10
# The first cycles fill pools and caches of the engine and of the allocator, so they are not measured.
const WARM := 3
const MOST_GROWTH := 8.0 * 1024 * 1024

var _checks := Checks.new()


func _initialize() -> void:
	var resident: Array[float] = []
	var objects: Array[float] = []
	for i in WARM + CYCLES:
		var cave := Cave.new(self)
		cave.world.collision = true
		await cave.enter()
		_checks.check(await cave.settle(), "cycle %d comes to rest" % i)
		await cave.leave()
		await process_frame
		resident.append(_resident_bytes())
		objects.append(Performance.get_monitor(Performance.OBJECT_COUNT))
	print("resident MiB: ", resident.map(func(bytes: float) -> String: return "%.1f" % (bytes / 1048576)))
	_checks.equal(objects[-1], objects[WARM], "objects of the engine's")
	_checks.check(resident[-1] - resident[WARM] < MOST_GROWTH,
			"memory grew by %.1f MiB in %d cycles" % [(resident[-1] - resident[WARM]) / 1048576, CYCLES - 1])
	await _checks.finish(self)


func _resident_bytes() -> float:
	var status := FileAccess.open("/proc/self/status", FileAccess.READ)
	while not status.eof_reached():
		var line := status.get_line()
		if line.begins_with("VmRSS:"):
			return line.trim_prefix("VmRSS:").trim_suffix("kB").strip_edges().to_float() * 1024
	return NAN

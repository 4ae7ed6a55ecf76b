extends RefCounted
## State that several tests of the demo's cave share: a world, a viewer, known places, and a path through passages from
## hall to hall.

var tree: SceneTree
var world: SgmWorld3D
var viewer: SgmViewer3D


func _init(in_tree: SceneTree, grammar_path := "res://tests/grammars/cave.sgm") -> void:
	tree = in_tree
	world = SgmWorld3D.new()
	world.grammar = load(grammar_path)
	world.view_distance = 160
	world.finest_distance = 24
	viewer = SgmViewer3D.new()


## Adds world and viewer to the scene, with the viewer in the hall nearest to the origin.
func enter() -> void:
	tree.root.add_child(world)
	tree.root.add_child(viewer)
	await tree.process_frame
	viewer.global_position = halls()[0]


func leave() -> void:
	world.queue_free()
	viewer.queue_free()
	for i in 2:
		await tree.process_frame


## Returns the middles of the halls around the origin, nearest first.
func halls() -> PackedVector3Array:
	var around := 420.0
	var places: Array[Vector3] = []
	for anchor: Dictionary in world.get_anchors(AABB(Vector3.ONE * -around, Vector3.ONE * 2 * around)):
		if anchor.kind == "spawn":
			places.append((anchor.transform as Transform3D).origin)
	places.sort_custom(func(a: Vector3, b: Vector3) -> bool: return a.length() < b.length())
	return PackedVector3Array(places)


## Waits until everything is drawn, has colliders, and is idle. Returns false after a timeout.
func settle(seconds := 60.0) -> bool:
	var limit := Time.get_ticks_msec() + int(seconds * 1000)
	while Time.get_ticks_msec() < limit:
		await tree.process_frame
		if world.is_idle():
			return true
	return false


## Returns a path through the passages from hall to hall, at least [param metres] long; empty if there is none.
func passages(metres: float, radius := 0.8) -> PackedVector3Array:
	var left := halls()
	var way := PackedVector3Array([left[0]])
	left.remove_at(0)
	var length := 0.0
	while length < metres and not left.is_empty():
		var from := way[way.size() - 1]
		var next := PackedVector3Array()
		for i in _by_distance(left, from).slice(0, 6):
			next = world.find_way(from, left[i], radius)
			if not next.is_empty():
				left.remove_at(i)
				break
		if next.is_empty():
			return PackedVector3Array()
		length += length_of(next)
		way.append_array(next)
	return way


static func length_of(way: PackedVector3Array) -> float:
	var length := 0.0
	for i in range(1, way.size()):
		length += way[i - 1].distance_to(way[i])
	return length


static func _by_distance(places: PackedVector3Array, from: Vector3) -> Array:
	var order := range(places.size())
	order.sort_custom(func(a: int, b: int) -> bool:
		return places[a].distance_squared_to(from) < places[b].distance_squared_to(from))
	return order

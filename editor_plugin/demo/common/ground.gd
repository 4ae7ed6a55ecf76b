class_name DemoGround
extends RefCounted
## Finds places in a world where a person can stand. Queries the world's field, so that nothing need be drawn for it.

## Half the edge, in metres, of the first box that is searched for anchors; it is doubled, up to LAST_REACH, until a
## suitable anchor is found.
const FIRST_REACH := 400.0
const LAST_REACH := 3200.0
## Free height above the feet that a person needs, metres.
const HEADROOM := 2.2
## Number of directions that are tried to find the widest view.
const DIRECTIONS := 24
## Ground less than this many metres below a hall's anchor is the ground of a passage; lower ground is that of the hall.
const PASSAGE_HEIGHT := 5.5
## Distance in metres from the beginning of a passage to the starting place.
const MOUTH := 4.0
const STEP := 0.5
## Distance in metres from the middle of a hall at which its ground is searched.
const BESIDE := 6.0


## Whether a place lies inside the solid. The result is exact within [param depth] metres of the surface.
static func is_inside(world: SgmWorld3D, place: Vector3, depth := 64.0) -> bool:
	var point := world.closest_point(place, depth)
	return not point.is_empty() and point.inside


## Returns the ground below a place, or the place itself if there is no ground within [param length] metres.
static func below(world: SgmWorld3D, place: Vector3, length := 64.0) -> Vector3:
	var hit := world.ray_cast(place, Vector3.DOWN, length)
	return place if hit.is_empty() or hit.inside else hit.position


## Returns the transform of the player's starting place, for any seed and parameters. The function takes the anchor of
## [param kind] in free space that is nearest to [param around]. The place is in the beginning of the longest passage
## that leads away from this anchor, or on the ground near the anchor if no passage does. Without such an
## anchor, the place is the ground below [param around].
static func start(world: SgmWorld3D, kind: String, around: Vector3) -> Transform3D:
	var reach := FIRST_REACH
	while reach <= LAST_REACH:
		var box := AABB(around - Vector3.ONE * reach, Vector3.ONE * reach * 2.0)
		var places: Array[Vector3] = []
		for anchor: Dictionary in world.get_anchors(box):
			if anchor.kind == kind:
				places.append(anchor.transform.origin)
		places.sort_custom(func(a: Vector3, b: Vector3) -> bool:
			return a.distance_squared_to(around) < b.distance_squared_to(around))
		for place in places:
			if not is_inside(world, place):
				return _mouth(world, place)
		reach *= 2.0
	return looking(below(world, around), 0.0)


## Returns the transform of a person who stands at a place and looks in the direction of an angle.
static func looking(feet: Vector3, yaw: float) -> Transform3D:
	return Transform3D(Basis(Vector3.UP, yaw), feet)


## Returns the yaw in radians of the longest horizontal view from a place.
static func widest_view(world: SgmWorld3D, eye: Vector3, length := 80.0) -> float:
	var best := 0.0
	var farthest := -1.0
	for step in DIRECTIONS:
		var yaw := TAU * step / DIRECTIONS
		var hit := world.ray_cast(eye, Vector3.FORWARD.rotated(Vector3.UP, yaw), length)
		var free: float = length if hit.is_empty() else eye.distance_to(hit.position)
		if free > farthest:
			farthest = free
			best = yaw
	return best


## Returns the lowest free place at or above [param feet], for a player who was buried when the world changed; returns
## [param otherwise] if there is no such place within [param height] metres.
static func dug_out(world: SgmWorld3D, feet: Vector3, otherwise: Vector3, height := 12.0) -> Vector3:
	var lift := 0.0
	while lift <= height:
		var place := feet + Vector3.UP * lift
		if _has_room(world, place):
			return place
		lift += STEP
	return otherwise


static func _mouth(world: SgmWorld3D, middle: Vector3) -> Transform3D:
	var yaw := widest_view(world, middle)
	var ahead := Vector3.FORWARD.rotated(Vector3.UP, yaw)
	var hit := world.ray_cast(middle, ahead, 80.0)
	var free: float = 80.0 if hit.is_empty() else middle.distance_to(hit.position)
	var way := 0.0
	while way < free - MOUTH:
		if middle.y - below(world, middle + ahead * way).y < PASSAGE_HEIGHT:
			var feet := below(world, middle + ahead * (way + MOUTH))
			if middle.y - feet.y < PASSAGE_HEIGHT and _has_room(world, feet):
				return looking(feet, yaw)
		way += STEP
	return looking(_ground_around(world, middle), yaw)


## Returns the highest ground near the middle of a hall. The ground below the middle itself does not suffice, because a
## shaft may open there.
static func _ground_around(world: SgmWorld3D, middle: Vector3) -> Vector3:
	var best := below(world, middle)
	for step in 8:
		var place := middle + Vector3.FORWARD.rotated(Vector3.UP, TAU * step / 8.0) * BESIDE
		if is_inside(world, place):
			continue
		var feet := below(world, place)
		if feet.y > best.y and feet.y < place.y and _has_room(world, feet):
			best = feet
	return best


static func _has_room(world: SgmWorld3D, feet: Vector3) -> bool:
	return not is_inside(world, feet + Vector3.UP * 0.3) and not is_inside(world, feet + Vector3.UP * HEADROOM)

extends Node3D
## A lantern that somebody has left in a hall, on the ground some steps from where one arrives.

## Steps from the anchor at which the ground is tried, metres.
const WAY := 5.5
const DIRECTIONS := 12
const DEEPEST := 4.0


func _ready() -> void:
	var world := get_parent() as SgmWorld3D
	if world == null:
		return
	var best := Vector3.INF
	for i in DIRECTIONS:
		# By the golden angle: halls get their lanterns on different sides.
		var ahead := Vector3.FORWARD.rotated(Vector3.UP, 2.4 * i + global_position.x)
		var hit := world.ray_cast(global_position, ahead, WAY + 1.5)
		if not hit.is_empty():
			continue
		var ground := world.ray_cast(global_position + ahead * WAY, Vector3.DOWN, DEEPEST)
		if not ground.is_empty() and not ground.inside and ground.normal.y > 0.7 and ground.material != "water":
			best = ground.position
			break
	visible = best != Vector3.INF
	if visible:
		global_position = best
		global_basis = Basis.IDENTITY

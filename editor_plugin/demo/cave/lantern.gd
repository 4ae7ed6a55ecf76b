extends Node3D
## A lantern on the ground of a hall, some steps from the player's starting place.

## Horizontal distance in metres from the hall's anchor to the place where the lantern looks for ground.
const WAY := 5.5
const DIRECTIONS := 12
const DEEPEST := 4.0


func _ready() -> void:
	var world := get_parent() as SgmWorld3D
	if world == null:
		return
	var best := Vector3.INF
	for i in DIRECTIONS:
		# Successive directions differ by the golden angle. The first one depends on the hall's position, so that
		# lanterns stand on different sides of their halls.
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

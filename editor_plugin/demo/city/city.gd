class_name DemoCity
extends DemoPlace
## An endless city of blocks and towers, in which the player walks and flies.

## A place next to a crossing of two streets: the grammar has a crossing at every corner of its cells.
const CROSSING := Vector3(-0.5, 2.5, 17.0)
## Yaw along one of the streets, radians.
const LOOK := -0.04


func find_start() -> Transform3D:
	return DemoGround.looking(DemoGround.below(world, CROSSING), LOOK)

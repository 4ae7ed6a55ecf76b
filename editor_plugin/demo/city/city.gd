class_name DemoCity
extends DemoPlace
## An endless city of blocks and towers, to walk in and to fly over.

## Beside a crossing of two streets: the grammar has one at every corner of its cells.
const CROSSING := Vector3(-0.5, 2.5, 17.0)
## Along one of them, radians.
const LOOK := -0.04


func find_start() -> Transform3D:
	return DemoGround.looking(DemoGround.below(world, CROSSING), LOOK)

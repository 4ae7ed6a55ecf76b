class_name DemoValley
extends DemoPlace
## A valley with a stream between limestone cliffs, and caves that lead into the rock.

## A place next to the stream, above the ground.
const BANK := Vector3(40.0, 30.0, 132.0)
## Yaw towards the cliff, radians.
const LOOK := -0.85


func find_start() -> Transform3D:
	return DemoGround.looking(DemoGround.below(world, BANK), LOOK)

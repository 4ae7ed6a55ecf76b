class_name DemoValley
extends DemoPlace
## A valley between cliffs of limestone with a stream in it, and caves that lead into the rock.

## Beside the stream, above the ground.
const BANK := Vector3(40.0, 30.0, 132.0)
## At the cliff, radians.
const LOOK := -0.85


func find_start() -> Transform3D:
	return DemoGround.looking(DemoGround.below(world, BANK), LOOK)

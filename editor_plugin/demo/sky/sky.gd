class_name DemoSky
extends DemoPlace
## Cumulus clouds over an endless plain, and a slow flight between them.

const HEIGHT := 1230.0
const DRIFT_SPEED := 14.0
## Length in metres of the part of the flight that is planned at a time.
const LEG := 2000.0


@export var volume: DemoCloudVolume

## Whether clouds are drawn as a participating medium, or as the meshes of their surfaces. The medium needs a graphics
## card.
var fog := false:
	set(value):
		fog = value
		volume.visible = value
		world.visible = not value


func _ready() -> void:
	super()
	fog = DemoQuality.is_fast()
	player.arrived.connect(drift)
	drift()


func _unhandled_input(event: InputEvent) -> void:
	if event.is_action_pressed("toggle_fog"):
		fog = not fog
		overlay.say("Clouds of fog" if fog else "Clouds of meshes")
	else:
		super(event)


func find_start() -> Transform3D:
	return DemoGround.looking(Vector3(0.0, HEIGHT, 0.0), 0.0)


## Flies straight ahead at constant height until the user moves the player.
func drift() -> void:
	var ahead := player.gaze() * Vector3(1.0, 0.0, 1.0)
	ahead = ahead.normalized() if ahead.length() > 0.01 else Vector3.FORWARD
	player.fly_to(PackedVector3Array([player.global_position + ahead * LEG]), DRIFT_SPEED)

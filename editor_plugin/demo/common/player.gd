class_name DemoPlayer
extends CharacterBody3D
## The player. It can walk only where the world has reported colliders of the ground; it can fly anywhere. While the
## mouse is captured, mouse movements turn the head. Scripts move the player with [method teleport], [method look] and
## [method fly_to].

## Emitted when the player has passed all points given to [method fly_to].
signal arrived
## Emitted when the player changes between flying and walking.
signal flight_changed(flying: bool)

const EYE_HEIGHT := 1.65
const MOUSE_TURN := 0.0022
const STEEPEST_LOOK := deg_to_rad(89.0)
## Speed at which the head turns towards the direction of a route, 1/s.
const ROUTE_TURN := 2.5
## Number of frames for which the player's viewer is disabled after a teleport. When it is enabled again, the world
## checks anew whether there is ground below the player.
const VIEWER_REST := 2

@export var flying := false:
	set(value):
		if flying == value:
			return
		flying = value
		velocity = Vector3.ZERO
		motion_mode = MOTION_MODE_FLOATING if flying else MOTION_MODE_GROUNDED
		flight_changed.emit(flying)
@export var can_walk := true
## View distance of the camera.
@export_range(10.0, 100000.0, 1.0, "suffix:m") var sight := 2000.0
@export_group("Speed")
@export_range(0.1, 100.0, 0.1, "or_greater", "suffix:m/s") var walk_speed := 3.6
@export_range(0.1, 500.0, 0.1, "or_greater", "suffix:m/s") var flight_speed := 9.0
@export_range(1.0, 20.0, 0.1) var sprint_factor := 2.5
@export_range(0.0, 20.0, 0.1, "suffix:m/s") var jump_speed := 4.2
@export_group("Lamp")
@export var lamp_on := true:
	set(value):
		lamp_on = value
		if is_node_ready():
			_lamp.visible = value
			_glow.visible = value

## Whether the world has reported a collider below the player. Before that, gravity has no effect.
var ground_ready := false
## If true, only scripts move the player.
var held := false

var _route := PackedVector3Array()
var _route_speed := 0.0
var _before := Vector3.ZERO
var _now := Vector3.ZERO
var _viewer_rest := 0
var _gravity: float = ProjectSettings.get_setting("physics/3d/default_gravity")

@onready var viewer: SgmViewer3D = %Viewer
@onready var camera: Camera3D = %Camera
@onready var _head: Node3D = %Head
@onready var _lamp: SpotLight3D = %Lamp
@onready var _glow: OmniLight3D = %Glow
@onready var _shape: CollisionShape3D = %Shape


func _ready() -> void:
	lamp_on = lamp_on
	motion_mode = MOTION_MODE_FLOATING if flying else MOTION_MODE_GROUNDED
	_before = global_position
	_now = global_position
	camera.far = sight
	viewer.fov = camera.fov


func _unhandled_input(event: InputEvent) -> void:
	if event is InputEventMouseMotion and Input.mouse_mode == Input.MOUSE_MODE_CAPTURED:
		var turn: Vector2 = event.relative * MOUSE_TURN
		look(_head.rotation.y - turn.x, _head.rotation.x - turn.y)
	elif event.is_action_pressed("toggle_flight") and can_walk:
		flying = not flying
	elif event.is_action_pressed("toggle_lamp"):
		lamp_on = not lamp_on


func _process(_delta: float) -> void:
	# Frames are drawn between two steps of the physics, so the head's position is interpolated between the positions
	# after the last two steps.
	_head.global_position = _before.lerp(_now, Engine.get_physics_interpolation_fraction()) + Vector3.UP * EYE_HEIGHT
	if _viewer_rest > 0:
		_viewer_rest -= 1
		viewer.enabled = _viewer_rest == 0


func _physics_process(delta: float) -> void:
	_before = _now
	var wish := Vector2.ZERO if held else Input.get_vector("move_left", "move_right", "move_forward", "move_back")
	var lift := 0.0 if held else Input.get_axis("move_down", "move_up")
	if is_on_route():
		if wish != Vector2.ZERO or lift != 0.0:
			stop()
		else:
			_follow_route(delta)
	elif flying:
		_fly(wish, lift, delta)
	else:
		_walk(wish, delta)
	_now = global_position


## Moves the feet to a place. Gravity has no effect until the world reports that there is ground.
func teleport(feet: Vector3) -> void:
	stop()
	global_position = feet
	velocity = Vector3.ZERO
	_before = feet
	_now = feet
	ground_ready = false
	_head.global_position = feet + Vector3.UP * EYE_HEIGHT
	viewer.enabled = false
	_viewer_rest = VIEWER_REST


## Turns the head to these angles, in radians.
func look(yaw: float, pitch: float) -> void:
	_head.rotation = Vector3(clampf(pitch, -STEEPEST_LOOK, STEEPEST_LOOK), wrapf(yaw, -PI, PI), 0.0)


## Turns the head towards a place.
func look_at_place(place: Vector3) -> void:
	var turn := _angles(place - eye())
	look(turn.y, turn.x)


## Returns the position of the eyes.
func eye() -> Vector3:
	return global_position + Vector3.UP * EYE_HEIGHT


## Returns the viewing direction, a unit vector.
func gaze() -> Vector3:
	return -_head.global_basis.z


## Flies through points, which the feet pass, at [param speed] metres per second. The player looks ahead and passes
## through solids. A movement by the user ends the flight. Emits [signal arrived] at the end.
func fly_to(points: PackedVector3Array, speed: float) -> void:
	if points.is_empty() or speed <= 0.0:
		return
	flying = true
	_route = points.duplicate()
	_route_speed = speed
	_shape.disabled = true


func is_on_route() -> bool:
	return not _route.is_empty()


## Ends a flight that [method fly_to] has started.
func stop() -> void:
	_route.clear()
	_shape.disabled = false


func _follow_route(delta: float) -> void:
	var left := _route_speed * delta
	var place := global_position
	while not _route.is_empty():
		var way := _route[0] - place
		var length := way.length()
		if length > left:
			place += way * (left / length)
			break
		place = _route[0]
		left -= length
		_route.remove_at(0)
	global_position = place
	if _route.is_empty():
		stop()
		arrived.emit()
		return
	var share := 1.0 - exp(-ROUTE_TURN * delta)
	var turn := _angles(_route[0] - place)
	look(lerp_angle(_head.rotation.y, turn.y, share), lerpf(_head.rotation.x, turn.x, share))


func _fly(wish: Vector2, lift: float, delta: float) -> void:
	var way := _head.global_basis * Vector3(wish.x, 0.0, wish.y) + Vector3.UP * lift
	var target := way.limit_length() * flight_speed * _haste()
	velocity = velocity.lerp(target, 1.0 - exp(-8.0 * delta))
	move_and_slide()


func _walk(wish: Vector2, delta: float) -> void:
	if not ground_ready:
		return
	var way := (Basis(Vector3.UP, _head.rotation.y) * Vector3(wish.x, 0.0, wish.y)).limit_length()
	var target := way * walk_speed * _haste()
	var grip := 1.0 - exp(-(12.0 if is_on_floor() else 2.0) * delta)
	velocity.x = lerpf(velocity.x, target.x, grip)
	velocity.z = lerpf(velocity.z, target.z, grip)
	if is_on_floor():
		if not held and Input.is_action_pressed("move_up"):
			velocity.y = jump_speed
	else:
		velocity.y -= _gravity * delta
	move_and_slide()


func _haste() -> float:
	return sprint_factor if not held and Input.is_action_pressed("sprint") else 1.0


func _angles(way: Vector3) -> Vector2:
	var flat := Vector2(way.x, way.z).length()
	var yaw := atan2(-way.x, -way.z) if flat > 1e-4 else _head.rotation.y
	return Vector2(atan2(way.y, flat), yaw)

class_name DemoPlace
extends Node3D
## Base class of the demo's places: a world, its player, and the texts over the picture.

const MENU := "res://menu/menu.tscn"
const GROWING := "The world grows …"
const WELCOME := "Click to look around, F1 for help"
## Maximum seconds for which the message "The world grows" is shown.
const LONGEST_GROWTH := 120.0
## Seconds between two checks whether the player is buried in rock.
const WATCH_SECONDS := 0.5
## A player who falls this many metres below the last ground on which they stood is moved back.
const DEEPEST_FALL := 60.0

@export var world: SgmWorld3D
@export var player: DemoPlayer
@export var overlay: DemoOverlay
@export var environment: WorldEnvironment
@export_group("With a graphics card")
## Settings of the world that replace the scene's own ones on machines with a graphics card.
@export var fine: Dictionary = {}
@export_group("")
## The text that F1 shows.
@export_multiline var help := ""

## The place where the player begins, and to which the player returns after a fall.
var start_place := Vector3.ZERO

var _safe_place := Vector3.ZERO
var _watch := 0.0


func _ready() -> void:
	DemoQuality.apply(get_viewport(), environment.environment)
	world.walkable.connect(_on_walkable)
	world.failed.connect(func(message: String) -> void: overlay.say(message, 10.0))
	overlay.set_up(world, help)
	overlay.say(GROWING, LONGEST_GROWTH)
	world.chunk_ready.connect(_on_first_chunk, CONNECT_ONE_SHOT)
	overlay.menu_asked.connect(leave)
	overlay.parameter_changed.connect(func(_name: String) -> void: _watch = 0.0)
	player.flight_changed.connect(_on_flight_changed)
	go_to_start()
	var figures := world.get_statistics()
	if not figures.is_empty() and figures.backend != "cpu":
		refine()


func _notification(what: int) -> void:
	if what == NOTIFICATION_APPLICATION_FOCUS_OUT and is_node_ready():
		overlay.capture_mouse(false)


func _exit_tree() -> void:
	Input.mouse_mode = Input.MOUSE_MODE_VISIBLE


func _unhandled_input(event: InputEvent) -> void:
	if event.is_action_pressed("free_mouse"):
		overlay.capture_mouse(false)
	elif event is InputEventMouseButton and event.pressed and Input.mouse_mode != Input.MOUSE_MODE_CAPTURED:
		overlay.capture_mouse(true)
		get_viewport().set_input_as_handled()
	elif event.is_action_pressed("show_help"):
		overlay.toggle_help()
	elif event.is_action_pressed("show_statistics"):
		overlay.toggle_statistics()


func _physics_process(delta: float) -> void:
	_watch -= delta
	if player.flying or not player.ground_ready or player.is_on_route():
		return
	if player.is_on_floor() and not DemoGround.is_inside(world, player.eye(), 1.0):
		_safe_place = player.global_position
	if _watch > 0.0:
		return
	_watch = WATCH_SECONDS
	if player.global_position.y < _safe_place.y - DEEPEST_FALL:
		bring_to(_safe_place)
	elif DemoGround.is_inside(world, player.global_position + Vector3.UP * 0.9, 8.0):
		bring_to(DemoGround.dug_out(world, player.global_position, start_place))


## Moves the player to the start of this place.
func go_to_start() -> void:
	var start := find_start()
	start_place = start.origin
	bring_to(start_place)
	player.look(start.basis.get_euler().y, 0.0)


## Returns the transform of the player at the start, for the world's seed and parameters. Subclasses override this
## method.
func find_start() -> Transform3D:
	var feet := DemoGround.below(world, Vector3(0.0, 40.0, 0.0))
	return DemoGround.looking(feet, DemoGround.widest_view(world, feet + Vector3.UP))


func bring_to(feet: Vector3) -> void:
	_safe_place = feet
	player.teleport(feet)


## Applies the settings for machines with a graphics card.
func refine() -> void:
	for setting: String in fine:
		world.set(setting, fine[setting])


## Returns to the menu.
func leave() -> void:
	get_tree().change_scene_to_file(MENU)


## Returns the message that is shown when the world is first visible.
func welcome() -> String:
	return WELCOME


func _on_first_chunk(_key: Vector4i) -> void:
	overlay.say(welcome(), 5.0)


func _on_walkable(viewer: Node3D) -> void:
	if viewer == player.viewer:
		player.ground_ready = true


func _on_flight_changed(flying: bool) -> void:
	overlay.say("Flying" if flying else "Walking")

class_name DemoCave
extends DemoPlace
## An endless cave in which the player walks and digs, and which can be grown again from other seeds. Digs are saved in
## a journal for each seed.

## The player begins in the hall nearest to this place.
const MIDDLE := Vector3(30.0, 0.0, 30.0)
## Path of the journal that stores the player's digs in one cave. The name contains everything that determines the cave:
## the seed, the cell size in mm, and a hash of the grammar and its parameters.
const JOURNAL := "user://cave_%d_%dmm_%08x.journal"
## Maximum distance in metres from the eyes at which the player can dig and build.
const REACH := 14.0
const DIG_RADIUS := 1.4
const BUILD_RADIUS := 1.1
const SMOOTH := 0.35
const BUILD_MATERIAL := "calcite"
## Seconds between two digs while the button is held.
const PACE := 0.16
## Maximum seconds until the picture is shown, even if no ground has been drawn yet.
const LONGEST_WAIT := 20.0

## Whether air scatters the lamp's light; initially true only on machines with a dedicated graphics card.
var fog := false:
	set(value):
		fog = value
		environment.environment.volumetric_fog_enabled = value

var _edits: Array[PackedInt64Array] = []
var _rest := 0.0
var _growing := false
## False until the user releases the mouse button whose click captured the mouse, so that this click does not dig.
var _armed := false


func _ready() -> void:
	world.journal = _journal()
	super()
	fog = DemoQuality.is_fast()
	var save_button := Button.new()
	save_button.text = "Save digs"
	save_button.focus_mode = Control.FOCUS_NONE
	save_button.pressed.connect(save)
	overlay.panel.add_extra(save_button)


func _process(delta: float) -> void:
	_rest -= delta
	var digs := Input.is_action_pressed("dig")
	var builds := Input.is_action_pressed("build")
	if Input.mouse_mode != Input.MOUSE_MODE_CAPTURED:
		_armed = false
	elif not digs and not builds:
		_armed = true
	elif _armed and not _growing and _rest <= 0.0:
		_rest = PACE
		if digs:
			dig()
		else:
			build()


func _unhandled_input(event: InputEvent) -> void:
	if event.is_action_pressed("undo", true):
		undo()
	elif event.is_action_pressed("next_seed"):
		grow(world.seed + 1)
	elif event.is_action_pressed("previous_seed"):
		grow(world.seed - 1)
	elif event.is_action_pressed("save"):
		save()
	elif event.is_action_pressed("toggle_fog"):
		fog = not fog
		overlay.say("Fog on" if fog else "Fog off")
	else:
		super(event)


func refine() -> void:
	super()
	world.journal = _journal()


func find_start() -> Transform3D:
	return DemoGround.start(world, "spawn", MIDDLE)


func welcome() -> String:
	return "What you dug here is back. " + WELCOME if world.get_edit_count() > 0 else WELCOME


## Digs where the player looks. Returns false if there is no rock within reach.
func dig() -> bool:
	var hit := world.ray_cast(player.eye(), player.gaze(), REACH)
	return not hit.is_empty() and _keep(world.dig(hit.position, DIG_RADIUS, SMOOTH))


## Builds rock where the player looks, but never around the player. Returns whether rock was built.
func build() -> bool:
	var hit := world.ray_cast(player.eye(), player.gaze(), REACH)
	if hit.is_empty():
		return false
	var middle := player.global_position + Vector3.UP * 0.9
	if middle.distance_to(hit.position) < BUILD_RADIUS + 1.4:
		overlay.say("Too near to build: step back")
		return false
	return _keep(world.build(hit.position, BUILD_RADIUS, BUILD_MATERIAL, SMOOTH))


## Undoes the last dig or building. Returns false if there was none.
func undo() -> bool:
	if _edits.is_empty():
		overlay.say("Nothing to undo")
		return false
	return not world.undo(_edits.pop_back()).is_empty()


## Writes the digs to the journal, from which they are loaded when this seed's cave is entered again.
func save() -> void:
	if world.flush_edits() == OK:
		overlay.say("Saved: they are here again when you come back")
	else:
		overlay.say("The digs cannot be saved: see whether the disk has room", 6.0)


## Replaces the cave by the cave of another seed, while a curtain hides the picture. A coroutine.
func grow(new_seed: int) -> void:
	if _growing:
		return
	_growing = true
	player.held = true
	await overlay.fade(true)
	_edits.clear()
	world.seed = new_seed
	world.journal = _journal()
	# The new cave exists from the next frame on; its anchors are not known before.
	await world.restarted
	go_to_start()
	var limit := Time.get_ticks_msec() + roundi(LONGEST_WAIT * 1000.0)
	while not player.ground_ready and Time.get_ticks_msec() < limit:
		await get_tree().process_frame
	await overlay.fade(false)
	overlay.say("Seed %d" % new_seed)
	player.held = false
	_growing = false


func _journal() -> String:
	var values := [world.grammar.get_meaning_hash()]
	for parameter: Dictionary in world.grammar.get_parameters():
		values.append(world.get("parameters/" + parameter.name))
	return JOURNAL % [world.seed, roundi(world.cell_size * 1000.0), hash(values)]


func _keep(id: PackedInt64Array) -> bool:
	if id.is_empty():
		return false
	_edits.append(id)
	return true

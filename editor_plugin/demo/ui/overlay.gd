class_name DemoOverlay
extends CanvasLayer
## Texts and sliders over the picture of a place.

signal menu_asked
signal parameter_changed(parameter: String)

const FADE_SECONDS := 0.35

var _message_tween: Tween
var _fade_tween: Tween

@onready var panel: DemoPanel = %Panel
@onready var statistics: DemoStatistics = %Statistics
@onready var _help: PanelContainer = %Help
@onready var _help_text: Label = %HelpText
@onready var _message: Label = %Message
@onready var _curtain: ColorRect = %Curtain
@onready var _aim: Control = %Aim


func _ready() -> void:
	panel.menu_asked.connect(func() -> void: menu_asked.emit())
	panel.parameter_changed.connect(func(parameter: String) -> void: parameter_changed.emit(parameter))
	_message.modulate.a = 0.0
	_aim.visible = false


func set_up(world: SgmWorld3D, help: String) -> void:
	panel.set_up(world)
	statistics.set_up(world)
	_help_text.text = help


## Shows a sentence for some seconds.
func say(sentence: String, seconds := 2.5) -> void:
	_message.text = sentence
	if _message_tween != null:
		_message_tween.kill()
	_message.modulate.a = 1.0
	_message_tween = create_tween()
	_message_tween.tween_interval(seconds)
	_message_tween.tween_property(_message, ^"modulate:a", 0.0, 0.5)


## Hides the picture behind the curtain, or shows it again. A coroutine.
func fade(closed: bool) -> void:
	if _fade_tween != null:
		_fade_tween.kill()
	_fade_tween = create_tween()
	_fade_tween.tween_property(_curtain, ^"color:a", 1.0 if closed else 0.0, FADE_SECONDS)
	await _fade_tween.finished


## Captures or releases the mouse. A captured mouse turns the head; a released mouse moves the sliders.
func capture_mouse(captured: bool) -> void:
	Input.mouse_mode = Input.MOUSE_MODE_CAPTURED if captured else Input.MOUSE_MODE_VISIBLE
	if captured:
		get_viewport().gui_release_focus()
	panel.visible = not captured
	_aim.visible = captured


func toggle_help() -> void:
	_help.visible = not _help.visible


func toggle_statistics() -> void:
	statistics.visible = not statistics.visible

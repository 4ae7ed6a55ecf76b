extends Control
## The menu of places. It uses no class of the native library, so that it can explain what to do if the library is
## missing.

const PLACES: Array[Dictionary] = [
	{name = "Cave", scene = "res://cave/cave.tscn", text = "Walk, dig and build in endless caves"},
	{name = "Clouds", scene = "res://sky/sky.tscn", text = "Drift among cumulus"},
	{name = "Valley", scene = "res://valley/valley.tscn", text = "Walk along a stream, and into the caves of its cliffs"},
	{name = "City", scene = "res://city/city.tscn", text = "Walk streets, or fly over them"},
]
const MISSING := "The native library of SG+M is missing: run editor_plugin/build.sh, " \
		+ "or copy the folder addons/sgm together with its bin/ into this project."

@onready var _buttons: VBoxContainer = %Buttons
@onready var _note: Label = %Note


func _ready() -> void:
	if not ClassDB.class_exists(&"SgmWorld3D"):
		_note.text = MISSING
		return
	_note.text = ""
	for place in PLACES:
		var button := Button.new()
		button.text = "%s\n%s" % [place.name, place.text]
		button.custom_minimum_size = Vector2(420.0, 64.0)
		button.pressed.connect(open.bind(place.scene))
		_buttons.add_child(button)
	(_buttons.get_child(0) as Button).grab_focus()


## Opens the scene of a place, by its path.
func open(scene: String) -> void:
	var error := get_tree().change_scene_to_file(scene)
	if error != OK:
		_note.text = "%s cannot be opened (%s): copy the whole demo folder again." % [scene, error_string(error)]

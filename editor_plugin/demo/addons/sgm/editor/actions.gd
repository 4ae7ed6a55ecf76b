@tool
extends GridContainer
## The buttons of the dock, which act on the selected world.

## Emitted with a sentence about the error of an action, or with an empty text if there is none.
signal told(sentence: String)

const TextEditing := preload("text_editing.gd")
const BAKE := "res://addons/sgm/bake.gd"
## Largest seed that roll_seed() chooses: short enough to type and to read out.
const MOST_SEED := 999_999

var undo_redo: EditorUndoRedoManager

var _world: SgmWorld3D
var _dialog: EditorFileDialog
var _method := &""
var _buttons: Array[Button] = []
var _tooltips: Array[String] = []
var _of_drawn: Array[Button] = []
var _of_grammar: Button


func _init() -> void:
	columns = 2
	_add("Copy seed", "Copies the world's seed to the clipboard", copy_seed)
	_add("New seed", "Throws the dice for another seed", roll_seed)
	_of_drawn.append(_add("Bake to scene…", "Saves what is drawn as a scene that goes without the plugin",
			_ask.bind(&"bake_to_scene")))
	_of_drawn.append(_add("Export GLB…", "Saves what is drawn as a glTF file for other programs",
			_ask.bind(&"export_glb")))
	_of_grammar = _add("Open grammar", "Shows the grammar's text in the script editor", open_grammar)
	_add("Restart", "Makes the world anew from its grammar and settings", restart)


func _ready() -> void:
	_dialog = EditorFileDialog.new()
	_dialog.file_mode = EditorFileDialog.FILE_MODE_SAVE_FILE
	_dialog.file_selected.connect(_on_file_selected)
	add_child(_dialog)


## Enables the buttons that can be pressed, and explains in a tooltip why the others cannot.
func refresh(world: SgmWorld3D, runs: bool) -> void:
	_world = world
	for i in _buttons.size():
		var reason := _reason_against_text() if _buttons[i] == _of_grammar else _reason(_buttons[i] in _of_drawn, runs)
		_buttons[i].disabled = not reason.is_empty()
		_buttons[i].tooltip_text = reason if not reason.is_empty() else _tooltips[i]


func copy_seed() -> void:
	DisplayServer.clipboard_set(str(_world.seed))


## Sets a random seed, as an action that can be undone.
func roll_seed() -> void:
	var rolled := randi_range(0, MOST_SEED - 1)
	if rolled >= _world.seed and _world.seed >= 0:
		rolled += 1
	undo_redo.create_action("New seed of " + _world.name, UndoRedo.MERGE_DISABLE, _world)
	undo_redo.add_do_property(_world, &"seed", rolled)
	undo_redo.add_undo_property(_world, &"seed", _world.seed)
	undo_redo.commit_action()


func open_grammar() -> void:
	TextEditing.open(_world.grammar.resource_path)


func restart() -> void:
	told.emit("")
	_world.restart()


func _add(text: String, tooltip: String, action: Callable) -> Button:
	var button := Button.new()
	button.text = text
	button.size_flags_horizontal = SIZE_EXPAND_FILL
	button.pressed.connect(action)
	_buttons.append(button)
	_tooltips.append(tooltip)
	add_child(button)
	return button


func _reason(needs_drawn: bool, runs: bool) -> String:
	if _world == null:
		return "Select an SgmWorld3D of the scene first."
	if not needs_drawn:
		return ""
	if not runs:
		return "Nothing is drawn: give the world a grammar, and turn its preview on."
	return "" if _world.is_idle() else "The world still streams: wait until it is idle."


func _reason_against_text() -> String:
	var reason := _reason(false, true)
	if not reason.is_empty() or _world.grammar != null and FileAccess.file_exists(_world.grammar.resource_path):
		return reason
	return "The world has no grammar in a file: give it one in the inspector."


func _ask(method: StringName) -> void:
	_method = method
	var is_scene := method == &"bake_to_scene"
	_dialog.access = EditorFileDialog.ACCESS_RESOURCES if is_scene else EditorFileDialog.ACCESS_FILESYSTEM
	_dialog.clear_filters()
	if is_scene:
		_dialog.add_filter("*.scn", "Scene")
		_dialog.add_filter("*.tscn", "Text scene")
	else:
		_dialog.add_filter("*.glb", "Binary glTF")
	_dialog.current_file = "%s_%d.%s" % [String(_world.name).to_snake_case(), _world.seed, "scn" if is_scene else "glb"]
	_dialog.popup_file_dialog()


func _on_file_selected(path: String) -> void:
	told.emit(_save(path))


# Saves the world to a file. Returns an error in one sentence; empty on success.
func _save(path: String) -> String:
	if not is_instance_valid(_world):
		return "The world is gone: select one and try again."
	var bake: GDScript = load(BAKE) if ResourceLoader.exists(BAKE) else null
	if bake == null:
		return "addons/sgm/bake.gd is missing: copy all of addons/sgm into the project."
	var error: Error = bake.call(_method, _world, path)
	if error != OK:
		return bake.get("trouble")
	EditorInterface.get_resource_filesystem().scan()
	return ""

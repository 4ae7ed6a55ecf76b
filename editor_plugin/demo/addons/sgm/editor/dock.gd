@tool
extends VBoxContainer
## The dock: figures of the selected world, such as its backend, its drawn chunks, and the histogram of its edges.

const Preview := preload("preview.gd")
const Histogram := preload("histogram.gd")
const Actions := preload("actions.gd")
const Measuring := preload("measuring.gd")
## Seconds between two updates of the figures that are cheap to compute.
const PACE := 0.5
const NONE := "–"
const ROWS := {
	device = ["Device", "What makes the chunks"],
	state = ["State", "Whether anything is still to be made or shown around the camera"],
	seed = ["Seed", "The seed that the world grows from"],
	triangles = ["Triangles", "Triangles on screen, all levels of detail together"],
	area = ["Area", "Area of the surface that is drawn"],
	volume = ["Volume", "Volume that the drawn surface bounds"],
	watertight = ["Watertight", "Whether the drawn surface is closed, without defects"],
	objects = ["Objects", "Parts of the drawn surface that do not touch each other"],
}

var histogram: Histogram

var _preview: Preview
var _actions: Actions
var _measuring := Measuring.new()
var _world: SgmWorld3D
var _values := {}
var _title: Label
var _message: Label
var _measure: Button
var _rest := 0.0


func _init() -> void:
	name = "SG+M"
	_title = Label.new()
	_title.text_overrun_behavior = TextServer.OVERRUN_TRIM_ELLIPSIS
	add_child(_title)
	var grid := GridContainer.new()
	grid.columns = 2
	add_child(grid)
	for row: String in ROWS:
		_add_row(grid, row)
	histogram = Histogram.new()
	add_child(histogram)
	_measure = Button.new()
	_measure.text = "Measure"
	_measure.pressed.connect(measure)
	add_child(_measure)
	add_child(HSeparator.new())
	_actions = Actions.new()
	_actions.told.connect(say)
	add_child(_actions)
	_message = Label.new()
	_message.autowrap_mode = TextServer.AUTOWRAP_WORD_SMART
	_message.custom_minimum_size.x = 160.0
	add_child(_message)


## Must be called before the dock enters the tree.
func set_up(preview: Preview, undo_redo: EditorUndoRedoManager) -> void:
	_preview = preview
	_actions.undo_redo = undo_redo


func _exit_tree() -> void:
	_measuring.finish()


func _notification(what: int) -> void:
	if what == NOTIFICATION_THEME_CHANGED and _message != null:
		_message.add_theme_color_override(&"font_color", get_theme_color(&"error_color", &"Editor"))


func _process(delta: float) -> void:
	if _measuring.is_done():
		_take_measures(_measuring.finish())
	_rest -= delta
	var world := _preview.chosen_world()
	if world != _world:
		_choose(world)
	if _rest <= 0.0:
		_rest = PACE
		refresh()


## Returns the displayed text of a figure, by its row's name in [constant ROWS].
func figure(row: String) -> String:
	return (_values[row] as Label).text


## Measures the drawn chunks in the background; the figures appear some frames later.
func measure() -> void:
	if _world != null and _world.running and not _measuring.is_busy():
		_measuring.start(_world, Histogram.BINS)
		refresh()


## Shows a sentence below the buttons until the next sentence, or until another world is selected.
func say(sentence: String) -> void:
	_message.text = sentence
	_message.visible = not sentence.is_empty()


## Updates the figures that are cheap to compute.
func refresh() -> void:
	var statistics := _world.get_statistics() if _world != null else {}
	var measures := _world.get_measures() if _world != null else {}
	_title.text = _title_text()
	_show("seed", str(_world.seed) if _world != null else NONE)
	_show("state", _state_text(statistics))
	_show("device", _device_text(statistics))
	_show("triangles", grouped(statistics.triangles) if not statistics.is_empty() else NONE)
	_show("area", "%s m²" % grouped(measures.area) if not measures.is_empty() else NONE)
	_show("volume", "%s m³" % grouped(measures.volume) if not measures.is_empty() else NONE)
	_show("watertight", _watertight_text(statistics, measures))
	_show_reason(_measure, _reason_not_to_measure(statistics), "Counts objects and bends of what is on screen")
	_actions.refresh(_world, not statistics.is_empty())


## Formats a whole number with separated groups of three digits.
static func grouped(number: float) -> String:
	var digits := str(roundi(absf(number)))
	for place in range(digits.length() - 3, 0, -3):
		digits = digits.insert(place, ",")
	return "-" + digits if number <= -0.5 else digits


func _add_row(grid: GridContainer, row: String) -> void:
	var caption := Label.new()
	caption.text = ROWS[row][0]
	caption.modulate.a = 0.7
	var value := Label.new()
	value.size_flags_horizontal = SIZE_EXPAND_FILL
	value.text_overrun_behavior = TextServer.OVERRUN_TRIM_ELLIPSIS
	for label: Label in [caption, value]:
		label.tooltip_text = ROWS[row][1]
		label.mouse_filter = MOUSE_FILTER_STOP
		grid.add_child(label)
	_values[row] = value
	_show(row, NONE)


func _show(row: String, text: String) -> void:
	var value := _values[row] as Label
	value.text = text
	# The tooltip shows the whole text, because the label may cut it off.
	value.tooltip_text = ROWS[row][1] if text == NONE else "%s\n%s" % [text, ROWS[row][1]]


func _show_reason(button: Button, reason: String, tooltip: String) -> void:
	button.disabled = not reason.is_empty()
	button.tooltip_text = tooltip if reason.is_empty() else reason


func _choose(world: SgmWorld3D) -> void:
	if _world != null:
		_world.became_idle.disconnect(_on_became_idle)
		_world.tree_exiting.disconnect(_on_world_leaves)
		_world.failed.disconnect(say)
	_measuring.finish()
	_world = world
	_clear_measures()
	say("")
	_rest = 0.0
	if world == null:
		return
	world.became_idle.connect(_on_became_idle)
	world.tree_exiting.connect(_on_world_leaves)
	world.failed.connect(say)
	say(world.get_error_text())
	if world.is_idle():
		measure()


func _on_became_idle() -> void:
	if is_visible_in_tree():
		measure()


# Deselects the world when it is deleted or when the tab of another scene hides it. This ends a running measurement: the
# world must not be destroyed while it is measured.
func _on_world_leaves() -> void:
	_choose(null)


func _clear_measures() -> void:
	_show("objects", NONE)
	histogram.clear()


func _take_measures(measures: Dictionary) -> void:
	if measures.is_empty():
		_clear_measures()
		say("What is drawn cannot be measured: see the Output panel for the reason.")
		return
	_show("objects", grouped(measures.objects))
	var sums: Array[float] = [measures.concave, measures.flat, measures.convex]
	histogram.show_shares(measures.histogram, sums)
	refresh()


func _title_text() -> String:
	if _world != null:
		return _world.name
	return "No SgmWorld3D in this scene" if _preview.worlds.is_empty() else "Select one of the worlds"


func _state_text(statistics: Dictionary) -> String:
	if _world == null:
		return NONE
	if statistics.is_empty():
		if not _world.get_error_text().is_empty():
			return _world.get_error_text()
		if _world.grammar == null:
			return "has no grammar: give it one"
		return "does not run" if _world.preview else "preview is off"
	if _world.is_idle():
		return "idle"
	var waiting: int = statistics.queued + statistics.in_work + statistics.uploads_waiting + statistics.colliders_waiting
	return "streaming, %s waiting" % grouped(waiting)


func _device_text(statistics: Dictionary) -> String:
	if statistics.is_empty():
		return NONE
	return "%s: %s" % [statistics.backend, statistics.device]


func _watertight_text(statistics: Dictionary, measures: Dictionary) -> String:
	if measures.is_empty():
		return NONE if statistics.is_empty() else "not measured: turn on Measure in the inspector"
	return "yes" if measures.watertight else "no: %s defects" % grouped(measures.defects)


func _reason_not_to_measure(statistics: Dictionary) -> String:
	if _world == null:
		return _title_text() + "."
	if statistics.is_empty():
		return "Nothing is drawn: %s." % _state_text(statistics)
	return "It is being measured." if _measuring.is_busy() else ""

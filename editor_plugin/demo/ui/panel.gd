class_name DemoPanel
extends PanelContainer
## Sliders for the parameters of a world's grammar.

signal parameter_changed(parameter: String)
signal menu_asked

## Minimum seconds between two updates of the world while a slider moves.
const PACE := 0.15

var _world: SgmWorld3D
var _waiting: Dictionary = {}
var _pace := Timer.new()

@onready var _title: Label = %Title
@onready var _rows: GridContainer = %Rows
@onready var _extras: VBoxContainer = %Extras


func _ready() -> void:
	_pace.one_shot = true
	_pace.wait_time = PACE
	_pace.timeout.connect(_send)
	add_child(_pace)
	(%Menu as Button).pressed.connect(func() -> void: menu_asked.emit())


## Shows the parameters of a world's grammar, and updates them when the grammar changes.
func set_up(world: SgmWorld3D) -> void:
	_world = world
	world.grammar.changed.connect(_build)
	_build()


## Adds a control that only the current place has, below the sliders.
func add_extra(control: Control) -> void:
	_extras.add_child(control)


func _build() -> void:
	for row in _rows.get_children():
		row.queue_free()
	_title.text = _world.grammar.resource_path.get_file()
	var parameters: Array = _world.grammar.get_parameters()
	for parameter: Dictionary in parameters:
		_add(parameter)
	_rows.visible = not parameters.is_empty()


func _add(parameter: Dictionary) -> void:
	var tooltip: String = parameter.doc
	var title := Label.new()
	title.text = String(parameter.name).replace("_", " ")
	title.tooltip_text = tooltip
	title.mouse_filter = Control.MOUSE_FILTER_PASS
	_rows.add_child(title)

	var bounded := is_finite(parameter.minimum) and is_finite(parameter.maximum)
	var scale := rad_to_deg(1.0) if parameter.quantity == "angle" else 1.0
	var range_control: Range
	var value_label: Label = null
	if bounded:
		range_control = HSlider.new()
		range_control.focus_mode = Control.FOCUS_NONE
		value_label = Label.new()
		value_label.custom_minimum_size.x = 64.0
		value_label.horizontal_alignment = HORIZONTAL_ALIGNMENT_RIGHT
	else:
		var box := SpinBox.new()
		box.suffix = _unit(parameter)
		range_control = box
	range_control.custom_minimum_size.x = 180.0
	range_control.size_flags_vertical = Control.SIZE_SHRINK_CENTER
	range_control.tooltip_text = tooltip
	_set_range(range_control, parameter, scale)
	range_control.value = float(_world.get("parameters/" + parameter.name)) * scale
	_rows.add_child(range_control)
	_rows.add_child(value_label if bounded else Control.new())

	var show_value := func(value: float) -> void:
		if value_label != null:
			value_label.text = _text(value, range_control.step, _unit(parameter))
	show_value.call(range_control.value)
	range_control.value_changed.connect(func(value: float) -> void:
		show_value.call(value)
		_ask(parameter.name, value / scale))


func _set_range(control: Range, parameter: Dictionary, scale: float) -> void:
	var around: float = maxf(absf(parameter.default), 1.0) * 10.0
	var least: float = parameter.minimum if is_finite(parameter.minimum) else parameter.default - around
	var most: float = parameter.maximum if is_finite(parameter.maximum) else parameter.default + around
	control.allow_lesser = not is_finite(parameter.minimum)
	control.allow_greater = not is_finite(parameter.maximum)
	control.min_value = least * scale
	control.max_value = most * scale
	# The step is a power of ten, which is easy to read; the slider then has 50 to 500 steps.
	var fine := pow(10.0, floorf(log(maxf((most - least) * scale, 1e-6) / 50.0) / log(10.0)))
	control.step = 1.0 if parameter.whole else fine


func _ask(parameter: String, value: float) -> void:
	_waiting[parameter] = value
	if _pace.is_stopped():
		_pace.start()


func _send() -> void:
	for parameter: String in _waiting:
		_world.set("parameters/" + parameter, _waiting[parameter])
		parameter_changed.emit(parameter)
	_waiting.clear()


func _unit(parameter: Dictionary) -> String:
	match parameter.quantity:
		"length":
			return "m"
		"angle":
			return "°"
	return ""


func _text(value: float, step: float, unit: String) -> String:
	var places := clampi(ceili(-log(step) / log(10.0) - 1e-6), 0, 4)
	return (String.num(value, places).pad_decimals(places) + " " + unit).strip_edges()

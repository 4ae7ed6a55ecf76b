@tool
extends EditorInspectorPlugin
## Shows the errors of a grammar above the grammar in the inspector, and above the property of a world that uses it.
## Adds the grammar's descriptions to a world's parameters, as tooltips.

const Diagnostics := preload("diagnostics.gd")
const RowTip := preload("row_tip.gd")
const PARAMETERS := "parameters/"

# True while this plugin asks the engine for the default row of a property. The engine then asks this plugin again for a
# row of the same property; that inner call must change nothing.
var _makes_row := false


func _can_handle(object: Object) -> bool:
	return object is SgmGrammar or object is SgmWorld3D


func _parse_begin(object: Object) -> void:
	if object is SgmGrammar:
		add_custom_control(Diagnostics.new(object as SgmGrammar))


func _parse_property(object: Object, type: Variant.Type, name: String, hint: PropertyHint, text: String, usage: int,
		wide: bool) -> bool:
	var world := object as SgmWorld3D
	if world == null or world.grammar == null or _makes_row:
		return false
	if name == "grammar":
		add_custom_control(Diagnostics.new(world.grammar))
	if not name.begins_with(PARAMETERS):
		return false
	var tip := tip_of(world.grammar, name.trim_prefix(PARAMETERS))
	# Before Godot 4.4, scripts cannot create the default row of a property: parameters then have no tooltip from the
	# grammar.
	if tip.is_empty() or not ClassDB.class_has_method(&"EditorInspector", &"instantiate_property_editor"):
		return false
	_makes_row = true
	var row: EditorProperty = EditorInterface.get_inspector().call(
			&"instantiate_property_editor", object, type, name, hint, text, usage, wide)
	_makes_row = false
	if row == null:
		return false
	row.add_child(RowTip.new(row, tip), false, Node.INTERNAL_MODE_FRONT)
	add_property_editor(name, row)
	return true


## Returns the grammar's description of a parameter, and its range; an empty text if the grammar has no such parameter.
static func tip_of(grammar: SgmGrammar, name: String) -> String:
	for parameter: Dictionary in grammar.get_parameters():
		if parameter.name == name:
			var doc: String = parameter.doc
			return (doc + "\n" if doc != "" else "") + _range_of(parameter)
	return ""


static func _range_of(parameter: Dictionary) -> String:
	var text := "%s by default" % _value_of(parameter, parameter.default)
	if is_finite(parameter.minimum) and is_finite(parameter.maximum):
		text = "%s to %s, " % [_value_of(parameter, parameter.minimum), _value_of(parameter, parameter.maximum)] + text
	elif is_finite(parameter.minimum):
		text = "%s or more, " % _value_of(parameter, parameter.minimum) + text
	elif is_finite(parameter.maximum):
		text = "%s or less, " % _value_of(parameter, parameter.maximum) + text
	return text


# Formats a value as the inspector's row shows it: angles in degrees.
static func _value_of(parameter: Dictionary, value: float) -> String:
	match parameter.quantity:
		"length":
			return _number(value) + " m"
		"angle":
			return _number(rad_to_deg(value)) + "°"
	return _number(value)


static func _number(value: float) -> String:
	return String.num(value, 3).trim_suffix(".0")

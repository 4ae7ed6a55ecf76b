@tool
extends Node2D
## Shows a tooltip for a row in the inspector, in place of the engine's tooltip.
##
## The engine interprets the tooltip of a row itself as the name of a symbol in its class reference. Therefore a control
## over the row's name has the text: since Godot 4.6 the engine's own control there; in older versions, a control behind
## everything else in the row. That control is a child of this node, because the row would change the layout of a child
## of its own. It passes mouse events on to the row.

var _row: EditorProperty
var _control := Control.new()


func _init(row: EditorProperty, text: String) -> void:
	_row = row
	for box: Control in row.find_children("*", "HBoxContainer", false, false):
		box.tooltip_text = text
	_control.tooltip_text = text
	_control.auto_translate_mode = Node.AUTO_TRANSLATE_MODE_DISABLED
	_control.mouse_filter = Control.MOUSE_FILTER_PASS
	add_child(_control)
	row.resized.connect(_cover)


func _cover() -> void:
	_control.size = _row.size


## Returns the displayed text.
func text() -> String:
	return _control.tooltip_text

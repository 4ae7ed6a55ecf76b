@tool
extends Node2D
## A tooltip of a row in the inspector, in place of the engine's.
##
## What a row itself has as tooltip the engine takes for the name of a symbol in its class reference, and looks that up.
## So something that lies on the row's name has the text: since Godot 4.6 the engine's own box there; before, a control
## behind all else in the row. That one is a child of this node, as the row would lay out a child of its own. The mouse
## goes through it to the row.

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


## The text that shows.
func text() -> String:
	return _control.tooltip_text

@tool
extends Node2D
## A tooltip of a row in the inspector, in place of the engine's.
##
## What a row itself has as tooltip the engine takes for the name of a symbol in its class reference, and looks that up.
## So another control lies on the row, behind its value's. It is no child of the row's own, which would lay it out, but
## of this node; the mouse goes through it to the row.

var _row: EditorProperty
var _control := Control.new()


func _init(row: EditorProperty, text: String) -> void:
	_row = row
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

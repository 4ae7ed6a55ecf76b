@tool
extends Node2D
## Shows a tooltip for a row in the inspector, in place of the engine's tooltip. If the row itself had a tooltip, the
## engine would interpret its text as the name of a symbol in its class reference. So the text is the tooltip of a
## control that covers the row's name. Since Godot 4.6 the engine has such a control. In older versions, this script
## adds a control behind everything else in the row, as a child of this node: as a child of the row, it would change the
## row's layout. This control passes mouse events on to the row.

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

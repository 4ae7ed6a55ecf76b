@tool
extends EditorInspectorPlugin
## Shows what is wrong with a grammar above it in the inspector, and above the property of a world that has it.

const Diagnostics := preload("diagnostics.gd")


func _can_handle(object: Object) -> bool:
	return object is SgmGrammar or object is SgmWorld3D


func _parse_begin(object: Object) -> void:
	if object is SgmGrammar:
		add_custom_control(Diagnostics.new(object as SgmGrammar))


func _parse_property(object: Object, _type: Variant.Type, name: String, _hint: PropertyHint, _text: String,
		_usage: int, _wide: bool) -> bool:
	if object is SgmWorld3D and name == "grammar" and (object as SgmWorld3D).grammar != null:
		add_custom_control(Diagnostics.new((object as SgmWorld3D).grammar))
	return false

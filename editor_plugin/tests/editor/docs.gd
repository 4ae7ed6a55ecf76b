@tool
extends RefCounted
## Tests the class reference: it describes all members and nothing else, and the editor's help shows it. Also tests the
## descriptions of a world's parameters in the inspector.

const Checks := preload("res://tests/lib/checks.gd")
const RowTip := preload("res://addons/sgm/editor/row_tip.gd")
const CLASSES: Array[StringName] = [&"SgmWorld3D", &"SgmGrammar", &"SgmViewer3D"]
const BOXY := "parameters/boxy"

var _checks := Checks.new()
var _plugin: EditorPlugin
var _tree: SceneTree


func run(plugin: EditorPlugin) -> void:
	_plugin = plugin
	_tree = plugin.get_tree()
	for type in CLASSES:
		var reference := _read("res://tests/doc/%s.xml" % type)
		_check_described(type, reference)
		await _check_help(type, reference)
	await _check_parameters()
	EditorInterface.get_selection().clear()
	EditorInterface.inspect_object(null)
	await _frames(5)
	await _checks.finish(_tree)


## Reads a reference file. The result maps kind and name of each entry, such as "method dig", to its text and arguments;
## "" stands for the class itself.
func _read(path: String) -> Dictionary:
	var found := {}
	var parser := XMLParser.new()
	_checks.equal(parser.open(path), OK, path + " can be read")
	var current := ""
	var in_text := false
	while parser.read() == OK:
		match parser.get_node_type():
			XMLParser.NODE_ELEMENT:
				var element := parser.get_node_name()
				var name := parser.get_named_attribute_value_safe("name")
				in_text = element in ["brief_description", "description", "member"]
				if element == "class":
					found[""] = {"name": name, "inherits": parser.get_named_attribute_value("inherits"), "text": ""}
				elif element in ["method", "signal", "member"]:
					current = element + " " + name
					_checks.check(not found.has(current), "%s is described once" % current)
					found[current] = {"text": "", "arguments": PackedStringArray(), "type": "", "default": ""}
					if element == "member":
						found[current].type = parser.get_named_attribute_value("type")
						found[current].default = parser.get_named_attribute_value("default")
				elif element == "return":
					found[current].type = parser.get_named_attribute_value("type")
				elif element == "param":
					found[current].arguments.append("%s: %s" % [name, parser.get_named_attribute_value("type")])
			XMLParser.NODE_ELEMENT_END:
				in_text = false
				if parser.get_node_name() in ["method", "signal", "member"]:
					current = ""
			XMLParser.NODE_TEXT:
				if in_text:
					found[current].text += parser.get_node_data().strip_edges() + "\n"
	return found


func _check_described(type: StringName, reference: Dictionary) -> void:
	_checks.equal(reference[""].name, String(type), "name of the class")
	_checks.equal(reference[""].inherits, String(ClassDB.get_parent_class(type)), "what %s inherits" % type)
	var there := _registered(type)
	for entry: String in reference:
		_checks.check((reference[entry].text as String).strip_edges().length() > 20, "%s: '%s' has a text" % [type, entry])
		_checks.check(entry == "" or there.has(entry), "%s: '%s' is described and is there" % [type, entry])
	for entry: String in there:
		if _checks.check(reference.has(entry), "%s: '%s' is there and is described" % [type, entry]):
			for key: String in there[entry]:
				_checks.equal(reference[entry][key], there[entry][key], "%s: %s of '%s'" % [type, key, entry])


## Returns the registered members of a class, in the form of the result of [method _read], but without texts.
func _registered(type: StringName) -> Dictionary:
	var there := {}
	var accessors := PackedStringArray()
	for property in ClassDB.class_get_property_list(type, true):
		var name: String = property.name
		if property.usage & (PROPERTY_USAGE_CATEGORY | PROPERTY_USAGE_GROUP) or name.begins_with("_"):
			continue
		there["member " + name] = {"type": _type_of(property),
				"default": var_to_str(ClassDB.class_get_property_default_value(type, name))}
		accessors.append_array(["set_" + name, "get_" + name])
	for method in ClassDB.class_get_method_list(type, true):
		var name: String = method.name
		if not name.begins_with("_") and not name in accessors:
			there["method " + name] = {"arguments": _arguments_of(method), "type": _type_of(method["return"], "void")}
	for event in ClassDB.class_get_signal_list(type, true):
		there["signal " + (event.name as String)] = {"arguments": _arguments_of(event)}
	return there


func _arguments_of(method: Dictionary) -> PackedStringArray:
	var arguments := PackedStringArray()
	for argument: Dictionary in method.args:
		arguments.append("%s: %s" % [argument.name, _type_of(argument)])
	return arguments


func _type_of(info: Dictionary, nothing := "Variant") -> String:
	if info.type == TYPE_NIL:
		return nothing
	var of_class: String = info.get("class_name", "")
	return of_class if info.type == TYPE_OBJECT and of_class != "" else type_string(info.type)


# Checks the page that the editor shows, because users read the page and not the file.
func _check_help(type: StringName, reference: Dictionary) -> void:
	EditorInterface.set_main_screen_editor("Script")
	EditorInterface.get_script_editor().goto_help("class_name:" + type)
	await _frames(20)
	var page := _help_text()
	_checks.check(page != "", "the help of %s is shown" % type)
	for entry: String in reference:
		var words: String = reference[entry].text
		# The page shows formatted text without BBCode tags, so compare only the text before the first tag.
		var start := words.strip_edges().get_slice("[", 0).get_slice("\n", 0).strip_edges()
		_checks.check(start.length() < 5 or start in page, "the help of %s has '%s'" % [type, start])
		_checks.check(entry == "" or entry.get_slice(" ", 1) in page, "the help of %s names '%s'" % [type, entry])
	_checks.check(not "There is currently no description" in page, "the help of %s leaves out nothing" % type)
	_check_example(type, reference[""].text, page)


# Checks that the lines of an example have kept their indentation; otherwise users could not copy it.
func _check_example(type: StringName, words: String, page: String) -> void:
	var lines := words.get_slice("[codeblock]", 1).get_slice("[/codeblock]", 0).split("\n", false)
	var margin := lines[0].length() - lines[0].dedent().length()
	for line in lines:
		var code := line.substr(margin)
		_checks.check("\n" + code in page, "the help of %s has the line '%s' of its example" % [type, code])


func _help_text() -> String:
	for label: RichTextLabel in EditorInterface.get_script_editor().find_children("*", "RichTextLabel", true, false):
		if label.is_visible_in_tree() and label.get_parent().is_class("EditorHelp"):
			return label.get_parsed_text()
	return ""


func _check_parameters() -> void:
	EditorInterface.open_scene_from_path("res://cave/cave.tscn")
	await _frames(5)
	var world: SgmWorld3D = EditorInterface.get_edited_scene_root().get_node("World")
	world.preview = false
	world.grammar = load("res://tests/grammars/cave.sgm")
	EditorInterface.edit_node(world)
	await _frames(10)
	var row := _row(BOXY)
	if not _checks.check(row != null, "the inspector has a row of " + BOXY):
		return
	var tips := row.find_children("*", "Node2D", true, false).filter(func(child: Node) -> bool: return child is RowTip)
	if not _checks.equal(tips.size(), 1, "tips of the row"):
		return
	_checks.equal((tips[0] as RowTip).text(), "0 round, 1 square\n0 to 1, 0.3 by default", "what the grammar says of boxy")
	_checks.equal(row.label, "Boxy", "label of the row")
	var slider: Range = row.find_children("*", "EditorSpinSlider", true, false)[0]
	_checks.equal([slider.min_value, slider.max_value, slider.value], [0.0, 1.0, 0.3], "range and value of boxy")
	await _check_hover(row, "0 round, 1 square")
	await _check_changes(world, slider)


# Checks the tooltip that appears over the name of the row.
func _check_hover(row: EditorProperty, words: String) -> void:
	_unfold(row)
	await _frames(5)
	EditorInterface.get_inspector().ensure_control_visible(row)
	await _frames(5)
	for step in 3:
		_tree.root.warp_mouse(row.global_position + Vector2(20.0 + step, row.size.y / 2.0))
		await _frames(5)
	var shown := ""
	var end := Time.get_ticks_msec() + 5000
	while shown == "" and Time.get_ticks_msec() < end:
		await _tree.process_frame
		for label: Label in _tree.root.find_children("*", "Label", true, false):
			if words in label.text and label.is_visible_in_tree():
				shown = label.text
	_checks.check(words in shown, "a tooltip over the row's name has the grammar's words")


func _check_changes(world: SgmWorld3D, slider: Range) -> void:
	slider.value = 0.75
	await _frames(5)
	_checks.near(world.get(BOXY), 0.75, 1e-6, "boxy of the world once the slider was moved")
	var history := _plugin.get_undo_redo().get_history_undo_redo(
			_plugin.get_undo_redo().get_object_history_id(world))
	_checks.check(history.has_undo(), "the change can be undone")
	history.undo()
	await _frames(5)
	_checks.near(world.get(BOXY), 0.3, 1e-6, "boxy once that was undone")
	_checks.near(slider.value, 0.3, 1e-6, "the slider once that was undone")
	history.redo()
	await _frames(30)
	_checks.near(world.get(BOXY), 0.75, 1e-6, "boxy once that was done again")
	_checks.check(world.property_can_revert(BOXY), "boxy can be reverted")
	_checks.near(world.property_get_revert(BOXY), 0.3, 1e-6, "what boxy reverts to")
	_revert(_row(BOXY))
	await _frames(5)
	_checks.near(world.get(BOXY), 0.3, 1e-6, "boxy once its row reverted it")


# Clicks on the row's icon, because scripts have no other access to the default value of the row.
func _revert(row: EditorProperty) -> void:
	var icon := row.get_theme_icon(&"ReloadSmall", &"EditorIcons")
	var place := Vector2(row.size.x * row.name_split_ratio - icon.get_width() / 2.0 - 4.0, row.size.y / 2.0)
	for pressed: bool in [true, false]:
		var click := InputEventMouseButton.new()
		click.button_index = MOUSE_BUTTON_LEFT
		click.pressed = pressed
		click.position = row.global_position + place
		click.global_position = click.position
		_tree.root.push_input(click, true)


# Unfolds the inspector's sections above the row: they are folded at first, and a folded row has no size.
func _unfold(row: EditorProperty) -> void:
	var parent := row.get_parent()
	while parent != EditorInterface.get_inspector():
		if parent.has_method(&"unfold"):
			parent.call(&"unfold")
		parent = parent.get_parent()


func _row(property: String) -> EditorProperty:
	for row: EditorProperty in EditorInterface.get_inspector().find_children("*", "EditorProperty", true, false):
		if row.get_edited_property() == property:
			return row
	return null


func _frames(count: int) -> void:
	for i in count:
		await _tree.process_frame

@tool
extends RefCounted
## Tests grammars as text in the editor: opening, syntax highlighting, messages about errors, and reloading of saved
## texts.

const Checks := preload("res://tests/lib/checks.gd")
const Diagnostics := preload("res://addons/sgm/editor/diagnostics.gd")
const Highlighter := preload("res://addons/sgm/editor/highlighter.gd")
const NewGrammar := preload("res://addons/sgm/editor/new_grammar.gd")
const TextEditing := preload("res://addons/sgm/editor/text_editing.gd")
const CAVE := "res://grammars/cave.sgm"
const NEW := "res://grammars/mine.sgm"
const WRONG := "res://grammars/wrong.sgm"
const GOOD := "sgm 1;\nstart Ball;\nrule Ball { sphere(5m); }\n"
const BROKEN := "sgm 1;\nstart Ball;\nrule Ball { spere(5m); }\n"
const IMPORTER := "sgm 1;\nimport \"parts.sgm\" as parts;\nstart Ball;\nrule Ball { parts.Part(); }\n"

var _checks := Checks.new()
var _tree: SceneTree


func run(plugin: EditorPlugin) -> void:
	_tree = plugin.get_tree()
	_check_endings()
	await _check_double_click()
	await _check_highlighter()
	await _check_new()
	await _check_diagnostics()
	await _check_world_property()
	await _check_reload()
	await _check_disabling()
	await _checks.finish(_tree)


func _check_endings() -> void:
	var settings := EditorInterface.get_editor_settings()
	var endings := func() -> PackedStringArray: return (settings.get_setting(TextEditing.SETTING) as String).split(",")
	_checks.check("sgm" in endings.call(), "grammars are taken for text")
	settings.set_setting(TextEditing.SETTING, "txt, own,sgm")
	TextEditing.take_for_text(false)
	_checks.equal(settings.get_setting(TextEditing.SETTING), "txt,own", "a user's endings without ours")
	TextEditing.take_for_text(true)
	TextEditing.take_for_text(true)
	_checks.equal(settings.get_setting(TextEditing.SETTING), "txt,own,sgm", "a user's endings and ours, once")


# Does the same as a double click in the FileSystem dock: activates the selected item of the dock's tree.
func _check_double_click() -> void:
	var dock := EditorInterface.get_file_system_dock()
	dock.navigate_to_path(CAVE)
	await _frames(5)
	var tree: Tree = dock.find_children("*", "Tree", true, false).filter(func(found: Tree) -> bool:
		return found.get_signal_connection_list(&"item_activated").any(func(connection: Dictionary) -> bool:
			return str(connection.callable).ends_with("::_tree_activate_file")))[0]
	_checks.equal(tree.get_selected().get_text(0), "cave.sgm", "the file that is selected")
	tree.item_activated.emit()
	await _frames(10)
	_checks.check(EditorInterface.get_script_editor().is_visible_in_tree(), "the script editor is in front")
	var text := TextEditing.shown_text()
	if _checks.check(text != null, "the script editor shows a text"):
		_checks.equal(text.text, FileAccess.get_file_as_string(CAVE), "text of the cave")
	_checks.equal(EditorInterface.get_inspector().get_edited_object(), load(CAVE), "what the inspector shows")
	_checks.check(load(CAVE) is SgmGrammar, "what scenes load from the path is a grammar still")
	_checks.equal((load(CAVE) as Resource).resource_path, CAVE, "path of the grammar")
	var open := EditorInterface.get_script_editor().get_open_script_editors().size()
	TextEditing.open(CAVE, 18, 3)
	await _frames(5)
	_checks.equal(EditorInterface.get_script_editor().get_open_script_editors().size(), open, "open editors, as before")
	text = TextEditing.shown_text()
	_checks.equal([text.get_caret_line(), text.get_caret_column()], [17, 2], "the caret")


func _check_highlighter() -> void:
	var text := TextEditing.shown_text()
	var highlighter := text.syntax_highlighter as Highlighter
	if not _checks.check(highlighter != null, "the highlighter is chosen for the ending"):
		return
	var found := {}
	for part in highlighter.kinds_of("rule Hall(r) when r > 1.5m { at(0..1) my_own(\"a // b\", cell); } // end"):
		found[part[0]] = part[1]
	var wanted := {0: "declaration", 5: "rule", 10: "plain", 13: "control", 22: "number", 25: "unit", 29: "operation",
			32: "number", 35: "number", 38: "call", 45: "text", 55: "value", 64: "comment"}
	for column: int in wanted:
		_checks.equal(found.get(column), wanted[column], "kind at column %d" % column)
	var colors := highlighter.get_line_syntax_highlighting(text.search("rule", 0, 0, 0).y)
	_checks.equal(colors[0].color, highlighter.color_of("declaration"), "colour of 'rule'")
	await _save_picture("grammar.png")


func _check_new() -> void:
	var grammar := SgmGrammar.new()
	_checks.equal(grammar.check(NewGrammar.TEMPLATE), [] as Array, "what is wrong with the template")
	var dialog: NewGrammar = _dialogs()[0]
	dialog.file_selected.emit(NEW)
	await _frames(5)
	_checks.equal(FileAccess.get_file_as_string(NEW), NewGrammar.TEMPLATE, "text of the new grammar")
	_checks.equal(TextEditing.shown_text().text, NewGrammar.TEMPLATE, "text in the editor")


func _check_diagnostics() -> void:
	_checks.expect_error("wrong.sgm:3:13: .*spere")
	_write(WRONG, GOOD)
	EditorInterface.get_resource_filesystem().update_file(WRONG)
	var grammar := load(WRONG) as SgmGrammar
	EditorInterface.edit_resource(grammar)
	await _frames(10)
	var panel := _panel()
	_checks.equal(panel.lines(), PackedStringArray(), "lines on a grammar that is right")
	grammar.text = BROKEN
	await _frames(3)
	var lines := panel.lines()
	_checks.check(lines.size() == 2 and lines[0].begins_with("3:13 ") and "spere" in lines[0],
			"the error and its place are told: " + str(lines))
	_checks.equal(lines[-1], Diagnostics.LAST_GOOD, "the last line")
	await _save_picture("diagnostics.png")
	_press(panel, "Open")
	await _frames(5)
	var text := TextEditing.shown_text()
	_checks.equal([text.get_caret_line(), text.get_caret_column()], [2, 12], "the caret is where the error is")
	_checks.equal(grammar.resource_path, WRONG, "path of the grammar that is shown as text")
	grammar.text = GOOD
	await _frames(3)
	_checks.equal(panel.lines(), PackedStringArray(), "lines once the text is mended")


func _check_world_property() -> void:
	var grammar := load(WRONG) as SgmGrammar
	var world := SgmWorld3D.new()
	world.preview = false
	world.grammar = grammar
	EditorInterface.get_base_control().add_child(world)
	EditorInterface.edit_node(world)
	await _frames(10)
	grammar.text = BROKEN
	await _frames(5)
	_checks.check(_panel().lines().size() == 2, "a world's grammar property has the error above it")
	# When the grammar is unfolded in the inspector, the engine passes it to the plugin. The plugin must not open its
	# text in this case.
	EditorInterface.set_main_screen_editor("3D")
	var pickers := EditorInterface.get_inspector().find_children("*", "EditorResourcePicker", true, false).filter(
			func(picker: EditorResourcePicker) -> bool: return picker.edited_resource == grammar)
	_checks.equal(pickers.size(), 1, "pickers of the grammar")
	var texts := _text_properties()
	(pickers[0] as EditorResourcePicker).resource_selected.emit(grammar, false)
	await _frames(10)
	_checks.equal(_text_properties(), texts + 1, "text properties, as the grammar is unfolded")
	_checks.check(not EditorInterface.get_script_editor().is_visible_in_tree(), "the 3D view stays in front")
	grammar.text = GOOD
	EditorInterface.edit_node(null)
	world.queue_free()
	await _frames(3)


func _check_reload() -> void:
	var parts := "res://grammars/parts.sgm"
	var importer := "res://grammars/importer.sgm"
	_write(parts, "sgm 1;\nrule Part() { sphere(5m); }\n")
	_write(importer, IMPORTER)
	EditorInterface.get_resource_filesystem().update_file(parts)
	EditorInterface.get_resource_filesystem().update_file(importer)
	var grammar := load(WRONG) as SgmGrammar
	var outer := load(importer) as SgmGrammar
	_checks.check(outer.is_valid(), "a grammar that imports is right: " + outer.get_error_text())
	await _seconds(1.2)
	# Changes the text as a user does: in the script editor, and saves it there.
	TextEditing.open(WRONG)
	await _frames(3)
	var text := TextEditing.shown_text()
	text.text = GOOD + "// more\n"
	await _frames(3)
	_save_in_script_editor()
	await _seconds(1.5)
	_checks.equal(FileAccess.get_file_as_string(WRONG), GOOD + "// more\n", "the file that the script editor saved")
	_checks.equal(grammar.text, GOOD + "// more\n", "the grammar in use")
	_checks.expect_error("parts.sgm:2:.*spere")
	_write(parts, "sgm 1;\nrule Part() { spere(5m); }\n")
	await _seconds(1.5)
	_checks.check(not outer.is_valid(), "a change of what is imported is seen")


func _check_disabling() -> void:
	var settings := EditorInterface.get_editor_settings()
	EditorInterface.set_plugin_enabled("sgm", false)
	await _frames(5)
	_checks.equal(settings.get_setting(TextEditing.SETTING), "txt,own", "a user's endings once the plugin is disabled")
	_checks.equal(_dialogs().size(), 0, "dialogs that a disabled plugin leaves")
	EditorInterface.set_plugin_enabled("sgm", true)
	await _frames(5)
	_checks.equal(settings.get_setting(TextEditing.SETTING), "txt,own,sgm", "endings once it is enabled again")
	_checks.equal(_dialogs().size(), 1, "dialogs of the plugin that is enabled again")


func _dialogs() -> Array[Node]:
	return EditorInterface.get_base_control().get_children().filter(func(child: Node) -> bool: return child is NewGrammar)


func _save_in_script_editor() -> void:
	for menu: MenuButton in EditorInterface.get_script_editor().find_children("*", "MenuButton", true, false):
		var popup := menu.get_popup()
		for i in popup.item_count:
			if popup.get_item_text(i) == "Save":
				popup.id_pressed.emit(popup.get_item_id(i))
				return
	_checks.check(false, "the script editor has an entry to save")


func _panel() -> Diagnostics:
	var panels := EditorInterface.get_inspector().find_children("*", "VBoxContainer", true, false).filter(
			func(found: Node) -> bool: return found is Diagnostics)
	_checks.equal(panels.size(), 1, "lists of what is wrong in the inspector")
	return panels[0] if not panels.is_empty() else null


func _text_properties() -> int:
	return EditorInterface.get_inspector().find_children("*", "EditorPropertyMultilineText", true, false).size()


func _press(within: Node, text: String) -> void:
	for button: Button in within.find_children("*", "Button", true, false):
		if button.text == text:
			button.pressed.emit()
			return
	_checks.check(false, "there is a button " + text)


func _write(path: String, text: String) -> void:
	var file := FileAccess.open(path, FileAccess.WRITE)
	file.store_string(text)


func _save_picture(name: String) -> void:
	RenderingServer.render_loop_enabled = true
	await _frames(10)
	await RenderingServer.frame_post_draw
	var picture := _tree.root.get_texture().get_image()
	RenderingServer.render_loop_enabled = false
	_checks.equal(picture.save_png(OS.get_environment("SGM_PICTURES").path_join(name)), OK, "picture is saved")


func _frames(count: int) -> void:
	for i in count:
		await _tree.process_frame


func _seconds(count: float) -> void:
	await _tree.create_timer(count).timeout

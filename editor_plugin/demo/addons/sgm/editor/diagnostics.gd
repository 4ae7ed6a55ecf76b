@tool
extends VBoxContainer
## Lists the errors and warnings of a grammar, with buttons that show their lines.

const TextEditing := preload("text_editing.gd")
const LAST_GOOD := "Shows the last text that was right, until this one is mended."
const NEVER_GOOD := "Grows nothing until the text is mended."
const COLORS := {error = &"error_color", warning = &"warning_color"}
const ICONS := {error = &"StatusError", warning = &"StatusWarning"}

var _grammar: SgmGrammar


func _init(grammar: SgmGrammar) -> void:
	_grammar = grammar


func _enter_tree() -> void:
	_grammar.changed.connect(refresh)
	refresh()


func _exit_tree() -> void:
	_grammar.changed.disconnect(refresh)


## Returns the displayed texts, from top to bottom.
func lines() -> PackedStringArray:
	var texts := PackedStringArray()
	for label: Label in find_children("*", "Label", true, false):
		if not label.is_queued_for_deletion():
			texts.append(label.text)
	return texts


func refresh() -> void:
	for child in get_children():
		remove_child(child)
		child.queue_free()
	for diagnostic: Dictionary in _grammar.get_diagnostics():
		_add(diagnostic)
	if not _grammar.is_valid():
		# A grammar without a domain has never been compiled successfully.
		_add_label(self, NEVER_GOOD if _grammar.get_domain().is_empty() else LAST_GOOD, &"warning_color")
	var path := _grammar.resource_path
	if FileAccess.file_exists(path):
		_add_button(self, "Edit as SG+M text", "Opens %s in the script editor" % path, TextEditing.open.bind(path))


func _add(diagnostic: Dictionary) -> void:
	var row := HBoxContainer.new()
	add_child(row)
	var icon := TextureRect.new()
	icon.texture = get_theme_icon(ICONS[diagnostic.severity], &"EditorIcons")
	icon.stretch_mode = TextureRect.STRETCH_KEEP_CENTERED
	row.add_child(icon)
	var file := _file_of(diagnostic)
	var place := "%d:%d" % [diagnostic.line, diagnostic.column]
	if file != _grammar.resource_path:
		place = "%s:%s" % [(diagnostic.file as String).get_file(), place]
	var hint: String = " (%s)" % diagnostic.hint if not diagnostic.hint.is_empty() else ""
	var label := _add_label(row, "%s %s%s" % [place, diagnostic.message, hint], COLORS[diagnostic.severity])
	label.tooltip_text = (diagnostic.source_line as String).strip_edges()
	if FileAccess.file_exists(file):
		_add_button(row, "Open", "Shows the place in the script editor",
				TextEditing.open.bind(file, diagnostic.line, diagnostic.column))


# Returns the path of a diagnostic's file. In diagnostics, the paths of imported files are relative to the grammar's
# folder.
func _file_of(diagnostic: Dictionary) -> String:
	var file: String = diagnostic.file
	return file if "://" in file else _grammar.resource_path.get_base_dir().path_join(file)


func _add_label(parent: Control, text: String, color: StringName) -> Label:
	var label := Label.new()
	label.text = text
	label.autowrap_mode = TextServer.AUTOWRAP_WORD_SMART
	label.size_flags_horizontal = SIZE_EXPAND_FILL
	label.mouse_filter = MOUSE_FILTER_STOP
	label.add_theme_color_override(&"font_color", get_theme_color(color, &"Editor"))
	parent.add_child(label)
	return label


func _add_button(parent: Control, text: String, tooltip: String, action: Callable) -> void:
	var button := Button.new()
	button.text = text
	button.tooltip_text = tooltip
	button.size_flags_vertical = SIZE_SHRINK_CENTER
	button.pressed.connect(action)
	parent.add_child(button)

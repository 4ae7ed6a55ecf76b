@tool
extends RefCounted
## Grammars as text in the script editor.
##
## What that editor opens takes the file's path from the resource that was loaded from there: scenes would then get a
## text instead of a grammar, and save a grammar as their own. So each time the path is given back.

const ENDING := "sgm"
const SETTING := "docks/filesystem/textfile_extensions"
const RECENT: Array[String] = ["recent_files", "scripts"]


## Whether this version of the editor (4.4 and newer) lets a text and a grammar have the same path.
static func is_supported() -> bool:
	return ClassDB.class_has_method(&"Resource", &"set_path_cache")


## Adds the grammars' ending to those that the editor takes for text, or takes it out; others stay as they are.
static func take_for_text(wanted: bool) -> void:
	var settings := EditorInterface.get_editor_settings()
	var endings := Array((settings.get_setting(SETTING) as String).split(",", false)).map(
			func(ending: String) -> String: return ending.strip_edges())
	if wanted == (ENDING in endings):
		return
	if wanted:
		endings.append(ENDING)
	else:
		endings.erase(ENDING)
	settings.set_setting(SETTING, ",".join(endings))


## Shows a file in the script editor, at a line and column where they are given (from 1 on). False where that fails.
static func open(path: String, line := 0, column := 1) -> bool:
	if not FileAccess.file_exists(path):
		push_error("SG+M: '%s' cannot be opened: save the grammar to a file first." % path)
		return false
	var opener := _opener()
	if not is_supported() or not opener.is_valid():
		# The program that the system has for such files; the reloader sees what it saves.
		return OS.shell_open(ProjectSettings.globalize_path(path)) == OK
	# What opens recent files is the one way to a text file that scripts can call. It takes a place in a list.
	var settings := EditorInterface.get_editor_settings()
	var recent: Array = settings.get_project_metadata(RECENT[0], RECENT[1], [])
	var grammar := load(path) as SgmGrammar if ResourceLoader.has_cached(path) else null
	settings.set_project_metadata(RECENT[0], RECENT[1], [path] + recent)
	opener.call(0)
	settings.set_project_metadata(RECENT[0], RECENT[1], recent)
	give_back(path, grammar)
	EditorInterface.set_main_screen_editor("Script")
	if line > 0:
		_place_caret(line, column)
	return true


## Makes what is loaded from a path the grammar again, after the script editor has taken the path; without a grammar,
## the next one to ask for the path loads it.
static func give_back(path: String, grammar: SgmGrammar) -> void:
	# A file that is deleted leaves its grammar without a path.
	if not is_supported() or not FileAccess.file_exists(path):
		return
	if not ResourceLoader.has_cached(path):
		# The script editor has dropped its own copy at once, as it had opened the file before.
		if grammar != null:
			grammar.take_over_path(path)
		return
	var text := load(path)
	if text is SgmGrammar:
		return
	# Without a grammar a resource that is gone at the end of this function leaves the path free.
	var heir: Resource = grammar if grammar != null else Resource.new()
	heir.take_over_path(path)
	text.call(&"set_path_cache", path)


## The text of the file that the script editor shows; null where it shows another kind of file.
static func shown_text() -> CodeEdit:
	var shown := EditorInterface.get_script_editor().get_current_editor()
	return shown.get_base_editor() as CodeEdit if shown != null else null


static func _place_caret(line: int, column: int) -> void:
	var text := shown_text()
	if text == null:
		return
	text.remove_secondary_carets()
	text.deselect()
	text.unfold_line(clampi(line - 1, 0, text.get_line_count() - 1))
	text.set_caret_line(clampi(line - 1, 0, text.get_line_count() - 1))
	text.set_caret_column(maxi(column - 1, 0))
	text.center_viewport_to_caret.call_deferred()
	text.grab_focus.call_deferred()


static func _opener() -> Callable:
	for menu in EditorInterface.get_script_editor().find_children("*", "PopupMenu", true, false):
		for connection in menu.get_signal_connection_list(&"id_pressed"):
			if str(connection.callable).ends_with("::_open_recent_script"):
				return connection.callable
	return Callable()

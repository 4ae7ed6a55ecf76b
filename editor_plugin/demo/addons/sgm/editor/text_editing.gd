@tool
extends RefCounted
## Opens grammars as text in the script editor.
##
## When that editor opens a file, its text resource takes over the path of the resource that was loaded from the file.
## Scenes would then load a text instead of the grammar, and save the grammar as a part of themselves. The path is
## therefore given back to the grammar each time.

const ENDING := "sgm"
const SETTING := "docks/filesystem/textfile_extensions"
const RECENT: Array[String] = ["recent_files", "scripts"]


## Whether this version of the editor (4.4 and newer) allows a text and a grammar to have the same path.
static func is_supported() -> bool:
	return ClassDB.class_has_method(&"Resource", &"set_path_cache")


## The editor has a list of the file extensions that it opens as text. Adds the extension of grammars to this list if
## [param wanted] is true, otherwise removes it. Other extensions stay in the list.
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


## Opens a file in the script editor, at a line and column if they are given (counted from 1). Returns false on failure.
static func open(path: String, line := 0, column := 1) -> bool:
	if not FileAccess.file_exists(path):
		push_error("SG+M: '%s' cannot be opened: save the grammar to a file first." % path)
		return false
	var opener := _opener()
	if not is_supported() or not opener.is_valid():
		# Open the file with the system's program for it; the reloader notices when that program saves the file.
		return OS.shell_open(ProjectSettings.globalize_path(path)) == OK
	# The menu of recent files is the only way in which scripts can open a text file, so add the file to that list.
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


## When the script editor opens a file, its text takes over the path of the grammar. This function gives the path back:
## the engine then finds [param grammar] under [param path] again. If the grammar is null, the path becomes free, and
## the next request for it loads the file.
static func give_back(path: String, grammar: SgmGrammar) -> void:
	# If the file was deleted, the grammar has no path any more.
	if not is_supported() or not FileAccess.file_exists(path):
		return
	if not ResourceLoader.has_cached(path):
		# The path is already free: the script editor has released its own text resource, because it had opened the file
		# before.
		if grammar != null:
			grammar.take_over_path(path)
		return
	var text := load(path)
	if text is SgmGrammar:
		return
	# Without a grammar, a temporary resource takes over the path. The path becomes free when that resource is released
	# at the end of this function.
	var heir: Resource = grammar if grammar != null else Resource.new()
	heir.take_over_path(path)
	text.call(&"set_path_cache", path)


## Returns the text control of the file that the script editor shows; null if it shows something else.
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

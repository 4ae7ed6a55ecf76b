@tool
extends Node
## Reads grammars that are in use again when their files, or files that they import, have changed, and gives them their
## paths back that the script editor takes (also when it opens what was open the last time).
##
## Files are compared by what is in them: the editor does not tell that it saved a text, other programs tell nothing,
## and times of files are too coarse for two changes in a second.

const TextEditing := preload("text_editing.gd")
## Seconds between two looks at the files.
const PACE := 0.5

var _rest := PACE
## By path, for grammars in use and all that they import: what was in the file.
var _seen := {}
## By path, weak references to grammars in use.
var _grammars := {}


func _enter_tree() -> void:
	get_tree().node_added.connect(_on_node_added)


func _exit_tree() -> void:
	get_tree().node_added.disconnect(_on_node_added)


func _process(delta: float) -> void:
	for path: String in _grammars:
		var grammar := (_grammars[path] as WeakRef).get_ref() as SgmGrammar
		if grammar != null and grammar.resource_path.is_empty():
			TextEditing.give_back(path, grammar)
	_rest -= delta
	if _rest <= 0.0:
		_rest = PACE
		look()


## Reads again what has changed since the last look.
func look() -> void:
	var seen := {}
	for path in _paths(EditorInterface.get_resource_filesystem().get_filesystem()):
		if not ResourceLoader.has_cached(path):
			_grammars.erase(path)
			continue
		var grammar := load(path) as SgmGrammar
		if grammar == null:
			TextEditing.give_back(path, null)
			continue
		_grammars[path] = weakref(grammar)
		var changed := false
		for file in _with_imports(path):
			if file not in seen:
				seen[file] = FileAccess.get_md5(file)
			changed = changed or file in _seen and _seen[file] != seen[file]
		if changed:
			_reload(grammar, path in _seen and _seen[path] != seen[path])
	_seen = seen


# Scenes that the editor opens at its start are there before a frame has passed.
func _on_node_added(node: Node) -> void:
	if node is SgmWorld3D and (node as SgmWorld3D).grammar != null:
		var grammar := (node as SgmWorld3D).grammar
		if FileAccess.file_exists(grammar.resource_path):
			_grammars[grammar.resource_path] = weakref(grammar)


# A world that follows its grammar's file may have been quicker.
func _reload(grammar: SgmGrammar, own_text: bool) -> void:
	if not own_text or grammar.text != FileAccess.get_file_as_string(grammar.resource_path):
		grammar.reload()


func _paths(folder: EditorFileSystemDirectory) -> PackedStringArray:
	var paths := PackedStringArray()
	if folder == null:
		return paths
	for i in folder.get_file_count():
		if folder.get_file_type(i) == &"SgmGrammar":
			paths.append(folder.get_file_path(i))
	for i in folder.get_subdir_count():
		paths.append_array(_paths(folder.get_subdir(i)))
	return paths


func _with_imports(path: String) -> PackedStringArray:
	var files := PackedStringArray([path])
	var next := 0
	while next < files.size():
		for import in ResourceLoader.get_dependencies(files[next]):
			if import not in files and FileAccess.file_exists(import):
				files.append(import)
		next += 1
	return files

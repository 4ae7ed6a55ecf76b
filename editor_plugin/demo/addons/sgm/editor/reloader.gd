@tool
extends Node
## Reloads the grammars in use when their files, or files that they import, have changed. The script editor may take
## over the resource path of a grammar, for example when it reopens its files at the start; this script then restores
## the path. Changes are found by comparing the contents of files: the editor does not report that it has saved a text,
## other programs report nothing, and file times are too coarse for two changes within a second.

const TextEditing := preload("text_editing.gd")
## Seconds between two checks of the files.
const PACE := 0.5

var _rest := PACE
## The last contents of the files of used grammars and of all files that they import, by path.
var _seen := {}
## Weak references to the used grammars, by path.
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


## Reloads the grammars whose files have changed since the last check.
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


# Finds the grammars of worlds when the worlds are added to the tree. A later search would be too late for scenes that
# the editor opens at its start: they exist before the first frame.
func _on_node_added(node: Node) -> void:
	if node is SgmWorld3D and (node as SgmWorld3D).grammar != null:
		var grammar := (node as SgmWorld3D).grammar
		if FileAccess.file_exists(grammar.resource_path):
			_grammars[grammar.resource_path] = weakref(grammar)


# Skips the reload if a world that follows its grammar's file has already read the same text.
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

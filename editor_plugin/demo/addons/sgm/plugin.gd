@tool
extends EditorPlugin
## The editor plugin of SG+M: previews of worlds, their gizmos, and the dock with their figures.
##
## The other scripts use native classes, so they are loaded only after this script has checked that the library exists.

const REMEDY := "run editor_plugin/build.sh, or copy all of addons/sgm with its bin/ folder, and restart the editor"
const NEW_GRAMMAR := "New SG+M grammar…"

var _preview: Node
var _gizmo: EditorNode3DGizmoPlugin
var _dock: Control
var _text_editing: GDScript
var _highlighter: EditorSyntaxHighlighter
var _inspector: EditorInspectorPlugin
var _reloader: Node
var _new_grammar: Window


func _enter_tree() -> void:
	var trouble := _trouble()
	if not trouble.is_empty():
		push_error("SG+M: %s; %s." % [trouble, REMEDY])
		return
	_preview = _script("editor/preview.gd").new()
	add_child(_preview)
	_gizmo = _script("editor/gizmo.gd").new()
	add_node_3d_gizmo_plugin(_gizmo)
	_dock = _script("editor/dock.gd").new()
	_dock.call("set_up", _preview, get_undo_redo())
	add_control_to_dock(DOCK_SLOT_RIGHT_UL, _dock)
	_add_grammar_tools()


func _exit_tree() -> void:
	if _dock == null:
		return
	remove_control_from_docks(_dock)
	_dock.free()
	_remove_grammar_tools()
	remove_node_3d_gizmo_plugin(_gizmo)
	_gizmo = null
	_preview.queue_free()


func _disable_plugin() -> void:
	if _text_editing != null:
		_text_editing.call("take_for_text", false)


func _handles(object: Object) -> bool:
	return _text_editing != null and object.is_class("SgmGrammar")


# When a grammar is opened as a resource, shows it as text, like a script. The engine also calls this function for a
# grammar that is only unfolded among a world's properties. The inspector then still edits the world, so such a grammar
# is not shown.
func _edit(object: Object) -> void:
	if object != null:
		_show_text.call_deferred(object)


func _show_text(object: Object) -> void:
	if not is_instance_valid(object) or EditorInterface.get_inspector().get_edited_object() != object:
		return
	var path := (object as Resource).resource_path
	if FileAccess.file_exists(path):
		_text_editing.call("open", path)


func _add_grammar_tools() -> void:
	_text_editing = _script("editor/text_editing.gd")
	_text_editing.call("take_for_text", _text_editing.call("is_supported"))
	_highlighter = _script("editor/highlighter.gd").new()
	EditorInterface.get_script_editor().register_syntax_highlighter(_highlighter)
	_inspector = _script("editor/inspector.gd").new()
	add_inspector_plugin(_inspector)
	_reloader = _script("editor/reloader.gd").new()
	add_child(_reloader)
	_new_grammar = _script("editor/new_grammar.gd").new()
	EditorInterface.get_base_control().add_child(_new_grammar)
	add_tool_menu_item(NEW_GRAMMAR, Callable(_new_grammar, "ask"))


func _remove_grammar_tools() -> void:
	remove_tool_menu_item(NEW_GRAMMAR)
	_new_grammar.queue_free()
	_reloader.queue_free()
	remove_inspector_plugin(_inspector)
	EditorInterface.get_script_editor().unregister_syntax_highlighter(_highlighter)
	_inspector = null
	_highlighter = null
	_text_editing = null


## Returns the problem with the native library; an empty text if the library exists and has this plugin's version.
func _trouble() -> String:
	if not ClassDB.class_exists(&"SgmWorld3D") or not ClassDB.class_exists(&"SgmGrammar"):
		return "the native library in addons/sgm/bin is missing or does not load"
	var config := ConfigFile.new()
	if config.load(_folder().path_join("plugin.cfg")) != OK:
		return "addons/sgm/plugin.cfg cannot be read"
	var wanted: String = config.get_value("plugin", "version", "")
	var found: String = ClassDB.instantiate(&"SgmGrammar").call("get_version")
	if found != wanted:
		return "the native library is of version %s, the plugin of version %s" % [found, wanted]
	return ""


func _script(path: String) -> GDScript:
	return load(_folder().path_join(path))


func _folder() -> String:
	return (get_script() as Script).resource_path.get_base_dir()

@tool
extends EditorFileDialog
## The dialog for a new grammar: asks for its path, writes a template there, and opens it in the script editor.

const TextEditing := preload("text_editing.gd")
const TEMPLATE := """sgm 1;
// A grammar of shapes. Rules grow a world from `start`; worlds that use this file change when it is saved.
units m;

// Parameters are in the inspector of each SgmWorld3D, with their ranges and notes.
param height = 12m in 4m..40m "of the tower";
param round = 0.3 in 0..1 "0: square storeys, 1: round ones";

start Tower;

// A rule replaces its name by what is between its braces; statements join, `cut` takes away from those before it.
rule Tower {
  at(0m, 0.5*height, 0m) Storeys(0.25*height, height);
  cut { at(0m, 2m, 0.25*height) box(2m, 4m, 4m); }
  anchor spawn "door";  // games find it by SgmWorld3D.get_anchors
}

// `morph` blends two shapes: try the parameter.
rule Storeys(r, h) {
  morph(box(2*r, h, 2*r), cylinder(r, h), round);
  mat brick;
}

// Checked by `sgm check`, and by the tests of a project.
expect watertight;
expect components == 1;
"""


func _init() -> void:
	title = "New SG+M grammar"
	file_mode = FILE_MODE_SAVE_FILE
	access = ACCESS_RESOURCES
	add_filter("*.sgm", "SG+M grammar")
	file_selected.connect(write)


func ask() -> void:
	current_file = "new_grammar.sgm"
	popup_file_dialog()


## Writes the template to a path, and opens it. Returns false if it cannot be written.
func write(path: String) -> bool:
	var file := FileAccess.open(path, FileAccess.WRITE)
	if file == null:
		push_error("SG+M: '%s' cannot be written (%s): choose another folder." % [
				path, error_string(FileAccess.get_open_error())])
		return false
	file.store_string(TEMPLATE)
	file.close()
	EditorInterface.get_resource_filesystem().update_file(path)
	return TextEditing.open(path)

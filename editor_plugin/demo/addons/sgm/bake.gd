@tool
class_name SgmBake
extends RefCounted
## Saves the drawn surface of a world for use without the plugin: as a scene of the engine's own nodes, or as glTF.
##
## Only chunks that are drawn at the time of the call are saved, so wait until the world is idle: [codeblock]
## await world.became_idle
## if SgmBake.bake_to_scene(world, "user://cave.scn", {merge = true}) != OK:
##     print(SgmBake.trouble)
## [/codeblock]
## A file is written under another name and renamed when it is complete: after a failure, the previous file still
## exists.

const ROUGHNESS := 0.85
## The folder of the plugin. Its shaders read vertex attributes that exist only on surfaces that the plugin draws, so
## saved surfaces do not use these shaders.
const OWN_FOLDER := "res://addons/sgm/"
const PARTS: Array[int] = [Mesh.ARRAY_VERTEX, Mesh.ARRAY_NORMAL, Mesh.ARRAY_COLOR, Mesh.ARRAY_TEX_UV]

## The error of the last call and its remedy, in one sentence; empty after a success.
static var trouble := ""


## Saves a scene (.tscn or .scn): a [Node3D] with the name and transform of [param world], and a [MeshInstance3D] for
## each chunk.
##
## A surface has the material that the world has for it, unless a shader of the plugin draws that material; all other
## surfaces share a [StandardMaterial3D] that shows the vertex colors. Options: [br]
## - [code]merge[/code] (false): makes one mesh of all chunks, with one surface for each material; [br]
## - [code]collision[/code] (true): adds a [StaticBody3D] with a [ConcavePolygonShape3D] for each mesh, with the world's
## collision layers; [br]
## - [code]anchors[/code] (true): adds a [Marker3D] with the name of each anchor within the bounds of the drawn chunks,
## with the anchor's kind and tag as metadata.
static func bake_to_scene(world: SgmWorld3D, path: String, options := {}) -> Error:
	var chunks: Array[Dictionary] = []
	var error := _begin(world, path, ["tscn", "scn"], chunks)
	if error != OK:
		return error
	var root := _tree_of(world, chunks, options, false)
	var scene := PackedScene.new()
	error = scene.pack(root)
	root.free()
	var unfinished := _unfinished(path)
	if error == OK:
		var binary := path.get_extension().to_lower() == "scn"
		error = ResourceSaver.save(scene, unfinished, ResourceSaver.FLAG_COMPRESS if binary else ResourceSaver.FLAG_NONE)
	if error == OK:
		_keep_identifier(unfinished, path)
	return _finish(error, unfinished, path)


## Saves the meshes and anchors as a binary glTF file (.glb), in metres, for other programs.
##
## glTF has no shader materials: such surfaces show the vertex colors instead.
static func export_glb(world: SgmWorld3D, path: String) -> Error:
	var chunks: Array[Dictionary] = []
	var error := _begin(world, path, ["glb"], chunks)
	if error != OK:
		return error
	var root := _tree_of(world, chunks, {collision = false}, true)
	var document := GLTFDocument.new()
	var state := GLTFState.new()
	error = document.append_from_scene(root, state)
	root.free()
	var unfinished := _unfinished(path)
	if error == OK:
		error = document.write_to_filesystem(state, unfinished)
	return _finish(error, unfinished, path)


# Checks the arguments before anything is built. If they are valid, fills `chunks` and creates the unfinished file.
static func _begin(world: SgmWorld3D, path: String, endings: Array[String], chunks: Array[Dictionary]) -> Error:
	trouble = ""
	if path.get_extension().to_lower() not in endings:
		return _fail(ERR_FILE_UNRECOGNIZED, "'%s' has an unknown ending: name the file .%s" % [path, " or .".join(endings)])
	if world == null or not world.is_inside_tree():
		return _fail(ERR_INVALID_PARAMETER, "there is no world to bake: pass an SgmWorld3D that is in the scene tree")
	chunks.assign(world.bake_chunks())
	if chunks.is_empty():
		return _fail(ERR_UNAVAILABLE,
				"'%s' has drawn nothing yet: wait for its signal became_idle, with a viewer or camera near it" % world.name)
	var folder := path.get_base_dir()
	if not DirAccess.dir_exists_absolute(folder):
		return _fail(ERR_FILE_BAD_PATH, "there is no folder '%s': make it first, or choose another one" % folder)
	if FileAccess.open(_unfinished(path), FileAccess.WRITE) == null:
		return _fail_to_write(path, FileAccess.get_open_error())
	return OK


static func _finish(error: Error, unfinished: String, path: String) -> Error:
	if error == OK:
		error = DirAccess.rename_absolute(unfinished, path)
	if error == OK:
		return OK
	DirAccess.remove_absolute(unfinished)
	return _fail_to_write(path, error)


# The name of the unfinished file begins with a dot: the editor does not import such files into the project.
static func _unfinished(path: String) -> String:
	return path.get_base_dir().path_join(".unfinished-" + path.get_file())


# Gives the new scene the UID of the file that it replaces: other scenes that refer to the file by this UID thus still
# find it (Godot 4.4 and newer).
static func _keep_identifier(unfinished: String, path: String) -> void:
	var identifier := ResourceLoader.get_resource_uid(path) if FileAccess.file_exists(path) else ResourceUID.INVALID_ID
	if identifier != ResourceUID.INVALID_ID and ResourceSaver.has_method(&"set_uid"):
		ResourceSaver.call(&"set_uid", unfinished, identifier)


static func _fail_to_write(path: String, error: Error) -> Error:
	return _fail(error, "'%s' cannot be written (%s): choose a folder that lets you write and has room" % [
			path, error_string(error).to_lower()])


static func _fail(error: Error, sentence: String) -> Error:
	trouble = sentence
	push_error("SgmBake: ", sentence)
	return error


# Makes the nodes of the scene. The caller owns them.
static func _tree_of(world: SgmWorld3D, chunks: Array[Dictionary], options: Dictionary, for_gltf: bool) -> Node3D:
	var root := Node3D.new()
	root.name = world.name
	root.transform = world.transform
	var to_local := world.global_transform.affine_inverse()
	var materials := {"": _plain_material(for_gltf)}
	for chunk in chunks:
		chunk.transform = to_local * (chunk.transform as Transform3D)
		for surface: Dictionary in chunk.surfaces:
			var slot: String = surface.material
			if slot not in materials:
				materials[slot] = _material_of(world, slot, for_gltf, materials[""])
			surface.arrays[Mesh.ARRAY_COLOR] = _colors(surface.arrays[Mesh.ARRAY_COLOR], for_gltf)
	for chunk: Dictionary in ([_merged(chunks, materials)] if options.get("merge", false) else chunks):
		_add_mesh(root, world, chunk, materials, options.get("collision", true))
	if options.get("anchors", true):
		_add_anchors(root, world, to_local)
	return root


static func _add(node: Node, title: String, parent: Node, root: Node) -> void:
	node.name = title.validate_node_name()
	parent.add_child(node, true)
	node.owner = root


static func _add_mesh(
		root: Node3D, world: SgmWorld3D, chunk: Dictionary, materials: Dictionary, collision: bool) -> void:
	var mesh := ArrayMesh.new()
	for surface: Dictionary in chunk.surfaces:
		var slot: String = surface.material
		var last := mesh.get_surface_count()
		mesh.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, surface.arrays)
		mesh.surface_set_name(last, "blended" if slot.is_empty() else slot)
		mesh.surface_set_material(last, materials[slot])
	var instance := MeshInstance3D.new()
	instance.mesh = mesh
	instance.transform = chunk.transform
	instance.layers = world.render_layers
	instance.cast_shadow = (GeometryInstance3D.SHADOW_CASTING_SETTING_ON if world.cast_shadow
			else GeometryInstance3D.SHADOW_CASTING_SETTING_OFF)
	_add(instance, chunk.name, root, root)
	if not collision:
		return
	var body := StaticBody3D.new()
	body.collision_layer = world.collision_layer
	body.collision_mask = world.collision_mask
	_add(body, "Body", instance, root)
	var place := CollisionShape3D.new()
	var shape := ConcavePolygonShape3D.new()
	shape.set_faces(chunk.faces)
	place.shape = shape
	_add(place, "Shape", body, root)


static func _add_anchors(root: Node3D, world: SgmWorld3D, to_local: Transform3D) -> void:
	var bounds: AABB = world.get_bounds()
	for anchor: Dictionary in world.get_anchors(world.global_transform * bounds):
		var place := to_local * (anchor.transform as Transform3D)
		# The search used an axis-aligned box. If the world is rotated, this box is larger than the bounds, so skip the
		# anchors outside of the bounds.
		if not bounds.has_point(place.origin):
			continue
		var marker := Marker3D.new()
		marker.transform = place
		marker.set_meta(&"kind", anchor.kind)
		marker.set_meta(&"tag", anchor.tag)
		_add(marker, anchor.kind if anchor.name.is_empty() else anchor.name, root, root)


static func _material_of(world: SgmWorld3D, slot: String, for_gltf: bool, plain: Material) -> Material:
	var chosen: Material = world.get("materials/" + slot)
	var shaded := chosen as ShaderMaterial
	if shaded == null:
		return chosen if chosen != null else plain
	var own := shaded.shader == null or OWN_FOLDER in shaded.shader.resource_path or OWN_FOLDER in shaded.shader.code
	return plain if own or for_gltf else chosen


# The engine expects vertex colors in sRGB, as the world provides them; glTF expects linear colors.
static func _plain_material(linear: bool) -> StandardMaterial3D:
	var material := StandardMaterial3D.new()
	material.resource_name = "vertex colors"
	material.vertex_color_use_as_albedo = true
	material.vertex_color_is_srgb = not linear
	material.roughness = ROUGHNESS
	return material


# Returns the colors with alpha 1: in the world's vertex colors, alpha is the roughness.
static func _colors(colors: PackedColorArray, linear: bool) -> PackedColorArray:
	for i in colors.size():
		colors[i] = Color(colors[i].srgb_to_linear() if linear else colors[i], 1.0)
	return colors


# Joins all chunks into one mesh, whose vertices are in the world's own coordinates.
static func _merged(chunks: Array[Dictionary], materials: Dictionary) -> Dictionary:
	var surfaces := {}
	var faces := PackedVector3Array()
	for chunk in chunks:
		var place: Transform3D = chunk.transform
		faces.append_array(place * (chunk.faces as PackedVector3Array))
		for surface: Dictionary in chunk.surfaces:
			var arrays: Array = surface.arrays
			arrays[Mesh.ARRAY_VERTEX] = place * (arrays[Mesh.ARRAY_VERTEX] as PackedVector3Array)
			var material: Material = materials[surface.material]
			if material in surfaces:
				_append(surfaces[material].arrays, arrays)
			else:
				surfaces[material] = surface
	return {name = "Mesh", transform = Transform3D(), surfaces = surfaces.values(), faces = faces}


static func _append(arrays: Array, more: Array) -> void:
	var first: int = arrays[Mesh.ARRAY_VERTEX].size()
	var indices: PackedInt32Array = more[Mesh.ARRAY_INDEX]
	for i in indices.size():
		indices[i] += first
	arrays[Mesh.ARRAY_INDEX].append_array(indices)
	for part in PARTS:
		arrays[part].append_array(more[part])

extends SceneTree
## Tests saving the drawn world as a scene and as glTF: triangles, their area, orientation and colors, colliders,
## anchors and materials. The files must not need the plugin: a project without it shows the scene. Errors say what to
## do, and leave no files.

const Checks := preload("res://tests/lib/checks.gd")
const Cave := preload("res://tests/lib/cave.gd")
const FOLDER := "user://bake_test"
const SCENE := FOLDER + "/baked.tscn"
## Folder of a project without the plugin, which contains only the saved scene.
const BARE := FOLDER + "/bare_project"
const BARE_SCRIPT := """extends SceneTree


func _init() -> void:
	var scene := (load("res://baked.tscn") as PackedScene).instantiate()
	var triangles := 0
	for instance: MeshInstance3D in scene.find_children("*", "MeshInstance3D"):
		for surface in instance.mesh.get_surface_count():
			triangles += instance.mesh.surface_get_array_index_len(surface) / 3
	print("bare: %d triangles, world class %s" % [triangles, ClassDB.class_exists(&"SgmWorld3D")])
	scene.free()
	quit()
"""

var _checks := Checks.new()
var _world: SgmWorld3D
var _triangles := 0


func _initialize() -> void:
	_remove(FOLDER)
	DirAccess.make_dir_recursive_absolute(FOLDER)
	var cave := Cave.new(self)
	_world = cave.world
	_world.name = "Deep Cave"
	_world.view_distance = 60
	_world.finest_distance = 16
	_world.collision = false
	_world.collision_layer = 5
	await cave.enter()
	_refusals()
	_checks.check(await cave.settle(), "the world comes to rest")
	# Builds something of a second material, so that the surface has two.
	var floor_hit: Dictionary = _world.ray_cast(cave.viewer.global_position, Vector3.DOWN, 60)
	_checks.equal(_world.build(floor_hit.position, 3.0, "calcite").size(), 2, "building")
	if _checks.check(await cave.settle(), "what was built is drawn"):
		for chunk in _world.bake_chunks():
			_triangles += (chunk.faces as PackedVector3Array).size() / 3
		_checks.check(_triangles > 5000, "triangles to bake: %d" % _triangles)
		_scene()
		_bare_project()
		_merged()
		_placed()
		await _materials(cave)
		_gltf()
		_failures()
	_world = null
	await cave.leave()
	_remove(FOLDER)
	await _checks.finish(self)


func _refusals() -> void:
	_checks.expect_error("SgmBake: 'Deep Cave' has drawn nothing yet: wait")
	_checks.equal(SgmBake.bake_to_scene(_world, SCENE), ERR_UNAVAILABLE, "nothing is drawn yet")
	_checks.equal(SgmBake.export_glb(_world, FOLDER + "/baked.glb"), ERR_UNAVAILABLE, "nor for glTF")
	_checks.expect_error("SgmBake: there is no world to bake")
	_checks.equal(SgmBake.bake_to_scene(null, SCENE), ERR_INVALID_PARAMETER, "no world")
	_checks.equal(_files(), PackedStringArray(), "files that refusals leave")


func _scene() -> void:
	_checks.equal(SgmBake.bake_to_scene(_world, SCENE), OK, "baking")
	_checks.equal(SgmBake.trouble, "", "no trouble")
	_checks.equal(_files(), PackedStringArray(["baked.tscn"]), "files that baking leaves")
	# Remove the meshes' bytes first, since they may contain any word.
	var bytes := RegEx.create_from_string("PackedByteArray\\([^)]*\\)")
	var text := bytes.sub(FileAccess.get_file_as_string(SCENE), "", true)
	_checks.check(text.contains("ArrayMesh"), "the scene has meshes")
	for word: String in ["Sgm", "addons/", "ext_resource"]:
		_checks.check(not text.contains(word), "the scene's text does without '%s'" % word)
	var scene := _load(SCENE)
	_checks.equal(scene.name, &"Deep Cave", "the root's name")
	var chunks := _world.bake_chunks()
	var instances := scene.find_children("*", "MeshInstance3D", false)
	_checks.equal(instances.size(), chunks.size(), "meshes")
	_checks.equal(_count(scene), _triangles, "triangles")
	_checks.equal(_count(scene), _world.get_measures().triangles, "triangles, as they are measured")
	var measured: float = _world.get_measures().area
	_checks.near(_area(scene), measured, 0.01 * measured, "area")
	_sides(scene)
	_bodies(scene, chunks.size())
	_anchors(scene)

	var materials := {}
	for instance: MeshInstance3D in instances:
		for surface in instance.mesh.get_surface_count():
			materials[instance.mesh.surface_get_material(surface)] = true
	if _checks.equal(materials.size(), 1, "materials, shared by all"):
		var plain: StandardMaterial3D = materials.keys()[0]
		_checks.check(plain.vertex_color_use_as_albedo and plain.vertex_color_is_srgb, "it shows the colors")
	var wanted: Color = _world.get("colors/limestone")
	_checks.check(_has_color(scene, wanted), "the rock's color is there: %s" % wanted)
	scene.free()


# Checks that the normals and the front faces (clockwise triangles) point to the side without rock.
func _sides(scene: Node3D) -> void:
	var agreement := 0.0
	var count := 0
	var open := 0
	var probed := 0
	for instance: MeshInstance3D in scene.find_children("*", "MeshInstance3D", false):
		for surface in instance.mesh.get_surface_count():
			var arrays := instance.mesh.surface_get_arrays(surface)
			var points: PackedVector3Array = arrays[Mesh.ARRAY_VERTEX]
			var normals: PackedVector3Array = arrays[Mesh.ARRAY_NORMAL]
			var indices: PackedInt32Array = arrays[Mesh.ARRAY_INDEX]
			for i in range(0, indices.size(), 3):
				var a := points[indices[i]]
				var front := (points[indices[i + 2]] - a).cross(points[indices[i + 1]] - a).normalized()
				agreement += front.dot(normals[indices[i]])
				count += 1
			if indices.size() < 3:
				continue
			var middle := (points[indices[0]] + points[indices[1]] + points[indices[2]]) / 3
			var at := scene.transform * (instance.transform * middle)
			probed += 1
			open += int(_is_open(at + normals[indices[0]]) and not _is_open(at - normals[indices[0]]))
	_checks.check(agreement > 0.8 * count, "fronts agree with normals: %f on average" % (agreement / count))
	_checks.check(open > 0.8 * probed, "normals look into the void: %d of %d" % [open, probed])


func _is_open(at: Vector3) -> bool:
	var hit := _world.ray_cast(at, Vector3.UP, 0.01)
	return hit.is_empty() or not hit.inside


func _bodies(scene: Node3D, meshes: int) -> void:
	var corners := 0
	var shapes := scene.find_children("*", "CollisionShape3D", true)
	for place: CollisionShape3D in shapes:
		corners += (place.shape as ConcavePolygonShape3D).get_faces().size()
	_checks.equal([shapes.size(), corners], [meshes, _triangles * 3], "colliders and their corners")
	for body: StaticBody3D in scene.find_children("*", "StaticBody3D", true):
		if not _checks.equal(body.collision_layer, 5, "a body's layer"):
			break


func _anchors(scene: Node3D) -> void:
	var bounds := _world.get_bounds()
	var wanted := _world.get_anchors(bounds).filter(func(anchor: Dictionary) -> bool:
		return bounds.has_point((anchor.transform as Transform3D).origin))
	var markers := scene.find_children("*", "Marker3D", false)
	_checks.check(markers.size() > 0, "there is a marker, where the viewer is")
	if not _checks.equal(markers.size(), wanted.size(), "markers"):
		return
	for i in markers.size():
		var marker := markers[i] as Marker3D
		_checks.check(String(marker.name).begins_with("chamber"), "a marker's name: %s" % marker.name)
		_checks.equal([marker.get_meta(&"kind"), marker.get_meta(&"tag")], [wanted[i].kind, wanted[i].tag], "its metadata")
		_checks.check(marker.transform.is_equal_approx(wanted[i].transform), "its place: %s" % marker.transform)


func _bare_project() -> void:
	# The harness sets GODOT. OS.get_executable_path() does not serve here: if the engine was unpacked with a dynamic
	# loader of its own, it returns the path of that loader.
	var godot := OS.get_environment("GODOT")
	if not _checks.check(not godot.is_empty(), "GODOT names the engine, as tests/run.sh sets it"):
		return
	DirAccess.make_dir_absolute(BARE)
	DirAccess.copy_absolute(SCENE, BARE + "/baked.tscn")
	_write(BARE + "/project.godot", "config_version=5\n")
	_write(BARE + "/bare.gd", BARE_SCRIPT)
	var output := []
	var project := ProjectSettings.globalize_path(BARE)
	var status := OS.execute(godot, ["--headless", "--path", project, "--script", "bare.gd"], output, true)
	var text := String(output[0])
	_checks.equal(status, 0, "the bare project's status")
	_checks.check(text.contains("bare: %d triangles, world class false" % _triangles), "what it has loaded: " + text)
	_checks.check(not text.contains("ERROR"), "it has no errors: " + text.replace("ERROR", "error"))


func _merged() -> void:
	var path := FOLDER + "/merged.scn"
	_checks.equal(SgmBake.bake_to_scene(_world, path, {merge = true, anchors = false}), OK, "merging")
	var scene := _load(path)
	var instances := scene.find_children("*", "MeshInstance3D", true)
	if _checks.equal(instances.size(), 1, "meshes, merged"):
		_checks.equal((instances[0] as MeshInstance3D).mesh.get_surface_count(), 1, "surfaces, one for the one material")
	_checks.equal(_count(scene), _triangles, "triangles, merged")
	var measured: float = _world.get_measures().area
	_checks.near(_area(scene), measured, 0.01 * measured, "area, merged")
	_sides(scene)
	_bodies(scene, 1)
	_checks.equal(scene.find_children("*", "Marker3D", true).size(), 0, "markers that are not wanted")
	scene.free()
	_checks.equal(SgmBake.bake_to_scene(_world, path, {merge = true, collision = false}), OK, "over one that is there")
	scene = _load(path)
	_checks.equal(scene.find_children("*", "CollisionObject3D", true).size(), 0, "bodies that are not wanted")
	scene.free()


# If the world has a transform, it must be saved with this transform, and its chunks must keep their places in it.
func _placed() -> void:
	var path := FOLDER + "/placed.scn"
	_world.transform = Transform3D(Basis(Vector3.UP, 0.7), Vector3(10, 20, 30))
	_checks.equal(SgmBake.bake_to_scene(_world, path, {collision = false}), OK, "baking a world that is turned")
	var scene := _load(path)
	_checks.check(scene.transform.is_equal_approx(_world.transform), "the root's place: %s" % scene.transform)
	var bounds := AABB()
	for instance: MeshInstance3D in scene.find_children("*", "MeshInstance3D", false):
		var box := instance.transform * instance.get_aabb()
		bounds = bounds.merge(box) if bounds.has_volume() else box
	var wanted := _world.get_bounds()
	_checks.near(bounds.position.distance_to(wanted.position), 0, 0.1, "the bounds' begin in the root")
	_checks.near(bounds.end.distance_to(wanted.end), 0, 0.1, "and their end")
	for marker: Marker3D in scene.find_children("*", "Marker3D", false):
		_checks.check(wanted.has_point(marker.position), "a marker within them: %s" % marker.position)
	scene.free()
	_world.transform = Transform3D()


func _materials(cave: RefCounted) -> void:
	var path := FOLDER + "/materials.tscn"
	var chosen := StandardMaterial3D.new()
	chosen.albedo_color = Color(0.25, 0.5, 0.75)
	_world.set("materials/limestone", chosen)
	var own := ShaderMaterial.new()
	own.shader = load("res://addons/sgm/shaders/triplanar.gdshader")
	_world.set("materials/calcite", own)
	_checks.check(await cave.settle(), "materials are drawn")
	_checks.equal(SgmBake.bake_to_scene(_world, path, {merge = true, collision = false}), OK, "baking with materials")
	_checks.check(not FileAccess.get_file_as_string(path).contains("res://"), "none of the plugin's shaders is in it")
	var scene := _load(path)
	var mesh := (scene.find_children("*", "MeshInstance3D", true)[0] as MeshInstance3D).mesh
	var found := {}
	for surface in mesh.get_surface_count():
		var material := mesh.surface_get_material(surface) as StandardMaterial3D
		found["chosen" if material.albedo_color.is_equal_approx(chosen.albedo_color) else "plain"] = surface
	_checks.equal([mesh.get_surface_count(), found.size()], [2, 2], "the material that was set, and a plain one")
	_checks.equal(_count(scene), _triangles, "triangles of all materials")
	scene.free()
	_world.set("materials/limestone", null)
	_world.set("materials/calcite", null)
	_checks.check(await cave.settle(), "without materials again")


func _gltf() -> void:
	var path := FOLDER + "/baked.glb"
	_checks.equal(SgmBake.export_glb(_world, path), OK, "exporting glTF")
	var document := GLTFDocument.new()
	var state := GLTFState.new()
	if not _checks.equal(document.append_from_file(path, state), OK, "reading it"):
		return
	var scene := document.generate_scene(state) as Node3D
	_checks.equal(_count(scene), _triangles, "triangles in glTF")
	_checks.equal(scene.find_children("*", "CollisionObject3D", true, false).size(), 0, "bodies in glTF")
	var wanted: Color = (_world.get("colors/limestone") as Color).srgb_to_linear()
	_checks.check(_has_color(scene, wanted), "the rock's color, linear: %s" % wanted)
	scene.free()


func _failures() -> void:
	var before := _files()
	_checks.expect_error("SgmBake: '.*baked.obj' has an unknown ending: name the file .tscn or .scn")
	_checks.equal(SgmBake.bake_to_scene(_world, FOLDER + "/baked.obj"), ERR_FILE_UNRECOGNIZED, "an unknown ending")
	_checks.expect_error("SgmBake: '.*baked.gltf' has an unknown ending: name the file .glb")
	_checks.equal(SgmBake.export_glb(_world, FOLDER + "/baked.gltf"), ERR_FILE_UNRECOGNIZED, "and for glTF")
	_checks.expect_error("SgmBake: there is no folder '.*nowhere': make it first")
	_checks.equal(SgmBake.bake_to_scene(_world, FOLDER + "/nowhere/baked.scn"), ERR_FILE_BAD_PATH, "no such folder")
	_checks.equal(SgmBake.export_glb(_world, FOLDER + "/nowhere/baked.glb"), ERR_FILE_BAD_PATH, "and for glTF")
	# Two paths that cannot be written: a file name that is too long for any file system, and a path at which a folder
	# exists.
	_checks.expect_error("SgmBake: '.*' cannot be written .*: choose a folder")
	var long := FOLDER.path_join("a".repeat(300))
	_checks.check(SgmBake.bake_to_scene(_world, long + ".tscn") != OK, "a file that cannot be written")
	_checks.check(SgmBake.export_glb(_world, long + ".glb") != OK, "and for glTF")
	_checks.check(SgmBake.trouble.contains("choose a folder"), "the trouble is kept: " + SgmBake.trouble)
	DirAccess.make_dir_absolute(FOLDER + "/taken.scn")
	DirAccess.make_dir_absolute(FOLDER + "/taken.glb")
	_checks.check(SgmBake.bake_to_scene(_world, FOLDER + "/taken.scn") != OK, "a file that cannot be renamed")
	_checks.check(SgmBake.export_glb(_world, FOLDER + "/taken.glb") != OK, "and for glTF")
	_checks.equal(_files(), before, "files that failures leave")


func _load(path: String) -> Node3D:
	return (ResourceLoader.load(path, "", ResourceLoader.CACHE_MODE_IGNORE) as PackedScene).instantiate() as Node3D


# Returns the corners of all triangles in scene coordinates, three for each triangle.
static func _corners(scene: Node3D) -> PackedVector3Array:
	var corners := PackedVector3Array()
	for node in scene.find_children("*", "", true, false):
		var mesh := _mesh_of(node)
		for surface in (mesh.get_surface_count() if mesh != null else 0):
			var arrays := mesh.surface_get_arrays(surface)
			var points: PackedVector3Array = (node as Node3D).transform * (arrays[Mesh.ARRAY_VERTEX] as PackedVector3Array)
			for index in arrays[Mesh.ARRAY_INDEX] as PackedInt32Array:
				corners.append(points[index])
	return corners


static func _mesh_of(node: Node) -> ArrayMesh:
	if node is MeshInstance3D:
		return (node as MeshInstance3D).mesh as ArrayMesh
	if node is ImporterMeshInstance3D:
		return (node as ImporterMeshInstance3D).mesh.get_mesh()
	return null


static func _count(scene: Node3D) -> int:
	return _corners(scene).size() / 3


static func _area(scene: Node3D) -> float:
	var corners := _corners(scene)
	var area := 0.0
	for i in range(0, corners.size(), 3):
		area += (corners[i + 1] - corners[i]).cross(corners[i + 2] - corners[i]).length() / 2
	return area


static func _has_color(scene: Node3D, wanted: Color) -> bool:
	for node in scene.find_children("*", "", true, false):
		var mesh := _mesh_of(node)
		for surface in (mesh.get_surface_count() if mesh != null else 0):
			for color in mesh.surface_get_arrays(surface)[Mesh.ARRAY_COLOR] as PackedColorArray:
				var off := Vector3(color.r - wanted.r, color.g - wanted.g, color.b - wanted.b)
				if off.length() < 0.01 and color.a == 1:
					return true
	return false


# Returns all files in the folder, including unfinished ones, whose names begin with a dot: the plugin must leave
# no unfinished file.
static func _files() -> PackedStringArray:
	var folder := DirAccess.open(FOLDER)
	folder.include_hidden = true
	return folder.get_files()


static func _write(path: String, text: String) -> void:
	FileAccess.open(path, FileAccess.WRITE).store_string(text)


static func _remove(folder: String) -> void:
	var opened := DirAccess.open(folder)
	if opened == null:
		return
	opened.include_hidden = true
	for file in opened.get_files():
		opened.remove(file)
	for below in opened.get_directories():
		_remove(folder.path_join(below))
	DirAccess.remove_absolute(folder)

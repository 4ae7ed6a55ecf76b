@tool
extends EditorPlugin
## Runs the script whose path SGM_EDITOR_TEST contains, once the editor has started up. The test itself quits the
## editor.

## Number of frames in which the editor lays out its docks and scans its files.
const SETTLING := 30
const FRAMES_PER_SECOND := 20


func _enter_tree() -> void:
	_run.call_deferred()


func _run() -> void:
	# A software renderer takes most of a test's time, so the editor draws nothing until a test needs a picture. Its
	# frames then follow each other fast, so their rate is limited: the tests wait for some of its work by frames.
	RenderingServer.render_loop_enabled = false
	# Where it draws, it draws each frame; by default, only frames in which something has changed.
	OS.low_processor_usage_mode = false
	Engine.max_fps = FRAMES_PER_SECOND
	for i in SETTLING:
		await get_tree().process_frame
	while EditorInterface.get_resource_filesystem().is_scanning():
		await get_tree().process_frame
	var path := OS.get_environment("SGM_EDITOR_TEST")
	var script: GDScript = load(path) if ResourceLoader.exists(path) else null
	if script == null or not script.can_instantiate():
		printerr("ERROR: the editor's test cannot be loaded: ", path)
		get_tree().quit(1)
		return
	var test: RefCounted = script.new()
	await test.call("run", self)

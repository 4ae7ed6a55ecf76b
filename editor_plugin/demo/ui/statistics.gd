class_name DemoStatistics
extends PanelContainer
## Shows the activity of a world and measures of its drawn chunks, a few times a second.

const SECONDS := 0.25

var _world: SgmWorld3D
var _left := 0.0

@onready var _text: Label = %Text


func set_up(world: SgmWorld3D) -> void:
	_world = world


func _process(delta: float) -> void:
	_left -= delta
	if not visible or _world == null or _left > 0.0:
		return
	_left = SECONDS
	_text.text = describe(_world)


## Returns the figures of a world as lines of text.
static func describe(world: SgmWorld3D) -> String:
	var lines := PackedStringArray()
	lines.append("%d frames/s" % roundi(Engine.get_frames_per_second()))
	var figures := world.get_statistics()
	if figures.is_empty():
		lines.append(world.get_error_text() if world.get_error_text() != "" else "The world does not run.")
		return "\n".join(lines)
	lines.append("%s  %s" % [figures.backend, figures.device])
	lines.append("main thread %.2f ms, p99 %.2f ms" % [figures.main_thread_ms, figures.main_thread_p99_ms])
	lines.append("%d chunks drawn, %d waiting, %d in work" % [figures.drawn, figures.queued, figures.in_work])
	lines.append("%s triangles, %.0f MiB of meshes" % [grouped(figures.triangles), figures.mesh_bytes / 1048576.0])
	lines.append("%d colliders, %d waiting; %d uploads waiting"
			% [figures.colliders, figures.colliders_waiting, figures.uploads_waiting])
	lines.append("%d edits, detail %.2f, %s" % [figures.edits, figures.detail, "idle" if figures.idle else "at work"])
	var measures := world.get_measures()
	if not measures.is_empty():
		lines.append("area %s m², volume %s m³" % [grouped(roundi(measures.area)), grouped(roundi(measures.volume))])
		lines.append("%s, %d slivers" % ["watertight" if measures.watertight else "%d defects" % measures.defects,
				measures.slivers])
	return "\n".join(lines)


## Formats a whole number with separated groups of three digits.
static func grouped(number: int) -> String:
	var digits := str(absi(number))
	var text := ""
	while digits.length() > 3:
		text = " " + digits.right(3) + text
		digits = digits.left(-3)
	return ("-" if number < 0 else "") + digits + text

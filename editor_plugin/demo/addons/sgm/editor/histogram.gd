@tool
extends Control
## A histogram of the dihedral angles at a surface's edges: concave edges on the left, flat ones in the middle, convex
## ones on the right. The height of a bar is proportional to the square root of the share of edges with its angles, so
## that the few sharp edges are visible in addition to the many flat ones.

## Number of bars. It is odd, so that one bar, in the middle, contains all flat edges.
const BINS := 33
const HEIGHT := 110.0
const GAP := 1.0
const LABELS: Array[String] = ["concave", "flat", "convex"]

## For each bar, its share of all edges. The first bar has the most concave edges, the last bar the most convex ones.
## Empty before the first measurement.
var shares := PackedFloat64Array()

## The total shares of concave, flat and convex edges; empty before the first measurement.
var _sums: Array[float] = []
var _hovered := -1


func _init() -> void:
	custom_minimum_size.y = HEIGHT
	mouse_exited.connect(_hover.bind(-1))


func _notification(what: int) -> void:
	if what == NOTIFICATION_ENTER_TREE or what == NOTIFICATION_THEME_CHANGED:
		custom_minimum_size.y = HEIGHT * EditorInterface.get_editor_scale()


## Shows the shares by angle, and the total shares of concave, flat and convex edges.
func show_shares(by_bend: PackedFloat64Array, sums: Array[float]) -> void:
	shares = by_bend
	_sums = sums
	queue_redraw()


func clear() -> void:
	show_shares(PackedFloat64Array(), [])


func _gui_input(event: InputEvent) -> void:
	if event is InputEventMouseMotion:
		_hover(bin_at((event as InputEventMouseMotion).position.x))


func _get_tooltip(at_position: Vector2) -> String:
	if shares.is_empty():
		return "The bends along the edges of what is drawn: press Measure to see them."
	var bin := bin_at(at_position.x)
	var degrees := (bin + 0.5) / shares.size() * 360.0 - 180.0
	var reach := 180.0 / shares.size()
	if absf(degrees) < reach:
		return "%.2f %% of the edges bend by less than %.1f°" % [shares[bin] * 100.0, reach]
	return "%.2f %% of the edges are %s by %.1f° to %.1f°" % [shares[bin] * 100.0, LABELS[2 if degrees > 0.0 else 0],
			absf(degrees) - reach, absf(degrees) + reach]


## Returns the index of the bar at an x coordinate.
func bin_at(x: float) -> int:
	return clampi(floori(x / maxf(size.x, 1.0) * shares.size()), 0, maxi(shares.size() - 1, 0))


func _hover(bin: int) -> void:
	if bin != _hovered:
		_hovered = bin
		queue_redraw()


func _draw() -> void:
	var font := get_theme_font(&"font", &"Label")
	var font_size := roundi(get_theme_font_size(&"font_size", &"Label") * 0.85)
	var ink := get_theme_color(&"font_color", &"Label")
	var accent := get_theme_color(&"accent_color", &"Editor")
	var foot := font.get_height(font_size) + 2.0
	var floor_y := size.y - foot
	draw_rect(Rect2(Vector2.ZERO, Vector2(size.x, floor_y)), Color(ink, 0.06))
	var middle := size.x / 2.0
	draw_dashed_line(Vector2(middle, 0.0), Vector2(middle, floor_y), Color(ink, 0.35), 1.0, 3.0)
	_draw_bars(floor_y, accent)
	draw_line(Vector2(0.0, floor_y), Vector2(size.x, floor_y), Color(ink, 0.5), 1.0)
	var alignments: Array[HorizontalAlignment] = [
		HORIZONTAL_ALIGNMENT_LEFT, HORIZONTAL_ALIGNMENT_CENTER, HORIZONTAL_ALIGNMENT_RIGHT]
	for i in LABELS.size():
		var text := LABELS[i] if _sums.is_empty() else "%s %.1f %%" % [LABELS[i], _sums[i] * 100.0]
		draw_string(font, Vector2(0.0, size.y - font.get_descent(font_size)), text, alignments[i], size.x,
				font_size, Color(ink, 0.8))


func _draw_bars(floor_y: float, accent: Color) -> void:
	var most := 0.0
	for share in shares:
		most = maxf(most, share)
	if most <= 0.0:
		return
	var step := size.x / shares.size()
	for bin in shares.size():
		if shares[bin] <= 0.0:
			continue
		# A bar with a share above 0 is at least one pixel high.
		var height := maxf(sqrt(shares[bin] / most) * (floor_y - 4.0), 1.0)
		var bar := Rect2(bin * step + GAP / 2.0, floor_y - height, maxf(step - GAP, 1.0), height)
		draw_rect(bar, Color(accent, 1.0 if bin == _hovered else 0.75))

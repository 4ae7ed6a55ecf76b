@tool
extends EditorSyntaxHighlighter
## Syntax highlighting of grammars in the script editor.

const DECLARATIONS: Array[String] = [
	"domain", "expect", "field", "import", "layer", "let", "morphic", "override", "param", "report", "rule", "seed",
	"sgm", "start", "units",
]
const CONTROL: Array[String] = [
	"and", "as", "by", "depth", "else", "for", "if", "in", "lod", "minsize", "not", "or", "query", "repeat", "then",
	"weight", "when",
]
const OPERATIONS: Array[String] = [
	"anchor", "at", "comp", "cut", "detail", "displace", "extrude", "fit", "footprint", "inner", "link", "mat", "meet",
	"mirror", "morph", "roof", "rot", "scale", "scatter", "size", "snap", "split", "sum", "tag", "treemap", "union",
	"warp", "wfc",
]
const SHAPES: Array[String] = [
	"beam", "blob", "box", "ca", "capsule", "cylinder", "ellipsoid", "halfspace", "prism", "sphere", "superq", "torus",
	"truncone", "tube",
]
const VALUES: Array[String] = ["cell", "false", "p", "q", "scope", "true", "u"]
const CLAUSES: Array[String] = [
	"above", "air", "amp", "animated", "axes", "block", "border", "clear", "corridor", "density", "disc", "door", "down",
	"edge", "empty", "facade", "finite", "flat", "from", "gable", "gap", "hip", "infinite", "inside", "lerp", "meets",
	"merge", "of", "on", "output", "per", "poisson", "polygon", "power", "probe", "reach", "rect", "regular", "shell",
	"smooth", "solid", "stretch", "turn", "up", "uses", "within",
]
const UNITS: Array[String] = ["cm", "deg", "km", "m", "mm", "rad"]
## The editor setting that contains the color for each kind of word.
const COLORS := {
	comment = "comment_color", text = "string_color", number = "number_color", unit = "member_variable_color",
	declaration = "keyword_color", control = "control_flow_keyword_color", operation = "keyword_color",
	shape = "engine_type_color", value = "base_type_color", clause = "member_variable_color",
	rule = "user_type_color", call = "function_color", symbol = "symbol_color", plain = "text_color",
}
const PATTERN := ("(?<comment>//.*)|(?<text>\"(?:\\\\.|[^\"\\\\])*\"?)" +
		"|(?<number>\\d+(?:\\.(?!\\.)\\d+)?(?:[eE][+-]?\\d+)?)(?<unit>[A-Za-z]+\\d?|%)?" +
		"|(?<word>[A-Za-z_]\\w*)|(?<symbol>[^\\s\\w\"]+?)")

var _regex := RegEx.create_from_string(PATTERN)
var _kinds := {}


func _init() -> void:
	_learn(CLAUSES, "clause")
	_learn(UNITS, "unit")
	_learn(VALUES, "value")
	_learn(SHAPES, "shape")
	_learn(OPERATIONS, "operation")
	_learn(CONTROL, "control")
	_learn(DECLARATIONS, "declaration")


func _get_name() -> String:
	return "SG+M"


func _get_supported_languages() -> PackedStringArray:
	return ["sgm"]


func _get_line_syntax_highlighting(line: int) -> Dictionary:
	var text := get_text_edit().get_line(line)
	var colors := {}
	for found in kinds_of(text):
		colors[found[0]] = {color = color_of(found[1])}
	return colors


## Returns the parts of a line in order: for each part, the column where it begins, and its kind.
func kinds_of(text: String) -> Array[Array]:
	var parts: Array[Array] = []
	for found in _regex.search_all(text):
		for group: String in ["comment", "text", "number", "unit", "symbol"]:
			if found.get_start(group) >= 0 and not found.get_string(group).is_empty():
				parts.append([found.get_start(group), group])
		if found.get_start("word") >= 0:
			parts.append([found.get_start(), _kind_of_word(found.get_string(), text, found.get_end())])
	return parts


func color_of(kind: String) -> Color:
	return EditorInterface.get_editor_settings().get_setting("text_editor/theme/highlighting/" + COLORS[kind])


func _learn(words: Array[String], kind: String) -> void:
	for word in words:
		_kinds[word] = kind


func _kind_of_word(word: String, text: String, end: int) -> String:
	if word in _kinds:
		return _kinds[word]
	if word[0] >= "A" and word[0] <= "Z":
		return "rule"
	return "call" if text.substr(end).strip_edges(true, false).begins_with("(") else "plain"

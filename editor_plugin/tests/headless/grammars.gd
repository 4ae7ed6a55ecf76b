extends SceneTree
## Tests grammars as resources: loading, saving, checking, imports, errors with their lines, and reloading of changed
## files.

const Checks := preload("res://tests/lib/checks.gd")
const FOLDER := "user://grammars_test"
const GOOD := "sgm 1;\nparam girth = 2m in 1m..4m \"of the ball\";\nparam count = 3 in 1..5;\nstart sphere(girth);\n"

var _checks := Checks.new()


func _initialize() -> void:
	DirAccess.make_dir_recursive_absolute(FOLDER)
	_loads()
	_checks_texts()
	_saves()
	_imports()
	_keeps_the_last_good_text()
	_follows_its_file()
	await _checks.finish(self)


func _loads() -> void:
	var grammar := load("res://tests/grammars/cave.sgm") as SgmGrammar
	if not _checks.check(grammar != null and grammar.is_valid(), "the demo's cave is loaded"):
		return
	_checks.equal(grammar.get_error_text(), "", "its error")
	_checks.check(grammar.get_materials().has("limestone"), "its materials: %s" % grammar.get_materials())
	_checks.check(grammar.get_domain().infinite, "its domain is infinite")
	var boxy: Dictionary = grammar.get_parameters().filter(func(p: Dictionary) -> bool: return p.name == "boxy")[0]
	_checks.equal([boxy.minimum, boxy.maximum, boxy.default, boxy.quantity], [0.0, 1.0, 0.3, "number"], "boxy")
	_checks.check(ResourceLoader.exists("res://tests/grammars/cave.sgm"), "the engine knows that it is there")
	_checks.check(load("res://tests/grammars/cave.sgm") == grammar, "the engine keeps one of it")
	_checks.check(not grammar.get_version().is_empty() and not grammar.get_build_info().is_empty(), "versions")


func _checks_texts() -> void:
	var grammar := SgmGrammar.new()
	grammar.text = GOOD
	_checks.check(grammar.is_valid(), "a text compiles")
	var count: Dictionary = grammar.get_parameters()[1]
	_checks.equal([count.name, count.minimum, count.maximum], ["count", 1.0, 5.0], "a parameter")
	var girth: Dictionary = grammar.get_parameters()[0]
	_checks.equal([girth.quantity, girth.doc, girth.maximum], ["length", "of the ball", 4.0], "a length")
	var found := grammar.check("sgm 1;\nstart spere(1m);\n")
	_checks.equal(found.size(), 1, "errors of a wrong text")
	_checks.equal([found[0].severity, found[0].line, found[0].column], ["error", 2, 7], "its place")
	_checks.check(found[0].hint.contains("sphere"), "its hint: %s" % found[0].hint)
	_checks.equal(grammar.text, GOOD, "checking changes nothing")
	var meaning := grammar.get_meaning_hash()
	grammar.text = GOOD + "// a comment\n"
	_checks.equal(grammar.get_meaning_hash(), meaning, "a comment changes no meaning")
	grammar.text = GOOD.replace("sphere", "box")
	_checks.check(meaning != 0 and grammar.get_meaning_hash() != meaning, "another shape does")
	_checks.equal(SgmGrammar.new().get_meaning_hash(), 0, "without a text")
	grammar.text = GOOD


func _saves() -> void:
	var grammar := SgmGrammar.new()
	grammar.text = GOOD
	var path := FOLDER + "/saved.sgm"
	_checks.equal(ResourceSaver.save(grammar, path), OK, "saving")
	_checks.equal(FileAccess.get_file_as_string(path), GOOD, "what was saved")
	var again := ResourceLoader.load(path, "", ResourceLoader.CACHE_MODE_IGNORE) as SgmGrammar
	_checks.check(again != null and again.is_valid() and again.text == GOOD, "what is loaded again")
	_checks.expect_error("cannot be written")
	_checks.check(ResourceSaver.save(grammar, "user://no/such/folder/x.sgm") != OK, "saving where there is no folder")


func _imports() -> void:
	_write("parts.sgm", "sgm 1;\nrule Ball { sphere(1m); }\n")
	_write("whole.sgm", "sgm 1;\nimport \"parts.sgm\" as parts;\nstart parts.Ball;\n")
	var grammar := ResourceLoader.load(FOLDER + "/whole.sgm") as SgmGrammar
	_checks.check(grammar != null and grammar.is_valid(), "a grammar that imports one beside it: " + grammar.get_error_text())
	_checks.equal(ResourceLoader.get_dependencies(FOLDER + "/whole.sgm"), PackedStringArray([FOLDER + "/parts.sgm"]),
			"what an export has to take along")
	_checks.expect_error("whole2.sgm:2:")
	_write("whole2.sgm", "sgm 1;\nimport \"none.sgm\" as parts;\nstart parts.Ball;\n")
	var broken := ResourceLoader.load(FOLDER + "/whole2.sgm") as SgmGrammar
	_checks.check(broken != null and not broken.is_valid(), "an import that is missing is an error of the text")


func _keeps_the_last_good_text() -> void:
	_checks.expect_error("grammar:2:7: unknown name")
	var grammar := SgmGrammar.new()
	var changes := [0]
	grammar.changed.connect(func() -> void: changes[0] += 1)
	grammar.text = GOOD
	grammar.text = "sgm 1;\nstart Nowhere;\n"
	_checks.check(not grammar.is_valid(), "a wrong text is not valid")
	_checks.equal(grammar.get_parameters().size(), 2, "the last good one's parameters")
	_checks.check(grammar.get_error_text().begins_with("grammar:2:7: "), "the error's place: " + grammar.get_error_text())
	_checks.equal(changes[0], 2, "changes that were told")


func _follows_its_file() -> void:
	_write("followed.sgm", GOOD)
	var grammar := ResourceLoader.load(FOLDER + "/followed.sgm") as SgmGrammar
	_write("followed.sgm", GOOD.replace("1..5", "1..7"))
	_checks.equal(grammar.reload(), OK, "reading the file again")
	_checks.equal(grammar.get_parameters()[1].maximum, 7.0, "what the file says now")
	_checks.expect_error("cannot be read")
	DirAccess.remove_absolute(FOLDER + "/followed.sgm")
	_checks.check(grammar.reload() != OK, "a file that has gone")
	_checks.check(grammar.is_valid() and grammar.get_parameters()[1].maximum == 7.0, "goes on as it was")


func _write(file: String, text: String) -> void:
	FileAccess.open(FOLDER + "/" + file, FileAccess.WRITE).store_string(text)

extends RefCounted
## Counts the checks of one test, and prints the marker at its end. A test that does not reach its end has no marker and
## fails.
##
## The harness (tests/run.sh) searches the output for `SGM TEST PASSED: N checks`, and for errors in the engine's log
## other than those that the test has announced with [method expect_error].

var _passed := 0
var _failed := 0


## Counts a check; if it fails, prints what was expected.
func check(condition: bool, text: String) -> bool:
	if condition:
		_passed += 1
	else:
		_failed += 1
		print("SGM CHECK FAILED: ", text)
	return condition


## As [method check], for equality; prints both values if they differ.
func equal(got: Variant, wanted: Variant, text: String) -> bool:
	return check(got == wanted, "%s: got %s, wanted %s" % [text, got, wanted])


func near(got: float, wanted: float, tolerance: float, text: String) -> bool:
	return check(absf(got - wanted) <= tolerance, "%s: got %f, wanted %f +- %f" % [text, got, wanted, tolerance])


## Announces an error in the engine's log. The error must occur, and does not fail the test.
func expect_error(pattern: String) -> void:
	print("SGM TEST EXPECTS: ", pattern)


## Prints the marker and quits, after all freed nodes have been destroyed.
func finish(tree: SceneTree) -> void:
	for i in 3:
		await tree.process_frame
	if _failed == 0 and _passed > 0:
		print("SGM TEST PASSED: %d checks" % _passed)
	else:
		print("SGM TEST FAILED: %d of %d checks" % [_failed, _failed + _passed])
	tree.quit(0 if _failed == 0 and _passed > 0 else 1)

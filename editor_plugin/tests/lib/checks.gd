extends RefCounted
## Checks of one test, and the marker that it ends with: a test that does not reach it has failed.
##
## The harness (tests/run.sh) looks for `SGM TEST PASSED: N checks`, and for errors in the engine's log other than those
## that the test has announced with [method expect_error].

var _passed := 0
var _failed := 0


## Counts a check; prints what was expected where it does not hold.
func check(condition: bool, text: String) -> bool:
	if condition:
		_passed += 1
	else:
		_failed += 1
		print("SGM CHECK FAILED: ", text)
	return condition


## As [method check], with both values in the message.
func equal(got: Variant, wanted: Variant, text: String) -> bool:
	return check(got == wanted, "%s: got %s, wanted %s" % [text, got, wanted])


func near(got: float, wanted: float, tolerance: float, text: String) -> bool:
	return check(absf(got - wanted) <= tolerance, "%s: got %f, wanted %f +- %f" % [text, got, wanted, tolerance])


## Announces a line of the engine's log that would fail the test otherwise, and has to come.
func expect_error(pattern: String) -> void:
	print("SGM TEST EXPECTS: ", pattern)


## Prints the marker and ends the program, once everything that was freed is gone.
func finish(tree: SceneTree) -> void:
	for i in 3:
		await tree.process_frame
	if _failed == 0 and _passed > 0:
		print("SGM TEST PASSED: %d checks" % _passed)
	else:
		print("SGM TEST FAILED: %d of %d checks" % [_failed, _failed + _passed])
	tree.quit(0 if _failed == 0 and _passed > 0 else 1)

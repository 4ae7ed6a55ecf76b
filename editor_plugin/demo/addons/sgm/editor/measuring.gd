@tool
extends RefCounted
## One measurement of a world's drawn chunks, in a thread of the engine's worker pool.

const NO_TASK := -1

var _task := NO_TASK
var _measures := {}


func start(world: SgmWorld3D, bins: int) -> void:
	_task = WorkerThreadPool.add_task(_run.bind(world, bins), false, "SG+M: measure what is drawn")


func is_busy() -> bool:
	return _task != NO_TASK


func is_done() -> bool:
	return is_busy() and WorkerThreadPool.is_task_completed(_task)


## Waits for the measurement, if one is running, and returns its result; empty if it failed.
func finish() -> Dictionary:
	if is_busy():
		WorkerThreadPool.wait_for_task_completion(_task)
		_task = NO_TASK
	var measures := _measures
	_measures = {}
	return measures


func _run(world: SgmWorld3D, bins: int) -> void:
	_measures = world.measure_drawn(bins)

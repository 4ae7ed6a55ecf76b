extends "res://tests/rendered/closed.gd"
## The same on the Compatibility renderer, whose vertices come another way, and which takes longer for each look.


func _init() -> void:
	metres = 40.0

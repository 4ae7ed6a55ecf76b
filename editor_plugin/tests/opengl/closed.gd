extends "res://tests/rendered/closed.gd"
## The same on the Compatibility renderer, whose vertices come another way. In software it takes far longer for each
## look, so there are fewer of them.


func _init() -> void:
	metres = 40.0
	step = 3.0

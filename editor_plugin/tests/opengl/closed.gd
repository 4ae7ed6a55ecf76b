extends "res://tests/rendered/closed.gd"
## The test of rendered/closed.gd with the Compatibility renderer (OpenGL), which receives vertices in another format. A
## software renderer takes far longer for its pictures, so the flight is shorter and has fewer pictures.


func _init() -> void:
	metres = 40.0
	step = 3.0

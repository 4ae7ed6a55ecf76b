extends "res://tests/rendered/closed.gd"
## The same test with the Compatibility renderer (OpenGL), which receives vertices in another format. Pictures take far
## longer in software, so the test draws fewer.
## look, so there are fewer of them.


func _init() -> void:
	metres = 40.0
	step = 3.0

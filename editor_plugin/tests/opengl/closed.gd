extends "res://tests/rendered/closed.gd"
## The same on the Compatibility renderer, whose vertices come another way.

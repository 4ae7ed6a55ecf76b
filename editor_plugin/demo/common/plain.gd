class_name DemoPlain
extends MeshInstance3D
## Level ground up to the horizon, below the drawn world. It follows the camera.


func _process(_delta: float) -> void:
	var camera := get_viewport().get_camera_3d()
	if camera != null:
		global_position = Vector3(camera.global_position.x, global_position.y, camera.global_position.z)

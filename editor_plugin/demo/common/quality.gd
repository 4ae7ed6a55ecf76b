class_name DemoQuality
extends RefCounted
## What the machine can draw at a good rate.


## For pictures and films, which may take their time: all is drawn as with a graphics card.
static var always_fast := false


## Whether there is a graphics card of its own, and the renderer that can use it to the full.
static func is_fast() -> bool:
	var method: String = ProjectSettings.get_setting("rendering/renderer/rendering_method")
	return always_fast or (
		method == "forward_plus"
		and RenderingServer.get_rendering_device() != null
		and RenderingServer.get_video_adapter_type() == RenderingDevice.DEVICE_TYPE_DISCRETE_GPU
	)


## Turns on what makes a picture better and costs time.
static func apply(viewport: Viewport, environment: Environment) -> void:
	var fast := is_fast()
	viewport.msaa_3d = Viewport.MSAA_4X if fast else Viewport.MSAA_DISABLED
	viewport.screen_space_aa = Viewport.SCREEN_SPACE_AA_DISABLED if fast else Viewport.SCREEN_SPACE_AA_FXAA
	environment.ssao_enabled = fast
	environment.ssil_enabled = fast
	environment.ssr_enabled = fast and environment.ssr_max_steps > 0
	if environment.sky != null and not fast:
		for parameter: String in ["has_cumulus", "has_cirrus"]:
			(environment.sky.sky_material as ShaderMaterial).set_shader_parameter(parameter, false)

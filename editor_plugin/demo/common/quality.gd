class_name DemoQuality
extends RefCounted
## Decides how much detail the machine can draw at a good frame rate.


## True: uses the full quality on any machine. Set for pictures and films, which are not drawn in real time.
static var always_fast := false


## Whether the machine has a dedicated graphics card, and the project a renderer that makes full use of it.
static func is_fast() -> bool:
	var method: String = ProjectSettings.get_setting("rendering/renderer/rendering_method")
	return always_fast or (
		method == "forward_plus"
		and RenderingServer.get_rendering_device() != null
		and RenderingServer.get_video_adapter_type() == RenderingDevice.DEVICE_TYPE_DISCRETE_GPU
	)


## Enables effects that improve the picture but cost time.
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

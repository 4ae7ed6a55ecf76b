#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_shuffle : require

// Requires no rounding mode, for devices on which a shader cannot require one: they round to nearest, or are reported
// as not exact.
#include "mesher/attributes.glsl"

#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_shuffle : require

// A variant of the shader that does not require a rounding mode, for devices that do not support such a requirement.
// These devices are reported as not exact.
#include "mesher/sample.glsl"

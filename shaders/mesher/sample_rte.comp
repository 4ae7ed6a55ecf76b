#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_shuffle : require
#extension GL_EXT_spirv_intrinsics : require

// Requires rounding to nearest even for 32-bit floats (SPIR-V capability and execution mode RoundingModeRTE; arithmetic
// contract, rule 6), for devices that have shaderRoundingModeRTEFloat32.
spirv_execution_mode(capabilities = [4467], 4462, 32);
#include "mesher/sample.glsl"

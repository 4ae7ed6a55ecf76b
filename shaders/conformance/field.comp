#version 450
#extension GL_GOOGLE_include_directive : require
// Requires no rounding mode, for devices on which a shader cannot require one: they round to nearest, or are reported
// as not exact.
#include "conformance/field.glsl"

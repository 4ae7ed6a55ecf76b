#version 450
#extension GL_GOOGLE_include_directive : require
// For devices that cannot be asked for a rounding: they round to nearest or are reported as not exact.
#include "conformance/field.glsl"

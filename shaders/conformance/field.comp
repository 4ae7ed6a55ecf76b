#version 450
#extension GL_GOOGLE_include_directive : require
// For devices on which a shader cannot require a rounding mode: they round to nearest, or are reported as not exact.
#include "conformance/field.glsl"

// The push constants for drawing blades and leaves; runtime/tools/render/foliage.h defines the same layout.
layout(push_constant) uniform Foliage {
  mat4 view_projection;
  vec4 eye;     // metres from the scene's origin; w: width of a sample at distance 1
  // vector from the scene's origin to that of the patterns; w: distance in metres up to which blades are drawn
  vec4 offset;
};

// Returns 1 near the eye, where blades contrast with the dark ground between them, and 0 far away, where all has the
// mean brightness.
float nearness(float t) { return 1.0 - smoothstep(0.3, 0.75, t / offset.w); }

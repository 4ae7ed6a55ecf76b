// The push constants for drawing blades of grass and leaves; runtime/tools/render/foliage.h defines the same layout.
layout(push_constant) uniform Foliage {
  mat4 view_projection;
  vec4 eye;     // eye, in metres from the scene's origin; w: width of a sample at distance 1
  // vector from the scene's origin to the patterns' origin; w: maximum distance in metres at which blades are drawn
  vec4 offset;
};

// Returns 1 near the eye, where bright blades contrast with dark ground, falling to 0 far away, where only the mean
// brightness is visible. t: distance in metres.
float nearness(float t) { return 1.0 - smoothstep(0.3, 0.75, t / offset.w); }

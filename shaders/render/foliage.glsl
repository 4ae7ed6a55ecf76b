// What the drawing of blades and leaves is told: runtime/tools/render/foliage.h lays it out.
layout(push_constant) uniform Foliage {
  mat4 view_projection;
  vec4 eye;     // metres from the scene's origin; w: a sample's width at distance 1
  vec4 offset;  // from the scene's origin to where patterns begin; w: metres to the farthest blades
};

// Blades that are near stand out from the dark ground between them; far away all is as bright as it is on a mean.
float nearness(float t) { return 1.0 - smoothstep(0.3, 0.75, t / offset.w); }

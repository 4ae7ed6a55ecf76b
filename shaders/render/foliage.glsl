// What the drawing of blades and leaves is told: runtime/cli/render/foliage.h lays it out.
layout(push_constant) uniform Foliage {
  mat4 view_projection;
  vec4 eye;     // metres from the scene's origin; w: a sample's width at distance 1
  vec4 offset;  // from the scene's origin to where patterns begin; w: metres that a layer's blades or leaves reach up
  vec4 kind;    // x: 0 blades, 1 leaves; y: layers; z: metres to the farthest; w: metres that they reach down
};

// Calls the shading function of a surface pattern. The numbers of patterns are those of SurfacePattern in
// runtime/tools/materials/material.h.
#include "render/material/surface.glsl"
#include "render/material/stone.glsl"
#include "render/material/masonry.glsl"
#include "render/material/worked.glsl"
#include "render/material/ground.glsl"
#include "render/material/fluid.glsl"

// Mask of the patterns that occur in the scene, one bit each; the highest bit is for the sky. Branches for other
// patterns depend only on this constant, so they are removed before a driver compiles the shader.
layout(constant_id = 0) const uint kPatterns = 0xFFFFFFFFu;
const uint kSkyBit = 31u;
#define has(pattern) ((kPatterns >> (pattern) & 1u) != 0u)

Surface patterned(uint pattern, Spot at) {
  if (has(0u)) { if (pattern == 0u) return rock(at); }
  if (has(1u)) { if (pattern == 1u) return speckled(at); }
  if (has(2u)) { if (pattern == 2u) return veined(at); }
  if (has(3u)) { if (pattern == 3u) return flowstone(at); }
  if (has(4u)) { if (pattern == 4u) return brickwork(at); }
  if (has(5u)) { if (pattern == 5u) return ashlar(at); }
  if (has(6u)) { if (pattern == 6u) return rubble(at); }
  if (has(7u)) { if (pattern == 7u) return paving(at); }
  if (has(8u)) { if (pattern == 8u) return cobbles(at); }
  if (has(9u)) { if (pattern == 9u) return roofTiles(at); }
  if (has(10u)) { if (pattern == 10u) return slates(at); }
  if (has(11u)) { if (pattern == 11u) return plain(at); }
  if (has(12u)) { if (pattern == 12u) return concrete(at); }
  if (has(13u)) { if (pattern == 13u) return wooden(at); }
  if (has(14u)) { if (pattern == 14u) return metallic(at); }
  if (has(15u)) { if (pattern == 15u) return asphalt(at); }
  if (has(16u)) { if (pattern == 16u) return glazed(at); }
  if (has(17u)) { if (pattern == 17u) return windblown(at); }
  if (has(18u)) { if (pattern == 18u) return gravelly(at); }
  if (has(19u)) { if (pattern == 19u) return grassy(at); }
  if (has(20u)) { if (pattern == 20u) return leafy(at); }
  if (has(21u)) { if (pattern == 21u) return fibrous(at); }
  if (has(22u)) { if (pattern == 22u) return mossy(at); }
  if (has(23u)) { if (pattern == 23u) return water(at); }
  if (has(25u)) { if (pattern == 25u) return boarded(at); }
  if (has(26u)) { if (pattern == 26u) return glowing(at); }
  if (has(27u)) { if (pattern == 27u) return lying(at); }
  if (has(28u)) { if (pattern == 28u) return lava(at); }
  if (has(29u)) { if (pattern == 29u) return leaded(at); }
  if (has(24u)) return vapour(at);
  return surfaceOf(at);
}

// What each pattern looks like. Numbers as SurfacePattern has them, runtime/materials/material.h.
#include "render/material/surface.glsl"
#include "render/material/stone.glsl"
#include "render/material/masonry.glsl"
#include "render/material/worked.glsl"
#include "render/material/ground.glsl"
#include "render/material/fluid.glsl"

// A bit for each pattern that the scene has, and the highest for a sky: the others are not compiled.
layout(constant_id = 0) const uint kPatterns = 0xFFFFFFFFu;
const uint kSkyBit = 31u;
bool has(uint pattern) { return (kPatterns >> pattern & 1u) != 0u; }

Surface patterned(uint pattern, Spot at) {
  if (pattern == 0u && has(0u)) return rock(at);
  if (pattern == 1u && has(1u)) return speckled(at);
  if (pattern == 2u && has(2u)) return veined(at);
  if (pattern == 3u && has(3u)) return flowstone(at);
  if (pattern == 4u && has(4u)) return brickwork(at);
  if (pattern == 5u && has(5u)) return ashlar(at);
  if (pattern == 6u && has(6u)) return rubble(at);
  if (pattern == 7u && has(7u)) return paving(at);
  if (pattern == 8u && has(8u)) return cobbles(at);
  if (pattern == 9u && has(9u)) return roofTiles(at);
  if (pattern == 10u && has(10u)) return slates(at);
  if (pattern == 11u && has(11u)) return plain(at);
  if (pattern == 12u && has(12u)) return concrete(at);
  if (pattern == 13u && has(13u)) return wooden(at);
  if (pattern == 14u && has(14u)) return metallic(at);
  if (pattern == 15u && has(15u)) return asphalt(at);
  if (pattern == 16u && has(16u)) return glazed(at);
  if (pattern == 17u && has(17u)) return granular(at);
  if (pattern == 18u && has(18u)) return gravelly(at);
  if (pattern == 19u && has(19u)) return grassy(at);
  if (pattern == 20u && has(20u)) return leafy(at);
  if (pattern == 21u && has(21u)) return fibrous(at);
  if (pattern == 22u && has(22u)) return mossy(at);
  if (pattern == 23u && has(23u)) return water(at);
  if (pattern == 25u && has(25u)) return boarded(at);
  if (pattern == 26u && has(26u)) return glowing(at);
  if (pattern == 27u && has(27u)) return lying(at);
  if (pattern == 28u && has(28u)) return lava(at);
  if (pattern == 29u && has(29u)) return leaded(at);
  if (has(24u)) return vapour(at);
  return surfaceOf(at);
}

#pragma once
// The only table of materials: the appearance of a grammar's `mat NAME` in every renderer, that is, in the command's
// renderer and in the Godot plugin. It has no dependencies, so that any program can compile it.

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace sgm {

/// The procedural pattern of a surface; shaders/render/materials.glsl and patterns.h use the same numbers.
enum class SurfacePattern : uint32_t {
  rock,        ///< strata, mineral stains, cracks; silt on flat surfaces
  speckled,    ///< grains of several colours: granite
  veined,      ///< marble
  flow,        ///< calcite and other flowstone: fluted, pale, wet
  brick,       ///< courses with mortar
  ashlar,      ///< courses of dressed stone
  rubble,      ///< walling of rough stones
  paving,      ///< flagstones
  cobbles,     ///< setts
  roof_tiles,  ///< rows of clay tiles
  slates,
  plain,  ///< colour with a fine grain, stained by rain: plaster, paint, clay
  concrete,
  wooden,
  metallic,
  asphalt,
  glass,     ///< a pane that mirrors, with a scene behind it (see kRoomBehind)
  granular,  ///< sand, soil, mud, snow
  gravelly,
  grassy,
  leafy,   ///< foliage: broad leaves if relief is at least 0.9, otherwise needles
  fibres,  ///< bark, thatch
  mossy,
  water,  ///< reflects its surroundings; darker with depth
  /// Soft white; under a sky drawn as a participating medium that the mesh bounds: roughness sets its density, relief
  /// the strength of its puffs.
  cloud,
  boards,   ///< wood, boards side by side
  glowing,  ///< emits light: the pane of a lit lantern, embers
  lying,    ///< wood with horizontal grain: beams, planks, sleepers
  lava,     ///< frozen basalt: dark crust, glazed and rusty in patches, cracked on floors
  leaded,   ///< small panes of stained glass in strips of lead, which transmit light
};

/// The scene behind a pane of glass, as a value of MaterialLook::relief: a living room, the real scene, a shop, an
/// office, a curtain or a blind close behind the pane.
constexpr float kRoomBehind = 0, kClearPane = 1, kShopBehind = 2, kOfficeBehind = 3, kCurtainBehind = 4,
                kBlindBehind = 5;

struct MaterialLook {
  SurfacePattern pattern = SurfacePattern::rock;
  std::array<float, 3> colour{0.42f, 0.37f, 0.31f};  ///< linear RGB, each 0..1
  float roughness = 0.75f;                           ///< 0.05..1
  /// Strength of the shading relief, 0: as smooth as the mesh. For glass, the scene behind the pane.
  float relief = 1;
};

/// The look of a name in the table ("plaster"), also tinted by a final word ("plaster_ochre") or wet ("wet_limestone").
/// Returns nullopt if the name is unknown.
std::optional<MaterialLook> findLook(std::string_view name);
/// As findLook(), but any name gets a look: an unknown name gets the look of its first word in the table
/// ("old_brick_wall": brick), otherwise of the first synonym in it ("road": asphalt), otherwise of rock with a tint
/// that depends on the name.
MaterialLook lookOf(std::string_view name);

}  // namespace sgm

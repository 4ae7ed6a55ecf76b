#pragma once
// The only table of materials: the look of a grammar's `mat NAME` in every renderer. The command's renderer and the
// Godot plugin use it, and baked textures will. It has no dependencies, so that any program can compile it.

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
  glass,     ///< a pane that mirrors, with a room or something else behind
  granular,  ///< sand, soil, mud, snow
  gravelly,
  grassy,
  leafy,   ///< broad leaves if relief is at least 0.9, otherwise needles
  fibres,  ///< bark, thatch
  mossy,
  water,    ///< mirrors; darker with depth
  cloud,    ///< soft white; under a sky it is drawn as a medium, with the mesh as its outline: roughness sets its
            ///< density, relief its puffs
  boards,   ///< wood, boards side by side
  glowing,  ///< emits light: the pane of a lit lantern, embers
  lying,    ///< wood with horizontal grain: beams, planks, sleepers
  lava,     ///< frozen basalt: dark crust, glazed and rusty in patches, cracked on floors
  leaded,   ///< small panes of stained glass in strips of lead, which transmit light
};

/// The scene behind a pane of glass, given by its look's relief: a living room, the real scene, a shop, an office, a
/// curtain or a blind close behind the pane.
constexpr float kRoomBehind = 0, kClearPane = 1, kShopBehind = 2, kOfficeBehind = 3, kCurtainBehind = 4,
                kBlindBehind = 5;

struct MaterialLook {
  SurfacePattern pattern = SurfacePattern::rock;
  std::array<float, 3> colour{0.42f, 0.37f, 0.31f};  ///< linear, 0..1
  float roughness = 0.75f;                           ///< 0.05..1
  /// Strength of the shading relief, 0: as smooth as the mesh; for glass, the scene behind it.
  float relief = 1;
};

/// The look of a name: from the table ("plaster"), tinted by a final word ("plaster_ochre") or wet ("wet_limestone").
/// nullopt if the name is unknown.
std::optional<MaterialLook> findLook(std::string_view name);
/// The same; an unknown name gets the look of its first word that is in the table ("old_brick_wall": brick), otherwise
/// of its first synonym ("road": asphalt), otherwise of rock with its own tint.
MaterialLook lookOf(std::string_view name);

}  // namespace sgm

#pragma once
// The table of materials: maps the name in a grammar's `mat NAME` to an appearance, for all renderers (the command's
// renderer and the Godot plugin). It has no dependencies, so that any program can compile it.

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace sgm {

/// The procedural pattern of a surface. The numeric values must equal those in shaders/render/materials.glsl and
/// patterns.h.
enum class SurfacePattern : uint32_t {
  rock,        ///< strata, mineral stains, cracks; silt on flat surfaces
  speckled,    ///< grains of several colours: granite
  veined,      ///< marble
  flow,        ///< calcite and other flowstone: fluted, pale, wet
  brick,       ///< brick courses with mortar joints
  ashlar,      ///< courses of dressed (squared) stone
  rubble,      ///< wall of rough, irregular stones
  paving,      ///< flagstones
  cobbles,     ///< setts
  roof_tiles,  ///< rows of clay tiles
  slates,
  plain,  ///< colour with a fine grain, stained by rain: plaster, paint, clay
  concrete,
  wooden,
  metallic,
  asphalt,
  glass,     ///< a reflecting pane, with a scene behind it (see kRoomBehind)
  granular,  ///< sand, soil, mud, snow
  gravelly,
  grassy,
  leafy,   ///< foliage: broad leaves if relief is at least 0.9, otherwise needles
  fibres,  ///< bark, thatch
  mossy,
  water,  ///< reflects its surroundings; darker with depth
  /// Soft white. If the renderer draws a sky, the mesh bounds a participating medium instead: roughness determines its
  /// density, relief the strength of its puffs.
  cloud,
  boards,   ///< wooden boards side by side
  glowing,  ///< emits light: the pane of a lit lantern, embers
  lying,    ///< wood with horizontal grain: beams, planks, sleepers
  lava,     ///< frozen basalt: dark crust, glazed and rusty in patches, cracked on floors
  leaded,   ///< small panes of stained glass, framed by strips of lead; the panes transmit light
};

/// Values of MaterialLook::relief for glass, which select what is visible through the pane: a painted living room, the
/// real scene (clear glass), a shop, an office, or a curtain or blind close behind the pane.
constexpr float kRoomBehind = 0, kClearPane = 1, kShopBehind = 2, kOfficeBehind = 3, kCurtainBehind = 4,
                kBlindBehind = 5;

struct MaterialLook {
  SurfacePattern pattern = SurfacePattern::rock;
  std::array<float, 3> colour{0.42f, 0.37f, 0.31f};  ///< linear RGB, each 0..1
  float roughness = 0.75f;                           ///< 0.05..1
  /// Strength of the shading relief; 0: as smooth as the mesh. For glass, selects the scene behind the pane.
  float relief = 1;
};

/// The look of a material name in the table ("plaster"), optionally with a tint as the last word ("plaster_ochre") or
/// with the prefix "wet_" ("wet_limestone"). Returns nullopt if the name is unknown.
std::optional<MaterialLook> findLook(std::string_view name);
/// The look of any material name. If findLook() does not know the name, its first word that is in the table gives the
/// look ("old_brick_wall": brick). If there is none, its first synonym does ("road": asphalt). If there is none either,
/// the look is rock with a tint that depends on the name.
MaterialLook lookOf(std::string_view name);

}  // namespace sgm

#pragma once
// The one table of materials: what a grammar's `mat NAME` looks like, whoever draws it. The command's renderer and the
// Godot plugin read it, and textures that are baked will. It depends on nothing, so that any program can compile it.

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace sgm {

/// The procedural pattern that a surface is covered with; shaders/render/materials.glsl and patterns.h have its number.
enum class SurfacePattern : uint32_t {
  rock,        ///< strata, mineral stains, cracks; silt on what lies flat
  speckled,    ///< grains of several colours: granite
  veined,      ///< marble
  flow,        ///< calcite and other flowstone: fluted, pale, wet
  brick,       ///< courses with mortar
  ashlar,      ///< courses of dressed stone
  rubble,      ///< walling of rough stones
  paving,      ///< flags
  cobbles,     ///< setts
  roof_tiles,  ///< rows of clay tiles
  slates,
  plain,  ///< colour with a fine grain, stained by rain: plaster, paint, clay
  concrete,
  wooden,
  metallic,
  asphalt,
  glass,     ///< a pane that mirrors, with a room or something else behind it
  granular,  ///< sand, soil, mud, snow
  gravelly,
  grassy,
  leafy,   ///< broad leaves where relief is 0.9 or more, else needles
  fibres,  ///< bark, thatch
  mossy,
  water,    ///< mirrors; the deeper the darker
  cloud,    ///< soft white; under a sky a medium is drawn, and the mesh is its outline:
            ///< the denser the rougher, and the more puffs the more relief
  boards,   ///< wood, a board beside the other
  glowing,  ///< shines by itself: the pane of a lit lantern, embers
  lying,    ///< wood whose grain runs level: beams, planks, sleepers
  lava,     ///< basalt as it ran and froze: dark crust, glazed and rusty in patches, cracked on floors
  leaded,   ///< small panes of stained glass in strips of lead, which let light through
};

/// What lies behind a pane of glass, as its look's relief says: a room to live in, whatever there is, a shop, an
/// office, or a curtain or a blind that hangs close behind it.
constexpr float kRoomBehind = 0, kClearPane = 1, kShopBehind = 2, kOfficeBehind = 3, kCurtainBehind = 4,
                kBlindBehind = 5;

struct MaterialLook {
  SurfacePattern pattern = SurfacePattern::rock;
  std::array<float, 3> colour{0.42f, 0.37f, 0.31f};  ///< linear, 0..1
  float roughness = 0.75f;                           ///< 0.05..1
  /// Strength of the shading relief, 0: as smooth as the mesh; of glass, what lies behind it.
  float relief = 1;
};

/// The look of a name: one of the table ("plaster"), tinted by a word behind it ("plaster_ochre") or wet
/// ("wet_limestone"). nullopt: the name is unknown.
std::optional<MaterialLook> findLook(std::string_view name);
/// The same; a name that is not known looks as the first of its words that is ("old_brick_wall" as brick), then as the
/// first that means a material ("road" as asphalt), and else as rock in a tint of its own.
MaterialLook lookOf(std::string_view name);

}  // namespace sgm

#include "tools/render/scene.h"

namespace sgm {
namespace {

namespace shaders {
using uint = uint32_t;
#include "render/patterns.h"
}  // namespace shaders

constexpr bool is(SurfacePattern pattern, uint32_t number) { return static_cast<uint32_t>(pattern) == number; }
static_assert(is(SurfacePattern::rock, shaders::kRock) && is(SurfacePattern::brick, shaders::kBrick) &&
              is(SurfacePattern::ashlar, shaders::kAshlar) && is(SurfacePattern::rubble, shaders::kRubble) &&
              is(SurfacePattern::paving, shaders::kPaving) && is(SurfacePattern::cobbles, shaders::kCobbles) &&
              is(SurfacePattern::roof_tiles, shaders::kRoofTiles) && is(SurfacePattern::slates, shaders::kSlates) &&
              is(SurfacePattern::plain, shaders::kPlain) && is(SurfacePattern::concrete, shaders::kConcrete) &&
              is(SurfacePattern::wooden, shaders::kWooden) && is(SurfacePattern::asphalt, shaders::kAsphalt) &&
              is(SurfacePattern::leafy, shaders::kLeafy) && is(SurfacePattern::boards, shaders::kBoards) &&
              is(SurfacePattern::glass, shaders::kGlass) && is(SurfacePattern::glowing, shaders::kGlowing) &&
              is(SurfacePattern::lying, shaders::kLying) && is(SurfacePattern::lava, shaders::kLava) &&
              is(SurfacePattern::leaded, shaders::kLeaded));

constexpr bool lies(float behind, uint32_t number) { return behind == static_cast<float>(number); }
static_assert(lies(kClearPane, shaders::kClearPane) && lies(kShopBehind, shaders::kShopBehind) &&
              lies(kOfficeBehind, shaders::kOfficeBehind) && lies(kCurtainBehind, shaders::kCurtainBehind) &&
              lies(kBlindBehind, shaders::kBlindBehind));

RenderMaterial drawn(const MaterialLook& look) {
  return {look.pattern, {look.colour[0], look.colour[1], look.colour[2]}, look.roughness, look.relief};
}

}  // namespace

std::optional<RenderMaterial> findMaterial(std::string_view name) {
  const std::optional<MaterialLook> look = findLook(name);
  return look ? std::optional(drawn(*look)) : std::nullopt;
}

RenderMaterial materialByName(std::string_view name) { return drawn(lookOf(name)); }

}  // namespace sgm

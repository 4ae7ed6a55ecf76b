#include "render/scene.h"

namespace sgm {
namespace {

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

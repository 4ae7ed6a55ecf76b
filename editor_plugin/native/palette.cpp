#include "palette.h"

#include <cmath>

namespace sgm_godot {
namespace {

float encoded(float linear) {
  return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

float decoded(float srgb) { return srgb <= 0.04045f ? srgb / 12.92f : std::pow((srgb + 0.055f) / 1.055f, 2.4f); }

}  // namespace

Color colorOf(std::string_view material) {
  const sgm::MaterialLook look = sgm::lookOf(material);
  return {encoded(look.colour[0]), encoded(look.colour[1]), encoded(look.colour[2]), look.roughness};
}

Color linear(Color srgb) { return {decoded(srgb.r), decoded(srgb.g), decoded(srgb.b), srgb.a}; }

}  // namespace sgm_godot

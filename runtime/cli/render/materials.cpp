#include <algorithm>

#include "render/scene.h"

namespace sgm {
namespace {

struct Named {
  std::string_view name;
  RenderMaterial material;
};

constexpr glm::vec3 rgb(float r, float g, float b) { return {r, g, b}; }

using enum SurfacePattern;

constexpr std::array<Named, 25> kTable{{
    {"rock", {rock, rgb(0.40f, 0.36f, 0.31f), 0.78f, 1.0f}},
    {"limestone", {rock, rgb(0.46f, 0.40f, 0.32f), 0.74f, 1.0f}},
    {"dolomite", {rock, rgb(0.44f, 0.41f, 0.38f), 0.78f, 1.0f}},
    {"sandstone", {rock, rgb(0.52f, 0.33f, 0.20f), 0.88f, 0.9f}},
    {"granite", {rock, rgb(0.38f, 0.36f, 0.35f), 0.70f, 0.8f}},
    {"basalt", {rock, rgb(0.13f, 0.13f, 0.14f), 0.72f, 1.1f}},
    {"slate", {rock, rgb(0.18f, 0.20f, 0.23f), 0.62f, 0.9f}},
    {"marble", {rock, rgb(0.66f, 0.63f, 0.59f), 0.45f, 0.5f}},
    {"clay", {smooth, rgb(0.34f, 0.21f, 0.13f), 0.85f, 0.8f}},
    {"mud", {smooth, rgb(0.20f, 0.14f, 0.09f), 0.40f, 0.8f}},
    {"sand", {smooth, rgb(0.58f, 0.46f, 0.30f), 0.95f, 0.6f}},
    {"calcite", {flow, rgb(0.78f, 0.68f, 0.52f), 0.34f, 1.0f}},
    {"flowstone", {flow, rgb(0.74f, 0.58f, 0.40f), 0.32f, 1.0f}},
    {"stalactite", {flow, rgb(0.76f, 0.65f, 0.48f), 0.34f, 1.0f}},
    {"gypsum", {flow, rgb(0.82f, 0.80f, 0.76f), 0.45f, 0.7f}},
    {"ice", {flow, rgb(0.60f, 0.74f, 0.82f), 0.12f, 0.6f}},
    {"water", {smooth, rgb(0.025f, 0.055f, 0.06f), 0.07f, 0.25f}},
    {"brick", {brick, rgb(0.42f, 0.15f, 0.09f), 0.85f, 1.0f}},
    {"concrete", {smooth, rgb(0.46f, 0.45f, 0.43f), 0.88f, 0.7f}},
    {"plaster", {smooth, rgb(0.74f, 0.70f, 0.62f), 0.92f, 0.4f}},
    {"glass", {smooth, rgb(0.22f, 0.30f, 0.33f), 0.08f, 0.0f}},
    {"metal", {smooth, rgb(0.42f, 0.42f, 0.43f), 0.35f, 0.2f}},
    {"wood", {smooth, rgb(0.32f, 0.19f, 0.10f), 0.70f, 0.6f}},
    {"snow", {cloud, rgb(0.90f, 0.92f, 0.95f), 0.90f, 0.3f}},
    {"cloud", {cloud, rgb(0.95f, 0.95f, 0.96f), 1.00f, 0.5f}},
}};

}  // namespace

RenderMaterial materialByName(std::string_view name) {
  for (const Named& named : kTable) {
    if (named.name == name) return named.material;
  }
  // Shapes that have none are looked at for their form.
  if (name.empty()) return {smooth, rgb(0.56f, 0.53f, 0.48f), 0.9f, 0.3f};
  uint32_t hash = 2166136261u;  // FNV-1a: the same name, the same tint, everywhere
  for (char c : name) hash = (hash ^ static_cast<uint8_t>(c)) * 16777619u;
  RenderMaterial material;
  const auto tint = [&](unsigned shift) { return 0.85f + 0.30f * static_cast<float>(hash >> shift & 255u) / 255.0f; };
  material.colour *= glm::vec3(tint(0), tint(8), tint(16));
  return material;
}

}  // namespace sgm

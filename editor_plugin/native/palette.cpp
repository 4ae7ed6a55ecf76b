#include "palette.h"

#include <cmath>

namespace sgm_godot {
namespace {

struct Known {
  std::string_view word;
  Color color;
};

// More telling words first: "brick_wall" is brick.
constexpr Known kKnown[] = {
    {"limestone", {0.62f, 0.55f, 0.45f, 0.85f}},  {"calcite", {0.80f, 0.75f, 0.64f, 0.45f}},
    {"granite", {0.48f, 0.46f, 0.45f, 0.80f}},    {"basalt", {0.23f, 0.23f, 0.25f, 0.80f}},
    {"sandstone", {0.72f, 0.55f, 0.36f, 0.90f}},  {"marble", {0.85f, 0.84f, 0.81f, 0.35f}},
    {"asphalt", {0.16f, 0.16f, 0.17f, 0.90f}},    {"concrete", {0.56f, 0.56f, 0.54f, 0.85f}},
    {"plaster", {0.82f, 0.77f, 0.68f, 0.90f}},    {"brick", {0.55f, 0.27f, 0.20f, 0.90f}},
    {"glass", {0.20f, 0.29f, 0.36f, 0.10f}},      {"window", {0.17f, 0.24f, 0.30f, 0.12f}},
    {"metal", {0.55f, 0.56f, 0.58f, 0.35f}},      {"steel", {0.50f, 0.52f, 0.55f, 0.35f}},
    {"copper", {0.38f, 0.55f, 0.46f, 0.55f}},     {"tile", {0.60f, 0.30f, 0.22f, 0.75f}},
    {"slate", {0.28f, 0.31f, 0.35f, 0.70f}},      {"roof", {0.44f, 0.24f, 0.20f, 0.80f}},
    {"wood", {0.43f, 0.29f, 0.17f, 0.75f}},       {"bark", {0.30f, 0.22f, 0.16f, 0.95f}},
    {"leaf", {0.24f, 0.40f, 0.15f, 0.80f}},       {"leaves", {0.24f, 0.40f, 0.15f, 0.80f}},
    {"grass", {0.27f, 0.40f, 0.17f, 0.95f}},      {"moss", {0.28f, 0.36f, 0.16f, 0.95f}},
    {"sand", {0.76f, 0.67f, 0.48f, 0.95f}},       {"mud", {0.32f, 0.24f, 0.17f, 0.60f}},
    {"soil", {0.34f, 0.25f, 0.17f, 0.95f}},       {"earth", {0.36f, 0.27f, 0.18f, 0.95f}},
    {"snow", {0.92f, 0.94f, 0.97f, 0.70f}},       {"ice", {0.68f, 0.82f, 0.90f, 0.20f}},
    {"water", {0.12f, 0.28f, 0.34f, 0.05f}},      {"cloud", {0.95f, 0.95f, 0.97f, 1.00f}},
    {"vapour", {0.95f, 0.95f, 0.97f, 1.00f}},     {"gold", {0.83f, 0.65f, 0.28f, 0.30f}},
    {"ashlar", {0.70f, 0.64f, 0.55f, 0.85f}},     {"rubble", {0.60f, 0.55f, 0.48f, 0.90f}},
    {"paving", {0.58f, 0.56f, 0.53f, 0.80f}},     {"cobble", {0.45f, 0.43f, 0.41f, 0.75f}},
    {"gravel", {0.56f, 0.53f, 0.49f, 0.90f}},     {"thatch", {0.56f, 0.47f, 0.33f, 0.95f}},
    {"stalactite", {0.80f, 0.74f, 0.62f, 0.45f}}, {"flowstone", {0.78f, 0.69f, 0.56f, 0.45f}},
    {"dolomite", {0.64f, 0.62f, 0.59f, 0.85f}},   {"gypsum", {0.90f, 0.88f, 0.85f, 0.55f}},
    {"clay", {0.52f, 0.38f, 0.28f, 0.90f}},       {"paint", {0.76f, 0.75f, 0.73f, 0.50f}},
    {"iron", {0.32f, 0.31f, 0.30f, 0.60f}},       {"boards", {0.46f, 0.36f, 0.26f, 0.80f}},
    {"stone", {0.55f, 0.52f, 0.47f, 0.85f}},      {"rock", {0.52f, 0.47f, 0.41f, 0.85f}},
    {"wall", {0.78f, 0.72f, 0.62f, 0.90f}},       {"floor", {0.50f, 0.45f, 0.40f, 0.80f}},
    {"road", {0.20f, 0.20f, 0.21f, 0.90f}},       {"pavement", {0.52f, 0.51f, 0.49f, 0.85f}},
};
constexpr Color kDefault{0.60f, 0.58f, 0.55f, 0.85f};

}  // namespace

Color colorOf(std::string_view material) {
  if (material.empty()) return kDefault;
  for (const Known& known : kKnown) {
    if (material.find(known.word) != std::string_view::npos) return known.color;
  }
  // The golden ratio spreads hues of neighbouring numbers; FNV-1a makes a number of the name.
  uint32_t hash = 2166136261u;
  for (const char c : material) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619u;
  const float hue = std::fmod(static_cast<float>(hash % 1000) * 0.618034f, 1.0f) * 6.2831853f;
  constexpr float kGrey = 0.5f, kChroma = 0.16f;
  return {kGrey + kChroma * std::cos(hue), kGrey + kChroma * std::cos(hue - 2.0944f),
          kGrey + kChroma * std::cos(hue + 2.0944f), 0.85f};
}

}  // namespace sgm_godot

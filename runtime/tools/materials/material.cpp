#include "tools/materials/material.h"

#include <algorithm>

namespace sgm {
namespace {

struct Named {
  std::string_view name;
  MaterialLook look;
};

using Rgb = std::array<float, 3>;

constexpr Rgb rgb(float r, float g, float b) { return {r, g, b}; }

using enum SurfacePattern;

constexpr std::array<Named, 56> kTable{{
    {"rock", {rock, rgb(0.40f, 0.36f, 0.31f), 0.82f, 1.0f}},
    {"limestone", {rock, rgb(0.47f, 0.42f, 0.345f), 0.80f, 1.0f}},
    {"dolomite", {rock, rgb(0.47f, 0.45f, 0.42f), 0.82f, 1.0f}},
    {"sandstone", {rock, rgb(0.54f, 0.32f, 0.19f), 0.88f, 0.9f}},
    {"granite", {speckled, rgb(0.40f, 0.38f, 0.37f), 0.72f, 1.0f}},
    {"basalt", {rock, rgb(0.115f, 0.112f, 0.112f), 0.78f, 1.1f}},
    {"lava", {lava, rgb(0.078f, 0.073f, 0.072f), 0.62f, 1.0f}},
    {"marble", {veined, rgb(0.68f, 0.66f, 0.63f), 0.30f, 0.6f}},
    {"calcite", {flow, rgb(0.78f, 0.69f, 0.55f), 0.36f, 1.0f}},
    {"flowstone", {flow, rgb(0.72f, 0.58f, 0.41f), 0.34f, 1.0f}},
    {"stalactite", {flow, rgb(0.75f, 0.65f, 0.50f), 0.36f, 1.0f}},
    {"gypsum", {flow, rgb(0.82f, 0.80f, 0.76f), 0.50f, 0.7f}},
    {"ice", {flow, rgb(0.62f, 0.76f, 0.84f), 0.12f, 0.6f}},
    {"brick", {brick, rgb(0.40f, 0.155f, 0.10f), 0.88f, 1.0f}},
    {"ashlar", {ashlar, rgb(0.52f, 0.46f, 0.37f), 0.85f, 1.0f}},
    {"rubble", {rubble, rgb(0.42f, 0.37f, 0.30f), 0.90f, 1.0f}},
    {"paving", {paving, rgb(0.40f, 0.385f, 0.36f), 0.80f, 1.0f}},
    {"cobble", {cobbles, rgb(0.27f, 0.255f, 0.235f), 0.72f, 1.0f}},
    {"roof_tile", {roof_tiles, rgb(0.46f, 0.19f, 0.105f), 0.85f, 1.0f}},
    {"slate", {slates, rgb(0.135f, 0.145f, 0.165f), 0.60f, 1.0f}},
    {"thatch", {fibres, rgb(0.34f, 0.26f, 0.15f), 0.95f, 1.0f}},
    {"plaster", {plain, rgb(0.70f, 0.66f, 0.585f), 0.94f, 1.0f}},
    {"paint", {plain, rgb(0.62f, 0.61f, 0.58f), 0.50f, 0.35f}},
    {"lacquer", {plain, rgb(0.22f, 0.222f, 0.225f), 0.07f, 0.0f}},
    {"clay", {plain, rgb(0.36f, 0.22f, 0.14f), 0.88f, 1.4f}},
    {"concrete", {concrete, rgb(0.43f, 0.42f, 0.40f), 0.90f, 1.0f}},
    {"wood", {wooden, rgb(0.225f, 0.155f, 0.098f), 0.75f, 1.0f}},
    {"boards", {boards, rgb(0.215f, 0.155f, 0.105f), 0.80f, 1.0f}},
    {"joist", {lying, rgb(0.225f, 0.155f, 0.098f), 0.75f, 1.0f}},
    {"metal", {metallic, rgb(0.27f, 0.27f, 0.275f), 0.55f, 0.8f}},
    {"iron", {metallic, rgb(0.12f, 0.115f, 0.11f), 0.55f, 1.0f}},
    {"steel", {metallic, rgb(0.42f, 0.43f, 0.45f), 0.34f, 0.2f}},
    {"copper", {metallic, rgb(0.25f, 0.40f, 0.33f), 0.70f, 0.3f}},
    {"asphalt", {asphalt, rgb(0.105f, 0.104f, 0.106f), 0.92f, 1.0f}},
    {"glass", {glass, rgb(0.22f, 0.30f, 0.33f), 0.08f, 0.0f}},
    {"windscreen", {glass, rgb(0.66f, 0.71f, 0.69f), 0.08f, kClearPane}},
    {"shop_window", {glass, rgb(0.22f, 0.30f, 0.33f), 0.08f, kShopBehind}},
    {"office_window", {glass, rgb(0.22f, 0.30f, 0.33f), 0.08f, kOfficeBehind}},
    {"curtained_window", {glass, rgb(0.58f, 0.56f, 0.51f), 0.08f, kCurtainBehind}},
    {"blind_window", {glass, rgb(0.55f, 0.51f, 0.42f), 0.08f, kBlindBehind}},
    {"leaded", {leaded, rgb(0.66f, 0.68f, 0.60f), 0.08f, 0.0f}},
    {"glow", {glowing, rgb(1.00f, 0.60f, 0.24f), 0.30f, 0.0f}},
    {"sand", {granular, rgb(0.56f, 0.45f, 0.30f), 0.95f, 1.0f}},
    {"soil", {granular, rgb(0.21f, 0.145f, 0.09f), 0.95f, 1.3f}},
    {"mud", {granular, rgb(0.20f, 0.145f, 0.095f), 0.45f, 0.8f}},
    {"gravel", {gravelly, rgb(0.38f, 0.35f, 0.31f), 0.88f, 1.0f}},
    {"grass", {grassy, rgb(0.125f, 0.150f, 0.060f), 0.95f, 1.0f}},
    {"leaf", {leafy, rgb(0.072f, 0.108f, 0.036f), 0.60f, 1.0f}},
    {"leaf_dark", {leafy, rgb(0.046f, 0.072f, 0.030f), 0.60f, 0.8f}},
    {"bark", {fibres, rgb(0.19f, 0.14f, 0.10f), 0.95f, 1.0f}},
    {"root", {fibres, rgb(0.240f, 0.175f, 0.120f), 0.92f, 0.8f}},
    {"moss", {mossy, rgb(0.085f, 0.110f, 0.038f), 1.00f, 1.0f}},
    {"water", {water, rgb(0.012f, 0.050f, 0.058f), 0.06f, 1.0f}},
    {"snow", {granular, rgb(0.88f, 0.90f, 0.93f), 0.80f, 0.5f}},
    {"cloud", {cloud, rgb(0.95f, 0.95f, 0.96f), 1.00f, 1.0f}},
    {"cirrus", {cloud, rgb(0.97f, 0.98f, 1.00f), 0.17f, 0.2f}},
}};

/// A tint word, such as "ochre": the colour of the material is mixed with this colour.
struct Tint {
  std::string_view word;
  Rgb colour;
  float share;
};

constexpr std::array<Tint, 14> kTints{{{"white", rgb(0.80f, 0.79f, 0.76f), 0.85f},
                                       {"cream", rgb(0.72f, 0.64f, 0.47f), 0.80f},
                                       {"ochre", rgb(0.60f, 0.39f, 0.14f), 0.75f},
                                       {"yellow", rgb(0.68f, 0.50f, 0.17f), 0.75f},
                                       {"orange", rgb(0.58f, 0.25f, 0.09f), 0.75f},
                                       {"rose", rgb(0.62f, 0.36f, 0.29f), 0.75f},
                                       {"red", rgb(0.40f, 0.075f, 0.055f), 0.80f},
                                       {"brown", rgb(0.20f, 0.115f, 0.065f), 0.80f},
                                       {"green", rgb(0.08f, 0.15f, 0.075f), 0.80f},
                                       {"blue", rgb(0.09f, 0.15f, 0.27f), 0.80f},
                                       {"grey", rgb(0.33f, 0.33f, 0.325f), 0.80f},
                                       {"black", rgb(0.03f, 0.03f, 0.032f), 0.85f},
                                       {"dark", rgb(0.0f, 0.0f, 0.0f), 0.50f},
                                       {"pale", rgb(0.85f, 0.84f, 0.82f), 0.40f}}};

/// A word, such as "wall", that stands for a material of the table. It is used if a name contains no word of the table.
struct Synonym {
  std::string_view word, means;
};

constexpr std::array<Synonym, 14> kSynonyms{{{"tile", "roof_tile"},
                                             {"roof", "roof_tile"},
                                             {"window", "glass"},
                                             {"leaves", "leaf"},
                                             {"earth", "soil"},
                                             {"stone", "limestone"},
                                             {"cliff", "limestone"},
                                             {"wall", "plaster"},
                                             {"floor", "paving"},
                                             {"pavement", "paving"},
                                             {"road", "asphalt"},
                                             {"street", "asphalt"},
                                             {"vapour", "cloud"},
                                             {"timber", "wood"}}};

const MaterialLook* known(std::string_view name) {
  const auto* found = std::ranges::find(kTable, name, &Named::name);
  return found == kTable.end() ? nullptr : &found->look;
}

const MaterialLook* meant(std::string_view word) {
  const auto* found = std::ranges::find(kSynonyms, word, &Synonym::word);
  return found == kSynonyms.end() ? nullptr : known(found->means);
}

constexpr float kSmoothest = 0.05f;  // minimum of MaterialLook::roughness

void wet(MaterialLook& look) {
  for (float& share : look.colour) share *= 0.55f;
  look.roughness = std::max(kSmoothest, 0.30f * look.roughness);
}

void tint(MaterialLook& look, const Tint& by) {
  for (size_t i = 0; i < 3; ++i) look.colour[i] += (by.colour[i] - look.colour[i]) * by.share;
}

constexpr std::string_view kWet = "wet", kWetBefore = "wet_";

/// The look of a known material with a tint word at the end: "plaster_ochre".
std::optional<MaterialLook> tinted(std::string_view name) {
  const size_t at = name.rfind('_');
  if (at == std::string_view::npos) return {};
  const auto* by = std::ranges::find(kTints, name.substr(at + 1), &Tint::word);
  const MaterialLook* plain_one = known(name.substr(0, at));
  if (by == kTints.end() || !plain_one) return {};
  MaterialLook look = *plain_one;
  tint(look, *by);
  return look;
}

/// The look of a name with several words ("old_brick_wall"): the look of its first word that is in the table; if there
/// is none, the look of its first synonym. A tint word and "wet" modify the look. So "brick_wall" is brick, while
/// "wall" alone means plaster.
std::optional<MaterialLook> byWords(std::string_view name) {
  const MaterialLook *named = nullptr, *meant_one = nullptr;
  bool is_wet = false;
  const Tint* last = nullptr;
  for (std::string_view rest = name; !rest.empty();) {
    const size_t at = rest.find('_');
    const std::string_view word = rest.substr(0, at);
    rest = at == std::string_view::npos ? std::string_view() : rest.substr(at + 1);
    const auto* by = std::ranges::find(kTints, word, &Tint::word);
    if (by != kTints.end()) last = by;
    is_wet |= word == kWet;
    if (!named) named = known(word);
    if (!meant_one) meant_one = meant(word);
  }
  if (!named && !meant_one) return {};
  MaterialLook look = named ? *named : *meant_one;
  if (last != nullptr) tint(look, *last);
  if (is_wet) wet(look);
  return look;
}

}  // namespace

std::optional<MaterialLook> findLook(std::string_view name) {
  // Remove all prefixes `wet_` in a loop, without recursion: names come from grammars and may have any length. Repeated
  // prefixes have the same effect as one.
  bool is_wet = false;
  for (; name.starts_with(kWetBefore); name.remove_prefix(kWetBefore.size())) is_wet = true;
  const MaterialLook* by_name = known(name);
  std::optional<MaterialLook> look = by_name ? std::optional(*by_name) : tinted(name);
  if (look && is_wet) wet(*look);
  return look;
}

MaterialLook lookOf(std::string_view name) {
  if (const std::optional<MaterialLook> found = findLook(name)) return *found;
  // A shape without a material gets a plain look that shows its form well.
  if (name.empty()) return {plain, rgb(0.50f, 0.48f, 0.44f), 0.9f, 0.5f};
  if (const std::optional<MaterialLook> found = byWords(name)) return *found;
  uint32_t hash = 2166136261u;  // FNV-1a hash, so that a name has the same tint on every machine
  for (const char c : name) hash = (hash ^ static_cast<uint8_t>(c)) * 16777619u;
  MaterialLook look;
  for (unsigned i = 0; i < 3; ++i)
    look.colour[i] *= 0.85f + 0.30f * static_cast<float>(hash >> (8 * i) & 255u) / 255.0f;
  return look;
}

}  // namespace sgm

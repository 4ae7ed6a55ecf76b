#include "world/named_settings.h"

#include <algorithm>
#include <cmath>

#include "number_text.h"
#include "palette.h"

namespace sgm_godot {
namespace {

// Values of the engine's enums PropertyHint and PropertyUsageFlags.
constexpr uint32_t kRange = 1, kResourceType = 17, kColorNoAlpha = 21;
constexpr uint32_t kStored = 2, kShown = 4;

constexpr std::string_view kParameters = "parameters/", kMaterials = "materials/", kColors = "colors/";

/// Returns the rest of a name after a prefix; empty if the name does not begin with the prefix.
std::string after(const std::string& name, std::string_view prefix) {
  return name.size() > prefix.size() && name.compare(0, prefix.size(), prefix) == 0 ? name.substr(prefix.size())
                                                                                    : std::string();
}

std::optional<sgm_parameter_info> parameterOf(const sgm_grammar* grammar, const std::string& name) {
  for (uint32_t i = 0; i < sgm_grammar_parameter_count(grammar); ++i) {
    sgm_parameter_info info = SGM_PARAMETER_INFO_INIT;
    if (sgm_grammar_parameter(grammar, i, &info) == SGM_OK && name == info.name) return info;
  }
  return std::nullopt;
}

std::string number(double value) { return numberText(value, 9); }

/// Parameters that are whole numbers become integers in the engine.
Variant parameterValue(const sgm_parameter_info& info, double value) {
  return info.whole != 0 ? Variant(static_cast<int64_t>(std::llround(value))) : Variant(value);
}

/// Returns the hint for a parameter in the inspector: a slider over its range, with its unit. If an end of the range is
/// infinite in the grammar, values beyond that end of the slider are allowed.
std::string rangeOf(const sgm_parameter_info& info) {
  const bool bounded = std::isfinite(info.minimum) && std::isfinite(info.maximum);
  // The inspector shows angles in degrees, so the range that it gets is in degrees, too.
  const double unit = info.quantity == SGM_QUANTITY_ANGLE ? 180 / 3.14159265358979323846 : 1;
  const double low = std::isfinite(info.minimum) ? info.minimum * unit : -1e6;
  const double high = std::isfinite(info.maximum) ? info.maximum * unit : 1e6;
  const double step = info.whole != 0 ? 1 : bounded ? (high - low) / 1000 : 0.001;
  std::string text = number(low) + "," + number(high) + "," + number(step);
  if (!std::isfinite(info.minimum)) text += ",or_less";
  if (!std::isfinite(info.maximum)) text += ",or_greater";
  if (info.quantity == SGM_QUANTITY_LENGTH) text += ",suffix:m";
  if (info.quantity == SGM_QUANTITY_ANGLE) text += ",radians_as_degrees";
  return text;
}

}  // namespace

std::optional<Settings::Effect> setNamed(Settings& settings, const std::string& name, const Variant& value) {
  if (const std::string parameter = after(name, kParameters); !parameter.empty()) {
    // The value is stored even if the grammar has no such parameter: a scene may set values before it sets its grammar.
    const double wanted = value.to<double>();
    const auto found = settings.parameters.find(parameter);
    if (found != settings.parameters.end() && found->second == wanted) return Settings::kNothing;
    settings.parameters[parameter] = wanted;
    return Settings::kField;
  }
  if (const std::string material = after(name, kMaterials); !material.empty()) {
    Variant& place = settings.materials[material];
    const bool slots_change = (place.object() != nullptr) != (value.object() != nullptr);
    place = value;
    return slots_change ? Settings::kRepack : Settings::kPaint;
  }
  if (const std::string material = after(name, kColors); !material.empty()) {
    settings.colors[material] = value.to<Color>();
    return Settings::kPaint;
  }
  return std::nullopt;
}

std::optional<Variant> namedValue(const Settings& settings, const sgm_grammar* grammar, const std::string& name) {
  if (const std::string parameter = after(name, kParameters); !parameter.empty()) {
    const auto chosen = settings.parameters.find(parameter);
    const std::optional<sgm_parameter_info> info = parameterOf(grammar, parameter);
    if (chosen == settings.parameters.end()) {
      return info ? std::optional(parameterValue(*info, info->default_value)) : std::nullopt;
    }
    return info ? parameterValue(*info, chosen->second) : Variant(chosen->second);
  }
  if (const std::string material = after(name, kMaterials); !material.empty()) {
    const auto chosen = settings.materials.find(material);
    return chosen != settings.materials.end() ? chosen->second : Variant();
  }
  if (const std::string material = after(name, kColors); !material.empty()) {
    const auto chosen = settings.colors.find(material);
    return Variant(chosen != settings.colors.end() ? chosen->second : colorOf(material));
  }
  return std::nullopt;
}

std::vector<Instance::Property> namedProperties(const Settings& settings, const sgm_grammar* grammar) {
  std::vector<Instance::Property> list;
  for (uint32_t i = 0; i < sgm_grammar_parameter_count(grammar); ++i) {
    sgm_parameter_info info = SGM_PARAMETER_INFO_INIT;
    if (sgm_grammar_parameter(grammar, i, &info) != SGM_OK) continue;
    list.push_back({std::string(kParameters) + info.name,
                    info.whole != 0 ? GDEXTENSION_VARIANT_TYPE_INT : GDEXTENSION_VARIANT_TYPE_FLOAT, "", kRange,
                    rangeOf(info), kStored | kShown});
  }
  for (const std::string& name : materialNames(grammar)) {
    list.push_back({std::string(kMaterials) + name, GDEXTENSION_VARIANT_TYPE_OBJECT, "Material", kResourceType,
                    "BaseMaterial3D,ShaderMaterial", kStored | kShown});
  }
  for (const std::string& name : materialNames(grammar)) {
    list.push_back(
        {std::string(kColors) + name, GDEXTENSION_VARIANT_TYPE_COLOR, "", kColorNoAlpha, "", kStored | kShown});
  }
  // Also list names that the grammar lacks for now, for example while it has an error: their values are then saved with
  // the scene.
  const auto keep = [&](std::string_view prefix, const std::string& name, GDExtensionVariantType type) {
    const std::string whole = std::string(prefix) + name;
    if (std::none_of(list.begin(), list.end(), [&](const Instance::Property& p) { return p.name == whole; }))
      list.push_back({whole, type, "", 0, "", kStored});
  };
  for (const auto& [name, value] : settings.parameters) keep(kParameters, name, GDEXTENSION_VARIANT_TYPE_FLOAT);
  for (const auto& [name, material] : settings.materials) {
    if (material.object() != nullptr) keep(kMaterials, name, GDEXTENSION_VARIANT_TYPE_OBJECT);
  }
  for (const auto& [name, color] : settings.colors) keep(kColors, name, GDEXTENSION_VARIANT_TYPE_COLOR);
  return list;
}

Variant namedDefault(const sgm_grammar* grammar, const std::string& name) {
  if (const std::string parameter = after(name, kParameters); !parameter.empty()) {
    const std::optional<sgm_parameter_info> info = parameterOf(grammar, parameter);
    return info ? parameterValue(*info, info->default_value) : Variant();
  }
  if (const std::string material = after(name, kColors); !material.empty()) return colorOf(material);
  return {};
}

}  // namespace sgm_godot

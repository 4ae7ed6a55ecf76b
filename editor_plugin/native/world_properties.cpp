// SgmWorld3D: its properties and methods, as registered with the engine for the inspector and scripts.

#include <cmath>

#include "godot/class_binder.h"
#include "number_text.h"
#include "palette.h"
#include "world.h"

namespace sgm_godot {
namespace {

// Values of the engine's enums PropertyHint and PropertyUsageFlags.
constexpr uint32_t kRange = 1, kLayersRender = 10, kLayersPhysics = 11, kFile = 13, kDirectory = 14, kResourceType = 17;
constexpr uint32_t kColorNoAlpha = 21;
constexpr uint32_t kStored = 2, kShown = 4, kReadOnlyShown = 1 << 28 | kShown;

constexpr std::string_view kParameters = "parameters/", kMaterials = "materials/", kColors = "colors/";

/// The part of a name after a prefix; empty if the name does not begin with the prefix.
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

/// The hint string of a slider over the parameter's range, in its unit; without bounds if the grammar gives none.
std::string rangeOf(const sgm_parameter_info& info) {
  const bool bounded = std::isfinite(info.minimum) && std::isfinite(info.maximum);
  // The engine shows angles in degrees, and expects the range in the displayed unit.
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

const sgm_grammar* compiledOf(Object object) {
  const auto* grammar = instanceOf<Grammar>(object);
  return grammar != nullptr ? grammar->compiled().get() : nullptr;
}

}  // namespace

bool World::set(const std::string& name, const Variant& value) {
  if (const std::string parameter = after(name, kParameters); !parameter.empty()) {
    // Unknown parameters are accepted too: a scene may set values before its grammar, or the grammar may have an error.
    const double wanted = value.to<double>();
    const auto found = settings_.parameters.find(parameter);
    if (found != settings_.parameters.end() && found->second == wanted) return true;
    settings_.parameters[parameter] = wanted;
    dirty_ |= kField;
    return true;
  }
  if (const std::string material = after(name, kMaterials); !material.empty()) {
    Variant& place = settings_.materials[material];
    const bool slots_change = (place.object() != nullptr) != (value.object() != nullptr);
    place = value;
    dirty_ |= slots_change ? kRepack : kPaint;
    return true;
  }
  if (const std::string material = after(name, kColors); !material.empty()) {
    settings_.colors[material] = value.to<Color>();
    dirty_ |= kPaint;
    return true;
  }
  return false;
}

bool World::get(const std::string& name, Variant& value) const {
  if (const std::string parameter = after(name, kParameters); !parameter.empty()) {
    const auto chosen = settings_.parameters.find(parameter);
    const std::optional<sgm_parameter_info> info = parameterOf(compiledOf(grammar()), parameter);
    if (chosen == settings_.parameters.end() && !info) return false;
    const double number = chosen != settings_.parameters.end() ? chosen->second : info->default_value;
    value = info && info->whole != 0 ? Variant(static_cast<int64_t>(std::llround(number))) : Variant(number);
    return true;
  }
  if (const std::string material = after(name, kMaterials); !material.empty()) {
    const auto chosen = settings_.materials.find(material);
    value = chosen != settings_.materials.end() ? chosen->second : Variant();
    return true;
  }
  if (const std::string material = after(name, kColors); !material.empty()) {
    const auto chosen = settings_.colors.find(material);
    value = chosen != settings_.colors.end() ? chosen->second : colorOf(material);
    return true;
  }
  return false;
}

std::vector<Instance::Property> World::properties() const {
  std::vector<Property> list;
  const sgm_grammar* grammar = compiledOf(this->grammar());
  for (uint32_t i = 0; i < sgm_grammar_parameter_count(grammar); ++i) {
    sgm_parameter_info info = SGM_PARAMETER_INFO_INIT;
    if (sgm_grammar_parameter(grammar, i, &info) != SGM_OK) continue;
    list.push_back({std::string(kParameters) + info.name,
                    info.whole != 0 ? GDEXTENSION_VARIANT_TYPE_INT : GDEXTENSION_VARIANT_TYPE_FLOAT, "", kRange,
                    rangeOf(info), kStored | kShown});
  }
  for (const std::string& name : materialNames()) {
    list.push_back({std::string(kMaterials) + name, GDEXTENSION_VARIANT_TYPE_OBJECT, "Material", kResourceType,
                    "BaseMaterial3D,ShaderMaterial", kStored | kShown});
  }
  for (const std::string& name : materialNames()) {
    list.push_back(
        {std::string(kColors) + name, GDEXTENSION_VARIANT_TYPE_COLOR, "", kColorNoAlpha, "", kStored | kShown});
  }
  // Values for names that the grammar lacks, for example while it has an error, are kept and stored in the scene.
  const auto keep = [&](std::string_view prefix, const std::string& name, GDExtensionVariantType type) {
    const std::string whole = std::string(prefix) + name;
    if (std::none_of(list.begin(), list.end(), [&](const Property& p) { return p.name == whole; }))
      list.push_back({whole, type, "", 0, "", kStored});
  };
  for (const auto& [name, value] : settings_.parameters) keep(kParameters, name, GDEXTENSION_VARIANT_TYPE_FLOAT);
  for (const auto& [name, material] : settings_.materials) {
    if (material.object() != nullptr) keep(kMaterials, name, GDEXTENSION_VARIANT_TYPE_OBJECT);
  }
  for (const auto& [name, color] : settings_.colors) keep(kColors, name, GDEXTENSION_VARIANT_TYPE_COLOR);
  return list;
}

Variant World::revertsTo(const std::string& name) const {
  if (const std::string parameter = after(name, kParameters); !parameter.empty()) {
    const std::optional<sgm_parameter_info> info = parameterOf(compiledOf(grammar()), parameter);
    if (!info) return {};
    return info->whole != 0 ? Variant(static_cast<int64_t>(std::llround(info->default_value)))
                            : Variant(info->default_value);
  }
  if (const std::string material = after(name, kColors); !material.empty()) return colorOf(material);
  return {};
}

void World::registerClass(ClassRecord& record) {
  using S = Settings;
  constexpr int kInt = GDEXTENSION_VARIANT_TYPE_INT, kText = GDEXTENSION_VARIANT_TYPE_STRING,
                kKey = GDEXTENSION_VARIANT_TYPE_VECTOR4I, kMap = GDEXTENSION_VARIANT_TYPE_DICTIONARY,
                kObject = GDEXTENSION_VARIANT_TYPE_OBJECT, kNumbers = GDEXTENSION_VARIANT_TYPE_PACKED_INT64_ARRAY;
  record.name = "SgmWorld3D";
  record.parent = "Node3D";
  ClassBinder binder = ClassBinder::add<World>(record);
#define SGM_SETTING(member, effect, ...) \
  property<&World::change<&S::member, effect>, &World::setting<&S::member>>(#member, ##__VA_ARGS__)
  binder.property<&World::setGrammar, &World::grammar>("grammar", {kResourceType, "SgmGrammar", "SgmGrammar"})
      .SGM_SETTING(seed, kField)
      .SGM_SETTING(backend, kRestart, choice("Auto,CPU,Vulkan,CUDA"))
      .SGM_SETTING(preview, kRestart)
      .SGM_SETTING(hot_reload, kNothing)
      .SGM_SETTING(origin, kPlacement, {0, "suffix:m"})
      .group("Detail")
      .SGM_SETTING(cell_size, kRestart, range("0.05,16,0.01,or_greater,suffix:m"))
      .SGM_SETTING(finest_distance, kRestart, range("4,512,0.5,or_greater,suffix:m"))
      .SGM_SETTING(view_distance, kRestart, range("16,4096,1,or_greater,suffix:m"))
      .SGM_SETTING(coarsest_level, kRestart, range("-1,16,1"))
      .SGM_SETTING(by_distance, kRestart)
      .SGM_SETTING(sharp, kRestart)
      .SGM_SETTING(morph, kRestart)
      .SGM_SETTING(measure, kRestart)
      .SGM_SETTING(mesh_memory, kRestart, range("16,8192,1,or_greater,suffix:MiB"))
      .SGM_SETTING(frame_budget, kNothing, range("0.1,16,0.1,or_greater,suffix:ms"))
      .group("Appearance")
      .SGM_SETTING(mapping, kPaint, choice("Triplanar,UV"))
      .SGM_SETTING(cast_shadow, kLook)
      .SGM_SETTING(render_layers, kLook, {kLayersRender})
      .group("Collision")
      .SGM_SETTING(collision, kRestart)
      .SGM_SETTING(collision_distance, kRestart, range("4,512,0.5,or_greater,suffix:m"))
      .SGM_SETTING(collision_layer, kBodies, {kLayersPhysics})
      .SGM_SETTING(collision_mask, kBodies, {kLayersPhysics})
      .group("Storage")
      .SGM_SETTING(journal, kRestart, {kFile, "*"})
      .SGM_SETTING(cache_folder, kRestart, {kDirectory})
      .SGM_SETTING(stores, kRestart)
      .property<&World::setAnchorScenes, &World::anchorScenes>("anchor_scenes")
#undef SGM_SETTING
      .readOnly<&World::running>("running", {0, "", "", kReadOnlyShown})
      .method_<&World::running>("is_running")
      .method_<&World::grammarChanged>("_grammar_changed")
      .method_<&World::monitor>("_monitor", {"key"})
      .method_<&World::restart>("restart")
      .method_<&World::errorText>("get_error_text")
      .method_<&World::setEditorView>("set_editor_view", {"transform", "fov_degrees"})
      .method_<&World::isIdle>("is_idle")
      .method_<&World::waitUntilIdle>("wait_until_idle", {"seconds"})
      .method_<&World::dig>("dig", {"position", "radius", "smooth"}, {0.0})
      .method_<&World::build>("build", {"position", "radius", "material", "smooth"}, {"", 0.0})
      .method_<&World::edit>("edit", {"brush"})
      .method_<&World::undo>("undo", {"id"})
      .method_<&World::editCount>("get_edit_count")
      .method_<&World::exportEdits>("export_edits", {"since"}, {int64_t{0}})
      .method_<&World::importEdits>("import_edits", {"bytes"})
      .method_<&World::flushEdits>("flush_edits")
      .method_<&World::editsHash>("get_edits_hash")
      .method_<&World::rayCast>("ray_cast", {"from", "direction", "length"})
      .method_<&World::closestPoint>("closest_point", {"position", "max_distance"})
      .method_<&World::findWay>("find_way", {"from", "to", "radius"})
      .method_<&World::anchors>("get_anchors", {"box"})
      .method_<&World::sampleDensity>("sample_density", {"corner", "spacing", "size", "to_sun", "fade", "edge"}, {0.0})
      .method_<&World::bounds>("get_bounds")
      .method_<&World::worldHash>("get_world_hash", {"box", "level"}, {int64_t{0}})
      .method_<&World::statistics>("get_statistics")
      .method_<&World::measures>("get_measures")
      .method_<&World::measureDrawn>("measure_drawn", {"bins"}, {int64_t{33}})
      .method_<&World::bakeChunks>("bake_chunks")
      .signal("chunk_ready", {{"key", kKey}})
      .signal("chunk_removed", {{"key", kKey}})
      .signal("walkable", {{"viewer", kObject, "Node3D"}})
      .signal("failed", {{"message", kText}})
      .signal("anchor_ready", {{"anchor", kMap}})
      .signal("anchor_removed", {{"key", kInt}})
      .signal("became_idle")
      .signal("edited", {{"id", kNumbers}})
      .signal("restarted");
}

}  // namespace sgm_godot

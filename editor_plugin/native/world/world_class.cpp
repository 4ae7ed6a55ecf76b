// Registers the class SgmWorld3D with the engine: its methods, properties and signals, for scripts and the inspector.

#include "godot/class_binder.h"
#include "world/density.h"
#include "world/edits.h"
#include "world/measures.h"
#include "world/queries.h"
#include "world/statistics.h"
#include "world/world.h"

namespace sgm_godot {
namespace {

// Values of the engine's enums PropertyHint and PropertyUsageFlags.
constexpr uint32_t kLayersRender = 10, kLayersPhysics = 11, kFile = 13, kDirectory = 14, kResourceType = 17;
constexpr uint32_t kReadOnlyShown = 1 << 28 | 4;

template <auto setting>
using SettingType = std::remove_cvref_t<decltype(std::declval<Settings&>().*setting)>;

template <auto setting>
SettingType<setting> settingOf(const World& world) {
  return world.node().settings.*setting;
}
template <auto setting, Settings::Effect effect>
void changeSetting(World& world, SettingType<setting> value) {
  world.change(setting, std::move(value), effect);
}

template <auto setting, Settings::Effect effect>
void addSetting(ClassBinder& binder, const char* name, const Hint& hint = {}) {
  binder.property<&changeSetting<setting, effect>, &settingOf<setting>>(name, hint);
}

Object grammarOf(const World& world) { return world.node().grammar.object(); }
bool isRunning(const World& world) { return world.stage().isRunning(); }
bool isIdle(const World& world) { return world.stage().isIdle(); }
std::string errorText(const World& world) { return world.node().messages.error(); }
void setEditorView(World& world, const Transform& view, double fov) {
  world.stage().viewers().setEditorView(view, fov);
}

}  // namespace

void World::registerClass(ClassRecord& record) {
  constexpr int kInt = GDEXTENSION_VARIANT_TYPE_INT, kText = GDEXTENSION_VARIANT_TYPE_STRING,
                kKey = GDEXTENSION_VARIANT_TYPE_VECTOR4I, kMap = GDEXTENSION_VARIANT_TYPE_DICTIONARY,
                kObject = GDEXTENSION_VARIANT_TYPE_OBJECT, kNumbers = GDEXTENSION_VARIANT_TYPE_PACKED_INT64_ARRAY;
  record.name = "SgmWorld3D";
  record.parent = "Node3D";
  ClassBinder binder = ClassBinder::add<World>(record);
  binder.property<&World::setGrammar, &grammarOf>("grammar", {kResourceType, "SgmGrammar", "SgmGrammar"});
#define SGM_SETTING(type, name, otherwise, effect, ...) \
  addSetting<&Settings::name, Settings::effect>(binder, #name __VA_OPT__(, ) __VA_ARGS__);
#define SGM_SETTING_GROUP(title) binder.group(title);
#include "settings.def"
#undef SGM_SETTING_GROUP
#undef SGM_SETTING
  binder.readOnly<&isRunning>("running", {0, "", "", kReadOnlyShown})
      .method_<&isRunning>("is_running")
      .method_<&World::followGrammar>("_grammar_changed")
      .method_<&figure>("_monitor", {"key"})
      .method_<&World::restart>("restart")
      .method_<&errorText>("get_error_text")
      .method_<&setEditorView>("set_editor_view", {"transform", "fov_degrees"})
      .method_<&isIdle>("is_idle")
      .method_<&World::waitUntilIdle>("wait_until_idle", {"seconds"})
      .method_<&dig>("dig", {"position", "radius", "smooth"}, {0.0})
      .method_<&build>("build", {"position", "radius", "material", "smooth"}, {"", 0.0})
      .method_<&edit>("edit", {"brush"})
      .method_<&undo>("undo", {"id"})
      .method_<&countEdits>("get_edit_count")
      .method_<&exportEdits>("export_edits", {"since"}, {int64_t{0}})
      .method_<&importEdits>("import_edits", {"bytes"})
      .method_<&flushEdits>("flush_edits")
      .method_<&hashEdits>("get_edits_hash")
      .method_<&castRay>("ray_cast", {"from", "direction", "length"})
      .method_<&findClosestPoint>("closest_point", {"position", "max_distance"})
      .method_<&findPath>("find_way", {"from", "to", "radius"})
      .method_<&listAnchors>("get_anchors", {"box"})
      .method_<&sampleDensity>("sample_density", {"corner", "spacing", "size", "to_sun", "fade", "edge"}, {0.0})
      .method_<&drawnBounds>("get_bounds")
      .method_<&hashWorld>("get_world_hash", {"box", "level"}, {int64_t{0}})
      .method_<&statistics>("get_statistics")
      .method_<&drawnMeasures>("get_measures")
      .method_<&measureDrawn>("measure_drawn", {"bins"}, {int64_t{33}})
      .method_<&bakeChunks>("bake_chunks")
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

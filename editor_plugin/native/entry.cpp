// The entry point of the library: the engine calls sgm_godot_init, which sgm.gdextension names.

#include <deque>

#include "class_reference.h"
#include "godot/class_binder.h"
#include "grammar.h"
#include "grammar_files.h"
#include "plugin.h"
#include "viewer.h"
#include "world/world.h"

namespace sgm_godot {
namespace {

/// Data of the library, which live from the call of the entry point until the last initialization level ends.
struct Loaded {
  Plugin plugin;
  std::deque<ClassRecord> classes;
  Variant loader, saver;
};

void writeLog(void*, sgm_log_level level, const char* message) {
  if (level == SGM_LOG_ERROR) logError(message);
  if (level == SGM_LOG_WARNING) logWarning(message);
}

// The runtime calls the profiler's hook `thread` in each of its threads before the thread does any work. The plugin
// uses this hook to lower the thread's priority.
constexpr sgm_profiler kThreads{[](void*, const char*) -> uint64_t { return 0; }, [](void*, uint64_t) {},
                                [](void*, const char*) { yieldToEngine(); }, nullptr, nullptr};

Variant singleton(const char* name) { return Variant(engine().global_get_singleton(Name(name).get())); }

/// Returns the reason why this library cannot be used in this engine; an empty text if it can.
std::string reasonAgainst() {
  GDExtensionGodotVersion version{};
  engine().get_godot_version(&version);
  if (version.major != 4 || version.minor < 3) {
    return "this engine is " + std::string(version.string) + "; the plugin is for Godot 4.3 and newer 4.x";
  }
  if (singleton("OS").call("has_feature", "double").truth()) {
    return "this engine was built with precision=double, the plugin for precision=single; use a standard build";
  }
  if (sgm_version() != SGM_API_VERSION) {
    return "the plugin was built for libsgm " + std::to_string(SGM_VERSION_MAJOR) + "." +
           std::to_string(SGM_VERSION_MINOR) + "." + std::to_string(SGM_VERSION_PATCH) + " and found " +
           sgm_version_string() + "; copy the whole folder addons/sgm/bin of one build";
  }
  return {};
}

template <class T>
void add(Loaded& loaded) {
  ClassRecord& record = loaded.classes.emplace_back();
  record.plugin = &loaded.plugin;
  T::registerClass(record);
}

bool start(Loaded& loaded) {
  const std::string reason = reasonAgainst();
  if (!reason.empty()) {
    logError("SG+M is not loaded: " + reason);
    return false;
  }
  Plugin& plugin = loaded.plugin;
  static constexpr sgm_log_sink kLog{writeLog, nullptr};
  sgm_runtime_desc desc = SGM_RUNTIME_DESC_INIT;
  desc.log = &kLog;
  desc.profiler = &kThreads;
  sgm_error error = SGM_ERROR_INIT;
  if (sgm_runtime_create(&desc, &plugin.runtime, &error) < SGM_OK) {
    logError(std::string("SG+M is not loaded: ") + error.message);
    return false;
  }
  plugin.background = std::make_unique<Background>();
  plugin.in_editor = singleton("Engine").call("is_editor_hint").truth();
  add<Grammar>(loaded);
  add<GrammarLoader>(loaded);
  add<GrammarSaver>(loaded);
  add<Viewer>(loaded);
  add<World>(loaded);
  const auto made = [](const char* name) { return Variant(engine().classdb_construct_object(Name(name).get())); };
  loaded.loader = made("SgmGrammarLoader");
  loaded.saver = made("SgmGrammarSaver");
  singleton("ResourceLoader").call("add_resource_format_loader", loaded.loader, true);
  singleton("ResourceSaver").call("add_resource_format_saver", loaded.saver, true);
  return true;
}

void stop(Loaded& loaded) {
  if (!loaded.loader.isNil()) {
    singleton("ResourceLoader").call("remove_resource_format_loader", loaded.loader);
    singleton("ResourceSaver").call("remove_resource_format_saver", loaded.saver);
  }
  loaded.loader = loaded.saver = Variant();
  for (auto record = loaded.classes.rbegin(); record != loaded.classes.rend(); ++record) removeClass(*record);
  loaded.classes.clear();
  Plugin& plugin = loaded.plugin;
  plugin.background.reset();  // the destructor waits until all worlds have been destroyed
  plugin.rendering.reset();
  plugin.physics.reset();
  if (plugin.runtime != nullptr && sgm_runtime_destroy(plugin.runtime) != SGM_OK) {
    logError("SG+M: something that was made of the runtime outlives the plugin");
  }
  plugin.runtime = nullptr;
}

/// Passes the class reference to the editor's help. The engine removes it when the classes are unregistered.
void document() {
  if (engine().load_help == nullptr) return;
  for (const std::string_view xml : classReference()) {
    engine().load_help(xml.data(), static_cast<GDExtensionInt>(xml.size()));
  }
}

void initialise(void* userdata, GDExtensionInitializationLevel level) {
  auto& loaded = *static_cast<Loaded*>(userdata);
  if (level == GDEXTENSION_INITIALIZATION_SCENE) start(loaded);
  // Only editors reach this level. Without a runtime, the classes were not registered, so there is nothing to describe.
  if (level == GDEXTENSION_INITIALIZATION_EDITOR && loaded.plugin.runtime != nullptr) document();
}

void deinitialise(void* userdata, GDExtensionInitializationLevel level) {
  // Levels end in the reverse order of their start, so the scene level, the lowest that this library uses, ends last.
  if (level != GDEXTENSION_INITIALIZATION_SCENE) return;
  auto* loaded = static_cast<Loaded*>(userdata);
  stop(*loaded);
  delete loaded;
}

}  // namespace
}  // namespace sgm_godot

extern "C" __attribute__((visibility("default"))) GDExtensionBool sgm_godot_init(
    GDExtensionInterfaceGetProcAddress address, GDExtensionClassLibraryPtr library,
    GDExtensionInitialization* initialization) {
  using namespace sgm_godot;
  if (const char* missing = loadInterface(address, library); missing != nullptr) {
    // The interface is not loaded, so get the function that prints the error directly.
    const auto print = reinterpret_cast<GDExtensionInterfacePrintErrorWithMessage>(
        reinterpret_cast<void*>(address("print_error_with_message")));
    if (print != nullptr) {
      print("SG+M is not loaded: the plugin is for Godot 4.3 and newer", missing, "SG+M", "sgm", 0, 1);
    }
    return 0;
  }
  auto* loaded = new (std::nothrow) Loaded;
  if (loaded == nullptr) return 0;
  initialization->minimum_initialization_level = GDEXTENSION_INITIALIZATION_SCENE;
  initialization->userdata = loaded;
  initialization->initialize = initialise;
  initialization->deinitialize = deinitialise;
  return 1;
}

#include "world/monitors.h"

namespace sgm_godot {
namespace {

/// A figure that the engine's debugger shows: its title in the debugger, and its key in the world's statistics.
struct Monitor {
  const char* title;
  const char* key;
};
constexpr Monitor kMonitors[] = {
    {"main thread (ms)", "main_thread_ms"},
    {"main thread p99 (ms)", "main_thread_p99_ms"},
    {"chunks drawn", "drawn"},
    {"chunks waiting", "queued"},
    {"triangles", "triangles"},
    {"mesh memory (MiB)", "mesh_mib"},
    {"uploads waiting", "uploads_waiting"},
    {"colliders", "colliders"},
    {"colliders waiting", "colliders_waiting"},
};

Variant performance() { return Variant(engine().global_get_singleton(Name("Performance").get())); }

}  // namespace

void Monitors::add(Object node) {
  const Variant server = performance();
  const std::string owner = "SG+M " + Variant(node).call("get_name").to<std::string>();
  const Variant figure = callable(node, Name("_monitor"));
  for (const Monitor& m : kMonitors) {
    const std::string id = owner + "/" + m.title;
    // skip a figure that another world has already registered: its node has the same name
    if (server.call("has_custom_monitor", Name(id)).truth()) continue;
    const Variant arguments = Variant::array();
    arguments.append(m.key);
    server.call("add_custom_monitor", Name(id), figure, arguments);
    ids_.push_back(id);
  }
}

void Monitors::remove() {
  const Variant server = performance();
  for (const std::string& id : ids_) server.call("remove_custom_monitor", Name(id));
  ids_.clear();
}

}  // namespace sgm_godot

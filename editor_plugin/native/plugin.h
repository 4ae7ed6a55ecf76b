#pragma once
// Data that all objects of this plugin share, from the engine's start to its end.

#include <sgm/sgm.h>

#include <map>
#include <memory>
#include <string>
#include <utility>

#include "background.h"
#include "physics.h"
#include "rendering.h"

namespace sgm_godot {

struct Plugin {
  sgm_runtime* runtime = nullptr;
  /// The thread that packs meshes and destroys worlds.
  std::unique_ptr<Background> background;
  /// Wrappers of the engine's servers. The servers exist when the first world enters a scene, which then sets these
  /// members.
  std::unique_ptr<Rendering> rendering;
  std::unique_ptr<Physics> physics;
  /// Instance ids of the shaders that worlds share, by file and pattern mask (materials.cpp). Main thread only.
  std::map<std::pair<std::string, uint32_t>, uint64_t> shaders;
  bool in_editor = false;
  /// While this flag is true, the plugin reports to the engine that .sgm files are not resources, so that the editor's
  /// FileSystem dock opens them as text.
  bool files_are_text = false;
};

}  // namespace sgm_godot

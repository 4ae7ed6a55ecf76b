#pragma once
// What all objects of this plugin share, from the engine's start to its end.

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
  /// Packs meshes and ends worlds.
  std::unique_ptr<Background> background;
  /// The engine's servers: they are there when the first world enters a scene, which then fills these in.
  std::unique_ptr<Rendering> rendering;
  std::unique_ptr<Physics> physics;
  /// Ids of the shaders that worlds share, by file and patterns (materials.cpp). Main thread.
  std::map<std::pair<std::string, uint32_t>, uint64_t> shaders;
  bool in_editor = false;
  /// While it is set, the engine is told that .sgm files are no resources: the editor's file dock opens them as text
  /// then.
  bool files_are_text = false;
};

}  // namespace sgm_godot

#pragma once
// The settings of an SgmWorld3D and their defaults.

#include <map>
#include <string>
#include <vector>

#include "godot/variant.h"

namespace sgm_godot {

struct Settings {
  int64_t seed = 0;
  std::map<std::string, double> parameters;  // values of parameters that differ from the grammar's defaults
  int64_t backend = 0;                       // a value of sgm_backend
  double cell_size = 0.5, finest_distance = 32, view_distance = 300;  // all in metres
  int64_t coarsest_level = -1;                                        // -1: depends on view_distance
  bool by_distance = false, sharp = false, morph = true, measure = true;
  int64_t mesh_memory = 256;  // MiB
  std::string journal, cache_folder;
  std::vector<std::string> stores;  // folders, and URLs of web servers

  int64_t mapping = 0;  // 0: triplanar, 1: texture coordinates
  std::map<std::string, Variant> materials;
  std::map<std::string, Color> colors;
  bool cast_shadow = true;
  int64_t render_layers = 1;

  bool collision = false;
  double collision_distance = 48;
  int64_t collision_layer = 1, collision_mask = 1;

  Variant anchor_scenes = Variant::dictionary();
  Vector3i origin;
  double frame_budget = 1.0;  // milliseconds of main-thread time for each frame
  bool preview = true, hot_reload = true;
};

}  // namespace sgm_godot

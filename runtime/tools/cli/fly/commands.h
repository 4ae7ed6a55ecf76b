#pragma once
// The options of `sgm fly`.

#include <cstdint>
#include <string>
#include <vector>

#include "tools/support/console.h"
#include "tools/support/options.h"
#include "tools/support/serving.h"

namespace sgm::cli {

struct FlyOptions : WorldOptions {
  std::string path;  ///< JSON file with the points of the path; empty: the path is planned automatically
  double speed = 20;
  uint64_t frames = 600;
  uint64_t teleports = 0;
  double edits = 0;      ///< number of digs (edits of the world) per second of the flight
  bool animate = false;  ///< true: animates grammar parameters during the flight
  /// Names of the parameters to animate; empty: all parameters that the grammar declares animated.
  std::vector<std::string> animated;
  bool check = false, unpaced = false, compare = false;
  bool measure = false;  ///< true: measures the mesh of every chunk (SGM_WORLD_MEASURE)
  int top_level = 6;
  /// In metres: the distance up to which level 0 (the finest) is drawn; the additional distance in which level 0 is
  /// already requested; and the view distance.
  double finest = 24, finest_margin = 6, view = 600;
  uint64_t mesh_mb = 256;
  uint64_t pictures = 0;
  std::string out = "flight.png";
  std::string light = "auto";  ///< light of the pictures: "auto", "sun", "lamp" or "none"
  bool levels = false;
  std::string video;                ///< .mp4 file to write; empty: none
  std::string journal, cache;       ///< file of the edit journal; folder of the disk cache; empty: none
  std::vector<std::string> stores;  ///< store folders with baked worlds
  bool serve = false, keep_serving = false;
  ServingOptions serving;  ///< settings of the service that watches the world; used if `serve` is set
};
Exit fly(const FlyOptions& options);

}  // namespace sgm::cli

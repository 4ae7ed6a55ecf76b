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
  std::string path;  ///< a JSON file; empty: the flight plans its own path
  double speed = 20;
  uint64_t frames = 600;
  uint64_t teleports = 0;
  double edits = 0;      ///< number of digs per second of the path
  bool animate = false;  ///< animates parameters during the flight
  /// Names of the parameters to animate; empty: all that the grammar declares animated.
  std::vector<std::string> animated;
  bool check = false, unpaced = false, compare = false;
  bool measure = false;  ///< measures every meshed chunk
  int top_level = 6;
  double finest = 24, finest_margin = 6, view = 600;  ///< distances in metres; see the command's help
  uint64_t mesh_mb = 256;
  uint64_t pictures = 0;
  std::string out = "flight.png";
  std::string light = "auto";  ///< light of the pictures, as RenderOptions::light
  bool levels = false;
  std::string video;                ///< an .mp4 file; empty: none
  std::string journal, cache;       ///< the file of the edit journal, and the folder of the disk cache; empty: none
  std::vector<std::string> stores;  ///< folders of baked worlds
  bool serve = false, keep_serving = false;
  ServingOptions serving;  ///< used if `serve` is set
};
Exit fly(const FlyOptions& options);

}  // namespace sgm::cli

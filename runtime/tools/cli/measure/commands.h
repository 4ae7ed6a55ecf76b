#pragma once
// The commands that measure meshes and list devices.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tools/support/console.h"
#include "tools/support/options.h"

namespace sgm::cli {

struct MeasureOptions : WorldOptions {
  double weld = 0;  ///< metres
  uint32_t bins = 33;
  std::string mode = "corrected";
  double curvature_length = 1;  ///< metres
  bool unique_edges = false;
  std::optional<double> cubes;  ///< metres
  bool no_self_intersections = false;
  bool strict = false;                             ///< fail where the mesh is not valid
  std::vector<std::string> of_grammars, of_files;  ///< options that were given which only these have
  bool field = false;                              ///< also against the grammar's field
  int levels = 0;                                  ///< also so many pairs of levels, from `level` on
  bool drawing = false;                            ///< also what drawing it costs
  std::optional<double> texels;                    ///< also the texels of a texture of this resolution
  std::string against;                             ///< also the distance to this file's mesh; empty: none
  std::string from, to;                            ///< of a way through the void, points in metres; both or neither
  std::optional<double> radius;  ///< metres: of who is to go there; given, or with a way, the void is measured
  uint64_t memory = 4096;        ///< MB
  double seconds = 300;
};
Exit measureMesh(const MeasureOptions& options);

Exit listBackends(bool json);

}  // namespace sgm::cli

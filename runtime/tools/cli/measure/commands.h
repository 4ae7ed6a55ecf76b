#pragma once
// The commands that measure meshes and list devices.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tools/support/console.h"
#include "tools/support/options.h"
#include "tools/support/sandbox.h"

namespace sgm::cli {

struct MeasureOptions : WorldOptions {
  double weld = 0;  ///< distance in metres up to which vertices of a file are merged; 0: only equal positions
  uint32_t bins = 33;
  std::string mode = "corrected";
  double curvature_length = 1;  ///< radius in metres of the ball that is at 3/4 of the range of curvatures
  bool unique_edges = false;
  std::optional<double> cubes;  ///< edge in metres of the cubes by which the volume is measured as well; empty: none
  bool no_self_intersections = false;
  bool strict = false;                             ///< fails if the mesh is not valid
  std::vector<std::string> of_grammars, of_files;  ///< given options that only grammars or only files have
  bool field = false;                              ///< also compares with the grammar's field
  int levels = 0;                                  ///< also compares this many pairs of levels, from `level` on
  bool drawing = false;                            ///< also measures the cost of drawing
  std::optional<double> texels;                    ///< also the texel density of a texture of this resolution
  std::string against;                             ///< also the distance to this file's mesh; empty: none
  std::string from, to;                            ///< of a path through the void, points in metres; both or neither
  std::optional<double> radius;  ///< metres: of the agent; if given, or with a path, the void is measured
  SandboxOptions sandbox;        ///< for the reading of mesh files
};
Exit measureMesh(const MeasureOptions& options);

Exit listBackends(bool json);

}  // namespace sgm::cli

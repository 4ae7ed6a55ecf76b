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
  double weld = 0;  ///< maximum distance in metres of vertices of a file that are merged; 0: only equal positions
  uint32_t bins = 33;
  std::string mode = "corrected";
  /// Length L of HistogramMode::curvature, metres. The edges of a ball with radius L lie at 3/4 of the histogram's
  /// range.
  double curvature_length = 1;
  bool unique_edges = false;
  /// Edge in metres of the cubes that are counted for an additional measurement of the volume; empty: no such
  /// measurement.
  std::optional<double> cubes;
  bool no_self_intersections = false;
  bool strict = false;  ///< true: exits with an error if the mesh is not valid
  /// names of the given options that apply only to grammars, and of those that apply only to mesh files
  std::vector<std::string> of_grammars, of_files;
  bool field = false;            ///< true: compares the mesh with the field of its grammar
  int levels = 0;                ///< number of pairs of successive levels to compare, from `level` on
  bool drawing = false;          ///< true: estimates the cost of drawing the mesh on a GPU
  std::optional<double> texels;  ///< resolution of the texture whose texel density is measured
  std::string against;           ///< mesh file to which the distance is measured; empty: none
  std::string from, to;          ///< end points in metres of a path through the void; both or neither
  /// Radius, in metres, of an agent. If `radius` or `from` is set, the command measures the void through which the
  /// agent moves, instead of the surface.
  std::optional<double> radius;
  SandboxOptions sandbox;  ///< limits of the process that reads mesh files
};
Exit measureMesh(const MeasureOptions& options);

Exit listBackends(bool json);

}  // namespace sgm::cli

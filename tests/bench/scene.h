#pragma once
// The fixed scenes of the benchmarks, as grammar texts: what is measured is what a user would write.

#include <cstdint>
#include <string>
#include <vector>

namespace bench {

struct Scene {
  std::string name;
  std::string text;    ///< the grammar
  int32_t cell_units;  ///< edge of a cell where the scene is meshed with `cells` cells on an axis
  int32_t origin[3];   ///< lowest corner of the cube that is meshed, units, on a chunk border
};

/// sphere, blobs (a sum of 200), spheres (a union of 1,000) and cave (read from cave_path), each filling a cube of
/// `cells` cells (a multiple of 64) on an edge. The same numbers give the same scenes on every machine.
std::vector<Scene> makeScenes(int cells, const std::string& cave_path);

}  // namespace bench

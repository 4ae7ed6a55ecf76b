#pragma once
// The fixed scenes of the benchmarks. They are grammar texts, so that the benchmarks measure what a user would write.

#include <cstdint>
#include <string>
#include <vector>

namespace bench {

struct Scene {
  std::string name;
  std::string text;    ///< source text of the grammar
  int32_t cell_units;  ///< edge of a grid cell in units, for the requested number of cells along an axis
  int32_t origin[3];   ///< lowest corner of the meshed cube in units; lies on a chunk border
};

/// Makes a scene by its name:
///   sphere     one sphere
///   blobs      a sum of 200 balls
///   caves      300 tunnels and noise, cut out of rock
///   spheres    a union of 1,000 spheres (or N: "spheres:N"), with the same total volume for any number
///   cave       128 m of the sample in the file cave_path
///   world      as much of that sample as `cells` cells of 0.5 m cover
/// A scene fills a cube with `cells` cells along each edge: a multiple of a chunk's cells, and a power of two from 32
/// to 2048 except for `world`. Every machine makes the same scenes. Throws std::runtime_error for an unknown name or an
/// invalid number of cells.
Scene makeScene(const std::string& name, int cells, const std::string& cave_path);

/// Ball number i of the scene `blobs`: its centre and radius in units.
struct Ball {
  int32_t centre[3], radius;
};
Ball blobAt(uint64_t i);
inline constexpr uint64_t kBlobs = 200;

}  // namespace bench

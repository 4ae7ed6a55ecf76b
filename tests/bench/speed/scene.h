#pragma once
// The fixed scenes of the benchmarks. They are grammar texts, so that the benchmarks measure what a user would write.

#include <cstdint>
#include <string>
#include <vector>

namespace bench {

struct Scene {
  std::string name;
  std::string text;    ///< text of the grammar
  int32_t cell_units;  ///< edge of a grid cell, if the scene is meshed with `cells` cells on an axis
  int32_t origin[3];   ///< lowest corner of the meshed cube, units; on a chunk border
};

/// Makes a scene by its name: sphere; blobs, a sum of 200 balls; caves, 300 tunnels and noise cut out of rock; spheres,
/// a union of 1,000 (or N as spheres:N) whose radii keep the filled volume equal; cave, 128 m of the sample that
/// cave_path names; world, as much of that sample as `cells` cells of 0.5 m cover. Each fills a cube of `cells` cells
/// on an edge, which must be whole chunks, and except for world one of 32, 64, ... 2048. Every machine makes the same
/// scenes. Throws std::runtime_error for an unknown name and for any other number of cells.
Scene makeScene(const std::string& name, int cells, const std::string& cave_path);

/// Ball i of the scene blobs: its centre and radius in units.
struct Ball {
  int32_t centre[3], radius;
};
Ball blobAt(uint64_t i);
inline constexpr uint64_t kBlobs = 200;

}  // namespace bench

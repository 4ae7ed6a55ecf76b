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

/// sphere; blobs, a sum of 200; caves, 300 tunnels and noise cut out of rock; spheres, a union of 1,000, or of N as
/// spheres:N, with radii that leave as much filled; cave, 128 m of the sample that cave_path names; and world, as much
/// of it as `cells` of half a metre make. Each fills a cube of `cells` cells on an edge: whole chunks, and of all but
/// world one of 32, 64, ... 2048. The same numbers give the same scenes on every machine. Throws std::runtime_error for
/// an unknown name and for other cells.
Scene makeScene(const std::string& name, int cells, const std::string& cave_path);

/// Blob i of the scene blobs: its centre and radius in units.
struct Ball {
  int32_t centre[3], radius;
};
Ball blobAt(uint64_t i);
inline constexpr uint64_t kBlobs = 200;

}  // namespace bench

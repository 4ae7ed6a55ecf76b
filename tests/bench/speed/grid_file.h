#pragma once
// Reads and writes grids of samples as files, so that every program meshes the same samples. A file begins with four
// int32: the numbers of samples along x, y and z, and 0. Then follow the float32 samples in units of a cell, x fastest,
// negative inside the solid.

#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace bench {

struct Grid {
  int32_t size[3] = {0, 0, 0};
  std::vector<float> values;
};

inline void writeGrid(const std::string& path, const Grid& grid) {
  std::ofstream out(path, std::ios::binary);
  const int32_t header[4] = {grid.size[0], grid.size[1], grid.size[2], 0};
  out.write(reinterpret_cast<const char*>(header), sizeof header);
  out.write(reinterpret_cast<const char*>(grid.values.data()),
            static_cast<std::streamsize>(grid.values.size() * sizeof(float)));
  out.flush();
  if (!out) throw std::runtime_error("cannot write " + path);
}

inline Grid readGrid(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  int32_t header[4] = {0, 0, 0, 0};
  in.read(reinterpret_cast<char*>(header), sizeof header);
  Grid grid{{header[0], header[1], header[2]}, {}};
  grid.values.resize(static_cast<size_t>(header[0]) * static_cast<size_t>(header[1]) * static_cast<size_t>(header[2]));
  in.read(reinterpret_cast<char*>(grid.values.data()),
          static_cast<std::streamsize>(grid.values.size() * sizeof(float)));
  if (!in) throw std::runtime_error("cannot read " + path);
  return grid;
}

}  // namespace bench

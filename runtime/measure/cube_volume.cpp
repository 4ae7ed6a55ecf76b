#include "measure/cube_volume.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/large_pages.h"
#include "measure/column.h"

namespace sgm::measure {
namespace {

/// The grid of samples as columns along z: the samples of column (x, y) are the bits of a row of words.
struct Lattice {
  Point first;
  double edge = 0;
  size_t nx = 0, ny = 0, nz = 0;

  size_t words() const { return (nz + 63) / 64; }
  double x(size_t i) const { return first.x + static_cast<double>(i) * edge; }
  double y(size_t j) const { return first.y + static_cast<double>(j) * edge; }
  double z(size_t k) const { return first.z + static_cast<double>(k) * edge; }
};

/// A point where a column crosses the surface. Walking upwards, the column enters the solid there (turn 1) or leaves it
/// (turn -1).
struct Crossing {
  uint64_t column;
  double z;
  int turn;
  bool operator<(const Crossing& o) const {
    return column != o.column ? column < o.column : z != o.z ? z < o.z : turn < o.turn;
  }
};

/// Returns the first and the last sample of a range on one axis that includes all samples with coordinates between
/// `low` and `high`.
std::pair<size_t, size_t> samplesIn(double low, double high, double first, double edge, size_t count) {
  const double last = static_cast<double>(count - 1);
  const double a = std::clamp(std::floor((low - first) / edge), 0.0, last);
  const double b = std::clamp(std::ceil((high - first) / edge), 0.0, last);
  return {static_cast<size_t>(a), static_cast<size_t>(b)};
}

void crossingsOf(const std::array<Point, 3>& t, const Lattice& lattice, LargeVector<Crossing>& crossings) {
  const auto [low_x, high_x] = std::minmax({t[0].x, t[1].x, t[2].x});
  const auto [low_y, high_y] = std::minmax({t[0].y, t[1].y, t[2].y});
  const auto [low_z, high_z] = std::minmax({t[0].z, t[1].z, t[2].z});
  const auto [i0, i1] = samplesIn(low_x, high_x, lattice.first.x, lattice.edge, lattice.nx);
  const auto [j0, j1] = samplesIn(low_y, high_y, lattice.first.y, lattice.edge, lattice.ny);
  const Point normal = asset::cross(t[1] - t[0], t[2] - t[0]);
  for (size_t j = j0; j <= j1; ++j) {
    for (size_t i = i0; i <= i1; ++i) {
      const double x = lattice.x(i), y = lattice.y(j);
      const int turn = turnOver(t, x, y);
      if (turn == 0) continue;
      const double z = t[0].z - (normal.x * (x - t[0].x) + normal.y * (y - t[0].y)) / normal.z;
      // The column is traversed upwards, so at a triangle that faces up it leaves the solid. A nearly vertical triangle
      // may give any z or NaN, so z is clamped to the triangle's extent.
      crossings.push_back({i + lattice.nx * j, z > low_z ? std::min(z, high_z) : low_z, -turn});
    }
  }
}

LargeVector<uint64_t> insideOf(const Triangles& mesh, const Lattice& lattice) {
  LargeVector<Crossing> crossings(mesh.memory);
  for (const Triangle& t : mesh.triangles) {
    crossingsOf({mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]}, lattice, crossings);
  }
  std::sort(crossings.begin(), crossings.end());
  LargeVector<uint64_t> inside(lattice.nx * lattice.ny * lattice.words(), mesh.memory);
  for (size_t c = 0; c < crossings.size();) {
    const uint64_t column = crossings[c].column;
    uint64_t* bits = inside.data() + column * lattice.words();
    int depth = 0;
    size_t k = 0;
    for (; c < crossings.size() && crossings[c].column == column; ++c) {
      // Process the samples below the crossing. A sample exactly at the crossing counts as above it.
      for (; k < lattice.nz && lattice.z(k) < crossings[c].z; ++k)
        if (depth > 0) bits[k / 64] |= uint64_t{1} << k % 64;
      depth += crossings[c].turn;
    }
    for (; depth > 0 && k < lattice.nz; ++k) bits[k / 64] |= uint64_t{1} << k % 64;
  }
  return inside;
}

uint64_t countOf(const LargeVector<uint64_t>& bits) {
  uint64_t count = 0;
  for (const uint64_t word : bits) count += static_cast<uint64_t>(std::popcount(word));
  return count;
}

}  // namespace

Result<CubeVolumes> cubeVolumes(const Triangles& mesh, Point low, Point high, double edge) {
  if (!(edge > 0) || !std::isfinite(edge)) {
    return Error{Code::invalid_argument, "the edge of the cubes that are counted must be more than 0"};
  }
  std::array<double, 3> cubes{};
  for (int axis = 0; axis < 3; ++axis) {
    cubes[static_cast<size_t>(axis)] = std::floor((high[axis] - low[axis]) / edge) + 3;
  }
  if (!(cubes[0] * cubes[1] * std::max(cubes[2], 64.0) <= static_cast<double>(kMaxCubes))) {
    return Error{Code::limit, "the mesh's box holds more than 2^30 cubes: choose larger ones"};
  }
  double looks = 0;
  for (const Triangle& t : mesh.triangles) {
    double columns = 1;
    for (int axis = 0; axis < 2; ++axis) {
      const auto [least, most] =
          std::minmax({mesh.points[t[0]][axis], mesh.points[t[1]][axis], mesh.points[t[2]][axis]});
      columns *= (most - least) / edge + 2;
    }
    looks += columns;
  }
  if (!(looks <= static_cast<double>(kMaxLooks))) {
    return Error{Code::limit, "the mesh's triangles lie over more than 2^27 columns of cubes: choose larger ones"};
  }
  Lattice corners;
  corners.edge = edge;
  corners.first = low - edge * Point{1, 1, 1};
  corners.nx = static_cast<size_t>(cubes[0]) + 1;
  corners.ny = static_cast<size_t>(cubes[1]) + 1;
  corners.nz = static_cast<size_t>(cubes[2]) + 1;
  Lattice centres = corners;
  centres.first = low - 0.5 * edge * Point{1, 1, 1};
  --centres.nx, --centres.ny, --centres.nz;

  CubeVolumes result;
  result.edge = edge;
  result.centre = countOf(insideOf(mesh, centres));
  const LargeVector<uint64_t> inside = insideOf(mesh, corners);
  const size_t words = corners.words();
  const auto column = [&](size_t x, size_t y) { return inside.data() + (x + corners.nx * y) * words; };
  LargeVector<uint64_t> all(words + 1, mesh.memory), any(words + 1, mesh.memory);
  for (size_t y = 0; y + 1 < corners.ny; ++y) {
    for (size_t x = 0; x + 1 < corners.nx; ++x) {
      const uint64_t *a = column(x, y), *b = column(x + 1, y), *c = column(x, y + 1), *d = column(x + 1, y + 1);
      for (size_t w = 0; w < words; ++w) {
        all[w] = a[w] & b[w] & c[w] & d[w];
        any[w] = a[w] | b[w] | c[w] | d[w];
      }
      // Bit i stands for the cube between samples i and i + 1. The last sample of a column is outside the body, so the
      // cube beyond it is never counted.
      for (size_t w = 0; w < words; ++w) {
        result.all += static_cast<uint64_t>(std::popcount(all[w] & (all[w] >> 1 | all[w + 1] << 63)));
        result.any += static_cast<uint64_t>(std::popcount(any[w] | (any[w] >> 1 | any[w + 1] << 63)));
      }
    }
  }
  return result;
}

}  // namespace sgm::measure

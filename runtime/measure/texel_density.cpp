#include "measure/texel_density.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "measure/area_volume.h"

namespace sgm::measure {

TexelDensities texelDensities(const Triangles& mesh, std::span<const std::array<float, 2>> coordinates,
                              std::span<const Triangle> corners, double resolution) {
  struct Part {
    double density, area;
  };
  std::vector<Part> parts;
  parts.reserve(mesh.triangles.size());
  TexelDensities result;
  double whole = 0;
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Triangle& t = mesh.triangles[i];
    const double area = 0.5 * length(crossOf(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]));
    if (!(area > 0)) {
      ++result.without_area;
      continue;
    }
    const auto place = [&](size_t k) {
      const std::array<float, 2>& uv = coordinates[corners[i][k]];
      return Point{double{uv[0]}, double{uv[1]}, 0};
    };
    const double mapped = 0.5 * length(crossOf(place(0), place(1), place(2)));
    if (!(mapped > 0 && std::isfinite(mapped))) {
      ++result.unmapped;
      continue;
    }
    parts.push_back({resolution * std::sqrt(mapped / area), area});
    whole += area;
  }
  result.triangles = parts.size();
  if (parts.empty()) return result;
  std::sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) { return a.density < b.density; });
  result.least = parts.front().density;
  result.most = parts.back().density;
  double below = 0;
  size_t at = 0;
  for (const auto& [share, value] : {std::pair{0.05, &result.p5}, {0.5, &result.median}, {0.95, &result.p95}}) {
    while (at + 1 < parts.size() && below + parts[at].area < share * whole) below += parts[at++].area;
    *value = parts[at].density;
  }
  return result;
}

}  // namespace sgm::measure

#include "texture/unwrap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "base/hash.h"

namespace sgm {
namespace {

/// Identifies a wedge (a copy of a vertex with its own texture coordinates): corners with equal keys share a wedge.
struct WedgeKey {
  uint32_t vertex = 0, label = 0;
  Chart chart = 0;
  int32_t turns_u = 0, turns_v = 0;
  std::array<uint16_t, 2> materials{};
  friend bool operator==(const WedgeKey&, const WedgeKey&) = default;
};

struct WedgeKeyHash {
  size_t operator()(const WedgeKey& key) const {
    const uint64_t turns = static_cast<uint32_t>(key.turns_u) | uint64_t{static_cast<uint32_t>(key.turns_v)} << 32;
    const uint64_t place = uint64_t{key.vertex} | uint64_t{key.label} << 32;
    const uint64_t shown = key.chart | uint64_t{key.materials[0]} << 16 | uint64_t{key.materials[1]} << 32;
    return static_cast<size_t>(mix64((place * 0x9E3779B97F4A7C15u + turns) * 0x9E3779B97F4A7C15u + shown));
  }
};

/// Returns the whole number n for which x + n * step is nearest to `to`.
int32_t stepsTo(double x, double to, double step) {
  return static_cast<int32_t>(std::clamp(std::floor((to - x) / step + 0.5), -1e9, 1e9));
}

TexturePoint difference(const TexturePoint& a, const TexturePoint& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

TexturePoint crossed(const TexturePoint& a, const TexturePoint& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

TexturePoint sum(const TexturePoint& a, const TexturePoint& b, const TexturePoint& c) {
  return {a[0] + b[0] + c[0], a[1] + b[1] + c[1], a[2] + b[2] + c[2]};
}

double area(double ax, double ay, double bx, double by) { return std::fabs(ax * by - ay * bx); }

}  // namespace

Unwrapped unwrap(const UnwrapInput& mesh, std::pmr::memory_resource* memory) {
  Unwrapped out(memory);
  out.corners.reserve(mesh.indices.size());
  std::pmr::unordered_map<WedgeKey, uint32_t, WedgeKeyHash> known(memory);
  known.reserve(mesh.positions.size() * 2);
  for (size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
    const std::array<uint32_t, 3> corners{mesh.indices[t], mesh.indices[t + 1], mesh.indices[t + 2]};
    const TexturePoint &a = mesh.positions[corners[0]], &b = mesh.positions[corners[1]],
                       &c = mesh.positions[corners[2]];
    TexturePoint middle = sum(a, b, c);
    for (double& part : middle) part /= 3;
    const uint32_t second = mesh.labels[corners[1]];
    const uint32_t label = second == mesh.labels[corners[2]] ? second : mesh.labels[corners[0]];
    const TextureSpace& space = mesh.space_of(label);
    const bool of_seam = t >= mesh.body_indices;
    const TexturePoint normal = of_seam
                                    ? sum(mesh.normals[corners[0]], mesh.normals[corners[1]], mesh.normals[corners[2]])
                                    : crossed(difference(b, a), difference(c, a));
    const Chart chart = space.chartOf(middle, normal);
    const TextureCoordinates period = space.period(chart);
    const TextureCoordinates first = space.at(a, chart);
    const MaterialBlend blend =
        materialBlend(mesh.materials[corners[0]], mesh.materials[corners[1]], mesh.materials[corners[2]]);
    for (size_t corner = 0; corner < 3; ++corner) {
      const uint32_t vertex = corners[corner];
      TextureCoordinates at = space.at(mesh.positions[vertex], chart);
      // Shift each periodic coordinate of a corner so that the triangle's corners are close to each other. Shift
      // non-periodic coordinates of all three corners by the same amount, so that they are near 0.
      const auto steps = [](double x, double to, double step) {
        return step > 0 ? stepsTo(x, to, step) : stepsTo(to, 0, kTilesKept);
      };
      const int32_t turns_u = steps(at.u, first.u, period.u), turns_v = steps(at.v, first.v, period.v);
      at.u += turns_u * (period.u > 0 ? period.u : kTilesKept);
      at.v += turns_v * (period.v > 0 ? period.v : kTilesKept);
      const auto [entry, is_new] = known.try_emplace({vertex, label, chart, turns_u, turns_v, blend.materials},
                                                     static_cast<uint32_t>(out.wedges.size()));
      if (is_new) {
        Wedge& wedge = out.wedges.emplace_back();
        wedge.vertex = vertex;
        wedge.u = static_cast<float>(at.u);
        wedge.v = static_cast<float>(at.v);
        wedge.materials = blend.materials;
        wedge.share = blend.share[corner];
        if (space.byWorld()) wedge.plane_shares = planeShares(mesh.normals[vertex]);
      }
      out.corners.push_back(entry->second);
    }
  }
  out.wedges.shrink_to_fit();
  return out;
}

Unwrapped pairMaterials(std::span<const uint32_t> indices, std::span<const MaterialMix> materials,
                        std::pmr::memory_resource* memory) {
  Unwrapped out(memory);
  out.corners.reserve(indices.size());
  out.wedges.reserve(materials.size());
  // For each vertex, its first wedge; nearly all vertices have only one. Further wedges are in a linked list (`next`).
  std::pmr::vector<uint32_t> first(materials.size(), kNone, memory), next(memory);
  next.reserve(materials.size());
  for (size_t t = 0; t + 2 < indices.size(); t += 3) {
    const MaterialBlend blend =
        materialBlend(materials[indices[t]], materials[indices[t + 1]], materials[indices[t + 2]]);
    for (size_t corner = 0; corner < 3; ++corner) {
      const uint32_t vertex = indices[t + corner];
      uint32_t at = first[vertex];
      while (at != kNone && out.wedges[at].materials != blend.materials) at = next[at];
      if (at == kNone) {
        at = static_cast<uint32_t>(out.wedges.size());
        Wedge& wedge = out.wedges.emplace_back();
        wedge.vertex = vertex;
        wedge.materials = blend.materials;
        wedge.share = blend.share[corner];
        next.push_back(std::exchange(first[vertex], at));
      }
      out.corners.push_back(at);
    }
  }
  return out;
}

TexelDensity texelDensity(const UnwrapInput& mesh, const Unwrapped& unwrapped, int32_t tile) {
  struct Part {
    double density, area;
  };
  std::pmr::memory_resource* memory = unwrapped.wedges.get_allocator().resource();
  std::pmr::vector<Part> parts(memory);
  double whole = 0;
  for (size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
    const auto position = [&](size_t i) { return mesh.positions[mesh.indices[t + i]]; };
    const auto wedge = [&](size_t i) { return unwrapped.wedges[unwrapped.corners[t + i]]; };
    const TexturePoint normal = crossed(difference(position(1), position(0)), difference(position(2), position(0)));
    const double on_surface = std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
    if (!(on_surface > 0)) continue;
    const Wedge a = wedge(0), b = wedge(1), c = wedge(2);
    const double on_texture = area(double{b.u} - double{a.u}, double{b.v} - double{a.v}, double{c.u} - double{a.u},
                                   double{c.v} - double{a.v});
    parts.push_back({std::sqrt(on_texture * tile * tile / on_surface), on_surface});
    whole += on_surface;
  }
  TexelDensity density;
  if (parts.empty()) return density;
  std::sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) { return a.density < b.density; });
  const auto at = [&](double share) {
    double below = 0;
    for (const Part& part : parts) {
      below += part.area;
      if (below >= share * whole) return part.density;
    }
    return parts.back().density;
  };
  density.low = at(0.05);
  density.middle = at(0.5);
  density.high = at(0.95);
  std::pmr::vector<bool> used(mesh.positions.size(), memory);
  for (const uint32_t index : mesh.indices) used[index] = true;
  const auto vertices = static_cast<double>(std::count(used.begin(), used.end(), true));
  density.seams = static_cast<double>(unwrapped.wedges.size()) / vertices - 1;
  return density;
}

}  // namespace sgm

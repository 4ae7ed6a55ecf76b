#pragma once
// Solids with edges, for tests of meshing and of sharp features.

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/hash.h"
#include "mesh/body.h"
#include "mesh/creases.h"
#include "mesh/vertex.h"

namespace sgm::test {

inline constexpr int32_t kCell = 256;

struct Field {
  virtual ~Field() = default;
  /// The field's value and gradient at a point; value and point are in units.
  virtual double at(const Vector3& p, Vector3& gradient) const = 0;
};

inline Vector3 randomDirection(const PathKey& key, uint64_t at) {
  for (;; at += 3) {
    const Vector3 v{2 * key.unit(at) - 1, 2 * key.unit(at + 1) - 1, 2 * key.unit(at + 2) - 1};
    const double length = std::sqrt(dot(v, v));
    if (length > 0.1 && length < 1) return {v[0] / length, v[1] / length, v[2] / length};
  }
}

struct TurnedBox : Field {
  Vector3 centre, half;
  std::array<Vector3, 3> axes;

  /// A randomly rotated box. Its centre is near the middle of the common face of two chunks that are neighbours in x.
  explicit TurnedBox(uint64_t seed) {
    const PathKey key{seed};
    axes[0] = randomDirection(key, 10);
    Vector3 other = cross(axes[0], randomDirection(key, 100));
    const double length = std::sqrt(dot(other, other));
    for (double& x : other) x /= length;
    axes[1] = other;
    axes[2] = cross(axes[0], axes[1]);
    for (size_t k = 0; k < 3; ++k) {
      centre[k] = (k == 0 ? 32.0 : 16.0) * kCell + (key.unit(k) - 0.5) * 2 * kCell;
      half[k] = (4 + 3 * key.unit(3 + k)) * kCell;
    }
  }
  double at(const Vector3& p, Vector3& gradient) const override {
    double value = -1e9;
    for (size_t k = 0; k < 3; ++k) {
      const double along = dot(minus(p, centre), axes[k]);
      if (const double d = std::fabs(along) - half[k]; d > value) {
        value = d;
        for (size_t i = 0; i < 3; ++i) gradient[i] = along < 0 ? -axes[k][i] : axes[k][i];
      }
    }
    return value;
  }
  /// Points along the twelve edges of the box.
  std::vector<Vector3> edgePoints() const {
    constexpr int kSteps = 120;
    std::vector<Vector3> points;
    for (size_t axis = 0; axis < 3; ++axis) {
      for (int side = 0; side < 4; ++side) {
        for (int step = -kSteps; step <= kSteps; ++step) {
          Vector3 local{};
          local[axis] = half[axis] * step / kSteps;
          local[(axis + 1) % 3] = side & 1 ? half[(axis + 1) % 3] : -half[(axis + 1) % 3];
          local[(axis + 2) % 3] = side & 2 ? half[(axis + 2) % 3] : -half[(axis + 2) % 3];
          Vector3 p = centre;
          for (size_t k = 0; k < 3; ++k) {
            for (size_t i = 0; i < 3; ++i) p[i] += local[k] * axes[k][i];
          }
          points.push_back(p);
        }
      }
    }
    return points;
  }
};

struct Sphere : Field {
  double radius;
  Vector3 centre;
  /// By default, the centre is near the middle of the common face of two chunks that are neighbours in x.
  explicit Sphere(double r, const Vector3& c = {32.0 * kCell + 17, 16.0 * kCell - 5, 16.0 * kCell + 60})
      : radius(r), centre(c) {}
  double at(const Vector3& p, Vector3& gradient) const override {
    const Vector3 d = minus(p, centre);
    const double length = std::sqrt(dot(d, d));
    gradient = {d[0] / length, d[1] / length, d[2] / length};
    return length - radius;
  }
};

/// Stores a direction as the packed normal of a vertex or sample.
template <class Packed>
void setNormal(const Vector3& n, Packed& packed) {
  const std::array<int16_t, 2> normal = packNormal(n);
  packed.normal_x = normal[0];
  packed.normal_y = normal[1];
}

inline Vector3 exact(const Int3& p) {
  return {static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)};
}

inline ChunkSamples samplesOf(const Field& field, const ChunkGrid& grid) {
  ChunkSamples samples;
  Vector3 gradient{};
  size_t i = 0;
  for (int32_t z = 0; z < kChunkSamples; ++z) {
    for (int32_t y = 0; y < kChunkSamples; ++y) {
      for (int32_t x = 0; x < kChunkSamples; ++x, ++i) {
        const Int3 p{grid.origin.x + x * kCell, grid.origin.y + y * kCell, grid.origin.z + z * kCell};
        samples.q[i] = static_cast<int32_t>(std::floor(field.at(exact(p), gradient) * 64));
        samples.signs[static_cast<size_t>(y + z * kChunkSamples)] |= uint64_t{samples.q[i] < 0} << x;
      }
    }
  }
  return samples;
}

inline MeshPart meshChunk(const Field& field, const ChunkGrid& grid) {
  const ChunkSamples samples = samplesOf(field, grid);
  Vector3 gradient{};
  MeshPart part;
  polygonizeBody(samples, grid, part);
  for (Vertex& v : part.vertices) {
    field.at(exact(vertexUnits(grid, v)), gradient);
    setNormal(gradient, v);
  }
  return part;
}

inline FieldSampler samplerOf(const Field& field) {
  return [&field](std::span<const Int3> points, std::span<FieldSample> samples, Sampled) {
    for (size_t i = 0; i < points.size(); ++i) {
      Vector3 g{};
      const double value = field.at(exact(points[i]), g);
      samples[i].value = static_cast<float>(value);
      samples[i].q = static_cast<int32_t>(std::floor(value * 64));
      samples[i].gradient = {static_cast<float>(g[0]), static_cast<float>(g[1]), static_cast<float>(g[2])};
      setNormal(g, samples[i]);
    }
  };
}

}  // namespace sgm::test

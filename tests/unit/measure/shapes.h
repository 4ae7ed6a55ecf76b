#pragma once
// Meshes with known measures, and random meshes that are known to be valid.

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "measure/triangles.h"

namespace sgm::measure {

struct Mesh {
  std::vector<Point> points;
  std::vector<Triangle> triangles;

  operator Triangles() const { return {points, triangles}; }
  void add(const Mesh& other) {
    const auto first = static_cast<uint32_t>(points.size());
    points.insert(points.end(), other.points.begin(), other.points.end());
    for (Triangle t : other.triangles) {
      for (uint32_t& v : t) v += first;
      triangles.push_back(t);
    }
  }
  void invert() {
    for (Triangle& t : triangles) std::swap(t[1], t[2]);
  }
  template <class Move>
  Mesh moved(Move&& move) const {
    Mesh result = *this;
    for (Point& p : result.points) p = move(p);
    return result;
  }
  Mesh at(Point by) const {
    return moved([by](Point p) { return p + by; });
  }
};

inline double between(std::mt19937& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random()) / 4294967295.0;
}

/// A ball with radius 1 around the origin: an icosahedron whose triangles are divided into four, `cuts` times.
inline Mesh ball(int cuts) {
  const double g = (1 + std::sqrt(5.0)) / 2;
  Mesh mesh{{{-1, g, 0},
             {1, g, 0},
             {-1, -g, 0},
             {1, -g, 0},
             {0, -1, g},
             {0, 1, g},
             {0, -1, -g},
             {0, 1, -g},
             {g, 0, -1},
             {g, 0, 1},
             {-g, 0, -1},
             {-g, 0, 1}},
            {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
             {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
             {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
  for (int cut = 0; cut < cuts; ++cut) {
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
    const auto middle = [&](uint32_t a, uint32_t b) {
      const auto [at, made] = middles.insert({std::minmax(a, b), static_cast<uint32_t>(mesh.points.size())});
      if (made) mesh.points.push_back(0.5 * (mesh.points[a] + mesh.points[b]));
      return at->second;
    };
    std::vector<Triangle> finer;
    for (const Triangle& t : mesh.triangles) {
      const uint32_t a = middle(t[0], t[1]), b = middle(t[1], t[2]), c = middle(t[2], t[0]);
      finer.insert(finer.end(), {{t[0], a, c}, {t[1], b, a}, {t[2], c, b}, {a, b, c}});
    }
    mesh.triangles = finer;
  }
  return mesh.moved([](Point p) { return normalised(p); });
}

/// A torus around the z axis with n by n quadrangles.
inline Mesh torus(uint32_t n, double radius = 2, double thickness = 1) {
  Mesh mesh;
  for (uint32_t i = 0; i < n; ++i) {
    for (uint32_t j = 0; j < n; ++j) {
      const double u = 2 * std::numbers::pi * i / n, v = 2 * std::numbers::pi * j / n;
      const double r = radius + thickness * std::cos(v);
      mesh.points.push_back({r * std::cos(u), r * std::sin(u), thickness * std::sin(v)});
      const uint32_t a = i * n + j, b = (i + 1) % n * n + j, c = (i + 1) % n * n + (j + 1) % n, d = i * n + (j + 1) % n;
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    }
  }
  return mesh;
}

/// The surface of a box with one corner at the origin; each face has n by n quadrangles, which share their corners.
inline Mesh box(Point size, uint32_t n = 1) {
  Mesh mesh;
  std::map<std::array<uint32_t, 3>, uint32_t> numbers;
  const auto corner = [&](std::array<uint32_t, 3> at) {
    const auto [found, made] = numbers.insert({at, static_cast<uint32_t>(mesh.points.size())});
    if (made) mesh.points.push_back({size.x * at[0] / n, size.y * at[1] / n, size.z * at[2] / n});
    return found->second;
  };
  for (size_t axis = 0; axis < 3; ++axis) {
    for (const bool high : {false, true}) {
      for (uint32_t i = 0; i < n; ++i) {
        for (uint32_t j = 0; j < n; ++j) {
          const auto at = [&](uint32_t di, uint32_t dj) {
            std::array<uint32_t, 3> place{};
            place[axis] = high ? n : 0;
            place[(axis + 1) % 3] = i + di;
            place[(axis + 2) % 3] = j + dj;
            return corner(place);
          };
          const uint32_t a = at(0, 0), b = at(high ? 1 : 0, high ? 0 : 1), c = at(1, 1),
                         d = at(high ? 0 : 1, high ? 1 : 0);
          mesh.triangles.push_back({a, b, c});
          mesh.triangles.push_back({a, c, d});
        }
      }
    }
  }
  return mesh;
}

/// The surface that separates negative values from the others on a lattice of n^3 random values, by marching tetrahedra
/// with six tetrahedra for each cell. Values at the lattice's border are not negative, so the surface is closed. It has
/// no self-intersections, and any number of shells and handles.
inline Mesh randomSurface(std::mt19937& random, uint32_t n, double solid = 0.5) {
  Mesh mesh;
  std::vector<double> values(n * n * n);
  const auto number = [n](uint32_t x, uint32_t y, uint32_t z) { return x + n * (y + n * z); };
  for (uint32_t z = 0; z < n; ++z) {
    for (uint32_t y = 0; y < n; ++y) {
      for (uint32_t x = 0; x < n; ++x) {
        const bool border = x == 0 || y == 0 || z == 0 || x == n - 1 || y == n - 1 || z == n - 1;
        const double size = between(random, 0.1, 1);
        values[number(x, y, z)] = !border && between(random, 0, 1) < solid ? -size : size;
      }
    }
  }
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> crossings;
  const auto place = [n](uint32_t v) {
    return Point{static_cast<double>(v % n), static_cast<double>(v / n % n), static_cast<double>(v / n / n)};
  };
  const auto crossing = [&](uint32_t a, uint32_t b) {
    const auto [at, made] = crossings.insert({std::minmax(a, b), static_cast<uint32_t>(mesh.points.size())});
    if (made) {
      const auto [low, high] = at->first;
      const double t = values[low] / (values[low] - values[high]);
      mesh.points.push_back(place(low) + t * (place(high) - place(low)));
    }
    return at->second;
  };
  const auto tetrahedron = [&](std::array<uint32_t, 4> t) {
    // Corners with negative values (solid) come first; the order is then permuted so that the tetrahedron keeps its
    // orientation.
    std::array<uint32_t, 4> in{}, out{};
    size_t inside = 0, outside = 0;
    for (const uint32_t v : t) (values[v] < 0 ? in[inside++] : out[outside++]) = v;
    if (inside == 0 || outside == 0) return;
    std::vector<uint32_t> loop;
    if (inside == 1) {
      for (size_t k = 0; k < 3; ++k) loop.push_back(crossing(in[0], out[k]));
    } else if (outside == 1) {
      for (size_t k = 0; k < 3; ++k) loop.push_back(crossing(in[k], out[0]));
    } else {
      loop = {crossing(in[0], out[0]), crossing(in[0], out[1]), crossing(in[1], out[1]), crossing(in[1], out[0])};
    }
    const Point normal =
        cross(mesh.points[loop[1]] - mesh.points[loop[0]], mesh.points[loop[2]] - mesh.points[loop[0]]);
    if (dot(normal, place(out[0]) - place(in[0])) < 0) std::reverse(loop.begin(), loop.end());
    for (size_t k = 2; k < loop.size(); ++k) mesh.triangles.push_back({loop[0], loop[k - 1], loop[k]});
  };
  for (uint32_t z = 0; z + 1 < n; ++z) {
    for (uint32_t y = 0; y + 1 < n; ++y) {
      for (uint32_t x = 0; x + 1 < n; ++x) {
        constexpr std::array<std::array<uint32_t, 3>, 6> kOrders{
            {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
        for (const auto& order : kOrders) {
          std::array<uint32_t, 3> at{x, y, z};
          std::array<uint32_t, 4> t{number(x, y, z)};
          for (size_t k = 0; k < 3; ++k) {
            ++at[order[k]];
            t[k + 1] = number(at[0], at[1], at[2]);
          }
          tetrahedron(t);
        }
      }
    }
  }
  return mesh;
}

/// The mesh rotated by random angles, scaled uniformly, and moved.
inline Mesh placed(const Mesh& mesh, std::mt19937& random, double size, double far) {
  Point x = normalised(Point{between(random, -1, 1), between(random, -1, 1), between(random, -1, 1)});
  Point y = normalised(cross(x, Point{x.y, x.z, -x.x}));
  Point z = cross(x, y);
  const Point by{between(random, -far, far), between(random, -far, far), between(random, -far, far)};
  return mesh.moved([&](Point p) { return by + size * (p.x * x + p.y * y + p.z * z); });
}

/// The winding number of the mesh around a place: 1 inside a closed surface, 0 outside (the generalized winding number
/// of Jacobson, Kavan and Sorkine-Hornung, 2013).
inline double windingNumber(const Triangles& mesh, Point at) {
  double angle = 0;
  for (const Triangle& t : mesh.triangles) {
    const Point a = mesh.points[t[0]] - at, b = mesh.points[t[1]] - at, c = mesh.points[t[2]] - at;
    const double la = length(a), lb = length(b), lc = length(c);
    // Half of the solid angle of the triangle (Van Oosterom and Strackee, 1983).
    angle += std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return angle / (2 * std::numbers::pi);
}

/// The order of convergence, from the error at one density and the error at twice that density.
inline double orderOf(double coarse, double fine) { return std::log2(std::fabs(coarse) / std::fabs(fine)); }

}  // namespace sgm::measure

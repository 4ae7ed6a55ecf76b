#pragma once
// Meshes for tests of assets: boxes, prisms and bodies composed of them.

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "asset/polyhedron.h"
#include "asset/triangle_mesh.h"

namespace sgm::asset {

/// Makes meshes in which triangles share no points, as some modelling tools export them.
class MeshMaker {
 public:
  void triangle(Point a, Point b, Point c, uint32_t material = kNoMaterial) {
    const uint32_t first = static_cast<uint32_t>(mesh.points.size());
    mesh.points.insert(mesh.points.end(), {a, b, c});
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.materials.push_back(material);
  }

  /// Adds a quadrangle; corners are counter-clockwise as seen from outside.
  void quad(Point a, Point b, Point c, Point d, uint32_t material = kNoMaterial) {
    triangle(a, b, c, material);
    triangle(a, c, d, material);
  }

  void box(Point low, Point high, uint32_t material = kNoMaterial) {
    prism({{low.x, low.y}, {high.x, low.y}, {high.x, high.y}, {low.x, high.y}}, low.z, high.z, material);
  }

  /// Adds a prism: a polygon in x and y, counter-clockwise as seen from +z, that is extruded from z = back to z =
  /// front.
  void prism(const std::vector<std::array<double, 2>>& outline, double back, double front,
             uint32_t material = kNoMaterial) {
    const size_t n = outline.size();
    const auto at = [&](size_t i, double z) { return Point{outline[i % n][0], outline[i % n][1], z}; };
    for (size_t i = 0; i < n; ++i) quad(at(i, back), at(i + 1, back), at(i + 1, front), at(i, front), material);
    for (const auto& ear : ears(outline)) {
      triangle(at(ear[0], front), at(ear[1], front), at(ear[2], front), material);
      triangle(at(ear[0], back), at(ear[2], back), at(ear[1], back), material);
    }
  }

  TriangleMesh mesh;

 private:
  static double turn(const std::array<double, 2>& a, const std::array<double, 2>& b, const std::array<double, 2>& c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  }

  static std::vector<std::array<size_t, 3>> ears(const std::vector<std::array<double, 2>>& outline) {
    std::vector<std::array<size_t, 3>> out;
    std::vector<size_t> left;
    for (size_t i = 0; i < outline.size(); ++i) left.push_back(i);
    while (left.size() >= 3) {
      for (size_t i = 0; i < left.size(); ++i) {
        const size_t a = left[(i + left.size() - 1) % left.size()], b = left[i], c = left[(i + 1) % left.size()];
        bool ear = turn(outline[a], outline[b], outline[c]) > 1e-12;
        for (const size_t p : left) {
          if (p == a || p == b || p == c) continue;
          ear =
              ear && !(turn(outline[a], outline[b], outline[p]) >= 0 && turn(outline[b], outline[c], outline[p]) >= 0 &&
                       turn(outline[c], outline[a], outline[p]) >= 0);
        }
        if (!ear && left.size() > 3) continue;
        out.push_back({a, b, c});
        left.erase(left.begin() + static_cast<std::ptrdiff_t>(i));
        break;
      }
    }
    return out;
  }
};

/// Makes the polyhedron of a mesh, which must be the surface of a solid.
inline Polyhedron solidOf(const TriangleMesh& mesh) { return *makePolyhedron(mesh); }

/// A bay of an arcade, 3 m wide, 4 m high and 1 m deep: a wall with an opening whose arch has `chords` straight
/// segments.
inline TriangleMesh archedBay(size_t chords) {
  std::vector<std::array<double, 2>> outline{{0, 0}, {0.5, 0}};
  constexpr double kHalfTurn = 3.14159265358979323846;
  for (size_t i = 0; i <= chords; ++i) {
    const double turn = kHalfTurn * (1 - static_cast<double>(i) / static_cast<double>(chords));
    outline.push_back({1.5 + std::cos(turn), 2.4 + std::sin(turn)});
  }
  for (const std::array<double, 2>& p : {std::array{2.5, 0.0}, {3.0, 0.0}, {3.0, 4.0}, {0.0, 4.0}})
    outline.push_back(p);
  MeshMaker maker;
  maker.prism(outline, 0, 1);
  return maker.mesh;
}

/// A house with a gable, whose roof has its own material: 6 m wide, 4 m to the eaves, 6 m to the ridge, 8 m deep.
inline TriangleMesh gabledHouse() {
  MeshMaker maker;
  maker.mesh.material_names = {"plaster", "slate"};
  maker.prism({{0, 0}, {6, 0}, {6, 4}, {3, 6}, {0, 4}}, 0, 8, 0);
  for (size_t t = 0; t < maker.mesh.triangles.size(); ++t) {
    bool slopes = true;
    for (const uint32_t corner : maker.mesh.triangles[t]) slopes = slopes && maker.mesh.points[corner].y >= 4;
    const auto& c = maker.mesh.triangles[t];
    const bool upright = maker.mesh.points[c[0]].z == maker.mesh.points[c[1]].z &&
                         maker.mesh.points[c[1]].z == maker.mesh.points[c[2]].z;
    if (slopes && !upright) maker.mesh.materials[t] = 1;
  }
  return maker.mesh;
}

/// A wall with windows that pass through it, as one mesh.
inline TriangleMesh windowedWall(size_t columns, size_t rows) {
  // The front and the back are grids of quads; each hole has four reveals (inner sides).
  MeshMaker maker;
  const double depth = 0.5;
  std::vector<double> xs{0}, ys{0};
  for (size_t i = 0; i < columns; ++i) xs.insert(xs.end(), {xs.back() + 1, xs.back() + 2});
  for (size_t i = 0; i < rows; ++i) ys.insert(ys.end(), {ys.back() + 1, ys.back() + 2.5});
  xs.push_back(xs.back() + 1);
  ys.push_back(ys.back() + 1);
  const auto hole = [](size_t i, size_t j) { return i % 2 == 1 && j % 2 == 1; };
  for (size_t i = 0; i + 1 < xs.size(); ++i)
    for (size_t j = 0; j + 1 < ys.size(); ++j) {
      const double x0 = xs[i], x1 = xs[i + 1], y0 = ys[j], y1 = ys[j + 1];
      if (!hole(i, j)) {
        maker.quad({x0, y0, depth}, {x1, y0, depth}, {x1, y1, depth}, {x0, y1, depth});
        maker.quad({x0, y0, 0}, {x0, y1, 0}, {x1, y1, 0}, {x1, y0, 0});
        if (i == 0) maker.quad({x0, y0, 0}, {x0, y0, depth}, {x0, y1, depth}, {x0, y1, 0});
        if (i + 2 == xs.size()) maker.quad({x1, y0, 0}, {x1, y1, 0}, {x1, y1, depth}, {x1, y0, depth});
        if (j == 0) maker.quad({x0, y0, 0}, {x1, y0, 0}, {x1, y0, depth}, {x0, y0, depth});
        if (j + 2 == ys.size()) maker.quad({x0, y1, 0}, {x0, y1, depth}, {x1, y1, depth}, {x1, y1, 0});
      } else {
        maker.quad({x0, y0, 0}, {x0, y1, 0}, {x0, y1, depth}, {x0, y0, depth});
        maker.quad({x1, y0, 0}, {x1, y0, depth}, {x1, y1, depth}, {x1, y1, 0});
        maker.quad({x0, y0, 0}, {x0, y0, depth}, {x1, y0, depth}, {x1, y0, 0});
        maker.quad({x0, y1, 0}, {x1, y1, 0}, {x1, y1, depth}, {x0, y1, depth});
      }
    }
  return maker.mesh;
}

}  // namespace sgm::asset

#pragma once
// Random valid meshes, and functions that damage them with each kind of defect that measures must find.

#include <functional>

#include "measure/mesh_measures.h"
#include "shapes.h"

namespace sgm::measure {

/// A closed surface without self-intersections: the surface of a random field, or separate balls, rings and boxes.
inline Mesh goodMesh(std::mt19937& random) {
  Mesh mesh;
  while (mesh.triangles.empty()) {
    if (random() % 2 == 0) {
      mesh = randomSurface(random, 5 + static_cast<uint32_t>(random() % 3), between(random, 0.2, 0.6));
    } else {
      for (uint32_t i = 0; i < 1 + random() % 3; ++i) {
        const Point at{8.0 * i, 0, 0};
        switch (random() % 3) {
          case 0:
            mesh.add(ball(1 + static_cast<int>(random() % 2)).at(at));
            break;
          case 1:
            mesh.add(torus(6 + static_cast<uint32_t>(random() % 8)).at(at));
            break;
          case 2:
            mesh.add(box({1, 2, 3}, 1 + static_cast<uint32_t>(random() % 4)).at(at));
            break;
        }
      }
    }
  }
  return placed(mesh, random, between(random, 0.1, 20), random() % 2 == 0 ? 0 : 1000);
}

struct Defect {
  const char* name;
  std::function<void(Mesh&, std::mt19937&)> make;
  std::function<bool(const MeshMeasures&)> found;
};

inline uint32_t any(std::mt19937& random, size_t count) { return static_cast<uint32_t>(random() % count); }

inline Point middleOf(const Mesh& mesh, const Triangle& t) {
  return (1.0 / 3) * (mesh.points[t[0]] + mesh.points[t[1]] + mesh.points[t[2]]);
}

inline const std::vector<Defect>& defects() {
  static const std::vector<Defect> all{
      {"a triangle is missing",
       [](Mesh& mesh, std::mt19937& random) {
         mesh.triangles.erase(mesh.triangles.begin() + any(random, mesh.triangles.size()));
       },
       [](const MeshMeasures& m) { return m.identity.open_edges == 3; }},
      {"a triangle is turned over",
       [](Mesh& mesh, std::mt19937& random) {
         Triangle& t = mesh.triangles[any(random, mesh.triangles.size())];
         std::swap(t[0], t[1]);
       },
       [](const MeshMeasures& m) { return m.identity.unmatched_edges == 3 && m.identity.open_edges == 0; }},
      {"all is inside out", [](Mesh& mesh, std::mt19937&) { mesh.invert(); },
       [](const MeshMeasures& m) { return m.nesting.inside_out > 0; }},
      {"a corner is off, so that there is a crack",
       [](Mesh& mesh, std::mt19937& random) {
         Triangle& t = mesh.triangles[any(random, mesh.triangles.size())];
         uint32_t& corner = t[any(random, 3)];
         // Moves one corner by a hundredth of an edge, so that the mesh only appears to be closed.
         const Point moved =
             mesh.points[corner] + 0.01 * (mesh.points[t[0]] + mesh.points[t[1]] - 2.0 * mesh.points[t[2]]);
         corner = static_cast<uint32_t>(mesh.points.size());
         mesh.points.push_back(moved);
       },
       [](const MeshMeasures& m) { return m.identity.open_edges > 0; }},
      {"three triangles meet in an edge",
       [](Mesh& mesh, std::mt19937& random) {
         const Triangle t = mesh.triangles[any(random, mesh.triangles.size())];
         mesh.points.push_back(1.5 * middleOf(mesh, t) - 0.5 * mesh.points[t[2]]);
         mesh.triangles.push_back({t[0], t[1], static_cast<uint32_t>(mesh.points.size() - 1)});
       },
       [](const MeshMeasures& m) { return m.identity.non_manifold_edges > 0; }},
      {"two parts hang together in a point",
       [](Mesh& mesh, std::mt19937& random) {
         const uint32_t at = mesh.triangles[any(random, mesh.triangles.size())][0];
         const double size = 0.001 * length(mesh.points[mesh.triangles[0][0]] - mesh.points[mesh.triangles[0][1]]);
         Mesh part = ball(1);
         const Point to = mesh.points[at] - size * part.points[0];
         mesh.add(part.moved([&](Point p) { return to + size * p; }));
         // The first point of the ball coincides exactly with the vertex `at` of the mesh.
         mesh.points[mesh.points.size() - part.points.size()] = mesh.points[at];
       },
       [](const MeshMeasures& m) { return m.identity.pinched_vertices > 0; }},
      {"a triangle has no area",
       [](Mesh& mesh, std::mt19937& random) {
         // Points at a quarter and half of the way along an axis lie exactly on a line.
         const Triangle t = mesh.triangles[any(random, mesh.triangles.size())];
         const Point a = mesh.points[t[0]];
         const auto first = static_cast<uint32_t>(mesh.points.size());
         mesh.points.insert(mesh.points.end(), {{a.x + 0.25, a.y, a.z}, {a.x + 0.5, a.y, a.z}});
         if (random() % 2 == 0) {
           mesh.triangles.push_back({t[0], first, first + 1});
         } else {
           mesh.triangles.push_back({t[0], t[1], t[1]});
         }
       },
       [](const MeshMeasures& m) { return m.withoutArea() == 1; }},
      {"a triangle is there twice",
       [](Mesh& mesh, std::mt19937& random) {
         Triangle t = mesh.triangles[any(random, mesh.triangles.size())];
         std::rotate(t.begin(), t.begin() + any(random, 3), t.end());
         mesh.triangles.push_back(t);
       },
       [](const MeshMeasures& m) { return m.identity.duplicate_triangles == 1; }},
      {"a spike goes through the other side",
       [](Mesh& mesh, std::mt19937& random) {
         const Triangle& t = mesh.triangles[any(random, mesh.triangles.size())];
         const Point inward = cross(mesh.points[t[2]] - mesh.points[t[0]], mesh.points[t[1]] - mesh.points[t[0]]);
         mesh.points[t[0]] = mesh.points[t[0]] + 1e4 * normalised(inward);
       },
       [](const MeshMeasures& m) { return m.self_intersections->pairs > 0; }},
      {"a place is no number",
       [](Mesh& mesh, std::mt19937& random) {
         const uint32_t v = mesh.triangles[any(random, mesh.triangles.size())][any(random, 3)];
         const double bad[] = {std::nan(""), HUGE_VAL, -HUGE_VAL};
         mesh.points[v][static_cast<int>(random() % 3)] = bad[random() % 3];
       },
       [](const MeshMeasures& m) { return m.non_finite > 0; }},
      {"a second body stands in the first",
       [](Mesh& mesh, std::mt19937& random) {
         const Triangle& t = mesh.triangles[any(random, mesh.triangles.size())];
         const double size = length(mesh.points[t[0]] - mesh.points[t[1]]);
         const Point at = middleOf(mesh, t);
         mesh.add(ball(1).moved([&](Point p) { return at + size * p; }));
       },
       [](const MeshMeasures& m) { return m.self_intersections->pairs > 0 || m.nesting.nested > 0; }}};
  return all;
}

}  // namespace sgm::measure

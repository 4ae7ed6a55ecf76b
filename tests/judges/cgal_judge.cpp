// Prints CGAL's results for the meshes of a file (meshes.h), one line for each.
//
//   sgm_judge_cgal FILE

#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/helpers.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <utility>
#include <vector>

#include "soup_file.h"

namespace {

namespace PMP = CGAL::Polygon_mesh_processing;
using Surface = CGAL::Surface_mesh<Point>;

bool collinear(const Soup& soup, const Corners& t) {
  return CGAL::collinear(soup.points[t[0]], soup.points[t[1]], soup.points[t[2]]);
}

/// True if two triangles of a soup intersect, by CGAL's rule for two faces of a mesh (do_faces_intersect), applied to
/// point indices. Needed because CGAL::Polygon_mesh_processing has no such function for soups before version 6.0.
bool meet(const Soup& soup, const Corners& a, const Corners& b) {
  const auto point = [&](std::size_t v) { return soup.points[v]; };
  const auto has = [](const Corners& t, std::size_t v) { return std::find(t.begin(), t.end(), v) != t.end(); };
  const auto common = std::count_if(a.begin(), a.end(), [&](std::size_t v) { return has(b, v); });
  const Kernel::Triangle_3 first(point(a[0]), point(a[1]), point(a[2])), second(point(b[0]), point(b[1]), point(b[2]));
  if (common == 0) return CGAL::do_intersect(first, second);
  if (common == 3) return false;
  if (common == 2) {
    const Corners *one = &a, *other = &b;
    std::array<std::size_t, 4> v{};  // the two shared vertices, then the other vertex of a, then the other vertex of b
    std::size_t shared = 0;
    for (const std::size_t w : *one) (has(*other, w) ? v[shared++] : v[2]) = w;
    for (const std::size_t w : *other)
      if (!has(*one, w)) v[3] = w;
    return CGAL::coplanar(point(v[0]), point(v[1]), point(v[2]), point(v[3])) &&
           CGAL::coplanar_orientation(point(v[0]), point(v[1]), point(v[2]), point(v[3])) == CGAL::POSITIVE;
  }
  const auto opposite = [&](const Corners& t, const Corners& other) {
    std::size_t k = 0;
    while (!has(other, t[k])) ++k;
    return Kernel::Segment_3(point(t[(k + 1) % 3]), point(t[(k + 2) % 3]));
  };
  return CGAL::do_intersect(first, opposite(b, a)) || CGAL::do_intersect(second, opposite(a, b));
}

std::size_t pairsOf(const Soup& soup) {
  std::vector<CGAL::Bbox_3> boxes;
  for (const Corners& t : soup.triangles)
    boxes.push_back(soup.points[t[0]].bbox() + soup.points[t[1]].bbox() + soup.points[t[2]].bbox());
  std::size_t pairs = 0;
  for (std::size_t a = 0; a < boxes.size(); ++a) {
    if (collinear(soup, soup.triangles[a])) continue;
    for (std::size_t b = a + 1; b < boxes.size(); ++b) {
      if (!CGAL::do_overlap(boxes[a], boxes[b]) || collinear(soup, soup.triangles[b])) continue;
      pairs += meet(soup, soup.triangles[a], soup.triangles[b]);
    }
  }
  return pairs;
}

void judge(Soup& soup, bool weld, bool count_soup) {
  const bool finite = std::all_of(soup.triangles.begin(), soup.triangles.end(), [&](const Corners& t) {
    return std::all_of(t.begin(), t.end(), [&](std::size_t v) {
      const Point& p = soup.points[v];
      return std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z());
    });
  });
  if (!finite) {
    std::puts("0 0 0 0 0 0 0 0 0 0 0");
    return;
  }
  if (weld) PMP::merge_duplicate_points_in_polygon_soup(soup.points, soup.triangles);
  PMP::remove_isolated_points_in_polygon_soup(soup.points, soup.triangles);
  const auto flat = static_cast<std::size_t>(std::count_if(soup.triangles.begin(), soup.triangles.end(),
                                                           [&](const Corners& t) { return collinear(soup, t); }));
  const std::size_t soup_pairs = count_soup ? pairsOf(soup) : 0;
  const bool manifold = PMP::is_polygon_soup_a_polygon_mesh(soup.triangles);
  bool closed = false, outward = false, bounds = false;
  std::size_t components = 0, pairs = 0;
  double area = 0, volume = 0;
  if (manifold) {
    Surface mesh;
    PMP::polygon_soup_to_polygon_mesh(soup.points, soup.triangles, mesh);
    closed = CGAL::is_closed(mesh);
    std::vector<std::pair<Surface::Face_index, Surface::Face_index>> found;
    PMP::self_intersections(mesh, std::back_inserter(found));
    // CGAL reports a face without area as intersecting itself; do not count these.
    pairs = found.size() - flat;
    area = PMP::area(mesh);
    const auto part = mesh.add_property_map<Surface::Face_index, std::size_t>("part", 0).first;
    components = PMP::connected_components(mesh, part);
    if (closed) {
      volume = PMP::volume(mesh);
      // The two functions of CGAL below require meshes without self-intersections.
      if (found.empty()) {
        outward = PMP::is_outward_oriented(mesh);
        bounds = PMP::does_bound_a_volume(mesh);
      }
    }
  }
  std::printf("1 %d %d %d %d %zu %zu %zu %zu %.17g %.17g\n", manifold, closed, outward, bounds, components, flat, pairs,
              soup_pairs, area, volume);
}

}  // namespace

int main(int argc, char** argv) {
  std::ifstream file(argc == 2 ? argv[1] : "", std::ios::binary);
  const bool whole = forSoups(file, [](Soup& soup) { judge(soup, (soup.asked & 1) != 0, (soup.asked & 2) != 0); });
  return whole ? 0 : 1;
}

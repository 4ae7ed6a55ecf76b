// Prints CGAL's distances between the meshes of a file (meshes.h). Successive meshes form pairs. For each pair, prints
// two lines: the one-sided Hausdorff distance from the first mesh to the second, and that from the second to the first,
// each with an error of at most ERROR.
//
//   sgm_judge_distance ERROR FILE

// Include the kernel first: distance.h uses functions of the kernel without declaring them.
#include "soup_file.h"

#include <CGAL/Polygon_mesh_processing/distance.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Surface_mesh.h>

#include <cstdio>
#include <cstdlib>
#include <optional>

namespace {

namespace PMP = CGAL::Polygon_mesh_processing;
using Surface = CGAL::Surface_mesh<Point>;

Surface surfaceOf(Soup& soup) {
  PMP::merge_duplicate_points_in_polygon_soup(soup.points, soup.triangles);
  PMP::remove_isolated_points_in_polygon_soup(soup.points, soup.triangles);
  Surface mesh;
  PMP::polygon_soup_to_polygon_mesh(soup.points, soup.triangles, mesh);
  return mesh;
}

}  // namespace

int main(int argc, char** argv) {
  const double error = argc == 3 ? std::atof(argv[1]) : 0;
  std::ifstream file(argc == 3 ? argv[2] : "", std::ios::binary);
  std::optional<Surface> first;
  const bool whole = forSoups(file, [&](Soup& soup) {
    Surface mesh = surfaceOf(soup);
    if (!first) {
      first = std::move(mesh);
      return;
    }
    for (const auto& [from, to] : {std::pair<const Surface&, const Surface&>{*first, mesh}, {mesh, *first}})
      std::printf("%.17g\n", PMP::bounded_error_Hausdorff_distance<CGAL::Sequential_tag>(from, to, error));
    first.reset();
  });
  return whole && !first ? 0 : 1;
}

#pragma once
// Reads a file of meshes (format: meshes.h) for the judges that use CGAL.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <vector>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Corners = std::array<std::size_t, 3>;

struct Soup {
  std::uint32_t asked = 0;
  std::vector<Point> points;
  std::vector<Corners> triangles;
};

/// Calls judge(soup) for each mesh in the file. Returns true if the file ends after a complete mesh.
template <class Judge>
bool forSoups(std::ifstream& file, Judge&& judge) {
  const auto read = [&file](auto* values, std::size_t count) {
    return static_cast<bool>(
        file.read(reinterpret_cast<char*>(values), static_cast<std::streamsize>(count * sizeof *values)));
  };
  std::uint32_t head[3];
  while (read(head, 3)) {
    std::vector<double> places(std::size_t{3} * head[1]);
    std::vector<std::uint32_t> corners(std::size_t{3} * head[2]);
    if (!read(places.data(), places.size()) || !read(corners.data(), corners.size())) return false;
    Soup soup;
    soup.asked = head[0];
    for (std::size_t i = 0; i < places.size(); i += 3)
      soup.points.emplace_back(places[i], places[i + 1], places[i + 2]);
    for (std::size_t i = 0; i < corners.size(); i += 3)
      soup.triangles.push_back({corners[i], corners[i + 1], corners[i + 2]});
    judge(soup);
  }
  return file.eof();
}

#pragma once
// Meshes in the file format of the judges (independent programs that examine meshes), and the judges' results.
//
// A file contains meshes one after another: three 32-bit whole numbers (flags kWeld and kSoup; number of points; number
// of triangles), then the points, three doubles each, then the triangles, three 32-bit whole numbers each. A judge
// prints one line for each mesh.

#include <array>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>

#include "../unit/measure/shapes.h"
#include "../unit/temporary_folder.h"

namespace sgm::measure {

inline constexpr uint32_t kWeld = 1;  ///< flag: points with equal coordinates count as one point
/// flag: if the mesh is not a surface, count intersecting pairs by testing all pairs of triangles
inline constexpr uint32_t kSoup = 2;

class JudgedMeshes {
 public:
  JudgedMeshes() : path_((folder_.path / "meshes").string()), file_(path_, std::ios::binary) {}

  void add(const Triangles& mesh, uint32_t asked = kWeld) {
    const std::array<uint32_t, 3> head{asked, static_cast<uint32_t>(mesh.points.size()),
                                       static_cast<uint32_t>(mesh.triangles.size())};
    write(head.data(), sizeof head);
    for (const Point p : mesh.points) {
      const double places[] = {p.x, p.y, p.z};
      write(places, sizeof places);
    }
    write(mesh.triangles.data(), mesh.triangles.size_bytes());
    ++count_;
  }

  /// Runs the judge's command with the file as its last argument. Returns the results, one for each mesh.
  template <class Verdict>
  std::vector<Verdict> judge(const std::string& command) {
    file_.flush();
    std::vector<Verdict> verdicts;
    FILE* const output = popen((command + " '" + path_ + "'").c_str(), "r");
    REQUIRE(output != nullptr);
    char line[1000];
    while (std::fgets(line, sizeof line, output) != nullptr) {
      std::istringstream words(line);
      words >> verdicts.emplace_back();
      CAPTURE(line);
      REQUIRE(words);
    }
    REQUIRE(pclose(output) == 0);
    REQUIRE(verdicts.size() == count_);
    return verdicts;
  }

 private:
  void write(const void* bytes, size_t size) {
    file_.write(static_cast<const char*>(bytes), static_cast<std::streamsize>(size));
  }

  TemporaryFolder folder_;
  std::string path_;
  std::ofstream file_;
  size_t count_ = 0;
};

struct CgalVerdict {
  bool finite = false, manifold = false, closed = false;
  /// Set only for closed meshes without self-intersections. `outward`: each part is oriented so that it encloses its
  /// inside. `bounds`: the parts are oriented and nested as the boundary of a solid.
  bool outward = false, bounds = false;
  uint64_t components = 0, flat = 0, pairs = 0, soup_pairs = 0;
  double area = 0, volume = 0;

  /// True if the mesh is the boundary of a solid. An empty mesh is valid.
  bool valid() const { return finite && manifold && closed && flat == 0 && pairs == 0 && outward && bounds; }
  friend std::istream& operator>>(std::istream& in, CgalVerdict& v) {
    return in >> v.finite >> v.manifold >> v.closed >> v.outward >> v.bounds >> v.components >> v.flat >> v.pairs >>
           v.soup_pairs >> v.area >> v.volume;
  }
};

/// The one-sided Hausdorff distance from a mesh to the other mesh of its pair.
struct CgalDistance {
  double distance = 0;

  friend std::istream& operator>>(std::istream& in, CgalDistance& v) { return in >> v.distance; }
};

struct ManifoldVerdict {
  std::string status;
  uint64_t parts = 0;
  int64_t genus = 0;
  double area = 0, volume = 0;

  friend std::istream& operator>>(std::istream& in, ManifoldVerdict& v) {
    return in >> v.status >> v.parts >> v.genus >> v.area >> v.volume;
  }
};

/// Returns the mesh with coordinates rounded to single precision, the only precision that Manifold accepts.
inline Mesh inFloats(const Mesh& mesh) {
  return mesh.moved([](Point p) {
    const auto rounded = [](double v) { return static_cast<double>(static_cast<float>(v)); };
    return Point{rounded(p.x), rounded(p.y), rounded(p.z)};
  });
}

}  // namespace sgm::measure

#pragma once
// Builds glTF files for tests, element by element: each call returns the index by which the JSON refers to the element.

#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "asset/triangle_mesh.h"
#include "glb_bytes.h"

namespace sgm::asset {

/// glTF's code for the component type T (accessor.componentType).
template <class T>
constexpr int kComponent = 0;
template <>
inline constexpr int kComponent<int8_t> = 5120;
template <>
inline constexpr int kComponent<uint8_t> = 5121;
template <>
inline constexpr int kComponent<int16_t> = 5122;
template <>
inline constexpr int kComponent<uint16_t> = 5123;
template <>
inline constexpr int kComponent<uint32_t> = 5125;
template <>
inline constexpr int kComponent<float> = 5126;

class GltfBuilder {
 public:
  /// JSON members of the root object in addition to those that the other functions add, such as `"nodes":[{"mesh":0}]`.
  std::string members = R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}])";

  template <class T>
  int view(const std::vector<T>& values, const std::string& more = "") {
    while (binary_.size() % 4 != 0) binary_ += '\0';
    const size_t at = binary_.size();
    binary_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
    views_ += (views_.empty() ? "" : ",") + std::string(R"({"buffer":0,"byteOffset":)") + std::to_string(at) +
              R"(,"byteLength":)" + std::to_string(binary_.size() - at) + more + "}";
    return view_count_++;
  }
  /// more: further members of the JSON object, each preceded by a comma.
  int accessor(const std::string& type, int component, size_t count, const std::string& more) {
    accessors_ += (accessors_.empty() ? "" : ",") + std::string(R"({"componentType":)") + std::to_string(component) +
                  R"(,"count":)" + std::to_string(count) + R"(,"type":")" + type + '"' + more + "}";
    return accessor_count_++;
  }
  template <class T>
  int numbers(const std::string& type, const std::vector<T>& values, const std::string& more = "") {
    const size_t each = type == "SCALAR" ? 1 : type == "VEC2" ? 2 : type == "VEC3" ? 3 : type == "VEC4" ? 4 : 16;
    const std::string in = R"(,"bufferView":)" + std::to_string(view(values));
    return accessor(type, kComponent<T>, values.size() / each, in + more);
  }
  /// Adds a mesh with one primitive. primitive: the primitive's JSON members, without braces.
  void mesh(const std::string& primitive, const std::string& more = "") {
    meshes_ += (meshes_.empty() ? "" : ",") + std::string(R"({"primitives":[{)") + primitive + "}]" + more + "}";
  }

  std::string json(const std::string& uri = "") const {
    return R"({"asset":{"version":"2.0"},)" + members + R"(,"meshes":[)" + meshes_ + R"(],"accessors":[)" + accessors_ +
           R"(],"bufferViews":[)" + views_ + R"(],"buffers":[{"byteLength":)" + std::to_string(binary_.size()) + uri +
           "}]}";
  }
  std::string glb() const { return glbOf(json(), binary_); }
  const std::string& binary() const { return binary_; }

 private:
  std::string binary_, views_, accessors_, meshes_;
  int view_count_ = 0, accessor_count_ = 0;
};

/// The corners of a cube with edge 2 around the origin, and its twelve triangles, which face outward.
inline const std::vector<float> kCubePoints = {-1, -1, -1, 1, -1, -1, 1, 1, -1, -1, 1, -1,
                                               -1, -1, 1,  1, -1, 1,  1, 1, 1,  -1, 1, 1};
inline const std::vector<uint16_t> kCubeIndices = {0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4,
                                                   1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7};

/// The volume by the divergence theorem; negative if the triangles face inward.
inline double volumeOf(const TriangleMesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles) sum += dot(mesh.points[a], cross(mesh.points[b], mesh.points[c]));
  return sum / 6;
}

inline Point middleOf(const TriangleMesh& mesh) {
  Point sum;
  for (const Point& p : mesh.points) sum = sum + p;
  return (1.0 / static_cast<double>(mesh.points.size())) * sum;
}

/// Number of edges that triangles do not use equally often in both directions; edges are identified by point indices.
inline size_t openEdgesOf(const TriangleMesh& mesh) {
  std::vector<std::pair<uint32_t, uint32_t>> edges;
  size_t open = 0;
  for (const auto& t : mesh.triangles) {
    for (size_t k = 0; k < 3; ++k) {
      const std::pair edge{t[k], t[(k + 1) % 3]}, back{edge.second, edge.first};
      bool closed = false;
      for (auto& known : edges)
        if (!closed && known == back) {
          known = {UINT32_MAX, UINT32_MAX};
          closed = true;
        }
      if (!closed) edges.push_back(edge);
    }
  }
  for (const auto& edge : edges) open += edge.first == UINT32_MAX ? 0u : 1u;
  return open;
}

}  // namespace sgm::asset

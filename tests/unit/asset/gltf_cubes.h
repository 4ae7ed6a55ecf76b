#pragma once
// Makes cubes as glTF files, and reads them: the mesh, or the error message.

#include <cmath>

#include "asset/read/glb_reader.h"
#include "catch.h"
#include "gltf_builder.h"

namespace sgm::asset {

inline TriangleMesh gltf(const std::string& file) {
  Result<TriangleMesh> mesh = readGlb(std::as_bytes(std::span(file)));
  INFO((mesh ? "" : mesh.error().message));
  REQUIRE(mesh);
  return std::move(*mesh);
}

inline std::string gltfRefusal(const std::string& file) {
  const Result<TriangleMesh> mesh = readGlb(std::as_bytes(std::span(file)));
  return mesh ? "" : mesh.error().message;
}

using Notes = std::vector<std::string>;

inline bool isNear(Point a, Point b) { return length(a - b) < 1e-6; }
inline bool isNear(const TextureCoordinates& a, float u, float v) {
  return std::fabs(a[0] - u) < 1e-6f && std::fabs(a[1] - v) < 1e-6f;
}

/// A cube of volume 8. more: further vertex attributes, each preceded by a comma; behind: further members of the
/// primitive.
inline GltfBuilder cube(const std::string& more = "", const std::string& behind = "", const std::string& of_mesh = "") {
  GltfBuilder file;
  file.numbers("VEC3", kCubePoints);
  file.numbers("SCALAR", kCubeIndices);
  file.mesh(R"("attributes":{"POSITION":0)" + more + R"(},"indices":1)" + behind, of_mesh);
  return file;
}

inline std::vector<float> eight(std::initializer_list<float> values) {
  std::vector<float> out;
  for (int i = 0; i < 8; ++i) out.insert(out.end(), values.begin(), values.end());
  return out;
}

}  // namespace sgm::asset

// Reads arbitrary bytes as a mesh file, in the format that the first byte selects: the file must be read, or rejected
// with a message.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "asset/read/mesh_file.h"

using namespace sgm;
using namespace sgm::asset;

namespace {

void check(bool holds) {
  if (!holds) std::abort();
}

template <class Value>
void checkCorners(const CornerValues<Value>& of, const TriangleMesh& mesh) {
  if (of.empty()) return check(of.corners.empty());
  if (of.corners.empty()) return check(of.values.size() == mesh.points.size());
  check(of.corners.size() == mesh.triangles.size());
  for (const auto& triangle : of.corners)
    for (const uint32_t corner : triangle) check(corner < of.values.size());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (size == 0) return 0;
  const auto bytes = std::as_bytes(std::span(data + 1, size - 1));
  (void)meshFileKind(bytes);
  // The input's first byte selects the format by a letter (glb, obj, ply, stl), so that initial inputs can be written
  // by hand.
  constexpr char kLetters[] = {'g', 'o', 'p', 's'};
  size_t kind = data[0] % 4;
  for (size_t i = 0; i < 4; ++i)
    if (data[0] == kLetters[i]) kind = i;
  const MeshLimits limits{.points = 1u << 16, .triangles = 1u << 16};
  const Result<TriangleMesh> mesh = readMesh(bytes, static_cast<MeshFileKind>(kind), limits);
  if (!mesh) {
    check(!mesh.error().message.empty());
    return 0;
  }
  check(!mesh->triangles.empty() && mesh->triangles.size() <= limits.triangles);
  check(mesh->points.size() <= limits.points && mesh->materials.size() == mesh->triangles.size());
  for (const auto& triangle : mesh->triangles)
    for (const uint32_t corner : triangle) check(corner < mesh->points.size());
  for (const Point& p : mesh->points) check(limits.isPlace(p.x, p.y, p.z));
  for (const uint32_t material : mesh->materials)
    check(material == kNoMaterial || material < mesh->material_names.size());
  checkCorners(mesh->normals, *mesh);
  checkCorners(mesh->coordinates, *mesh);
  for (const Normal& n : mesh->normals.values) {
    const double size_of = length({double{n[0]}, double{n[1]}, double{n[2]}});
    check(size_of == 0 || std::fabs(size_of - 1) < 1e-6);
  }
  for (const TextureCoordinates& c : mesh->coordinates.values) check(std::isfinite(c[0]) && std::isfinite(c[1]));
  return 0;
}

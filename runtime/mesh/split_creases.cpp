#include "mesh/split_creases.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "mesh/hash.h"
#include "mesh/least_squares.h"
#include "mesh/vertex.h"

namespace sgm {
namespace {

constexpr double kSameSide = 0.95;
constexpr uint32_t kNoCopy = UINT32_MAX;

bool isFeatureKey(const VertexKey& key) { return key.axis >= kFaceVertex; }

/// The attributes for the feature vertices of a triangle. They are copied from the vertex `like`, which lies on the
/// same side of the crease as the triangle. Exception: if own_normal is set, it replaces the normal of `like`.
struct SideOfCrease {
  uint32_t like = kNoCopy;
  Vector3 normal{};
  /// packed normal of the side; set if it differs from the normal of `like`
  std::optional<std::array<int16_t, 2>> own_normal;
};

/// Returns the side of the crease that a triangle belongs to. Mesh must offer keys (one per vertex) and indices; at(v)
/// and normal(v), which read a vertex; give(v, side), which sets its attributes; and copy(v), which appends a copy of
/// it.
template <class Mesh>
SideOfCrease sideOf(const Mesh& mesh, size_t triangle) {
  // A corner that is not a feature has the attributes of the triangle's side of the crease. If all corners of the
  // triangle are features, the attributes come from the next triangle in the mesh that has such a corner. That triangle
  // usually lies on the same side. Exception: if this triangle is alone on its side in the cell, then the normals
  // differ, and the side gets a normal of its own.
  SideOfCrease side;
  for (size_t i = triangle; side.like == kNoCopy && i < mesh.indices.size(); i += 3) {
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t v = mesh.indices[i + k];
      if (!isFeatureKey(mesh.keys[v])) side.like = v;
    }
    if (side.like == kNoCopy) continue;
    side.normal = mesh.normal(side.like);
    if (i == triangle) break;
    const Vector3 a = mesh.at(mesh.indices[triangle]);
    const Vector3 area =
        cross(minus(mesh.at(mesh.indices[triangle + 1]), a), minus(mesh.at(mesh.indices[triangle + 2]), a));
    const double length = std::sqrt(dot(area, area));
    if (length > 0 && dot(area, side.normal) < kSameSide * length) {
      side.own_normal = packNormal(area);
      side.normal = unpackNormal((*side.own_normal)[0], (*side.own_normal)[1]);
    }
  }
  return side;
}

template <class Mesh>
void split(Mesh&& mesh, std::pmr::memory_resource* memory) {
  // next: linked lists of the copies of each vertex; next[v] is the next copy of v, or kNoCopy. set: set[v] is true if
  // v is a feature vertex that already has the attributes of a side.
  std::pmr::vector<uint32_t> next(mesh.keys.size(), kNoCopy, memory);
  std::pmr::vector<bool> set(mesh.keys.size(), false, memory);
  for (size_t at = 0; at < mesh.indices.size(); at += 3) {
    const auto isFeature = [&](size_t k) { return isFeatureKey(mesh.keys[mesh.indices[at + k]]); };
    if (!isFeature(0) && !isFeature(1) && !isFeature(2)) continue;
    const SideOfCrease side = sideOf(mesh, at);
    if (side.like == kNoCopy) return;
    for (size_t k = 0; k < 3; ++k) {
      uint32_t v = mesh.indices[at + k];
      if (!isFeature(k)) continue;
      if (!set[v]) {
        set[v] = true;
        mesh.give(v, side);
        continue;
      }
      const auto same = [&] { return dot(mesh.normal(v), side.normal) > kSameSide; };
      while (!same() && next[v] != kNoCopy) v = next[v];
      if (!same()) {
        const uint32_t added = mesh.copy(v);
        mesh.give(added, side);
        next.push_back(kNoCopy);
        next[v] = added;
        v = added;
      }
      mesh.indices[at + k] = v;
    }
  }
}

struct SplitWorldMesh {
  std::pmr::vector<std::array<double, 3>>& positions;
  std::pmr::vector<VertexAttributes>& attributes;
  std::pmr::vector<VertexKey>& keys;
  std::pmr::vector<uint32_t>& indices;

  Vector3 at(uint32_t v) const { return positions[v]; }
  Vector3 normal(uint32_t v) const { return unpackNormal(attributes[v].normal_x, attributes[v].normal_y); }
  void give(uint32_t v, const SideOfCrease& side) {
    attributes[v] = attributes[side.like];
    if (!side.own_normal) return;
    attributes[v].normal_x = (*side.own_normal)[0];
    attributes[v].normal_y = (*side.own_normal)[1];
  }
  uint32_t copy(uint32_t v) {
    const std::array<double, 3> position = positions[v];
    const VertexAttributes of = attributes[v];
    const VertexKey key = keys[v];
    positions.push_back(position);
    attributes.push_back(of);
    keys.push_back(key);
    return static_cast<uint32_t>(keys.size() - 1);
  }
};

struct SplitPart {
  RawVector<Vertex>& vertices;
  RawVector<VertexKey>& keys;
  RawVector<uint32_t>& indices;

  Vector3 at(uint32_t v) const { return {1.0 * vertices[v].x, 1.0 * vertices[v].y, 1.0 * vertices[v].z}; }
  Vector3 normal(uint32_t v) const { return unpackNormal(vertices[v].normal_x, vertices[v].normal_y); }
  void give(uint32_t v, const SideOfCrease& side) {
    const Vertex from = vertices[side.like];
    Vertex& to = vertices[v];
    to.normal_x = side.own_normal ? (*side.own_normal)[0] : from.normal_x;
    to.normal_y = side.own_normal ? (*side.own_normal)[1] : from.normal_y;
    to.material = from.material;
    to.tag = from.tag;
  }
  uint32_t copy(uint32_t v) {
    const Vertex vertex = vertices[v];
    const VertexKey key = keys[v];
    vertices.push_back(vertex);
    keys.push_back(key);
    return static_cast<uint32_t>(keys.size() - 1);
  }
};

}  // namespace

WorldMesh splitCreases(const WorldMesh& mesh, std::pmr::memory_resource* memory) {
  WorldMesh made(memory);
  made.origin = mesh.origin;
  made.positions = mesh.positions;
  made.attributes = mesh.attributes;
  made.keys = mesh.keys;
  made.indices = mesh.indices;
  split(SplitWorldMesh{made.positions, made.attributes, made.keys, made.indices}, memory);
  return made;
}

void splitCreases(MeshPart& part, std::pmr::memory_resource* memory) {
  split(SplitPart{part.vertices, part.keys, part.indices}, memory);
  hashPart(part);
}

}  // namespace sgm

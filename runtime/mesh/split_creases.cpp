#include "mesh/split_creases.h"

#include <algorithm>
#include <array>

#include "mesh/hash.h"
#include "mesh/least_squares.h"
#include "mesh/vertex.h"

namespace sgm {
namespace {

constexpr double kSameSide = 0.95;
constexpr uint32_t kNoCopy = UINT32_MAX;

bool isFeatureKey(const VertexKey& key) { return key.axis >= kFaceVertex; }

/// Mesh: keys, one a vertex, and indices; normal(v); give(v, like): v gets like's attributes; copy(v): appended.
template <class Mesh>
void split(Mesh&& mesh, std::pmr::memory_resource* memory) {
  // The copies of each vertex, in a chain; unset where a feature vertex has no side yet.
  std::pmr::vector<uint32_t> next(mesh.keys.size(), kNoCopy, memory);
  std::pmr::vector<bool> set(mesh.keys.size(), false, memory);
  for (size_t at = 0; at < mesh.indices.size(); at += 3) {
    // A triangle of a fan has a vertex or two on the side that it belongs to.
    const std::array<uint32_t, 3> triangle{mesh.indices[at], mesh.indices[at + 1], mesh.indices[at + 2]};
    uint32_t side = kNoCopy;
    for (const uint32_t v : triangle) side = isFeatureKey(mesh.keys[v]) ? side : v;
    for (size_t k = 0; k < 3; ++k) {
      uint32_t v = triangle[k];
      if (!isFeatureKey(mesh.keys[v])) continue;
      if (!set[v]) {
        set[v] = true;
        mesh.give(v, side);
        continue;
      }
      const auto same = [&] { return dot(mesh.normal(v), mesh.normal(side)) > kSameSide; };
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

  Vector3 normal(uint32_t v) const { return unpackNormal(attributes[v].normal_x, attributes[v].normal_y); }
  void give(uint32_t v, uint32_t like) { attributes[v] = attributes[like]; }
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

  Vector3 normal(uint32_t v) const { return unpackNormal(vertices[v].normal_x, vertices[v].normal_y); }
  void give(uint32_t v, uint32_t like) {
    const Vertex from = vertices[like];
    Vertex& to = vertices[v];
    to.normal_x = from.normal_x;
    to.normal_y = from.normal_y;
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

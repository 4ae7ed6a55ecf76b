#include <algorithm>
#include <array>

#include "mesh/least_squares.h"
#include "mesh/sharpen.h"
#include "mesh/vertex.h"

namespace sgm {
namespace {

constexpr double kSameSide = 0.95;
constexpr uint32_t kNoCopy = UINT32_MAX;

bool isFeatureKey(const VertexKey& key) { return key.axis >= kFaceVertex; }

}  // namespace

WorldMesh splitCreases(const WorldMesh& mesh, std::pmr::memory_resource* memory) {
  WorldMesh split(memory);
  split.origin = mesh.origin;
  split.positions = mesh.positions;
  split.attributes = mesh.attributes;
  split.keys = mesh.keys;
  split.indices = mesh.indices;
  // The copies of each vertex, in a chain; unset where a feature vertex has no side yet.
  std::pmr::vector<uint32_t> next(mesh.positions.size(), kNoCopy, memory);
  std::pmr::vector<bool> set(mesh.positions.size(), false, memory);
  const auto normalOf = [&](uint32_t v) {
    return unpackNormal(split.attributes[v].normal_x, split.attributes[v].normal_y);
  };
  for (size_t at = 0; at < mesh.indices.size(); at += 3) {
    // A triangle of a fan has a vertex or two on the side that it belongs to.
    uint32_t side = kNoCopy;
    for (size_t k = 0; k < 3; ++k) {
      if (!isFeatureKey(mesh.keys[mesh.indices[at + k]])) side = mesh.indices[at + k];
    }
    for (size_t k = 0; k < 3; ++k) {
      uint32_t v = mesh.indices[at + k];
      if (!isFeatureKey(mesh.keys[v])) continue;
      const VertexAttributes like = mesh.attributes[side];
      if (!set[v]) {
        set[v] = true;
        split.attributes[v] = like;
        continue;
      }
      const auto same = [&] { return dot(normalOf(v), normalOf(side)) > kSameSide; };
      while (!same() && next[v] != kNoCopy) v = next[v];
      if (!same()) {
        const auto added = static_cast<uint32_t>(split.positions.size());
        split.positions.push_back(mesh.positions[mesh.indices[at + k]]);
        split.attributes.push_back(like);
        split.keys.push_back(mesh.keys[mesh.indices[at + k]]);
        next.push_back(kNoCopy);
        next[v] = added;
        v = added;
      }
      split.indices[at + k] = v;
    }
  }
  return split;
}

}  // namespace sgm

#include "octree.h"

#include <algorithm>

namespace sgm::test {
namespace {

int32_t side(int level) { return kChunkCells << level; }

Int3 child(const Leaf& leaf, int i) {
  const int32_t half = side(leaf.level - 1);
  return {leaf.origin.x + (i & 1) * half, leaf.origin.y + (i >> 1 & 1) * half, leaf.origin.z + (i >> 2) * half};
}

}  // namespace

Octree::Octree(uint64_t seed, int grid, int levels) : levels_(levels), size_(grid * side(levels - 1)) {
  const int32_t step = side(levels - 1);
  for (int32_t z = 0; z < size_; z += step)
    for (int32_t y = 0; y < size_; y += step)
      for (int32_t x = 0; x < size_; x += step) build(pointHash(seed, {x, y, z}), {{x, y, z}, levels - 1});
  for (;;) {
    Leaf worst;
    const auto steep = std::find_if(leaves_.begin(), leaves_.end(), [&](const Leaf& leaf) { return tooSteep(leaf); });
    if (steep != leaves_.end()) {
      refine(*steep);
    } else if (findCheckerboard(worst)) {
      refine(worst);
    } else {
      break;
    }
  }
}

void Octree::build(uint64_t key, Leaf leaf) {
  if (leaf.level == 0 || PathKey{key}.unit(0) < 0.5) {
    leaves_.insert(leaf);
    return;
  }
  for (int i = 0; i < 8; ++i) build(hashCombine(key, static_cast<uint64_t>(i)), {child(leaf, i), leaf.level - 1});
}

void Octree::refine(Leaf leaf) {
  leaves_.erase(leaf);
  for (int i = 0; i < 8; ++i) leaves_.insert({child(leaf, i), leaf.level - 1});
}

bool Octree::contains(Int3 p) const {
  return p.x >= 0 && p.y >= 0 && p.z >= 0 && p.x < size_ && p.y < size_ && p.z < size_;
}

Leaf Octree::leafAt(Int3 p) const {
  for (int level = 0; level < levels_; ++level) {
    const int32_t s = side(level);
    const Leaf leaf{{p.x / s * s, p.y / s * s, p.z / s * s}, level};
    if (leaves_.count(leaf) != 0) return leaf;
  }
  return {};
}

bool Octree::tooSteep(const Leaf& leaf) const {
  const int32_t s = side(leaf.level);
  for (int axis = 0; axis < 3; ++axis) {
    for (int32_t offset : {-1, s}) {
      for (int32_t a = 0; a < s; a += kChunkCells) {
        for (int32_t b = 0; b < s; b += kChunkCells) {
          Int3 p = leaf.origin;
          p[axis] += offset;
          p[(axis + 1) % 3] += a;
          p[(axis + 2) % 3] += b;
          if (contains(p) && leafAt(p).level < leaf.level - 1) return true;
        }
      }
    }
  }
  return false;
}

bool Octree::findCheckerboard(Leaf& found) const {
  for (int axis = 0; axis < 3; ++axis) {
    for (int32_t along = 0; along < size_; along += kChunkCells) {
      for (int32_t u = kChunkCells; u < size_; u += kChunkCells) {
        for (int32_t v = kChunkCells; v < size_; v += kChunkCells) {
          std::array<Leaf, 4> ring;
          constexpr std::array<std::array<int32_t, 2>, 4> kAround{{{0, 0}, {-1, 0}, {-1, -1}, {0, -1}}};
          for (size_t i = 0; i < 4; ++i) {
            Int3 p;
            p[axis] = along;
            p[(axis + 1) % 3] = u + kAround[i][0];
            p[(axis + 2) % 3] = v + kAround[i][1];
            ring[i] = leafAt(p);
          }
          for (size_t i = 0; i < 2; ++i) {
            const int coarse = std::min(ring[i].level, ring[i + 2].level);
            if (std::max(ring[i + 1].level, ring[(i + 3) % 4].level) < coarse) {
              found = ring[i];
              return true;
            }
          }
        }
      }
    }
  }
  return false;
}

Neighbourhood Octree::coarserAround(const Leaf& leaf) const {
  const int32_t s = side(leaf.level);
  Neighbourhood mask = 0;
  for (int dz = -1; dz <= 1; ++dz) {
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const Int3 p{leaf.origin.x + dx * s, leaf.origin.y + dy * s, leaf.origin.z + dz * s};
        if (contains(p) && leafAt(p).level > leaf.level) mask |= neighbourBit(dx, dy, dz);
      }
    }
  }
  return mask;
}

LeafMesh meshLeaf(const Leaf& leaf, Neighbourhood coarser, const LatticeField& field) {
  LeafMesh mesh{latticeChunk(leaf.origin, leaf.level), MeshPart{}, {}};
  const ChunkSamples samples = sampleChunk(field, mesh.grid);
  polygonizeBody(samples, mesh.grid, mesh.body);
  for (int f = 0; f < 6; ++f) {
    const auto face = static_cast<Face>(f);
    if ((coarser & neighbourBit(face)) == 0) continue;
    MeshPart& seam = mesh.seams.emplace_back(face, MeshPart{}).second;
    polygonizeSeam(face, samples, sampleFace(field, mesh.grid, face), mesh.grid, coarser, seam);
  }
  return mesh;
}

std::vector<LeafMesh> meshOctree(const Octree& octree, const LatticeField& field) {
  std::vector<LeafMesh> meshes;
  for (const Leaf& leaf : octree.leaves()) meshes.push_back(meshLeaf(leaf, octree.coarserAround(leaf), field));
  return meshes;
}

std::vector<const MeshPart*> allParts(const std::vector<LeafMesh>& meshes) {
  std::vector<const MeshPart*> parts;
  for (const LeafMesh& mesh : meshes) {
    parts.push_back(&mesh.body);
    for (const auto& [face, seam] : mesh.seams) parts.push_back(&seam);
  }
  return parts;
}

}  // namespace sgm::test

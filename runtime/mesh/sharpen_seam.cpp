#include <algorithm>
#include <array>

#include "mesh/feature_kind.h"
#include "mesh/hash.h"
#include "mesh/sharpen.h"

namespace sgm {
namespace {

constexpr uint32_t kNoMiddle = Features::kNone;

/// The lowest corner of the square across `axis` whose edges these are; nullopt if they share no square.
std::optional<Int3> sharedSquare(const VertexKey& a, const VertexKey& b, int axis, int32_t cell) {
  Int3 corner;
  for (int k = 0; k < 3; ++k) corner[k] = std::min(a.corner[k], b.corner[k]);
  for (const VertexKey* key : {&a, &b}) {
    if (key->corner[axis] != corner[axis]) return std::nullopt;
    const int across = 3 - axis - key->axis;
    if (key->corner[key->axis] != corner[key->axis]) return std::nullopt;
    if (key->corner[across] != corner[across] && key->corner[across] != corner[across] + cell) return std::nullopt;
  }
  return corner;
}

/// The triangles of a polygon whose corners are a triangle's and, behind each, perhaps the middle of its side.
void divide(const std::array<uint32_t, 3>& corners, const std::array<uint32_t, 3>& middles,
            RawVector<uint32_t>& indices) {
  std::array<uint32_t, 6> ring;
  size_t count = 0, middle = 0;
  for (size_t k = 0; k < 3; ++k) {
    ring[count++] = corners[k];
    if (middles[k] == kNoMiddle) continue;
    middle = count;
    ring[count++] = middles[k];
  }
  // About a middle: it is no corner of another triangle here, so that no edge comes twice.
  for (size_t i = 1; i + 1 < count; ++i) {
    indices.insert(indices.end(), {ring[middle], ring[(middle + i) % count], ring[(middle + i + 1) % count]});
  }
}

/// The face vertices of one of the two levels that a seam joins. Positions in the seam are in 1/256 of the finer cell.
class LevelOfSeam {
 public:
  LevelOfSeam(const ChunkGrid& chunk, int level, Face face, const FieldSampler& field, MeshPart& seam,
              std::pmr::memory_resource* memory)
      : chunk_(chunk),
        scale_(level - chunk.level),
        kind_(level == chunk.level ? kOwnEdge : kCoarserEdge),
        face_(face),
        seam_(seam),
        patch_({chunk.origin, chunk.cell << scale_, level}, field, memory),
        features_(patch_, field, memory),
        of_seam_(memory),
        in_patch_(seam.vertices.size(), kNoMiddle, memory),
        middles_(memory),
        memory_(memory) {}

  /// Finds the face vertices of the seam's sides of this level, slides its vertices, and appends what there is.
  void addFaceVertices(size_t triangles_end) {
    for (uint32_t v = 0; v < in_patch_.size(); ++v) {
      if (seam_.vertices[v].kind != kind_) continue;
      Vertex vertex = seam_.vertices[v];
      vertex.x = static_cast<int16_t>(vertex.x >> scale_);
      vertex.y = static_cast<int16_t>(vertex.y >> scale_);
      vertex.z = static_cast<int16_t>(vertex.z >> scale_);
      in_patch_[v] = patch_.addVertex(vertex, seam_.keys[v]);
      of_seam_.push_back(v);
    }
    if (of_seam_.empty()) return;
    features_.settle();
    std::pmr::vector<Int3> beside(memory_);
    CellSet around(memory_);
    for (size_t i = 0; i < triangles_end; ++i) {
      const uint32_t a = seam_.indices[i], b = seam_.indices[i % 3 == 2 ? i - 2 : i + 1];
      if (in_patch_[a] == kNoMiddle || in_patch_[b] == kNoMiddle) continue;
      if (!features_.creases().isSharp(in_patch_[a], in_patch_[b])) continue;
      // Both levels' squares have sides; diagonals lie in none of them.
      const std::optional<Int3> square = sharedSquare(seam_.keys[a], seam_.keys[b], axis(), patch_.grid().cell);
      if (!square) continue;
      Int3 high;
      for (int k = 0; k < 3; ++k) high[k] = ((*square)[k] - chunk_.origin[k]) / patch_.grid().cell;
      Int3 low = high;
      --low[axis()];
      for (const Int3& cell : {low, high}) {
        beside.push_back(cell);
        around.addAround(cell, kReach);
      }
    }
    if (!beside.empty()) {
      patch_.addCells(around);
      features_.settle();
      features_.find({}, loopsIn(beside));
      append();
    }
    takeSlides();
  }

  /// The face vertex between two of the seam's vertices; kNoMiddle if there is none.
  uint32_t middleOf(uint32_t a, uint32_t b) const {
    if (in_patch_[a] == kNoMiddle || in_patch_[b] == kNoMiddle || middles_.empty()) return kNoMiddle;
    const SharpSide* side = features_.sideBetween(in_patch_[a], in_patch_[b]);
    return side == nullptr ? kNoMiddle : middles_[static_cast<size_t>(side - features_.sides().data())];
  }

 private:
  int axis() const { return faceAxis(face_); }

  std::pmr::vector<uint32_t> loopsIn(const std::pmr::vector<Int3>& cells) const {
    std::pmr::vector<uint32_t> numbers(memory_);
    for (const Int3& cell : cells) {
      const std::span<const uint32_t> loops = patch_.loopsOf(cell);
      numbers.insert(numbers.end(), loops.begin(), loops.end());
    }
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    return numbers;
  }

  /// Only face vertices between two vertices of the seam.
  void append() {
    middles_.assign(features_.sides().size(), kNoMiddle);
    for (size_t s = 0; s < middles_.size(); ++s) {
      const SharpSide& side = features_.sides()[s];
      if (std::max(side.from, side.to) >= of_seam_.size() || !features_.hasFaceVertex(side)) continue;
      const VertexKey key = faceVertexKey(side, patch_.part().keys[side.from]);
      Vertex vertex = patch_.part().vertices[side.from];
      const auto at = [&](int k) {
        const int32_t from = (key.corner[k] - chunk_.origin[k]) / chunk_.cell * kSubcell;
        return static_cast<int16_t>(from + (*side.place)[k] * (1 << scale_));
      };
      vertex.x = at(0);
      vertex.y = at(1);
      vertex.z = at(2);
      vertex.kind = featureKind(key, *side.place, chunk_.level);
      middles_[s] = static_cast<uint32_t>(seam_.vertices.size());
      seam_.vertices.push_back(vertex);
      seam_.keys.push_back(key);
    }
  }

  void takeSlides() {
    for (uint32_t i = 0; i < of_seam_.size(); ++i) {
      const Vertex& settled = patch_.part().vertices[i];
      Vertex& vertex = seam_.vertices[of_seam_[i]];
      vertex.x = static_cast<int16_t>(settled.x * (1 << scale_));
      vertex.y = static_cast<int16_t>(settled.y * (1 << scale_));
      vertex.z = static_cast<int16_t>(settled.z * (1 << scale_));
      vertex.normal_x = settled.normal_x;
      vertex.normal_y = settled.normal_y;
    }
  }

  const ChunkGrid chunk_;
  const int scale_;  ///< levels above the chunk's
  const uint16_t kind_;
  const Face face_;
  MeshPart& seam_;
  SurfacePatch patch_;
  Features features_;
  std::pmr::vector<uint32_t> of_seam_;   ///< the seam's vertices of this level, which are the patch's first ones
  std::pmr::vector<uint32_t> in_patch_;  ///< by the seam's vertex; kNoMiddle for the other level's
  std::pmr::vector<uint32_t> middles_;   ///< of the seam, by sharp side
  std::pmr::memory_resource* memory_;
};

}  // namespace

void sharpenSeam(const ChunkGrid& grid, Face face, const FieldSampler& field, const FieldSampler& coarser,
                 MeshPart& seam, std::pmr::memory_resource* memory) {
  if (seam.indices.empty()) return;
  const size_t triangles_end = seam.indices.size();
  LevelOfSeam fine(grid, grid.level, face, field, seam, memory),
      coarse(grid, grid.level + 1, face, coarser, seam, memory);
  fine.addFaceVertices(triangles_end);
  coarse.addFaceVertices(triangles_end);
  RawVector<uint32_t> indices(memory);
  indices.reserve(triangles_end);
  for (size_t i = 0; i < triangles_end; i += 3) {
    std::array<uint32_t, 3> corners, middles;
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t a = seam.indices[i + k], b = seam.indices[i + (k + 1) % 3];
      corners[k] = a;
      middles[k] = fine.middleOf(a, b);
      if (middles[k] == kNoMiddle) middles[k] = coarse.middleOf(a, b);
    }
    if (std::count(middles.begin(), middles.end(), kNoMiddle) == 3) {
      indices.insert(indices.end(), corners.begin(), corners.end());
    } else {
      divide(corners, middles, indices);
    }
  }
  seam.indices = std::move(indices);
  hashPart(seam);
}

}  // namespace sgm

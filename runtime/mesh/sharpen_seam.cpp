#include <algorithm>
#include <array>

#include "mesh/border_vertices.h"
#include "mesh/feature_kind.h"
#include "mesh/hash.h"
#include "mesh/sharpen.h"

namespace sgm {
namespace {

constexpr uint32_t kNoMiddle = SharpSide::kNone;

/// The face vertices on one side of a triangle, in order, as indices of the seam's vertices. Unused entries are
/// kNoMiddle.
using Middles = std::array<uint32_t, FacePlaces::kMost>;
constexpr Middles kNoMiddles{kNoMiddle, kNoMiddle};

/// Triangulates a polygon that consists of a triangle's corners and the face vertices (middles) on its sides.
void divide(const std::array<uint32_t, 3>& corners, const std::array<Middles, 3>& middles,
            RawVector<uint32_t>& indices) {
  std::array<uint32_t, 3 + 3 * FacePlaces::kMost> ring;
  size_t count = 0, middle = 0;
  for (size_t k = 0; k < 3; ++k) {
    ring[count++] = corners[k];
    for (const uint32_t m : middles[k]) {
      if (m == kNoMiddle) continue;
      middle = count;
      ring[count++] = m;
    }
  }
  // Makes a fan around one of the face vertices. No other triangle of the seam has this vertex as a corner, so no edge
  // of the fan can occur twice.
  for (size_t i = 1; i + 1 < count; ++i) {
    indices.insert(indices.end(), {ring[middle], ring[(middle + i) % count], ring[(middle + i + 1) % count]});
  }
}

/// Finds the face vertices of one of the two levels that a seam joins. Positions in the seam are in 1/256 of the finer
/// cell.
class LevelOfSeam {
 public:
  LevelOfSeam(const ChunkGrid& chunk, int level, Face face, const FieldSampler& field, MeshPart& seam,
              std::pmr::memory_resource* memory)
      : chunk_(chunk),
        scale_(level - chunk.level),
        grid_{chunk.origin, chunk.cell << scale_, level},
        axis_(faceAxis(face)),
        field_(field),
        seam_(seam),
        part_(memory),
        creases_(grid_, field, part_, memory),
        of_seam_(memory),
        in_part_(seam.vertices.size(), kNoMiddle, memory),
        sides_(memory),
        middles_(memory),
        memory_(memory) {}

  /// Slides those vertices of the seam that belong to this level onto the surface. Then finds this level's sharp loop
  /// sides (mesh/sharp_loops.h): edges of seam triangles whose two ends have different normals. Computes the face
  /// vertices of these sides, and appends them to the seam. triangles_end: number of the seam's triangle indices.
  void addFaceVertices(size_t triangles_end) {
    takeVertices();
    if (of_seam_.empty()) return;
    creases_.settle();
    findSides(triangles_end);
    placeBorderVertices(grid_, field_, creases_, part_.keys, sides_, memory_);
    takeSlides();
    append();
  }

  /// Returns the face vertices on the loop side from vertex a of the seam to vertex b; kNoMiddles if the two vertices
  /// are not the ends of a sharp side of this level.
  Middles middlesOf(uint32_t a, uint32_t b) const {
    if (in_part_[a] == kNoMiddle || in_part_[b] == kNoMiddle) return kNoMiddles;
    const SharpSide wanted = sideBetween(in_part_[a], in_part_[b], part_.keys);
    const auto side = std::lower_bound(sides_.begin(), sides_.end(), wanted);
    if (side == sides_.end() || wanted < *side) return kNoMiddles;
    Middles middles = middles_[static_cast<size_t>(side - sides_.begin())];
    if (wanted.from != in_part_[a]) std::reverse(middles.begin(), middles.end());
    return middles;
  }

 private:
  void takeVertices() {
    const uint16_t kind = scale_ == 0 ? kOwnEdge : kCoarserEdge;
    for (uint32_t v = 0; v < in_part_.size(); ++v) {
      if (seam_.vertices[v].kind != kind) continue;
      Vertex vertex = seam_.vertices[v];
      vertex.x = static_cast<int16_t>(vertex.x >> scale_);
      vertex.y = static_cast<int16_t>(vertex.y >> scale_);
      vertex.z = static_cast<int16_t>(vertex.z >> scale_);
      in_part_[v] = static_cast<uint32_t>(of_seam_.size());
      of_seam_.push_back(v);
      part_.vertices.push_back(vertex);
      part_.keys.push_back(seam_.keys[v]);
    }
  }

  void findSides(size_t triangles_end) {
    for (size_t i = 0; i < triangles_end; ++i) {
      const uint32_t a = in_part_[seam_.indices[i]], b = in_part_[seam_.indices[i % 3 == 2 ? i - 2 : i + 1]];
      if (a == kNoMiddle || b == kNoMiddle || !creases_.isSharp(a, b)) continue;
      // Uses only edges of triangles that are loop sides: both ends lie on edges of the same grid square. Other edges
      // are diagonals of a loop.
      if (!shareSquare(part_.keys[a], part_.keys[b])) continue;
      sides_.push_back(sideBetween(a, b, part_.keys));
      sides_.back().axis = axis_;
      sides_.back().at_border = true;
    }
    std::sort(sides_.begin(), sides_.end());
    sides_.erase(std::unique(sides_.begin(), sides_.end(),
                             [](const SharpSide& a, const SharpSide& b) { return a.from == b.from && a.to == b.to; }),
                 sides_.end());
  }

  /// True if the edges with these keys belong to one grid square in the seam's face.
  bool shareSquare(const VertexKey& a, const VertexKey& b) const {
    Int3 corner;
    for (int k = 0; k < 3; ++k) corner[k] = std::min(a.corner[k], b.corner[k]);
    for (const VertexKey* key : {&a, &b}) {
      const int across = 3 - axis_ - key->axis;
      if (key->corner[axis_] != corner[axis_] || key->corner[key->axis] != corner[key->axis]) return false;
      if (key->corner[across] != corner[across] && key->corner[across] != corner[across] + grid_.cell) return false;
    }
    return true;
  }

  void append() {
    middles_.assign(sides_.size(), kNoMiddles);
    for (size_t s = 0; s < middles_.size(); ++s) {
      const SharpSide& side = sides_[s];
      for (size_t which = 0; which < side.places.count(); ++which) {
        const Int3& place = side.places.all()[which];
        const VertexKey key = faceVertexKey(side, part_.keys[side.from], which);
        Vertex vertex = seam_.vertices[of_seam_[side.from]];
        const auto at = [&](int k) {
          const int32_t from = (key.corner[k] - chunk_.origin[k]) / chunk_.cell * kSubcell;
          return static_cast<int16_t>(from + place[k] * (1 << scale_));
        };
        vertex.x = at(0);
        vertex.y = at(1);
        vertex.z = at(2);
        vertex.kind = featureKind(key, place, chunk_.level);
        middles_[s][which] = static_cast<uint32_t>(seam_.vertices.size());
        seam_.vertices.push_back(vertex);
        seam_.keys.push_back(key);
      }
    }
  }

  void takeSlides() {
    for (uint32_t i = 0; i < of_seam_.size(); ++i) {
      const Vertex& settled = part_.vertices[i];
      Vertex& vertex = seam_.vertices[of_seam_[i]];
      vertex.x = static_cast<int16_t>(settled.x * (1 << scale_));
      vertex.y = static_cast<int16_t>(settled.y * (1 << scale_));
      vertex.z = static_cast<int16_t>(settled.z * (1 << scale_));
      vertex.normal_x = settled.normal_x;
      vertex.normal_y = settled.normal_y;
    }
  }

  const ChunkGrid chunk_;
  const int scale_;  ///< level above the chunk's level: 0 or 1
  const ChunkGrid grid_;
  const int axis_;
  const FieldSampler& field_;
  MeshPart& seam_;
  MeshPart part_;  ///< vertices of this level, copied from the seam
  Creases creases_;
  std::pmr::vector<uint32_t> of_seam_;  ///< for each vertex of part_: its index in the seam
  /// for each vertex of the seam: its index in part_; kNoMiddle if the vertex belongs to the other level
  std::pmr::vector<uint32_t> in_part_;
  std::pmr::vector<SharpSide> sides_;  ///< sharp loop sides between vertices of part_, sorted
  std::pmr::vector<Middles> middles_;  ///< for each loop side: its face vertices, as indices of the seam's vertices
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
    std::array<uint32_t, 3> corners;
    std::array<Middles, 3> middles;
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t a = seam.indices[i + k], b = seam.indices[i + (k + 1) % 3];
      corners[k] = a;
      middles[k] = fine.middlesOf(a, b);
      if (middles[k] == kNoMiddles) middles[k] = coarse.middlesOf(a, b);
    }
    if (std::count(middles.begin(), middles.end(), kNoMiddles) == 3) {
      indices.insert(indices.end(), corners.begin(), corners.end());
    } else {
      divide(corners, middles, indices);
    }
  }
  seam.indices = std::move(indices);
  hashPart(seam);
}

}  // namespace sgm

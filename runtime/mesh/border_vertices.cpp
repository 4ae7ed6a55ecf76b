#include "mesh/border_vertices.h"

#include <algorithm>
#include <cmath>

#include "mesh/cell_loops.h"
#include "mesh/loop_triangles.h"

namespace sgm {
namespace {

/// In 1/256 of a cell: how far a face vertex may move for convenience.
constexpr int32_t kClose = 8;

/// From a side's square to that of its face vertex; by 0 if that is its own.
struct Step {
  int axis = 0, by = 0;
};
Step stepToPlace(const SharpSide& side) {
  for (const int k : {(side.axis + 1) % 3, (side.axis + 2) % 3}) {
    if ((*side.place)[k] < 0) return {k, -1};
    if ((*side.place)[k] > kSubcell) return {k, 1};
  }
  return {};
}

/// Whether the square beside a side's is in the same face of the chunk.
bool isInFace(const SharpSide& side, int axis, int by, int32_t cell) {
  const int64_t square = floorDiv(side.corner[axis], cell);
  return floorDiv(square, kChunkCells) == floorDiv(square + by, kChunkCells);
}

/// At which end of a square's edge a place beside the square lies: 1 or -1 where it lies nearer to the edges there than
/// to the square's own, 0 where it does not.
int endOf(const SharpSide& side, const Step& beside) {
  const int32_t at = (*side.place)[beside.axis];
  const int32_t along = (*side.place)[3 - side.axis - beside.axis], height = at < 0 ? -at : at - kSubcell;
  return height >= along ? -1 : height >= kSubcell - along ? 1 : 0;
}

/// The field at the corners of the two cells beside a side, and of squares near it.
class Surroundings {
 public:
  /// Corner a + 2b + 4c lies a along u = (axis + 1) % 3, b along v = (axis + 2) % 3, and c - 1 along the axis of the
  /// face. The next two lie at the far edge of the square of the face vertex, if that is another; the last two at the
  /// far edge of a third square, beside that one at the end at which the face vertex lies.
  static constexpr size_t kCorners = 16, kOfCells = 12, kOfBoth = 14;

  Surroundings(const SharpSide& side, int32_t cell) : side_(side), cell_(cell) {}

  /// nullopt if the corner lies beyond the world or does not exist.
  std::optional<Int3> corner(size_t number) const {
    const int u = (side_.axis + 1) % 3, v = (side_.axis + 2) % 3;
    Int3 steps;
    if (number < kOfCells) {
      steps[u] = static_cast<int32_t>(number & 1);
      steps[v] = static_cast<int32_t>(number >> 1 & 1);
      steps[side_.axis] = static_cast<int32_t>(number >> 2) - 1;
    } else {
      const Step beside = stepToPlace(side_);
      if (beside.by == 0) return std::nullopt;
      const int along = u + v - beside.axis;
      const auto is_second = static_cast<int32_t>(number & 1);
      if (number < kOfBoth) {
        steps[beside.axis] = beside.by < 0 ? -1 : 2;
        steps[along] = is_second;
      } else {
        const int end = endOf(side_, beside);
        if (end == 0 || !isInFace(side_, along, end, cell_)) return std::nullopt;
        steps[beside.axis] = beside.by < 0 ? -is_second : 1 + is_second;
        steps[along] = end < 0 ? -1 : 2;
      }
    }
    Int3 at = side_.corner;
    for (int k = 0; k < 3; ++k) {
      const int64_t moved = at[k] + int64_t{steps[k]} * cell_;
      if (moved != saturate(moved)) return std::nullopt;
      at[k] = static_cast<int32_t>(moved);
    }
    return at;
  }

  /// samples: at all corners.
  void take(std::span<const FieldSample> samples) {
    for (size_t i = 0; i < kCorners; ++i) q_[i] = samples[i].q;
  }

  /// Whether the surface passes once through the side's square, and not through that of its face vertex, if it is
  /// another, nor through the third.
  bool passesOnceInFace() const {
    if (isSolid(4) == isSolid(7) && isSolid(5) == isSolid(6) && isSolid(4) != isSolid(5)) return false;
    const Step beside = stepToPlace(side_);
    if (beside.by == 0) return true;
    const size_t stepped = beside.axis == (side_.axis + 1) % 3 ? 1 : 2;  // a bit of a corner's number
    const size_t shared = 4 + (beside.by > 0 ? stepped : 0);
    for (const size_t other : {shared + 3 - stepped, kOfCells, kOfCells + 1, kOfBoth, kOfBoth + 1})
      if ((other < kOfBoth || corner(other)) && isSolid(other) != isSolid(shared)) return false;
    return true;
  }

  /// The field at the corners of the cell below the face, or above it, as the case tables number them; nullopt if the
  /// cell reaches beyond the world, and has no surface.
  std::optional<std::array<int32_t, 8>> ofCell(bool above) const {
    if (!corner(above ? kOfCells - 1 : 0)) return std::nullopt;
    std::array<int32_t, 8> q{};
    for (size_t i = 0; i < 8; ++i) {
      const size_t number =
          (i & 1) << (side_.axis + 1) % 3 | (i >> 1 & 1) << (side_.axis + 2) % 3 | i >> 2 << side_.axis;
      q[number] = q_[i + (above ? 4 : 0)];
    }
    return q;
  }

 private:
  bool isSolid(size_t corner) const { return q_[corner] < 0; }

  const SharpSide& side_;
  int32_t cell_;
  std::array<int32_t, kCorners> q_{};
};

bool hasTwoLoops(const std::array<int32_t, 8>& q) {
  size_t solid = 0;
  for (size_t corner = 0; corner < 8; ++corner) solid |= size_t{q[corner] < 0} << corner;
  return (kCubeFirstLoop[solid] >> 24 & 1) != 0;
}

/// From a point off the surface to the tangent of a third plane that lies in front of the two: one step of Newton's.
std::optional<FacePoint> ontoSurface(const SharpSide& side, const FacePoint& from, const FieldSample& sample) {
  const double u = sample.gradient[static_cast<size_t>((side.axis + 1) % 3)];
  const double v = sample.gradient[static_cast<size_t>((side.axis + 2) % 3)];
  const double square = u * u + v * v;
  if (!(square > 0)) return std::nullopt;
  const double step = double{sample.value} / square;
  return FacePoint{from[0] - step * u, from[1] - step * v};
}

/// A point on the grid, in the side's square or the one beside it, or as near to it as that has places; nullopt if it
/// is more than a cell away.
std::optional<Int3> placeAt(const SharpSide& side, const FacePoint& point, int32_t cell) {
  const auto outside = [](int32_t at) { return std::max(-at, at - kSubcell); };
  const int u = (side.axis + 1) % 3, v = (side.axis + 2) % 3;
  Int3 place;
  for (size_t k = 0; k < 2; ++k) {
    const double at = std::floor(point[k] / cell * kSubcell + 0.5);
    if (!(at >= -kSubcell && at <= 2 * kSubcell)) return std::nullopt;
    place[k == 0 ? u : v] = static_cast<int32_t>(at);
  }
  // Of two places in one square, from edges that lie opposite each other, each keeps to its half. And a place close to
  // the edge is as good in the side's own square, where nothing comes in its way.
  const int across = outside(place[u]) > outside(place[v]) ? u : v;
  const bool is_beside = outside(place[across]) > kClose && outside(place[across]) < kSubcell / 2 &&
                         isInFace(side, across, place[across] < 0 ? -1 : 1, cell);
  for (const int k : {u, v})
    if (!is_beside || k != across) place[k] = std::clamp(place[k], 1, kSubcell - 1);
  return place;
}

/// Cells with several loops, of which the one with a side takes its face vertex if, rounded, it keeps clear of the
/// others.
class CrowdedCells {
 public:
  CrowdedCells(const ChunkGrid& grid, const FieldSampler& field, std::pmr::memory_resource* memory)
      : grid_(grid), part_(memory), loops_(memory), claims_(memory), creases_(grid, field, part_, memory) {}

  /// Borrows the side. from, to: the keys of its ends.
  void add(SharpSide& side, const VertexKey& from, const VertexKey& to, bool above, const std::array<int32_t, 8>& q) {
    Int3 cell;
    for (int k = 0; k < 3; ++k) {
      cell[k] = static_cast<int32_t>((int64_t{side.corner[k]} - grid_.origin[k]) / grid_.cell);
    }
    if (!above) --cell[side.axis];
    const size_t first = loops_.size();
    addCellLoops(grid_, cell, q, part_, loops_);
    claims_.push_back({&side, from, to, first, loops_.size()});
  }

  /// Takes the place of those sides whose loop would not keep clear.
  void judge() {
    if (claims_.empty()) return;
    creases_.settle();
    for (const Claim& claim : claims_)
      if (claim.side->place && !keepsClear(claim)) claim.side->place = std::nullopt;
  }

 private:
  struct Claim {
    SharpSide* side;
    VertexKey from, to;
    size_t first, end;  ///< of the cell's loops
  };

  /// Whether another side of the cell may have a face vertex in a face of the chunk, of which nothing is known here.
  bool hasOther(const Claim& claim) const {
    for (size_t number = claim.first; number < claim.end; ++number) {
      const SurfaceLoop& loop = loops_[number];
      for (uint32_t i = 0; i < loop.count; ++i) {
        const uint32_t a = loop.vertices[i], b = loop.vertices[(i + 1) % loop.count];
        const SharpSide side = sideBetween(a, b, part_.keys);
        if (floorDiv(side.corner[side.axis], grid_.cell) % kChunkCells != 0 || side.axis == claim.side->axis) continue;
        if (creases_.isSharp(a, b)) return true;
      }
    }
    return false;
  }

  bool keepsClear(const Claim& claim) const {
    if (hasOther(claim)) return false;
    for (size_t own = claim.first; own < claim.end; ++own) {
      const SurfaceLoop& loop = loops_[own];
      for (uint32_t i = 0; i < loop.count; ++i) {
        const VertexKey &a = part_.keys[loop.vertices[i]], &b = part_.keys[loop.vertices[(i + 1) % loop.count]];
        if (!(a == claim.from && b == claim.to) && !(a == claim.to && b == claim.from)) continue;
        const LoopTriangles fan = roundedFan(*claim.side, loop, i);
        for (size_t other = claim.first; other < claim.end; ++other)
          if (other != own && anyMeets(fan, plainTriangles(part_, loops_[other]))) return false;
        return true;
      }
    }
    return false;
  }

  /// sharp: the number of the side that has the face vertex.
  LoopTriangles roundedFan(const SharpSide& side, const SurfaceLoop& loop, uint32_t sharp) const {
    Int3 middle = *side.place;
    for (int k = 0; k < 3; ++k) {
      middle[k] += static_cast<int32_t>((int64_t{side.corner[k]} - grid_.origin[k]) / grid_.cell) * kSubcell;
    }
    std::array<Int3, kLongestCubeLoop> ring;
    for (uint32_t i = 0; i < loop.count; ++i) ring[i] = placeOf(part_, loop.vertices[i]);
    const BorderVertex at_border{middle, side.axis};
    const Int3 centre = roundedCentre(loop.cell, {ring.data(), loop.count}, {&at_border, 1});
    LoopTriangles fan;
    for (uint32_t i = 0; i < loop.count; ++i) {
      const uint32_t next = (i + 1) % loop.count, a = loop.vertices[i], b = loop.vertices[next];
      if (i == sharp) {
        fan.add({centre, ring[i], middle}, {kCellVertices, a, kFaceVertices});
        fan.add({centre, middle, ring[next]}, {kCellVertices, kFaceVertices, b});
      } else {
        fan.add({centre, ring[i], ring[next]}, {kCellVertices, a, b});
      }
    }
    return fan;
  }

  const ChunkGrid grid_;
  MeshPart part_;
  std::pmr::vector<SurfaceLoop> loops_;
  std::pmr::vector<Claim> claims_;
  Creases creases_;
};

/// Gives sides the places that the tangents at their ends give them, if these lie on the surface; returns those sides.
std::pmr::vector<SharpSide*> placeOnSurface(const ChunkGrid& grid, const FieldSampler& field, const Creases& creases,
                                            std::span<SharpSide> sides, std::pmr::memory_resource* memory) {
  struct Try {
    SharpSide* side;
    FacePoint point;
  };
  std::pmr::vector<SharpSide*> placed(memory);
  std::pmr::vector<Try> tries(memory), again(memory);
  for (SharpSide& side : sides) {
    if (!side.at_border) continue;
    if (const std::optional<FacePoint> point = creases.meetingInFace(side.from, side.to, side.corner, side.axis))
      tries.push_back({&side, *point});
  }
  std::pmr::vector<Int3> points(memory);
  std::pmr::vector<FieldSample> samples(memory);
  for (int round = 0; round < 2 && !tries.empty(); ++round, tries.swap(again)) {
    points.clear();
    again.clear();
    for (const auto& [side, point] : tries) {
      side->place = placeAt(*side, point, grid.cell);
      points.push_back(creases.sampledAt(side->corner, side->place.value_or(Int3{})));
    }
    samples.resize(points.size());
    field(points, samples, Sampled::all);
    for (size_t i = 0; i < tries.size(); ++i) {
      SharpSide& side = *tries[i].side;
      if (!side.place) continue;
      if (creases.isOnSurface(samples[i])) {
        placed.push_back(&side);
        continue;
      }
      const double step = static_cast<double>(grid.cell) / kSubcell;
      const FacePoint at{(*side.place)[(side.axis + 1) % 3] * step, (*side.place)[(side.axis + 2) % 3] * step};
      if (round == 0) side.third = tangentAt(creases.sampledAt(side.corner, *side.place), samples[i]);
      side.place = std::nullopt;
      if (const std::optional<FacePoint> point = ontoSurface(side, at, samples[i])) again.push_back({&side, *point});
    }
  }
  return placed;
}

}  // namespace

void placeBorderVertices(const ChunkGrid& grid, const FieldSampler& field, const Creases& creases,
                         const RawVector<VertexKey>& keys, std::span<SharpSide> sides,
                         std::pmr::memory_resource* memory) {
  const std::pmr::vector<SharpSide*> placed = placeOnSurface(grid, field, creases, sides, memory);
  if (placed.empty()) return;
  std::pmr::vector<Int3> points(memory);
  points.reserve(placed.size() * Surroundings::kCorners);
  for (const SharpSide* side : placed) {
    const Surroundings around(*side, grid.cell);
    for (size_t i = 0; i < Surroundings::kCorners; ++i) points.push_back(around.corner(i).value_or(side->corner));
  }
  std::pmr::vector<FieldSample> samples(points.size(), memory);
  field(points, samples, Sampled::value);
  CrowdedCells crowded(grid, field, memory);
  for (size_t i = 0; i < placed.size(); ++i) {
    SharpSide& side = *placed[i];
    Surroundings around(side, grid.cell);
    around.take({samples.data() + i * Surroundings::kCorners, Surroundings::kCorners});
    bool passes = around.passesOnceInFace();
    for (const bool above : {false, true}) {
      const std::optional<std::array<int32_t, 8>> q = around.ofCell(above);
      if (!passes || !q || !hasTwoLoops(*q)) continue;
      crowded.add(side, keys[side.from], keys[side.to], above, *q);
    }
    if (!passes) side.place = std::nullopt;
  }
  crowded.judge();
}

}  // namespace sgm

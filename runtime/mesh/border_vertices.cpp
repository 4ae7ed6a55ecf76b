#include "mesh/border_vertices.h"

#include <algorithm>
#include <cmath>

#include "mesh/rounded_cells.h"
#include "mesh/surroundings.h"
#include "mesh/tables.h"

namespace sgm {
namespace {

/// Tolerance in 1/256 of a cell: a face vertex (mesh/sharp_loops.h) at most this far outside the grid square of its
/// loop side is moved into that square, where it cannot collide with other face vertices.
constexpr int32_t kClose = 8;

bool hasTwoLoops(const std::array<int32_t, 8>& q) {
  size_t solid = 0;
  for (size_t corner = 0; corner < 8; ++corner) solid |= size_t{q[corner] < 0} << corner;
  return (kCubeFirstLoop[solid] >> 24 & 1) != 0;
}

/// Makes one Newton step from a point off the surface towards the surface, within the cell face in which the loop side
/// lies. nullopt if the field has no gradient in the face.
std::optional<FacePoint> ontoSurface(const SharpSide& side, const FacePoint& from, const FieldSample& sample) {
  const double u = sample.gradient[static_cast<size_t>((side.axis + 1) % 3)];
  const double v = sample.gradient[static_cast<size_t>((side.axis + 2) % 3)];
  const double square = u * u + v * v;
  if (!(square > 0)) return std::nullopt;
  const double step = double{sample.value} / square;
  return FacePoint{from[0] - step * u, from[1] - step * v};
}

/// Rounds a point in the plane of a loop side's cell face to 1/256 of a cell. Then clamps it to the side's own grid
/// square or, if the point lies beyond that, to an adjacent square. nullopt if the point is more than a cell outside
/// the side's own square.
std::optional<Int3> placeAt(const SharpSide& side, const FacePoint& point, int32_t cell) {
  const auto outside = [](int32_t at) { return std::max(-at, at - kSubcell); };
  const int u = (side.axis + 1) % 3, v = (side.axis + 2) % 3;
  Int3 place;
  for (size_t k = 0; k < 2; ++k) {
    const double at = std::floor(point[k] / cell * kSubcell + 0.5);
    if (!(at >= -kSubcell && at <= 2 * kSubcell)) return std::nullopt;
    place[k == 0 ? u : v] = static_cast<int32_t>(at);
  }
  // A position stays in an adjacent square only if it lies more than kClose outside the loop side's own square. Any
  // other position is moved into the own square, where it cannot collide with other face vertices.
  const int across = outside(place[u]) > outside(place[v]) ? u : v;
  const bool is_beside = outside(place[across]) > kClose && outside(place[across]) <= kMaxOutside &&
                         isInFace(side, across, place[across] < 0 ? -1 : 1, cell);
  for (const int k : {u, v})
    if (!is_beside || k != across) place[k] = std::clamp(place[k], 1, kSubcell - 1);
  return place;
}

/// True if the path from one end of a loop side through the positions `first` and `second` to the other end does not
/// cross itself.
bool isSimple(const Creases& creases, const SharpSide& side, const Int3& first, const Int3& second, int32_t cell) {
  const auto u = static_cast<size_t>((side.axis + 1) % 3), v = static_cast<size_t>((side.axis + 2) % 3);
  const auto placeOfEnd = [&](uint32_t end) {
    const Vector3 units = creases.unitsFrom(side.corner, end);
    Int3 at;
    for (size_t k = 0; k < 3; ++k)
      at[static_cast<int>(k)] = static_cast<int32_t>(std::floor(units[k] / cell * kSubcell + 0.5));
    return at;
  };
  const auto turn = [&](const Int3& a, const Int3& b, const Int3& c) {
    const auto iu = static_cast<int>(u), iv = static_cast<int>(v);
    const int64_t area = int64_t{b[iu] - a[iu]} * (c[iv] - a[iv]) - int64_t{b[iv] - a[iv]} * (c[iu] - a[iu]);
    return area > 0 ? 1 : area < 0 ? -1 : 0;
  };
  const Int3 from = placeOfEnd(side.from), to = placeOfEnd(side.to);
  // The path has three segments; only the first and the last can cross. They do not if one of them lies on one side of
  // the line through the other.
  const bool apart =
      turn(from, first, second) * turn(from, first, to) > 0 || turn(second, to, from) * turn(second, to, first) > 0;
  return apart && turn(from, first, second) != 0 && turn(first, second, to) != 0;
}

/// Places the face vertices (mesh/sharp_loops.h) of loop sides in faces of the chunk, and returns the sides that got
/// positions.
class SurfacePlaces {
 public:
  SurfacePlaces(const ChunkGrid& grid, const FieldSampler& field, const Creases& creases,
                std::pmr::memory_resource* memory)
      : grid_(grid), field_(field), creases_(creases), points_(memory), samples_(memory), cut_off_(memory) {}

  std::pmr::vector<SharpSide*> give(std::span<SharpSide> sides, std::pmr::memory_resource* memory) {
    std::pmr::vector<SharpSide*> placed(memory);
    placeMeetings(sides, placed);
    placeCutOff(placed);
    return placed;
  }

 private:
  /// A loop side at which the tangent planes of its two ends meet off the surface, because a third plane cuts the
  /// crease off. Holds candidate positions of its face vertices: `first` and `second`, where the third plane meets the
  /// planes of the ends; or else `single`, a point on the third plane.
  struct CutOff {
    SharpSide* side;
    std::optional<Int3> single, first, second;
  };

  /// For each loop side in a face of the chunk: places a face vertex where the tangent planes at the side's two ends
  /// meet within that face. Where this point lies off the surface, calls cutOff().
  void placeMeetings(std::span<SharpSide> sides, std::pmr::vector<SharpSide*>& placed) {
    std::pmr::vector<SharpSide*> tried(points_.get_allocator());
    for (SharpSide& side : sides) {
      if (!side.at_border) continue;
      const auto point =
          creases_.meetingInFace(creases_.tangent(side.from), creases_.tangent(side.to), side.corner, side.axis);
      const std::optional<Int3> place = point ? placeAt(side, *point, grid_.cell) : std::nullopt;
      if (!place) continue;
      side.places = FacePlaces(*place);
      tried.push_back(&side);
      points_.push_back(creases_.sampledAt(side.corner, *place));
    }
    sample();
    for (size_t i = 0; i < tried.size(); ++i) {
      if (creases_.isOnSurface(samples_[i])) {
        placed.push_back(tried[i]);
      } else {
        cutOff(*tried[i], points_[i], samples_[i]);
      }
    }
  }

  void cutOff(SharpSide& side, const Int3& point, const FieldSample& sample) {
    const double step = static_cast<double>(grid_.cell) / kSubcell;
    const Int3 place = side.places.all().front();
    side.places = {};
    side.third = tangentAt(point, sample);
    const auto placeOfMeeting = [&](const Tangent& a, const Tangent& b) {
      const std::optional<FacePoint> meeting = creases_.meetingInFace(a, b, side.corner, side.axis);
      return meeting ? placeAt(side, *meeting, grid_.cell) : std::nullopt;
    };
    CutOff cut{&side,
               {},
               placeOfMeeting(creases_.tangent(side.from), *side.third),
               placeOfMeeting(*side.third, creases_.tangent(side.to))};
    const FacePoint from{place[(side.axis + 1) % 3] * step, place[(side.axis + 2) % 3] * step};
    if (const std::optional<FacePoint> onto = ontoSurface(side, from, sample))
      cut.single = placeAt(side, *onto, grid_.cell);
    cut_off_.push_back(cut);
  }

  /// Places the face vertices of loop sides whose crease a third plane cuts off. Preferably, these are two vertices,
  /// where the third plane meets the tangent planes of the two ends. If these positions are unusable, it is one vertex
  /// on the third plane.
  void placeCutOff(std::pmr::vector<SharpSide*>& placed) {
    points_.clear();
    for (const CutOff& cut : cut_off_) {
      const Int3 first = cut.first.value_or(Int3{}), second = cut.second.value_or(Int3{});
      Int3 middle;
      for (int k = 0; k < 3; ++k) middle[k] = (first[k] + second[k]) / 2;
      for (const Int3& place : {cut.single.value_or(Int3{}), first, second, middle})
        points_.push_back(creases_.sampledAt(cut.side->corner, place));
    }
    sample();
    for (size_t i = 0; i < cut_off_.size(); ++i) {
      const CutOff& cut = cut_off_[i];
      SharpSide& side = *cut.side;
      const auto isOn = [&](size_t k) { return creases_.isOnSurface(samples_[4 * i + k]); };
      if (cut.first && cut.second && isOn(1) && isOn(2) && isOn(3) &&
          isSimple(creases_, side, *cut.first, *cut.second, grid_.cell)) {
        side.places = FacePlaces(*cut.first, *cut.second);
        if (!Surroundings(side, grid_.cell).areTogether()) side.places = {};
      }
      if (side.places.empty() && cut.single && isOn(0)) side.places = FacePlaces(*cut.single);
      if (!side.places.empty()) placed.push_back(&side);
    }
  }

  void sample() {
    samples_.resize(points_.size());
    if (!points_.empty()) field_(points_, samples_, Sampled::all);
  }

  const ChunkGrid& grid_;
  const FieldSampler& field_;
  const Creases& creases_;
  std::pmr::vector<Int3> points_;
  std::pmr::vector<FieldSample> samples_;
  std::pmr::vector<CutOff> cut_off_;
};

/// Places the face vertices of loop sides, without testing whether the rounded loops would intersect others. Returns
/// the sides that have positions. A side gets no positions if they would lie in two different squares adjacent to its
/// own, or if its own square is ambiguous, that is, if the surface passes through it twice.
std::pmr::vector<SharpSide*> placeAlone(const ChunkGrid& grid, const FieldSampler& field, const Creases& creases,
                                        std::span<SharpSide> sides, std::pmr::memory_resource* memory) {
  std::pmr::vector<SharpSide*> placed = SurfacePlaces(grid, field, creases, memory).give(sides, memory);
  std::pmr::vector<Int3> points(memory);
  for (const SharpSide* side : placed) {
    for (const int corner : {0, 1, 2, 3}) {
      points.push_back(side->corner);
      points.back()[(side->axis + 1) % 3] += (corner & 1) * grid.cell;
      points.back()[(side->axis + 2) % 3] += (corner >> 1) * grid.cell;
    }
  }
  std::pmr::vector<FieldSample> samples(points.size(), memory);
  if (!points.empty()) field(points, samples, Sampled::value);
  size_t kept = 0;
  for (size_t i = 0; i < placed.size(); ++i) {
    SharpSide& side = *placed[i];
    const auto isSolid = [&](size_t corner) { return samples[4 * i + corner].q < 0; };
    const bool is_ambiguous = isSolid(0) == isSolid(3) && isSolid(1) == isSolid(2) && isSolid(0) != isSolid(1);
    if (!is_ambiguous && Surroundings(side, grid.cell).areTogether()) {
      placed[kept++] = &side;
    } else {
      side.places = {};
    }
  }
  placed.resize(kept);
  return placed;
}

/// Removes the face vertices of loop sides whose rounded loops (mesh/sharp_loops.h) would intersect other loops.
class RoundedLoops {
 public:
  RoundedLoops(const ChunkGrid& grid, const FieldSampler& field, std::pmr::memory_resource* memory)
      : grid_(grid), field_(field), memory_(memory) {}

  void judge(std::span<SharpSide* const> placed, const RawVector<VertexKey>& keys) {
    const RoundedCells::PlaceAlone place_others = [this](const Creases& creases, std::span<SharpSide> others) {
      placeAlone(grid_, field_, creases, others, memory_);
    };
    RoundedCells rounded(grid_, field_, place_others, memory_);
    std::pmr::vector<Int3> points(memory_);
    std::pmr::vector<size_t> ends(memory_);  // for each placed loop side: end of the range of its corners in `points`
    for (const SharpSide* side : placed) {
      const Surroundings around(*side, grid_.cell);
      for (size_t i = 0; i < Surroundings::kCorners; ++i)
        if (const std::optional<Int3> corner = around.corner(i)) points.push_back(*corner);
      ends.push_back(points.size());
    }
    std::pmr::vector<FieldSample> samples(points.size(), memory_);
    if (!points.empty()) field_(points, samples, Sampled::value);
    for (size_t i = 0; i < placed.size(); ++i) {
      Surroundings around(*placed[i], grid_.cell);
      const size_t begin = i == 0 ? 0 : ends[i - 1];
      around.take({samples.data() + begin, ends[i] - begin});
      claim(*placed[i], around, keys, rounded);
    }
    rounded.judge();
  }

 private:
  static void claim(SharpSide& side, const Surroundings& around, const RawVector<VertexKey>& keys,
                    RoundedCells& rounded) {
    using Place = Surroundings::Place;
    std::array<Place, 1 + Surroundings::kAround.size()> others;
    size_t count = 0;
    if (around.passes(Place::beside)) others[count++] = Place::beside;
    for (const Place place : Surroundings::kAround)
      if (around.leavesPart() && around.passes(place)) others[count++] = place;
    for (const bool above : {false, true}) {
      const std::optional<std::array<int32_t, 8>> q = around.ofCell(above, Place::own);
      if (!q || (count == 0 && !hasTwoLoops(*q))) continue;
      rounded.add(side, keys[side.from], keys[side.to], above, *q);
      for (size_t i = 0; i < count; ++i)
        if (const auto beside = around.ofCell(above, others[i])) rounded.addBeside(around.stepTo(others[i]), *beside);
    }
  }

  const ChunkGrid& grid_;
  const FieldSampler& field_;
  std::pmr::memory_resource* memory_;
};

}  // namespace

std::pmr::vector<SharpSide> borderSides(const BodyLoops& body, const Creases& creases, const FieldSampler& field,
                                        std::pmr::memory_resource* memory) {
  const RawVector<VertexKey>& keys = body.part().keys;
  std::pmr::vector<SharpSide> sides(memory);
  for (const SurfaceLoop& loop : body.all()) {
    const Int3& cell = loop.cell;
    if (std::min({cell.x, cell.y, cell.z}) > 0 && std::max({cell.x, cell.y, cell.z}) < kChunkCells - 1) continue;
    for (uint32_t i = 0; i < loop.count; ++i) {
      const uint32_t a = loop.vertices[i], b = loop.vertices[(i + 1) % loop.count];
      if (!creases.isSharp(a, b)) continue;
      SharpSide side = sideBetween(a, b, keys);
      side.at_border = isAtBorder(body.grid(), side);
      if (side.at_border) sides.push_back(side);
    }
  }
  std::sort(sides.begin(), sides.end());
  placeBorderVertices(body.grid(), field, creases, keys, sides, memory);
  return sides;
}

void placeBorderVertices(const ChunkGrid& grid, const FieldSampler& field, const Creases& creases,
                         const RawVector<VertexKey>& keys, std::span<SharpSide> sides,
                         std::pmr::memory_resource* memory) {
  const std::pmr::vector<SharpSide*> placed = placeAlone(grid, field, creases, sides, memory);
  if (!placed.empty()) RoundedLoops(grid, field, memory).judge(placed, keys);
}

}  // namespace sgm

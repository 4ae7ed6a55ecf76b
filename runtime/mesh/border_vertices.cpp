#include "mesh/border_vertices.h"

#include <algorithm>
#include <cmath>

#include "mesh/rounded_cells.h"
#include "mesh/tables.h"

namespace sgm {
namespace {

/// In 1/256 of a cell: how far a face vertex may move for convenience.
constexpr int32_t kClose = 8;

/// Whether the square beside a side's is in the same face of the chunk.
bool isInFace(const SharpSide& side, int axis, int by, int32_t cell) {
  const int64_t square = floorDiv(side.corner[axis], cell);
  return floorDiv(square, kChunkCells) == floorDiv(square + by, kChunkCells);
}

/// Where a side's face vertices lie beside its own square.
struct Beside {
  CellStep step;  ///< to their square; by 0 if that is the side's own
  /// At which end of the edge between the squares: 1 or -1 where a face vertex lies nearer to the edges there than to
  /// the square's own, 0 where none does.
  int end = 0;
  bool is_one = true;  ///< false if they lie in two squares beside, or at both ends
};
Beside besideOf(const SharpSide& side) {
  Beside beside;
  for (const Int3& place : side.places.all()) {
    for (const int k : {(side.axis + 1) % 3, (side.axis + 2) % 3}) {
      const int32_t height = std::max(-place[k], place[k] - kSubcell), along = place[3 - side.axis - k];
      if (height <= 0) continue;
      const CellStep step{k, place[k] < 0 ? -1 : 1};
      const int end = height >= along ? -1 : height >= kSubcell - along ? 1 : 0;
      if (beside.step.by != 0 && !(step == beside.step)) beside.is_one = false;
      if (beside.end * end < 0) beside.is_one = false;
      beside.step = step;
      if (end != 0) beside.end = end;
    }
  }
  return beside;
}

/// The field at the corners of the two cells beside a side, and of what its face vertex may lie beside.
class Surroundings {
 public:
  /// Corner a + 2b + 4c lies a along u = (axis + 1) % 3, b along v = (axis + 2) % 3, and c - 1 along the axis of the
  /// face. Where the face vertex lies in another square, kFar + a + 2c lies at the far edge of that: a along the edge,
  /// c as before. The last two lie at the far edge of a third square, beside that one at the end at which the face
  /// vertex lies.
  static constexpr size_t kCorners = 20, kFar = 12, kThird = 18;

  Surroundings(const SharpSide& side, int32_t cell) : side_(side), cell_(cell), beside_(besideOf(side)) {}

  const CellStep& step() const { return beside_.step; }

  /// nullopt if the corner lies beyond the world or does not exist.
  std::optional<Int3> corner(size_t number) const {
    const int u = (side_.axis + 1) % 3, v = (side_.axis + 2) % 3;
    Int3 steps;
    if (number < kFar) {
      steps[u] = static_cast<int32_t>(number & 1);
      steps[v] = static_cast<int32_t>(number >> 1 & 1);
      steps[side_.axis] = static_cast<int32_t>(number >> 2) - 1;
    } else {
      const CellStep& beside = beside_.step;
      if (beside.by == 0) return std::nullopt;
      const int along = u + v - beside.axis;
      const auto is_second = static_cast<int32_t>(number & 1);
      if (number < kThird) {
        steps[beside.axis] = beside.by < 0 ? -1 : 2;
        steps[along] = is_second;
        steps[side_.axis] = static_cast<int32_t>((number - kFar) >> 1) - 1;
      } else {
        const int end = beside_.end;
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

  /// Whether the surface passes once through the side's square, and not through the third, where another face vertex
  /// might get in the way.
  bool passesOnce() const {
    if (!beside_.is_one) return false;
    if (isSolid(4) == isSolid(7) && isSolid(5) == isSolid(6) && isSolid(4) != isSolid(5)) return false;
    return !corner(kThird) || !passesThird();
  }
  /// Whether the face vertex lies in another square through which the surface passes.
  bool passesBeside() const {
    if (beside_.step.by == 0) return false;
    const std::array<size_t, 3> others{shared() + 3 - bitOf(beside_.step.axis), kFar + 2, kFar + 3};
    return std::any_of(others.begin(), others.end(), [&](size_t other) { return isSolid(other) != isSolid(shared()); });
  }

  /// The field at the corners of the cell below the face, or above it, as the case tables number them; nullopt if the
  /// cell reaches beyond the world, and has no surface. beside: of the cell beside that one, at the square of the face
  /// vertex.
  std::optional<std::array<int32_t, 8>> ofCell(bool above, bool beside) const {
    if (!corner(above ? kFar - 1 : 0) || (beside && !corner(above ? kThird - 1 : kFar))) return std::nullopt;
    const CellStep step = beside ? beside_.step : CellStep{};
    std::array<int32_t, 8> q{};
    for (size_t i = 0; i < 8; ++i) {
      const size_t level = (i >> 2) + (above ? 1 : 0);
      size_t from = (i & 3) + 4 * level;
      if (step.by != 0) {
        const size_t across = bitOf(step.axis), along = 3 - across;
        const bool is_high = (i & across) != 0, is_far = is_high == (step.by > 0);
        from = is_far ? kFar + ((i & along) != 0 ? 1 : 0) + 2 * level : from ^ across;
      }
      q[(i & 1) << (side_.axis + 1) % 3 | (i >> 1 & 1) << (side_.axis + 2) % 3 | i >> 2 << side_.axis] = q_[from];
    }
    return q;
  }

 private:
  bool isSolid(size_t corner) const { return q_[corner] < 0; }
  /// Whether the surface passes through the third square, which has two corners of the face vertex's.
  bool passesThird() const {
    const size_t at_end = beside_.end > 0 ? 1 : 0;
    const std::array<size_t, 3> others{kFar + 2 + at_end, kThird, kThird + 1};
    const size_t near = shared() + at_end * (3 - bitOf(beside_.step.axis));
    return std::any_of(others.begin(), others.end(), [&](size_t other) { return isSolid(other) != isSolid(near); });
  }
  /// Of a corner's number.
  size_t bitOf(int axis) const { return axis == (side_.axis + 1) % 3 ? 1 : 2; }
  /// A corner at the edge between the side's square and that of its face vertex, if it has another.
  size_t shared() const { return 4 + (beside_.step.by > 0 ? bitOf(beside_.step.axis) : 0); }

  const SharpSide& side_;
  int32_t cell_;
  Beside beside_;
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

/// Whether a side that goes from its one end to the other by way of two places does not cross itself.
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
  // The first and last pieces lie on the two sides of one of them.
  const bool apart =
      turn(from, first, second) * turn(from, first, to) > 0 || turn(second, to, from) * turn(second, to, first) > 0;
  return apart && turn(from, first, second) != 0 && turn(first, second, to) != 0;
}

/// Gives sides at the border their places, and returns those that have any.
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
  /// A side whose planes meet off the surface, with the places that its third plane may give it.
  struct CutOff {
    SharpSide* side;
    std::optional<Int3> single, first, second;
  };

  /// Where the planes of a side's ends meet.
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

  /// Where a third plane meets those of a side's ends, or on it.
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
        if (!besideOf(side).is_one) side.places = {};
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

/// Gives sides their places, as they have them if no rounded loop is in their way. Calls visit(side, surroundings) for
/// those that have any.
template <class Visit>
void placeAlone(const ChunkGrid& grid, const FieldSampler& field, const Creases& creases, std::span<SharpSide> sides,
                std::pmr::memory_resource* memory, const Visit& visit) {
  const std::pmr::vector<SharpSide*> placed = SurfacePlaces(grid, field, creases, memory).give(sides, memory);
  if (placed.empty()) return;
  std::pmr::vector<Int3> points(memory);
  points.reserve(placed.size() * Surroundings::kCorners);
  for (const SharpSide* side : placed) {
    const Surroundings around(*side, grid.cell);
    for (size_t i = 0; i < Surroundings::kCorners; ++i) points.push_back(around.corner(i).value_or(side->corner));
  }
  std::pmr::vector<FieldSample> samples(points.size(), memory);
  field(points, samples, Sampled::value);
  for (size_t i = 0; i < placed.size(); ++i) {
    SharpSide& side = *placed[i];
    Surroundings around(side, grid.cell);
    around.take({samples.data() + i * Surroundings::kCorners, Surroundings::kCorners});
    if (around.passesOnce()) {
      visit(side, around);
    } else {
      side.places = {};
    }
  }
}

}  // namespace

void placeBorderVertices(const ChunkGrid& grid, const FieldSampler& field, const Creases& creases,
                         const RawVector<VertexKey>& keys, std::span<SharpSide> sides,
                         std::pmr::memory_resource* memory) {
  const RoundedCells::PlaceAlone place_others = [&](const Creases& theirs, std::span<SharpSide> others) {
    placeAlone(grid, field, theirs, others, memory, [](SharpSide&, const Surroundings&) {});
  };
  RoundedCells rounded(grid, field, place_others, memory);
  placeAlone(grid, field, creases, sides, memory, [&](SharpSide& side, const Surroundings& around) {
    const bool has_beside = around.passesBeside();
    for (const bool above : {false, true}) {
      const std::optional<std::array<int32_t, 8>> q = around.ofCell(above, false);
      if (!q || (!has_beside && !hasTwoLoops(*q))) continue;
      rounded.add(side, keys[side.from], keys[side.to], above, *q);
      if (!has_beside) continue;
      if (const auto beside = around.ofCell(above, true)) rounded.addBeside(around.step(), *beside);
    }
  });
  rounded.judge();
}

}  // namespace sgm
